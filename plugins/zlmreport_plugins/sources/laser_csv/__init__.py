"""Data source ``laser-csv``: tables of readings, as the contract with users lays them out or as they come."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
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
from zlmreport.plugin.table import days_of_readings, folded
from zlmreport_plugins.sources.laser_csv.layouts import (
    count_runs,
    find_directions,
    find_long_layout,
    find_wide_layout,
    read_heading,
)
from zlmreport_plugins.sources.laser_csv.options import (
    COLUMN_NAMES,
    LaserCsvOptions,
    run_and_direction,
)
from zlmreport_plugins.sources.laser_csv.remarks import list_remarks


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
            readings += find_directions(of_table) if each.direction == "by-order" else of_table
            if of_days := days_of_readings(cells, layout.time):
                days.append(of_days)
            problems += [*table.problems, *cells.problems]
            said += [remark for remark in list_remarks(table, layout, each) if remark not in said]
        if options.parts and options.layout == "wide":
            readings.sort(key=lambda reading: (reading.run, -reading.approach))  # as one table lists them
        provenance = Provenance(
            self.identifier, (text.source,), tuple(said), days=_join_days(days) if days else None
        )
        return collect_readings(
            count_runs(readings) if options.runs else readings,
            context.axis,
            provenance,
            place=text.place(),
            problems=problems,
        )


def _join_days(days: Sequence[ReadingDays]) -> ReadingDays:
    """Return the first and the last day of several tables."""
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
