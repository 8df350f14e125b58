"""Embeds fonts with the glyphs of the document alone, alike on every machine.

WeasyPrint 70 takes them out by HarfBuzz where the system has its library for that, and by fontTools where it
has none: other bytes for the same job. fontTools comes with the program, so it is always the one; and no time
of the day is written into the font, as it would be of itself.
"""

from __future__ import annotations

from collections.abc import Collection
from io import BytesIO
from typing import Any

from fontTools.subset import Options, Subsetter
from fontTools.ttLib import TTFont
from weasyprint.pdf.fonts import Font

#: How letters are put together is settled when a page is set: nothing is drawn by these.
_NOT_DRAWN_BY = ("BASE", "DSIG", "GDEF", "GPOS", "GSUB", "JSTF", "SVG ", "kern")


def settle() -> None:
    """Make WeasyPrint take glyphs out of fonts by fontTools in this process."""
    Font.subset = _subset_font


def keep_glyphs(
    content: bytes,
    glyphs: Collection[int],
    number: int = 0,
    *,
    hinting: bool = False,
    has_missing: bool = False,
) -> bytes:
    """Return a font program with some glyphs, under their old numbers.

    `number`: Of the font in a collection.
    `hinting`: Whether the programs that fit outlines to pixels are kept.
    `has_missing`: Whether characters without a glyph are drawn as a box.
    """
    options = Options(
        retain_gids=True,
        passthrough_tables=True,
        ignore_missing_glyphs=True,
        hinting=hinting,
        desubroutinize=True,
        notdef_outline=has_missing,
    )
    options.drop_tables += _NOT_DRAWN_BY
    subsetter = Subsetter(options)
    subsetter.populate(gids=glyphs)
    font, packed = TTFont(BytesIO(content), fontNumber=number, recalcTimestamp=False, lazy=True), BytesIO()
    subsetter.subset(font)
    font.save(packed)
    return packed.getvalue()


def _subset_font(font: Any, to_unicode: dict[int, str], hinting: bool) -> None:  # noqa: FBT001 - as WeasyPrint has it
    """Take out of a font of WeasyPrint what a document does not use."""
    if to_unicode:
        font.file_content = keep_glyphs(
            font.file_content,
            to_unicode,
            font.index,
            hinting=hinting,
            has_missing=bool(font.missing),
        )
