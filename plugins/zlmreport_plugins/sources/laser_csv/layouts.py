"""Reads the two layouts of a table: a reading a row, or a target a row and a run a column."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from zlmreport.plugin import (
    CONDITIONS,
    SECOND,
    TIME_UNITS,
    Approach,
    Axis,
    InputError,
    Problem,
    ReadingScale,
    Unit,
    counted,
    quoted,
)
from zlmreport.plugin.source import Reading, SourceContext
from zlmreport.plugin.table import (
    Cells,
    Heading,
    TextColumn,
    TextRow,
    TextTable,
    column_with_unit,
    find_heading,
    heading_of,
    missing_column,
    read_headings,
    time_reader,
)
from zlmreport_plugins.sources.laser_csv.options import (
    LaserCsvOptions,
    names_direction,
    read_direction,
    run_and_direction,
)


def read_heading(text: str) -> Heading:
    """Return a name in a header, its unit taken off; a direction in brackets belongs to the name.

    >>> read_heading("Run (up)").name
    'Run up'
    """
    return heading_of(text, is_no_unit=names_direction)


def find_column_of(
    name: str, heading: Heading, options: LaserCsvOptions, context: SourceContext, table: TextTable
) -> TextColumn:
    """Return a known column with its unit; raise `InputError` if the unit is none of its quantity."""
    return column_with_unit(name, heading, options, _list_units(name, context.axis), context.place, table)


def _list_units(
    name: str, axis: Axis
) -> tuple[Mapping[str, Unit | ReadingScale], Unit | ReadingScale] | None:
    """Return the units that a column may have by their spellings, and the usual one."""
    if name in {"target", "position"}:
        return axis.position_units, axis.position_unit
    if name == "deviation":
        return axis.deviation_units, axis.deviation_unit
    if name == "time":
        return TIME_UNITS, SECOND
    return (CONDITIONS[name].units, CONDITIONS[name].unit) if name in CONDITIONS else None


@dataclass(frozen=True, slots=True)
class LongLayout:
    """The columns of a long table."""

    target: TextColumn  #: The target position.
    value: TextColumn  #: The deviation or the actual position.
    direction: TextColumn | None  #: None where the job states one direction for all readings.
    run: TextColumn | None  #: None where the file has none: all readings are of one run.
    time: TextColumn | None  #: None where there is none.
    conditions: tuple[TextColumn, ...]  #: All the others.
    #: The direction that the job states; where the order of the rows tells it, that is found afterwards.
    stated_direction: Approach | None

    @property
    def columns(self) -> tuple[TextColumn, ...]:
        """Every column that is read."""
        others = (self.target, self.value, self.direction, self.run, self.time)
        return (*(column for column in others if column), *self.conditions)

    @property
    def value_columns(self) -> tuple[TextColumn, ...]:
        """The columns of readings."""
        return (self.value,)

    def list_number_columns(self) -> Iterator[TextColumn]:
        """Yield the columns that hold numbers with decimals."""
        return (column for column in self.columns if column not in {self.direction, self.run})

    def list_readings(self, cells: Cells, sense: float) -> Iterator[Reading]:
        """Yield the readings of the sound rows; `sense` is −1 for deviations given as nominal − actual."""
        time_of = time_reader(cells, self.time)
        for row in cells.table.rows:
            target = cells.demanded_number(row, self.target)
            approach = (
                cells.word(row, self.direction, read_direction) if self.direction else self.stated_direction
            )
            run = cells.run(row, self.run) if self.run else 1.0
            value = cells.number(row, self.value)
            time = time_of(row)
            conditions = {
                condition.name: _keep_condition(cells, row, condition) for condition in self.conditions
            }
            if target is None or approach is None or run is None or value is None or time is None:
                continue
            yield Reading(
                cells.table.place(row, self.value.index),
                target,
                approach,
                run,
                value - target if self.value.name == "position" else sense * value,
                None if math.isnan(time) else time,
                conditions,
            )


def find_long_layout(table: TextTable, options: LaserCsvOptions, context: SourceContext) -> LongLayout:
    """Return the columns of a long table; raise InputError with all that are missing or in doubt."""
    among = read_headings(table, options, names_direction)
    by_name = {
        name: heading
        for name in ("target", "direction", "run", "deviation", "position", "time", *CONDITIONS)
        if (heading := find_heading(name, among, table, options))
    }
    problems = list(_find_missing(by_name, among, table, options))
    if problems:
        raise InputError(problems)
    if "position" in by_name and not context.axis.measurand.is_position:
        raise InputError.at(table.place(table.header, by_name["position"].index), _say_no_positions(context))
    known = {
        name: find_column_of(name, heading, options, context, table) for name, heading in by_name.items()
    }
    taken = {found.index for found in known.values()}
    return LongLayout(
        known["target"],
        known.get("deviation") or known["position"],
        known.get("direction"),
        known.get("run"),
        known.get("time"),
        (
            *(known[name] for name in CONDITIONS if name in known),
            *(
                TextColumn(other.index, other.text, other.text, None)
                for other in among
                if other.index not in taken
            ),
        ),
        Approach.POSITIVE if options.direction == "by-order" else options.stated_direction,
    )


def find_directions(readings: Sequence[Reading]) -> Iterator[Reading]:
    """Yield the readings of a long table with the directions that their order tells.

    A target above the one before was approached upwards, one below it downwards, and where the same one
    follows, the axis turned there.
    """
    senses = find_senses([reading.target_position for reading in readings])
    for reading, sense in zip(readings, senses, strict=True):
        yield replace(reading, approach=Approach(sense))


def count_runs(readings: Sequence[Reading]) -> Iterator[Reading]:
    """Yield readings with their runs: the n-th of a target in a direction is of run n.

    Where a run left a target out, the passes over the targets tell it: there are as many as runs.
    """
    taken: Counter[tuple[float, Approach]] = Counter()
    passes: Counter[Approach] = Counter()
    counted, of_passes = [], []
    before: Reading | None = None
    for reading in readings:
        approach = reading.approach
        taken[reading.target_position, approach] += 1
        counted.append(taken[reading.target_position, approach])
        if (
            before is None
            or before.approach != approach
            or (reading.target_position - before.target_position) * approach <= 0
        ):
            passes[approach] += 1
        of_passes.append(passes[approach])
        before = reading
    most = max(taken.values(), default=0)
    runs = of_passes if passes and max(passes.values()) == most else counted
    yield from (replace(reading, run=float(run)) for reading, run in zip(readings, runs, strict=True))


def find_passes_as_runs(readings: Sequence[Reading], column: TextColumn) -> Iterator[Problem]:
    """Yield where a column of runs counts the passes: each run has one direction, and both occur."""
    ways = dict.fromkeys((reading.run, reading.approach) for reading in readings)
    runs = {run for run, _ in ways}
    if len({approach for _, approach in ways}) > 1 and len(ways) == len(runs):
        second = next(reading for reading in readings if reading.run != readings[0].run)
        yield Problem(
            second.place,
            f"each of {counted(len(runs), 'run')} has one direction: the column {quoted(column.text)} "
            "numbers the passes, and a run is one there and back; say 'runs: counted' in the job, and "
            f"'ignore: [{column.text}]'",
        )


def find_repeated(readings: Sequence[Reading], axis: Axis) -> Iterator[Problem]:
    """Yield the readings that follow one of the same target and direction, and are more than others have."""
    numbers = Counter((reading.target_position, reading.approach) for reading in readings)
    usual = Counter(numbers.values()).most_common(1)
    for before, reading in itertools.pairwise(readings):
        same = (reading.target_position, reading.approach)
        if same == (before.target_position, before.approach) and numbers[same] > usual[0][0]:
            yield Problem(
                reading.place,
                f"target {axis.typed(reading.target_position):.9g} {reading.approach.arrow} was read in line "
                f"{before.place.line} already, and has {counted(numbers[same], 'reading')} where most have "
                f"{usual[0][0]}; keep one of them, for runs are counted by them",
            )


def find_senses(targets: Sequence[float]) -> list[int]:
    """Return for each target, in order, in which sense it was approached: +1 or −1.

    >>> find_senses([0, 5, 10, 10, 5, 0, 0, 5])
    [1, 1, 1, -1, -1, -1, 1, 1]
    """
    senses: list[int] = []
    coming = 1
    for before, at in reversed([(targets[max(index - 1, 0)], at) for index, at in enumerate(targets)]):
        coming = (at > before) - (at < before) or coming
        senses.append(coming)
    return senses[::-1]


def _say_no_positions(context: SourceContext) -> str:
    return (
        "actual positions give deviations of positioning only, and this job is on "
        f"{context.axis.measurand.identifier}; its readings are deviations"
    )


def _find_missing(
    by_name: Iterable[str], among: Sequence[Heading], table: TextTable, options: LaserCsvOptions
) -> Iterator[Problem]:
    """Yield the columns that are missing, or that contradict each other or the job."""
    place = table.place(table.header, 0)
    if sum(run_and_direction(heading.name) is not None for heading in among) > 1 and "run" not in by_name:
        yield Problem(place, "the header names runs as columns; say 'layout: wide' in the job")
        return
    if "target" not in by_name:
        yield missing_column("target", among, table, options)
    if "direction" not in by_name and not options.direction:
        problem = missing_column("direction", among, table, options)
        yield Problem(
            problem.place,
            f"{problem.message}; or say 'direction: up' for all readings, or 'direction: by-order'",
        )
    if "direction" in by_name and options.direction:
        yield Problem(
            place, "the file has directions, and the job states one for all ('direction'); remove it there"
        )
    if "deviation" in by_name and "position" in by_name:
        yield Problem(
            place,
            "there are both deviations and positions; name one of the columns in the job under 'ignore'",
        )
    if "deviation" not in by_name and "position" not in by_name:
        problem = missing_column("deviation", among, table, options)
        yield Problem(problem.place, f"{problem.message}; actual positions stand in a column 'position'")
    if "deviation" not in by_name and options.sign == "nominal-actual":
        yield Problem(
            place, "'sign: nominal-actual' is said of deviations, and the file gives positions; remove it"
        )


def _keep_condition(cells: Cells, row: TextRow, condition: TextColumn) -> float:
    """Return a condition; NaN if it is none, which is noted then."""
    advice = f"; a column that holds no numbers is named in the job under 'ignore': {condition.text}"
    value = cells.number(row, condition, "" if condition.name in CONDITIONS else advice)
    return math.nan if value is None else value


_RULE = (
    "its columns are named after run and direction, as in '1+', '1-' or 'Run 1 fwd', mapped to such a "
    "name, as in 'columns: {1+: …}', or listed under 'ignore'"
)


@dataclass(frozen=True, slots=True)
class RunColumn:
    """A column of one run in one direction."""

    column: TextColumn
    run: int
    approach: Approach


@dataclass(frozen=True, slots=True)
class WideLayout:
    """The columns of a wide table."""

    target: TextColumn  #: The target position.
    runs: tuple[RunColumn, ...]  #: The columns of readings.
    time: TextColumn | None = None  #: It has none: a row holds readings of many times.

    @property
    def columns(self) -> tuple[TextColumn, ...]:
        """Every column that is read."""
        return (self.target, *self.value_columns)

    @property
    def value_columns(self) -> tuple[TextColumn, ...]:
        """The columns of readings."""
        return tuple(run.column for run in self.runs)

    def list_number_columns(self) -> Iterator[TextColumn]:
        """Yield the columns that hold numbers with decimals."""
        return iter(self.columns)

    def list_readings(self, cells: Cells, sense: float) -> Iterator[Reading]:
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


def find_wide_layout(table: TextTable, options: LaserCsvOptions, context: SourceContext) -> WideLayout:
    """Return the columns of a wide table; raise InputError with every column that has no meaning."""
    among = read_headings(table, options, names_direction)
    target = find_heading("target", among, table, options)
    problems = [] if target else [missing_column("target", among, table, options)]
    if options.values == "position" and not context.axis.measurand.is_position:
        problems.append(Problem(table.place(table.header, 0), _say_no_positions(context)))
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
        told = _tell_run_and_direction(named, options)
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
            read = find_column_of(options.values, named, options, context, table)
            runs[told[0], told[1]] = RunColumn(read, told[0], told[1])
    if not runs and not problems:
        problems.append(
            Problem(table.place(table.header, 0), f"a wide table has no columns of readings here; {_RULE}")
        )
    if problems or target is None:
        raise InputError(problems)
    return WideLayout(find_column_of("target", target, options, context, table), tuple(runs.values()))


def _tell_run_and_direction(named: Heading, options: LaserCsvOptions) -> tuple[int, Approach | None] | None:
    """Return run and direction of a column: as mapped, else as named, else as stated for all columns."""
    for key, file_name in options.columns.items():
        if named.is_called(file_name):
            return run_and_direction(key)
    told = run_and_direction(named.name)
    if told and told[1] is None:
        return told[0], options.stated_direction
    return told
