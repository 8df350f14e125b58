"""What the templates of tables are given."""

from __future__ import annotations

from zlmreport.certificate.document import (
    Align,
    Cell,
    Column,
    Explained,
    Formulas,
    Mark,
    RowGroup,
    Symbol,
    Table,
    Verdict,
)
from zlmreport.typesetting import columns
from zlmreport.typesetting.contexts import CellContext, FormulasContext, RowGroupContext, TableContext
from zlmreport.typesetting.templates import symbol

#: A table of no more lines is not parted by the end of a page.
_WHOLE_LINES = 16

_SHAPE = {Mark.MET: "met", Mark.NOT_MET: "not-met", Mark.OPEN: "open"}
_ALIGNMENT = {Align.LEFT: "", Align.RIGHT: "right", Align.CENTRE: "centre"}


def table_context(table: Table, label: str, page: str) -> TableContext:
    """Return the context of a table.

    Parameters
    ----------
    table
        The table.
    label
        Its number: ``Table 2``.
    page
        Word before the number of a page.
    """
    size, widths, whole = _columns(table)
    styles = tuple(
        "apart" if apart else _ALIGNMENT[column.align]
        for column, apart in zip(table.columns, columns.stands_apart(table.columns), strict=True)
    )
    padding = iter(columns.decimal_padding(table))
    return TableContext(
        label=label,
        caption=table.caption,
        size=size,
        whole=whole,
        widths=widths,
        headings=tuple(
            CellContext(_content(column.heading), style, column.unit)
            for column, style in zip(table.columns, styles, strict=True)
        ),
        groups=tuple(
            RowGroupContext(
                heading=group.heading,
                note=group.note,
                section=group.section,
                rows=tuple(tuple(map(_cell, row, styles, next(padding))) for row in group.rows),
            )
            for group in table.groups
        ),
        page=page,
    )


def formulas_context(formulas: Formulas, label: str) -> FormulasContext:
    """Return the context of definitions, which are set as a table without headings."""
    columns_of_words = (Column(""),) * 3
    _, widths, whole = _columns(Table("", columns_of_words, (RowGroup(formulas.rows),)))
    return FormulasContext(
        label=label,
        caption=formulas.caption,
        whole=whole,
        widths=widths,
        rows=tuple(
            (symbol(letter.notation), symbol(formula.notation), name)
            for letter, formula, name in formulas.rows
        ),
    )


def _columns(table: Table) -> tuple[str, tuple[str, ...], bool]:
    """Return the class name of a table's type size, its columns' widths, and whether it stays on a page."""
    needs = columns.measures(table)
    size = columns.size(table, needs)
    widths = columns.widths(needs, size.page_em)
    lines = columns.lines(table, [size.page_em * width / 100 for width in widths])
    return size.name, tuple(f"{width:.2f}" for width in widths), lines <= _WHOLE_LINES


def _cell(cell: Cell, style: str, padding: str) -> CellContext:
    if isinstance(cell, Verdict):
        return CellContext(cell.word, f"verdict {_SHAPE[cell.mark]} {style}".strip())
    note = cell.meaning if isinstance(cell, Explained) else ""
    return CellContext(_content(cell), f"{style} {padding}".strip(), note=note)


def _content(cell: Cell) -> str:
    match cell:
        case Symbol(notation):
            return symbol(notation)
        case Verdict(word=word):
            return word
        case Explained(name=name):
            return name
        case _:
            return cell
