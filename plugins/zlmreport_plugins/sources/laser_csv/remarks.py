"""Remarks on a table that the certificate prints: which columns were read, other conditions in the file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from zlmreport.plugin import Words
from zlmreport.plugin.table import TextColumn, TextTable
from zlmreport_plugins.sources.laser_csv.layouts import LongLayout, WideLayout
from zlmreport_plugins.sources.laser_csv.options import COLUMN_NAMES, LaserCsvOptions

_NAMES = {
    "deviation": Words("deviations"),
    "position": Words("actual positions"),
}


def list_remarks(
    table: TextTable, layout: LongLayout | WideLayout, options: LaserCsvOptions
) -> Iterator[Words]:
    """Yield what a reader of the results must know of the table."""
    yield from _place(table, options)
    target, values = layout.columns[0], layout.value_columns
    yield Words("Target positions from the column {target}, {quantity} from {values}.").given(
        target=_write_with_unit(target), quantity=_NAMES[values[0].name], values=_list_columns(values)
    )
    if options.sign == "nominal-actual":
        yield Words("The file gives deviations as nominal − actual; their sign was exchanged on reading.")
    if options.direction == "by-order":
        yield Words(
            "The direction of approach is not in the file: rows count as taken in their order, and a "
            "target above the one before as approached upwards."
        )
    elif options.direction:
        yield Words("The direction of approach is not in the file; the job states it ({direction}).").given(
            direction=options.direction
        )
    if isinstance(layout, WideLayout):
        yield Words(
            "The table does not tell the order of the readings: they are listed run by run, upwards and "
            "then downwards."
        )
    else:
        if options.runs == "counted":
            yield Words("Runs were counted: the n-th reading of a target in a direction is of run n.")
        elif layout.run is None:
            yield Words("The file names no runs: all readings were taken as one run.")
        others = [each.text for each in layout.conditions if each.name not in COLUMN_NAMES]
        if others:
            yield Words("Columns kept as conditions, as found: {names}.").given(names=", ".join(others))
    if options.missing:
        yield Words("A reading counts as missing where the file has {words}.").given(
            words=", ".join(options.missing)
        )
    if options.ignore:
        yield Words("Columns not read: {names}.").given(names=", ".join(options.ignore))


def _place(table: TextTable, options: LaserCsvOptions) -> Iterator[Words]:
    """Yield where the table stands, in a file that holds more or has it on its side."""
    if options.sheet is not None:
        yield Words("From the sheet “{sheet}”.").given(sheet=options.sheet)
    if options.transposed:
        yield Words("The table lies on its side in the file.")
    elif options.lines or options.skip_rows or options.ends_before:
        lines = [row.line for row in (table.header, *table.rows) if row.line] or [table.header.line]
        yield Words("Lines {first} to {last} of the file were read.").given(first=lines[0], last=lines[-1])


def _list_columns(columns: Sequence[TextColumn]) -> Words:
    """Return the column with its unit; of several, the first and the last."""
    if len(columns) == 1:
        return _write_with_unit(columns[0])
    first, last = _write_with_unit(columns[0]), _write_with_unit(columns[-1])
    return Words("{first} to {last}").given(first=first, last=last)


def _write_with_unit(column: TextColumn) -> Words:
    words = Words("“{name}” ({unit})")
    return words.given(name=column.text, unit=column.unit.symbol if column.unit else "")
