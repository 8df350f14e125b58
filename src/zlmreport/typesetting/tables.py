"""What the templates of tables are given."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.certificate import columns
from zlmreport.certificate.document import (
    Align,
    Cell,
    Explained,
    Formulas,
    Mark,
    Table,
    Verdict,
)
from zlmreport.typesetting.contexts import CellContext, FormulasContext, RowGroupContext, TableContext
from zlmreport.typesetting.templates import symbol

_SHAPE = {Mark.MET: "met", Mark.NOT_MET: "not-met", Mark.OPEN: "open"}
_ALIGNMENT = {Align.LEFT: "", Align.RIGHT: "right", Align.CENTRE: "centre"}


def table_context(table: Table, label: str, page: str, *, is_for_screens: bool = False) -> TableContext:
    """Return the context of a table.

    Parameters
    ----------
    table
        The table.
    label
        Its number: ``Table 2``.
    page
        Word before the number of a page.
    is_for_screens
        Whether it says of a cell what stands above it, and can be scrolled by keys.
    """
    layout = columns.table_layout(table)
    styles = tuple(
        "apart" if apart else _ALIGNMENT[column.align]
        for column, apart in zip(table.columns, layout.apart, strict=True)
    )
    padding = iter(columns.decimal_padding(table))
    return TableContext(
        label=label,
        caption=table.caption,
        size=layout.size,
        whole=layout.is_whole,
        in_fives=layout.in_fives,
        widths=_per_cent(layout.widths),
        headings=tuple(
            CellContext(columns.text_of(column.heading, symbol), style, column.unit)
            for column, style in zip(table.columns, styles, strict=True)
        ),
        is_for_screens=is_for_screens,
        labels=_labels(table) if is_for_screens else (),
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
    layout = columns.table_layout(formulas)
    return FormulasContext(
        label=label,
        caption=formulas.caption,
        whole=layout.is_whole,
        widths=_per_cent(layout.widths),
        rows=tuple(
            (symbol(letter.notation), symbol(formula.notation), name)
            for letter, formula, name in formulas.rows
        ),
    )


def _labels(table: Table) -> tuple[str, ...]:
    """Return what stands above the cells of a table of words; nothing of one of numbers: it is scrolled."""
    if table.columns[0].align is Align.RIGHT:
        return ()
    return tuple(
        f"{columns.text_of(each.heading)} ({each.unit})" if each.unit else columns.text_of(each.heading)
        for each in table.columns
    )


def _per_cent(widths: Iterable[float]) -> tuple[str, ...]:
    return tuple(f"{width:.2f}" for width in widths)


def _cell(cell: Cell, style: str, padding: str) -> CellContext:
    if isinstance(cell, Verdict):
        return CellContext(cell.word, f"verdict {_SHAPE[cell.mark]} {style}".strip())
    note = cell.meaning if isinstance(cell, Explained) else ""
    return CellContext(columns.text_of(cell, symbol), f"{style} {padding}".strip(), note=note)
