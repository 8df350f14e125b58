"""Reads the rows of a table of circles: columns, angles, senses, and whether units are as stated."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.plugin import CONDITIONS, Approach, InputError, NominalCircle, Place, Problem
from zlmreport.plugin.source import SourceContext
from zlmreport.plugin.table import (
    Cells,
    Heading,
    TextColumn,
    TextTable,
    column_with_unit,
    find_heading,
    missing_column,
    read_headings,
    time_reader,
)
from zlmreport_plugins.sources.circle_csv.options import COLUMN_NAMES, UNITS, CircleCsvOptions, read_sense

#: A whole test in degrees goes farther round; in radians it cannot.
_IN_RADIANS = 7.6
#: Of the nominal radius: deviations so near to it are radii, and radii so far from it are deviations.
_NEAR, _FAR = 0.1, 0.5


@dataclass(frozen=True, slots=True)
class CircleColumns:
    """The columns of a table."""

    sense: TextColumn | None
    run: TextColumn | None
    angle: TextColumn | None
    time: TextColumn | None
    value: TextColumn
    conditions: tuple[TextColumn, ...]

    def list_number_columns(self) -> Iterator[TextColumn]:
        """Yield the columns that hold numbers with decimals."""
        yield from (column for column in (self.angle, self.time, self.value) if column)
        yield from self.conditions


def find_circle_columns(table: TextTable, options: CircleCsvOptions, context: SourceContext) -> CircleColumns:
    """Return the columns of a table; raise InputError with all that are missing or contradict each other."""
    among = read_headings(table, options)
    named = {name: heading for name in COLUMN_NAMES if (heading := find_heading(name, among, table, options))}
    problems = list(_find_missing(named, among, table, options))
    if problems:
        raise InputError(problems)

    def column(name: str) -> TextColumn | None:
        heading = named.get(name)
        if heading is None:
            return None
        return column_with_unit(name, heading, options, UNITS.get(name), context.place, table)

    value = column("deviation") or column("radius")
    assert value is not None  # noqa: S101 - what is missing was refused above
    known = {heading.index for heading in named.values()}
    others = (
        TextColumn(other.index, other.text, other.text, None) for other in among if other.index not in known
    )
    logged = (found for name in CONDITIONS if (found := column(name)))
    return CircleColumns(
        column("sense"), column("run"), column("angle"), column("time"), value, (*logged, *others)
    )


def _find_missing(
    named: Mapping[str, Heading], among: Sequence[Heading], table: TextTable, options: CircleCsvOptions
) -> Iterator[Problem]:
    place = table.place(table.header, 0)
    if "sense" not in named and options.sense is None:
        problem = missing_column("sense", among, table, options)
        yield Problem(problem.place, f"{problem.message}; or say 'sense: ccw' for all readings")
    if "sense" in named and options.sense is not None:
        yield Problem(place, "the file has senses, and the job states one for all ('sense'); remove it there")
    if "angle" not in named and "time" not in named:
        problem = missing_column("angle", among, table, options)
        yield Problem(problem.place, f"{problem.message}; or a column 'time' (s)")
    if "deviation" in named and "radius" in named:
        yield Problem(
            place, "there are both deviations and radii; name one of the columns in the job under 'ignore'"
        )
    if "deviation" not in named and "radius" not in named:
        problem = missing_column("deviation", among, table, options)
        yield Problem(problem.place, f"{problem.message}; radii (mm) stand in a column 'radius'")


@dataclass(frozen=True, slots=True)
class CircleRow:
    """A row that is sound."""

    sense: Approach
    run: int
    angle: float  #: rad; NaN where the table has none.
    time: float  #: s; NaN where not logged.
    value: float  #: m; NaN where missing.
    conditions: tuple[float, ...]
    place: Place


def read_circle_rows(cells: Cells, layout: CircleColumns, options: CircleCsvOptions) -> Iterator[CircleRow]:
    """Yield the sound rows of a table."""
    time_of = time_reader(cells, layout.time)
    stated = options.stated_sense
    for row in cells.table.rows:
        way = cells.word(row, layout.sense, read_sense) if layout.sense else stated
        run = cells.run(row, layout.run) if layout.run else 1.0
        angle = cells.demanded_number(row, layout.angle) if layout.angle else math.nan
        time = time_of(row)
        value = cells.number(row, layout.value)
        conditions = tuple(_take_or_nan(cells.number(row, column)) for column in layout.conditions)
        if way is None or run is None or angle is None or time is None or value is None:
            continue
        if layout.angle is None and math.isnan(time):
            cells.note(row, layout.time or layout.value, "there is no time; only a reading may be missing")
            continue
        yield CircleRow(
            way, int(run), angle, time, value, conditions, cells.table.place(row, layout.value.index)
        )


def _take_or_nan(value: float | None) -> float:
    return math.nan if value is None else value


def find_misread(
    rows: Sequence[CircleRow],
    layout: CircleColumns,
    table: TextTable,
    circle: NominalCircle,
    options: CircleCsvOptions,
) -> Iterator[Problem]:
    """Yield whether a column holds something else than it says: radians, radii, deviations."""
    if layout.angle and layout.angle.unit is UNITS["angle"][1] and "angle" not in options.units:
        reach = max((abs(math.degrees(row.angle)) for row in rows), default=0.0)
        is_stated = "(" in layout.angle.text or "[" in layout.angle.text
        if reach <= _IN_RADIANS and not is_stated:
            yield Problem(
                table.place(table.header, layout.angle.index),
                f"the angles reach {reach:.4g}: as degrees that is hardly an arc; are they radians? Say "
                "'units: {angle: rad}' in the job, or 'units: {angle: deg}' if they are not",
            )
    values = np.array([row.value for row in rows])
    if not np.isfinite(values).any():
        return
    middle = float(np.nanmedian(values))
    column, radius = layout.value, circle.radius
    in_file = column.unit.from_si(middle) if column.unit else middle
    nominal = f"the nominal radius (circle.radius), {radius * 1e3:g} mm"
    place = table.place(table.header, column.index)
    if column.name == "deviation":
        as_radii = (in_file * 1e-3 / radius, middle / radius)
        if any(abs(ratio - 1) < _NEAR for ratio in as_radii):
            yield Problem(
                place,
                f"the deviations are about {in_file:.6g}, as {nominal}; are they radii? Say "
                f"'columns: {{radius: {column.text}}}' in the job, or call the column so",
            )
    elif not abs(middle / radius - 1) < _FAR:
        yield Problem(
            place,
            f"the radii are about {in_file:.4g} {column.unit.symbol if column.unit else ''}, and {nominal}; "
            "are they deviations, or is a unit wrong?",
        )
