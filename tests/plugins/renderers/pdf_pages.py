"""A PDF read again: its pages' text, its structure, and the files that it carries."""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from io import BytesIO

from pypdf import PageObject, PdfReader
from pypdf.generic import DictionaryObject

from document.typesetting import samples
from installed import registry
from zlmreport.document.blocks import write_cell_text
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import Attachment, Certificate, Relationship, Section, Table

#: A number as it is printed; a standard's year and the like are among them.
NUMBER = re.compile(r"(?<![\w.,−])−?\d+(?:[.,]\d+)?(?![\w.,])")
#: Files for a certificate to carry.
ATTACHED = (
    Attachment("CAL-1.json", b"{}\n", "application/json", Relationship.DATA, "Results file"),
    Attachment("CAL-1.xml", b"<dcc/>\n", "application/xml", Relationship.ALTERNATIVE, "DCC"),
    Attachment("job.yaml", b"axis: {}\n", "application/yaml", Relationship.SOURCE, "Job: job.yaml"),
    Attachment("Prüfung ↑.csv", b"\x00\xff", "text/csv", Relationship.SOURCE, "Messwerte: Prüfung ↑.csv"),
)


def read(certificate: Certificate, press: str = "pdf") -> PdfReader:
    """Print a certificate in a format and open it."""
    return PdfReader(BytesIO(registry().renderer(press).render(certificate)))


@cache
def sample(language: Language = Language.ENGLISH, paper: str = "A4", *, press: str = "pdf") -> PdfReader:
    """The sample certificate, printed once for all tests that only look."""
    return read(samples.certificate(language, paper), press)


def with_blocks(*sections: Section) -> Certificate:
    """A certificate without a cover that has these sections."""
    return replace(samples.certificate(standards=0), cover=(), sections=sections)


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


def unspaced(text: str) -> str:
    """A text without its spaces, composed."""
    return "".join(unicodedata.normalize("NFC", text).split())


def specifications(reader: PdfReader) -> dict[str, DictionaryObject]:
    """The files that a PDF carries, by name."""
    listed = reader.root_object["/Names"]["/EmbeddedFiles"]["/Names"]
    return {each.get_object()["/UF"]: each.get_object() for each in listed[1::2]}


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
