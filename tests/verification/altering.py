"""Ways to take a PDF apart and to put it together otherwise, object by object."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from io import BytesIO
from typing import Any

import pikepdf
from fontTools.ttLib import TTFont
from pikepdf import Array, Dictionary, Name, Pdf, Stream

Change = Callable[[Pdf], None]


def rewritten(pdf: bytes, change: Change) -> bytes:
    """Return a PDF as another program saves it, after a change."""
    saved = BytesIO()
    with warnings.catch_warnings(), pikepdf.open(BytesIO(pdf)) as opened:
        warnings.simplefilter("ignore")  # what is made here is meant to be odd
        change(opened)
        opened.save(saved, fix_metadata_version=False)
    return saved.getvalue()


def page_of(pdf: Pdf, number: int = 1) -> Dictionary:
    """Return a page, counted from 1."""
    return pdf.pages[number - 1].obj


def draw(pdf: Pdf, page: Dictionary, content: bytes) -> None:
    """Draw something over what a page has, in its own coordinates: points, from the lower left corner."""
    old = page.Contents.read_bytes()
    page.Contents = pdf.make_stream(b"q\n" + old + b"\nQ\n" + content + b"\n")


def fonts(page: Dictionary) -> list[Dictionary]:
    """Return the fonts of a page that have digits."""
    return [font for font in page.Resources.Font.values() if {"1", "9"} <= codes(font).keys()]


def codes(font: Dictionary) -> dict[str, int]:
    """Return the code of each character of a font."""
    table = font.ToUnicode.read_bytes()
    pairs = re.findall(rb"<([0-9a-fA-F]{4})>\s*<([0-9a-fA-F]{4})>\s*\n", table)
    return {bytes.fromhex(text.decode()).decode("utf-16-be"): int(code, 16) for code, text in pairs}


def descendant(font: Dictionary) -> Dictionary:
    return font.DescendantFonts[0]


def every_font(pdf: Pdf) -> Iterator[Dictionary]:
    """Yield each font of the pages that has digits once."""
    seen = set()
    for page in pdf.pages:
        for font in fonts(page.obj):
            if font.objgen not in seen:
                seen.add(font.objgen)
                yield font


def with_program(font: Dictionary, change: Callable[[TTFont], None]) -> None:
    """Change the program of a font."""
    holder = descendant(font).FontDescriptor
    program, packed = TTFont(BytesIO(holder.FontFile2.read_bytes())), BytesIO()
    change(program)
    program.save(packed)
    holder.FontFile2.write(packed.getvalue())


def glyph(program: TTFont, font: Dictionary, character: str) -> str:
    """Return the name of the glyph of a character."""
    return program.getGlyphOrder()[codes(font)[character]]


def form(pdf: Pdf, content: bytes, **entries: Any) -> Stream:
    """Return a form that draws."""
    return Stream(
        pdf,
        content,
        Type=Name.XObject,
        Subtype=Name.Form,
        BBox=Array([0, 0, 600, 850]),
        Resources=Dictionary(),
        **entries,
    )


def annotate(pdf: Pdf, page: Dictionary, **entries: Any) -> Dictionary:
    """Put an annotation on a page and return it."""
    annotation = pdf.make_indirect(
        Dictionary(Type=Name.Annot, Rect=Array([100, 600, 300, 700]), F=4, **entries)
    )
    if "/Annots" not in page:
        page.Annots = Array()
    page.Annots.append(annotation)
    return annotation


def script(text: str = "app.alert(1)") -> Dictionary:
    return Dictionary(S=Name.JavaScript, JS=text)


@dataclass(frozen=True)
class Forgery:
    """A way to alter a certificate.

    Attributes
    ----------
    name
        In a word or two.
    seen
        What a reader sees, hears or finds then.
    make
        Returns the altered PDF.
    """

    name: str
    seen: str
    make: Callable[[bytes], bytes]
