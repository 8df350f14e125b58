"""Data source ``laser-csv``: tables of readings as they come, and remarks on them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from pathlib import Path

from zlmreport.plugin import MeasurementSet, Options, Problem, Words, hookimpl
from zlmreport.plugin.source import (
    DataSource,
    Provenance,
    Reading,
    ReadingDays,
    SourceContext,
    SourceProposal,
    collect_readings,
)
from zlmreport.plugin.table import TextColumn, TextTable, days_of_readings, folded
from zlmreport_plugins.sources.laser_csv.layouts import (
    LongLayout,
    WideLayout,
    count_runs,
    find_directions,
    find_long_layout,
    find_passes_as_runs,
    find_repeated,
    find_wide_layout,
    read_heading,
)
from zlmreport_plugins.sources.laser_csv.options import COLUMN_NAMES, LaserCsvOptions, run_and_direction


class LaserCsv:
    """Tables of readings: text with a header row."""

    identifier = "laser-csv"
    title = Words("Table of readings (CSV)")
    options: type[Options] = LaserCsvOptions
    suffixes = (".csv", ".tsv", ".txt", ".xlsx")

    def proposals(self, file: Path) -> Iterable[SourceProposal]:
        """Return the keys by which a table that somebody else laid out may be read."""
        from zlmreport_plugins.sources.laser_csv.proposals import propose

        return propose(file)

    def read(self, options: LaserCsvOptions, context: SourceContext) -> MeasurementSet:
        """Read a table; raise `InputError` with every defect and its place."""
        readings: list[Reading] = []
        problems: list[Problem] = []
        said: list[Words] = []
        days: list[ReadingDays] = []
        for each in options.tables:
            table = each.read_table(partial(_is_column_name, options=each))
            text = table.source
            layout = (find_wide_layout if each.layout == "wide" else find_long_layout)(table, each, context)
            cells = each.cells_of(table, [column.index for column in layout.list_number_columns()])
            sense = -1.0 if each.sign == "nominal-actual" else 1.0
            of_table = list(layout.list_readings(cells, sense))
            if isinstance(layout, LongLayout) and layout.run and not options.runs:
                problems += find_passes_as_runs(of_table, layout.run)
            readings += find_directions(of_table) if each.direction == "by-order" else of_table
            if of_days := days_of_readings(cells, layout.time):
                days.append(of_days)
            problems += [*table.problems, *cells.problems]
            said += [remark for remark in list_remarks(table, layout, each) if remark not in said]
        if options.runs:
            problems += find_repeated(readings, context.axis)
            readings = list(count_runs(readings))
        if options.layout == "wide" and (options.parts or options.runs):
            readings.sort(key=lambda reading: (reading.run, -reading.approach))  # as one table lists them
        provenance = Provenance(
            self.identifier, (text.source,), tuple(said), days=_join_days(days) if days else None
        )
        return collect_readings(
            readings,
            context.axis,
            provenance,
            place=text.place(),
            problems=problems,
        )


def _join_days(days: Sequence[ReadingDays]) -> ReadingDays:
    first, last = min(each.first for each in days), max(each.last for each in days)
    return ReadingDays(first, last, is_utc=any(each.is_utc for each in days))


def _is_column_name(text: str, options: LaserCsvOptions) -> bool:
    """Whether a header is a name that this source or the job knows."""
    named = read_heading(text)
    return (
        folded(named.name) in COLUMN_NAMES
        or any(named.is_called(name) for name in (*options.columns.values(), *options.ignore))
        or (options.layout == "wide" and run_and_direction(named.name) is not None)
    )


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of tables, and that of two tables of one line."""
    from zlmreport_plugins.sources.laser_csv.reversal import ReversedLaserCsv

    return [LaserCsv(), ReversedLaserCsv()]


_NAMES = {"deviation": Words("deviations"), "position": Words("actual positions")}


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
    if options.runs == "counted":
        yield Words("Runs were counted: the n-th reading of a target in a direction is of run n.")
    elif isinstance(layout, LongLayout) and layout.run is None:
        yield Words("The file names no runs: all readings were taken as one run.")
    yield from _tell_columns(layout, options)


def _tell_columns(layout: LongLayout | WideLayout, options: LaserCsvOptions) -> Iterator[Words]:
    """Yield what became of columns that are no readings, and of words among them."""
    if isinstance(layout, LongLayout):
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
