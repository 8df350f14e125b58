"""Blocks as values for a browser: a page lays out what terminal and certificate say, and adds nothing."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any
from xml.etree import ElementTree as ET

from zlmreport.document.blocks import (
    Align,
    Block,
    Cell,
    Explained,
    Facts,
    Formulas,
    Graph,
    Notice,
    Paragraph,
    Section,
    Symbol,
    Table,
    Verdict,
)
from zlmreport.document.figures.draw import to_svg
from zlmreport.web.naming import Naming
from zlmreport.web.panels import symbol


def section_values(section: Section, names: Naming) -> dict[str, Any]:
    """Return a section in the language of its names, which stand in place of identifiers of effects."""
    return {
        "key": section.key,
        "title": section.title,
        "blocks": blocks_values(section.blocks, names),
    }


def blocks_values(blocks: Iterable[Block], names: Naming) -> list[dict[str, Any]]:
    """Return blocks one after the other."""
    return [_block(each, names) for each in blocks]


def _block(block: Block, names: Naming) -> dict[str, Any]:
    match block:
        case Paragraph(text, mark):
            return {"kind": "paragraph", "text": names.text(text), "mark": mark.name.lower() if mark else ""}
        case Notice(heading, items):
            said = [names.text(each) for each in items]
            return {"kind": "notice", "heading": heading, "items": said}
        case Facts(pairs):
            return {"kind": "facts", "pairs": [list(each) for each in pairs]}
        case Table():
            return _table(block, names)
        case Formulas(caption, rows):
            cells = [[_cell(each, names) for each in row] for row in rows]
            return {"kind": "table", "caption": caption, "columns": [], "rows": cells}
        case Graph(figure):
            image = ET.fromstring(to_svg(figure, names.language))  # noqa: S314 - drawn by this program
            return {
                "kind": "graph",
                "caption": figure.title.in_language(names.language),
                "drawing": _drawing(image),
            }


def _table(table: Table, names: Naming) -> dict[str, Any]:
    """Return a table with the columns that hold anything."""
    rows = [row for group in table.groups for row in group.rows]
    shown = [number for number in range(len(table.columns)) if any(row[number] != "" for row in rows)]
    return {
        "kind": "table",
        "caption": names.text(table.caption),
        "columns": [
            {
                "heading": _cell(column.heading, names),
                "unit": column.unit,
                "right": column.align is Align.RIGHT,
            }
            for column in (table.columns[number] for number in shown)
        ],
        "rows": [[_cell(row[number], names) for number in shown] for row in rows],
    }


def _cell(cell: Cell, names: Naming) -> dict[str, Any]:
    match cell:
        case Symbol(notation):
            return {"symbol": symbol(notation)}
        case Verdict(mark, word):
            return {"text": word, "mark": mark.name.lower()}
        case Explained(name, meaning):
            return {"text": name, "meaning": meaning}
        case _:
            return {"text": names.text(cell)}


def _drawing(element: ET.Element) -> list[Any]:
    """Return an element of a drawing: its name, attributes, and what it holds."""
    inside = [_drawing(each) for each in element]
    name = element.tag.rpartition("}")[2]
    return [name, dict(element.attrib), inside or (element.text or "").strip()]


def all_sections(sections: Iterable[Section | None], names: Naming) -> list[dict[str, Any]]:
    """Return the sections that there are."""
    return [section_values(each, names) for each in sections if each]
