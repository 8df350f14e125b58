"""The wide layout: one target position a row, one column a run and direction."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from zlmreport.plugin import Approach, InputError, Problem, Reading, SourceContext, quoted
from zlmreport_plugins.sources.laser_csv.cells import Cells
from zlmreport_plugins.sources.laser_csv.columns import (
    Column,
    Heading,
    column_of,
    find,
    missing_column,
    read_headings,
)
from zlmreport_plugins.sources.laser_csv.names import run_and_direction
from zlmreport_plugins.sources.laser_csv.options import LaserCsvOptions
from zlmreport_plugins.sources.laser_csv.table import Table

_RULE = (
    "its columns are named after run and direction, as in '1+', '1-' or 'Run 1 fwd', mapped to such a "
    "name, as in 'columns: {1+: …}', or listed under 'ignore'"
)


@dataclass(frozen=True, slots=True)
class RunColumn:
    """A column of one run in one direction."""

    column: Column
    run: int
    approach: Approach


@dataclass(frozen=True, slots=True)
class WideLayout:
    """The columns of a wide table.

    Attributes
    ----------
    target
        The target position.
    runs
        The columns of readings.
    """

    target: Column
    runs: tuple[RunColumn, ...]

    @property
    def columns(self) -> tuple[Column, ...]:
        """Every column that is read."""
        return (self.target, *self.value_columns)

    @property
    def value_columns(self) -> tuple[Column, ...]:
        """The columns of readings."""
        return tuple(run.column for run in self.runs)

    def number_columns(self) -> Iterator[Column]:
        """Yield the columns that hold numbers with decimals."""
        return iter(self.columns)

    def readings(self, cells: Cells, sense: float) -> Iterator[Reading]:
        """Yield the readings run by run, as the linear method takes them: upwards, then downwards.

        The table itself does not tell their order. `sense` is −1 for deviations given as nominal − actual.
        """
        rows = [
            (target, row)
            for row in cells.table.rows
            if (target := cells.demanded_number(row, self.target)) is not None
        ]
        for run in sorted(self.runs, key=lambda run: (run.run, -run.approach)):
            for target, row in sorted(rows, key=lambda pair: run.approach * pair[0]):
                value = cells.number(row, run.column)
                if value is not None:
                    deviation = value - target if run.column.name == "position" else sense * value
                    place = cells.table.place(row, run.column.index)
                    yield Reading(place, target, run.approach, float(run.run), deviation)


def wide_layout(table: Table, options: LaserCsvOptions, context: SourceContext) -> WideLayout:
    """Return the columns of a wide table; raise InputError with every column that has no meaning."""
    among = read_headings(table, options)
    target = find("target", among, table, options)
    problems = [] if target else [missing_column("target", among, table)]
    if options.values == "position" and options.sign == "nominal-actual":
        problems.append(
            Problem(
                table.place(table.header, 0),
                "'sign: nominal-actual' is said of deviations, and 'values: position' says there are none",
            )
        )
    runs: dict[tuple[int, Approach], RunColumn] = {}
    for named in among:
        if named is target:
            continue
        told = _told(named, options)
        place = table.place(table.header, named.index)
        if told is None:
            problems.append(
                Problem(place, f"no rule reads the column {quoted(named.text)} of a wide table; {_RULE}")
            )
        elif told[1] is None:
            problems.append(
                Problem(
                    place,
                    f"the column {quoted(named.text)} does not tell its direction; say 'direction: up' in "
                    f"the job for all such columns, or 'columns: {{{told[0]}+: {named.text}}}' for this one",
                )
            )
        elif (told[0], told[1]) in runs:
            other = runs[told[0], told[1]].column.text
            problems.append(
                Problem(place, f"{quoted(named.text)} and {quoted(other)} are the same run and direction")
            )
        else:
            read = column_of(options.values, named, options, context, table)
            runs[told[0], told[1]] = RunColumn(read, told[0], told[1])
    if not runs and not problems:
        problems.append(
            Problem(table.place(table.header, 0), f"a wide table has no columns of readings here; {_RULE}")
        )
    if problems or target is None:
        raise InputError(problems)
    return WideLayout(column_of("target", target, options, context, table), tuple(runs.values()))


def _told(named: Heading, options: LaserCsvOptions) -> tuple[int, Approach | None] | None:
    """Return run and direction of a column: as mapped, else as named, else as stated for all columns."""
    for key, file_name in options.columns.items():
        if named.is_called(file_name):
            return run_and_direction(key)
    told = run_and_direction(named.name)
    if told and told[1] is None:
        return told[0], options.stated_direction
    return told
