"""Every statement of the document, word by word: the DCC says in the same words what the pages say.

Values of the results stand as quantities with all their digits, and not in the rounded tables of the pages.
"""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree import ElementTree as ET

from zlmreport.plugin import (
    TRACEABLE,
    Block,
    Cell,
    Certificate,
    Explained,
    Facts,
    Formulas,
    Notice,
    Paragraph,
    RowGroup,
    Symbol,
    Table,
    Verdict,
    notation_spans,
)
from zlmreport_plugins.renderers.dcc.elements import dcc


def statements(certificate: Certificate) -> Iterator[ET.Element]:
    """Yield the statements, in the order of the pages and each once."""
    language = certificate.language.value
    instrument = certificate.job.keys.instrument if certificate.job else None
    number = instrument.certificate if instrument else None
    traceability = TRACEABLE.given(certificate=number or "").in_language(certificate.language)

    def content(text: str) -> ET.Element:
        return dcc("content", text, lang=language)

    def statement(name: str, text: str = "", items: tuple[str, ...] = ()) -> ET.Element:
        return dcc(
            "statement",
            dcc("name", content(name)) if name else None,
            dcc("traceable", "true") if text == traceability else None,
            dcc("declaration", content(text)) if text else None,
            dcc("data", *(dcc("text", content(each)) for each in items)) if items else None,
        )

    yield statement(certificate.title, certificate.subtitle)
    letterhead = certificate.letterhead
    if letterhead and letterhead.accreditation:
        yield statement(letterhead.laboratory.name, letterhead.accreditation)
    said: set[tuple[str, tuple[str, ...]]] = {("", ())}
    for title, blocks in _parts(certificate):
        for name, text, items in (each for block in blocks for each in _said(block, title)):
            if (text, items) not in said:
                said.add((text, items))
                yield statement(name, text, items)


def _parts(certificate: Certificate) -> Iterator[tuple[str, tuple[Block, ...]]]:
    """Yield the title and the blocks of each part, without the tables of results."""
    yield "", tuple(each for each in certificate.cover if not isinstance(each, Table))
    for section in certificate.sections:
        of_results = any(isinstance(each, Table) and _is_by_position(each) for each in section.blocks)
        blocks = section.blocks
        yield (
            section.title,
            tuple(each for each in blocks if not isinstance(each, Table)) if of_results else blocks,
        )


def _is_by_position(table: Table) -> bool:
    """Whether a table counts positions: its first column is headed by the symbol of their number."""
    return isinstance(table.columns[0].heading, Symbol)


def _said(block: Block, title: str) -> Iterator[tuple[str, str, tuple[str, ...]]]:
    """Yield what a block says: name, text, items; a graph says nothing that a table does not."""
    match block:
        case Paragraph(text):
            yield title, text, ()
        case Notice(heading, items):
            yield title, heading, items
        case Facts(pairs, heading):
            yield heading or title, "", tuple(f"{name}: {value}" for name, value in pairs)
        case Formulas(caption, rows):
            yield (
                title,
                caption,
                tuple(f"{_cell(left)} = {_cell(right)} ({name})" for left, right, name in rows),
            )
        case Table(caption, columns, groups):
            headings = tuple(" ".join(filter(None, (_cell(each.heading), each.unit))) for each in columns)
            yield title, caption, tuple(row for group in groups for row in _rows(group, headings))


def _rows(group: RowGroup, headings: tuple[str, ...]) -> Iterator[str]:
    before = f"{group.heading}: " if group.heading else ""
    if group.note:
        yield before + group.note
    for row in group.rows:
        cells = ((heading, _cell(cell)) for heading, cell in zip(headings, row, strict=True))
        yield before + "; ".join(f"{heading}: {cell}" for heading, cell in cells if cell)


def _cell(cell: Cell) -> str:
    match cell:
        case Symbol(notation):
            return "".join(span.text for span in notation_spans(notation))
        case Verdict(_, word):
            return word
        case Explained(name, meaning):
            return f"{name} ({meaning})" if meaning else name
        case str():
            return cell
