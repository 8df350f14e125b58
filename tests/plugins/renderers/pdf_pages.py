"""A PDF read again: its pages' text and its structure."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from functools import cache
from io import BytesIO

from pypdf import PageObject, PdfReader
from pypdf.generic import DictionaryObject

from document.typesetting import samples
from installed import registry
from zlmreport.document.blocks import write_cell_text
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import Certificate, Table

#: A number as it is printed; a standard's year and the like are among them.
NUMBER = re.compile(r"(?<![\w.,−])−?\d+(?:[.,]\d+)?(?![\w.,])")


def read(certificate: Certificate) -> PdfReader:
    """Print a certificate and open it."""
    return PdfReader(BytesIO(registry().renderer("pdf").render(certificate)))


@cache
def sample(language: Language = Language.ENGLISH, paper: str = "A4") -> PdfReader:
    """The sample certificate, printed once for all tests that only look."""
    return read(samples.certificate(language, paper))


@cache
def texts(reader: PdfReader) -> tuple[str, ...]:
    """The text of each page."""
    return tuple(page.extract_text() for page in reader.pages)


def printed_numbers(text: str) -> Counter[str]:
    """All numbers in a text."""
    return Counter(NUMBER.findall(text))


def numbers_of(certificate: Certificate) -> Counter[str]:
    """All numbers in the cells of a certificate's tables."""
    blocks = (*certificate.cover, *(block for section in certificate.sections for block in section.blocks))
    tables = [block for block in blocks if isinstance(block, Table)]
    cells = (
        write_cell_text(cell)
        for table in tables
        for group in table.groups
        for row in group.rows
        for cell in row
    )
    return Counter(cell for cell in cells if NUMBER.fullmatch(cell))


def page_of(reader: PdfReader, text: str) -> int:
    """The number of the one page that has this text, from 1."""
    pages = [number for number, page in enumerate(texts(reader), start=1) if text in page]
    assert len(pages) == 1, f"{text!r} stands on pages {pages}"
    return pages[0]


def elements(reader: PdfReader, kind: str) -> Iterator[DictionaryObject]:
    """The elements of a kind in the document's structure: ``/Figure``, ``/TH``."""

    def walk(node: object) -> Iterator[DictionaryObject]:
        if not isinstance(node, DictionaryObject):
            return
        if node.get("/S") == kind:
            yield node
        children = node.get("/K")
        for child in children if isinstance(children, list) else [children]:
            yield from walk(child.get_object() if hasattr(child, "get_object") else child)

    yield from walk(reader.trailer["/Root"]["/StructTreeRoot"].get_object())


def fonts(page: PageObject) -> Iterator[DictionaryObject]:
    """The fonts that a page uses."""
    for font in page["/Resources"]["/Font"].values():
        yield font.get_object()
