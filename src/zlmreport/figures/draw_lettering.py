"""Lines of text and symbols in the bundled typeface, measured and composed."""

from __future__ import annotations

import threading
from functools import cache, lru_cache
from importlib.resources import files
from pathlib import Path

from matplotlib.ft2font import FT2Font, LoadFlags

from zlmreport.figures.canvas import Face, Label, Run
from zlmreport.quantities.notation import Span, spans

#: Subscripts, as parts of the type size: their size, and how far they lie below the line.
_SUBSCRIPT_SIZE = 0.72
_SUBSCRIPT_DROP = 0.2
#: Fonts are measured at this size, where a unit of the font is a hundredth of a point, and scaled.
_MEASURING_SIZE = 1000.0


@cache
def font_file(face: Face) -> Path:
    """Return the path of a face's file: fonts of the system are never used."""
    return Path(str(files("zlmreport_templates").joinpath("fonts", f"{face.value}.ttf")))


class _Fonts(threading.local):
    """The faces that a thread has opened: measuring a text changes the font that measures."""

    def __init__(self) -> None:
        self._opened: dict[Face, FT2Font] = {}

    def __getitem__(self, face: Face) -> FT2Font:
        if face not in self._opened:
            self._opened[face] = FT2Font(str(font_file(face)))
            self._opened[face].set_size(_MEASURING_SIZE, 72)
        return self._opened[face]


_fonts = _Fonts()


@lru_cache(maxsize=4096)
def _advance(text: str, face: Face) -> float:
    """Return how far a text of size 1 moves the pen."""
    font = _fonts[face]
    font.set_text(text, 0.0, flags=LoadFlags.NO_HINTING)
    width, _ = font.get_width_height()
    return float(width / 64 / _MEASURING_SIZE)


def plain_label(text: str, size: float, face: Face = Face.REGULAR) -> Label:
    """Return a line of words or a number."""
    return Label((Run(text, face, size, 0.0, 0.0),), size * _advance(text, face), size)


@lru_cache(maxsize=1024)
def symbol_label(notation: str, size: float) -> Label:
    """Return a symbol or a formula as `zlmreport.quantities.notation` writes it."""
    runs = []
    end = 0.0
    for span in spans(notation):
        run = _run(span, size, end)
        runs.append(run)
        end += run.size * _advance(run.text, run.face)
    return Label(tuple(runs), end, size)


def _run(span: Span, size: float, start: float) -> Run:
    face = Face.ITALIC if span.italic else Face.REGULAR
    if span.subscript:
        return Run(span.text, face, size * _SUBSCRIPT_SIZE, start, size * _SUBSCRIPT_DROP)
    return Run(span.text, face, size, start, 0.0)
