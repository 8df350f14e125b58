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
from zlmreport.web.panels import split_symbol


def _collect_section(section: Section, names: Naming) -> dict[str, Any]:
    """Return a section in the language of its names, which stand in place of identifiers of effects."""
    return {
        "key": section.key,
        "title": section.title,
        "blocks": collect_blocks(section.blocks, names),
    }


def collect_blocks(blocks: Iterable[Block], names: Naming) -> list[dict[str, Any]]:
    """Return blocks one after the other."""
    return [_make_block(each, names) for each in blocks]


def _make_block(block: Block, names: Naming) -> dict[str, Any]:
    match block:
        case Paragraph(text, mark):
            return {
                "kind": "paragraph",
                "text": names.name_in(text),
                "mark": mark.name.lower() if mark else "",
            }
        case Notice(heading, items):
            said = [names.name_in(each) for each in items]
            return {"kind": "notice", "heading": heading, "items": said}
        case Facts(pairs):
            return {"kind": "facts", "pairs": [list(each) for each in pairs]}
        case Table():
            return _make_table(block, names)
        case Formulas(caption, rows):
            cells = [[_make_cell(each, names) for each in row] for row in rows]
            groups = [{"heading": "", "rows": cells}]
            return {"kind": "table", "caption": caption, "columns": [], "groups": groups}
        case Graph(figure):
            image = ET.fromstring(to_svg(figure, names.language))  # noqa: S314 - drawn by this program
            return {
                "kind": "graph",
                "caption": figure.title.in_language(names.language),
                "drawing": _make_drawing(image),
            }


def _make_table(table: Table, names: Naming) -> dict[str, Any]:
    """Return a table with the columns that hold anything."""
    rows = [row for group in table.groups for row in group.rows]
    shown = [number for number in range(len(table.columns)) if any(row[number] != "" for row in rows)]
    return {
        "kind": "table",
        "caption": names.name_in(table.caption),
        "columns": [
            {
                "heading": _make_cell(column.heading, names),
                "unit": column.unit,
                "right": column.align is Align.RIGHT,
            }
            for column in (table.columns[number] for number in shown)
        ],
        "groups": [
            {
                "heading": names.name_in(group.heading),
                "rows": [[_make_cell(row[number], names) for number in shown] for row in group.rows],
            }
            for group in table.groups
        ],
    }


def _make_cell(cell: Cell, names: Naming) -> dict[str, Any]:
    match cell:
        case Symbol(notation):
            return {"symbol": split_symbol(notation)}
        case Verdict(mark, word):
            return {"text": word, "mark": mark.name.lower()}
        case Explained(name, meaning):
            return {"text": name, "meaning": meaning}
        case _:
            return {"text": names.name_in(cell)}


def _make_drawing(element: ET.Element) -> list[Any]:
    """Return an element of a drawing: its name, attributes, and what it holds."""
    inside = [_make_drawing(each) for each in element]
    name = element.tag.rpartition("}")[2]
    return [name, dict(element.attrib), inside or (element.text or "").strip()]


def list_all_sections(sections: Iterable[Section | None], names: Naming) -> list[dict[str, Any]]:
    """Return the sections that there are."""
    return [_collect_section(each, names) for each in sections if each]
