"""Whether two embedded fonts show the same: a font that draws a 3 for a 2 leaves a page's text as it is."""

from __future__ import annotations

import re
from collections.abc import Hashable, Mapping
from io import BytesIO
from itertools import count
from typing import Any

_MAPPED = re.compile(rb"<([0-9a-fA-F]{4})>\s*<([0-9a-fA-F]+)>")


def show_the_same(font: Any, again: Any, *, completely: bool) -> bool:
    """Compare two fonts glyph by glyph: their shape, their width, and the text that they stand for.

    Which other glyphs and tables a font has depends on the library that packed it.

    Parameters
    ----------
    font, again
        Fonts of pypdf, of the certificate and of the one printed again.
    completely
        Whether every glyph of the font printed again must be there; otherwise those that both have count.
    """
    glyphs, glyphs_again = _glyphs(font), _glyphs(again)
    codes = glyphs_again.keys() if completely else glyphs_again.keys() & glyphs.keys()
    return all(glyphs.get(code) == glyphs_again[code] for code in codes)


def _glyphs(font: Any) -> Mapping[int, Hashable]:
    """Return text, width and outline of each glyph that a font says a text of, by its code."""
    from fontTools.pens.recordingPen import RecordingPen  # noqa: PLC0415 - slow to load
    from fontTools.ttLib import TTFont  # noqa: PLC0415 - slow to load

    descendant = font["/DescendantFonts"][0].get_object()
    program = TTFont(BytesIO(descendant["/FontDescriptor"]["/FontFile2"].get_data()), lazy=True)
    shapes, names = program.getGlyphSet(), program.getGlyphOrder()
    widths = _widths(descendant["/W"])
    found: dict[int, Hashable] = {}
    for code, text in _MAPPED.findall(font["/ToUnicode"].get_data()):
        number = int(code, 16)
        pen = RecordingPen()
        shapes[names[number]].draw(pen)
        found[number] = (text.lower(), widths.get(number), repr(pen.value))
    return found


def _widths(entries: Any) -> dict[int, float]:
    """Return the widths of glyphs as a PDF lists them: a code, and the widths from there on."""
    found: dict[int, float] = {}
    for first, widths in zip(entries[::2], entries[1::2], strict=True):
        found.update(zip(count(int(first)), map(float, widths), strict=False))
    return found
