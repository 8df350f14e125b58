"""Lines of text and symbols in the bundled typeface, measured and composed."""

from __future__ import annotations

from functools import lru_cache

from zlmreport.figures.canvas import Face, Label, Run
from zlmreport.figures.metrics import advance
from zlmreport.quantities.notation import Span, spans

#: Subscripts, as parts of the type size: their size, and how far they lie below the line.
_SUBSCRIPT_SIZE = 0.72
_SUBSCRIPT_DROP = 0.2


def plain_label(text: str, size: float, face: Face = Face.REGULAR) -> Label:
    """Return a line of words or a number."""
    return Label((Run(text, face, size, 0.0, 0.0),), size * advance(text, face), size)


@lru_cache(maxsize=1024)
def symbol_label(notation: str, size: float) -> Label:
    """Return a symbol or a formula as `zlmreport.quantities.notation` writes it."""
    runs = []
    end = 0.0
    for span in spans(notation):
        run = _run(span, size, end)
        runs.append(run)
        end += run.size * advance(run.text, run.face)
    return Label(tuple(runs), end, size)


def _run(span: Span, size: float, start: float) -> Run:
    face = Face.ITALIC if span.italic else Face.REGULAR
    if span.subscript:
        return Run(span.text, face, size * _SUBSCRIPT_SIZE, start, size * _SUBSCRIPT_DROP)
    return Run(span.text, face, size, start, 0.0)
