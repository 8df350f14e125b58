"""Widths of text in the bundled fonts (HarfBuzz), and labels of symbols with subscripts.

No library that draws is needed; each font file is read once, when its first text is set.
"""

from __future__ import annotations

from functools import cache, lru_cache
from importlib.resources import files
from pathlib import Path
from typing import Any
from unicodedata import normalize

from zlmreport.document.figures.canvas import Label, Run, TypeFace
from zlmreport.language.formatting import Span, split_spans


@cache
def find_font_file(face: TypeFace) -> Path:
    """Return the path of a face's file: fonts of the system are never used."""
    return Path(str(files("zlmreport_templates").joinpath("fonts", f"{face.value}.ttf")))


@lru_cache(maxsize=4096)
def measure_advance(text: str, face: TypeFace) -> float:
    """Return how far a text of size 1 moves the pen."""
    glyphs = _shape_text(normalize("NFC", text), face).glyph_positions or ()  # none of an empty text
    units = sum(each.x_advance for each in glyphs)
    return float(units / _load_font(face).face.upem)


def mark_offset(letter: str, mark: str, face: TypeFace) -> tuple[float, float]:
    """Return how far right of a letter's pen, and above it, that of a mark on it stands, at size 1."""
    of_letter, on_letter = _shape_text(letter + mark, face).glyph_positions
    _, unplaced = _shape_text(letter + mark, face, mark=False).glyph_positions
    em = _load_font(face).face.upem
    if (on_letter.x_offset, on_letter.y_offset) == (unplaced.x_offset, unplaced.y_offset):
        raise LookupError(f"no place for U+{ord(mark):04X} on {letter!r}")
    return (of_letter.x_advance + on_letter.x_offset) / em, on_letter.y_offset / em


def has_letter(letter: str, face: TypeFace) -> bool:
    """Return whether a face has a shape for a letter."""
    return _load_font(face).get_nominal_glyph(ord(letter)) is not None


@cache
def _load_font(face: TypeFace) -> Any:
    import uharfbuzz  # noqa: PLC0415 - only where a text is set

    return uharfbuzz.Font(uharfbuzz.Face(uharfbuzz.Blob.from_file_path(str(find_font_file(face)))))


def _shape_text(text: str, face: TypeFace, **features: bool) -> Any:
    """Return the glyphs of a text in the order of the line: mixed directions have no place on a graph."""
    import uharfbuzz  # noqa: PLC0415 - the same

    buffer = uharfbuzz.Buffer()
    buffer.add_str(text)
    buffer.direction, buffer.script, buffer.language = "ltr", "Latn", "en"
    # A mark stays a glyph of its own, as it is drawn.
    uharfbuzz.shape(_load_font(face), buffer, {"ccmp": False, "locl": False, **features})
    return buffer


#: Subscripts, as parts of the type size: their size, and how far they lie below the line.
_SUBSCRIPT_SIZE = 0.72
_SUBSCRIPT_DROP = 0.2


def make_plain_label(text: str, size: float, face: TypeFace = TypeFace.REGULAR) -> Label:
    """Return a line of words or a number."""
    return Label((Run(text, face, size, 0.0, 0.0),), size * measure_advance(text, face), size)


@lru_cache(maxsize=1024)
def make_symbol_label(notation: str, size: float) -> Label:
    """Return a symbol or a formula as `zlmreport.language.formatting` writes it."""
    runs = []
    end = 0.0
    for span in split_spans(notation):
        run = _run(span, size, end)
        runs.append(run)
        end += run.size * measure_advance(run.text, run.face)
    return Label(tuple(runs), end, size)


def _run(span: Span, size: float, start: float) -> Run:
    face = TypeFace.ITALIC if span.italic else TypeFace.REGULAR
    if span.subscript:
        return Run(span.text, face, size * _SUBSCRIPT_SIZE, start, size * _SUBSCRIPT_DROP)
    return Run(span.text, face, size, start, 0.0)
