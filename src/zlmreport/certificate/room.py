"""How much of a page blocks take in a compact document, so that it is decided before it is set.

The estimate follows the style sheets (``.compact``) and the widths of the typeface; it is on the high side.
Lengths are in points.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import ceil

from zlmreport.certificate import columns
from zlmreport.certificate.document import (
    Block,
    Facts,
    Formulas,
    Graph,
    Letterhead,
    Notice,
    Paragraph,
    Table,
    Verdict,
)

#: In points.
MILLIMETRE = 72 / 25.4
#: The mark at the end of a document.
END_MARK = 22.0
#: What stands between the margins of a page of each paper, but for that mark.
PAGES = {
    paper: (height - 21 - 19) * MILLIMETRE - END_MARK for paper, height in (("A4", 297.0), ("Letter", 279.4))
}
#: What the first page has besides, for it has no running head.
OF_FIRST = 6 * MILLIMETRE

_EM = 8.1
_LINE = 1.3 * _EM
_SMALL = 0.944
_DENSE = 0.811
#: Em of a page, with some words too long to end a line.
_PAGE_EM = 57.0
_NOTICE_EM = 52.0
#: What the mark of a verdict adds to its row.
_MARK = 1.3
#: What parts five rows from the next.
_FIVE = 4.6
_HEADING = 14.0 + 2.5 + 5.0
_LOGO = 31.0
#: Em of the names and values of facts in one of two columns.
_NAME_EM, _VALUE_EM = 9.9, 16.8
_FACTS_MARGIN = 4.0
_USUAL_GRAPH = 60 * MILLIMETRE


def height(blocks: Iterable[Block]) -> float:
    """Return how high blocks stand, one below the other, facts that follow each other in two columns."""
    return sum(map(_height, columns.gather_facts(blocks)))


def head(letterhead: Letterhead | None, title: str) -> float:
    """Return how high the letterhead and the title stand, with what the first page has besides."""
    room = _lines(title, 26.0) * 17.5 + _LINE * 1.1 + 7.0
    if letterhead:
        beside = ", ".join((*letterhead.laboratory.lines, letterhead.accreditation))
        text = 13.8 + 9.8 * _lines(beside, 40.0)
        room += max(text, _LOGO if letterhead.logo else 0.0) + 10.2
    return room - OF_FIRST


def heading(title: str) -> float:
    """Return how high the heading of a section stands that begins a page."""
    return _HEADING + (_lines(title, 38.0) - 1) * 14.0


def _height(block: columns.GatheredBlock) -> float:
    match block:
        case Table():
            return _table(block)
        case Formulas(rows=rows):
            return 25.0 + len(rows) * (_DENSE * _LINE + 3.4)
        case Graph(figure):
            drawing = figure.height * MILLIMETRE if figure.height else _USUAL_GRAPH * len(figure.panels)
            return drawing + 10.0 + _SMALL * _LINE
        case Paragraph(text):
            return _lines(text, _PAGE_EM) * _LINE + 3.0
        case Notice(title, items):
            lines = sum(_lines(item, _NOTICE_EM) for item in items) + _lines(title, _NOTICE_EM)
            return lines * _LINE + 1.5 * len(items) + 19.0
        case facts:
            return _FACTS_MARGIN + max(map(_facts, columns.side_by_side(facts)))


def _table(table: Table) -> float:
    layout = columns.table_layout(table)
    rows = [row for group in table.groups for row in group.rows]
    em = {"regular": _SMALL, "dense": _DENSE}.get(layout.size, _DENSE) * _EM
    head_lines = 2 if any(column.unit for column in table.columns) else 1
    head = _lines(table.caption, _PAGE_EM) * _SMALL * _LINE + 3.0 + head_lines * 1.25 * em + 5.0
    between = len(rows) * (3.0 if layout.size == "regular" else 1.4)
    between += len(rows) // 5 * _FIVE if layout.in_fives else 0.0
    between += _MARK * sum(any(isinstance(cell, Verdict) for cell in row) for row in rows)
    return head + layout.lines * 1.3 * em + between + 8.0


def _facts(groups: tuple[Facts, ...]) -> float:
    room = 0.0
    for group in groups:
        room += _LINE + 2.0 if group.heading else 0.0
        room += sum(
            max(_lines(name, _NAME_EM), sum(_lines(line, _VALUE_EM) for line in value.split("\n"))) * _LINE
            + 1.6
            for name, value in group.pairs
        )
    return room


def _lines(text: str, room: float) -> int:
    return max(1, ceil(columns.width_of(text) / room))
