"""Tables as data: columns shared out and numbers aligned as in every other renderer."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import repeat
from math import inf
from typing import Any

from zlmreport.plugin import (
    Align,
    Cell,
    Explained,
    FontFace,
    Formulas,
    Mark,
    Symbol,
    Table,
    Verdict,
    decimal_padding,
    table_layout,
)
from zlmreport_plugins.renderers.pdf_typst.words import fitted, symbol_data

#: Width of a figure, and of a decimal sign, in em: all figures of the typeface are of one width.
_FIGURE = 0.6
_DECIMAL_SIGN = 0.272

#: Space at both sides of a cell, further space before words after numbers, and the mark of a verdict, in em.
_PADDING = 0.9
_APART = 1.15
_BADGE = 1.5
#: Size of the small type below a name.
_SMALL = 0.9
#: Width of a group's heading.
_GROUP = 50.0
#: Characters of a cell that fits on a page for certain.
_LONG_CELL = 400

_SHAPE = {Mark.MET: "met", Mark.NOT_MET: "not-met", Mark.OPEN: "open"}


def table_data(table: Table) -> dict[str, Any]:
    """Return the columns and rows of a table."""
    columns_data = _columns(
        table, [group.rows for group in table.groups], [column.align for column in table.columns]
    )
    rooms = columns_data.pop("rooms")
    padding = iter(decimal_padding(table))
    return {
        **columns_data,
        "align": [column.align.value for column in table.columns],
        "headings": [
            {"content": _cell(column.heading, room, face=FontFace.SEMIBOLD), "unit": column.unit}
            for column, room in zip(table.columns, rooms, strict=True)
        ],
        "groups": [
            {
                "heading": fitted(group.heading, _GROUP, FontFace.SEMIBOLD),
                "note": fitted(group.note, _GROUP),
                "section": group.section,
                "rows": [_row(row, rooms, next(padding)) for row in group.rows],
            }
            for group in table.groups
        ],
    }


def formulas_data(formulas: Formulas) -> dict[str, Any]:
    """Return definitions, which are set as a table without headings."""
    columns_data = _columns(formulas, [formulas.rows], [Align.LEFT] * 3)
    rooms = columns_data.pop("rooms")
    return {**columns_data, "rows": [_row(row, rooms) for row in formulas.rows]}


def _columns(
    block: Table | Formulas, groups: Sequence[Sequence[Sequence[Cell]]], alignments: Sequence[Align]
) -> dict[str, Any]:
    """Return how columns share the page, and `rooms`: the width that each leaves for words, in em.

    Columns of numbers were made wide enough for each of them, and never part one.
    """
    layout = table_layout(block)
    return {
        "size": layout.size,
        "widths": layout.widths,
        "apart": layout.apart,
        "whole": layout.is_whole,
        "in-fives": layout.in_fives,
        "breakable": any(_is_long(cell) for rows in groups for row in rows for cell in row),
        "rooms": [
            inf if align is Align.RIGHT else room - _PADDING - (_APART if apart else 0.0)
            for room, align, apart in zip(layout.rooms, alignments, layout.apart, strict=True)
        ],
    }


def _is_long(cell: Cell) -> bool:
    """Return whether a row with this cell might fill more than a page."""
    match cell:
        case str():
            return len(cell) > _LONG_CELL
        case Explained(name, meaning):
            return len(name) + len(meaning) > _LONG_CELL
        case _:
            return False


def _row(row: Sequence[Cell], rooms: Sequence[float], padding: Iterable[str] = repeat("")) -> list[Any]:
    return [_cell(cell, room, lacking) for cell, room, lacking in zip(row, rooms, padding, strict=False)]


def _cell(cell: Cell, room: float, padding: str = "", face: FontFace = FontFace.REGULAR) -> Any:
    """Return a cell: a text as it stands, and what is more than a text with its kind."""
    match cell:
        case Symbol(notation):
            return symbol_data(notation)
        case Verdict(mark, word):
            return {"kind": "verdict", "shape": _SHAPE[mark], "word": fitted(word, room - _BADGE)}
        case Explained(name, meaning):
            return {
                "kind": "explained",
                "name": fitted(name, room),
                "meaning": fitted(meaning, room / _SMALL),
            }
        case text if padding:
            return {"kind": "number", "text": text, "gap": _gap(padding)}
        case text:
            return fitted(text, room, face)


def _gap(padding: str) -> float:
    """Return how far left of the column's end a number stands, in em, for the decimals that it lacks."""
    kind, _, lacking = padding.partition("-")
    return int(lacking) * _FIGURE + (_DECIMAL_SIGN if kind == "whole" else 0.0)
