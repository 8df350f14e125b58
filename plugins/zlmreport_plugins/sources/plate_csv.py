"""Data source ``plate-csv``: slopes of a surface plate along the lines of a union jack, as one table.

A row is one reading: the line, the number of the station, and the inclination of the carriage there. One line
becomes a measurement set: that which has the name of the test. Its target positions are where the front foot
stands, a foot spacing from station to station; there is one direction.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from types import MappingProxyType

from pydantic import Field

from zlmreport.plugin import (
    ANGLE_UNITS,
    ARCSECOND,
    MILLIMETRE,
    Approach,
    InputError,
    MeasurementSet,
    Options,
    Place,
    Positive,
    Problem,
    Words,
    did_you_mean,
    hookimpl,
    quoted,
)
from zlmreport.plugin.source import (
    DataSource,
    Provenance,
    Reading,
    SourceContext,
    SourceProposal,
    collect_readings,
)
from zlmreport.plugin.table import (
    Cells,
    Heading,
    TableOptions,
    TextColumn,
    TextTable,
    column_with_unit,
    find_heading,
    missing_column,
    read_headings,
)
from zlmreport_plugins.union_jack_lines import FLATNESS, LINE as LINE_OF_A_PLATE, LINES

LINE, STATION, RUN, READING = "line", "station", "run", "reading"
COLUMN_NAMES: tuple[str, ...] = (LINE, STATION, RUN, READING)
#: What the feet of a carriage may be apart, m: what is farther off is in another unit.
_SHORTEST, _LONGEST = 5e-3, 1.0
#: What they are apart in a job that is begun, mm, until somebody says it.
_USUAL_FOOT = 100.0
_FOOT_ASKED = "How far apart are the feet of the carriage (mm)? 'foot: 100' is a guess; heights grow with it."
_SENSE_ASKED = "Do readings grow where the front foot stands higher? If they fall, say 'falls: true'."


class PlateCsvOptions(TableOptions):
    """Where the table of slopes is, and what it does not say itself."""

    column_names = COLUMN_NAMES
    column_units = MappingProxyType({READING: ANGLE_UNITS})
    header_example = "line,station,reading"

    foot: Positive = Field(
        description="Distance of the feet of the carriage, and of two stations, mm.", examples=[101.6]
    )
    falls: bool = Field(
        default=False,
        description="Whether readings grow where the front foot stands lower, on every line.",
    )


class PlateCsv:
    """Tables of slopes along the lines of a plate."""

    identifier = "plate-csv"
    title = Words("Slopes of a surface plate (CSV)")
    options: type[Options] = PlateCsvOptions
    suffixes = ()

    def proposals(self, file: Path) -> Iterable[SourceProposal]:
        """Return the keys by which a file may be read, if it has readings of the lines of a plate."""
        options = PlateCsvOptions(file=file, foot=_USUAL_FOOT)
        try:
            cells, columns = _read_table_of(options, Place(str(file)))
        except InputError:
            return []
        table = cells.table
        said = (cells.word(row, columns[LINE], str) for row in table.rows)
        names = {_fold_line_name(name): name for name in said if name}
        tests = tuple(name for name in FLATNESS.test_names if name in names)
        if not tests:
            return []
        others = [said for name, said in names.items() if name not in tests]
        asks = [_FOOT_ASKED, _SENSE_ASKED, *(_say_no_line_asked(others) if others else ())]
        keys = {"foot": _USUAL_FOOT}
        return [SourceProposal(keys, tuple(asks), quantity=LINE_OF_A_PLATE, tests=tests)]

    def read(self, options: PlateCsvOptions, context: SourceContext) -> MeasurementSet:
        """Read the readings of one line; raise `InputError` with every defect."""
        axis, foot = context.axis, float(MILLIMETRE.to_si(options.foot))
        if axis.measurand.unit is not ARCSECOND or axis.measurand.coordinate.unit is not MILLIMETRE:
            raise InputError.at(
                context.place,
                f"plate-csv reads slopes along a line, and this job is on {axis.measurand.identifier}; name "
                "the lines as tests: measurement.tests: {NW-SE: {source: …}, …}, and evaluate a standard of "
                "flatness",
            )
        if not _SHORTEST <= foot <= _LONGEST:
            raise InputError.at(
                context.place,
                f"the feet of a carriage are not {options.foot:g} mm apart; 'foot' is in millimetres",
            )
        cells, columns = _read_table_of(options, context.place)
        table = cells.table
        side = -1.0 if options.falls else 1.0
        readings, names = [], dict[str, str]()
        for row in table.rows:
            name = cells.word(row, columns[LINE], str)
            station = cells.run(row, columns[STATION])
            run = cells.run(row, columns[RUN]) if RUN in columns else 1.0
            value = cells.number(row, columns[READING])
            if name is None or station is None or run is None or value is None:
                continue
            names.setdefault(_fold_line_name(name), name)
            if _fold_line_name(name) == _fold_line_name(axis.name):
                place = table.place(row, columns[READING].index)
                readings.append(Reading(place, station * foot, Approach.POSITIVE, run, side * value))
        problems = [*table.problems, *cells.problems]
        if not readings and not problems:
            near = did_you_mean(axis.name, list(names.values()))
            problems.append(Problem(table.source.place(), f"there is no line {quoted(axis.name)}; {near}"))
        problems += _find_gaps(readings, foot)
        provenance = Provenance(self.identifier, (table.source.source,))
        return collect_readings(readings, axis, provenance, place=table.source.place(), problems=problems)


def _fold_line_name(name: str) -> str:
    """Return the name of a line as it is compared: whatever its hyphen and its case."""
    return name.strip().upper().replace("–", "-").replace("−", "-").replace("_", "-").replace(" ", "")


def _say_no_line_asked(names: list[str]) -> Iterator[str]:
    shown = ", ".join(map(quoted, names[:8]))
    yield f"What is {shown}? The lines of a union jack are {', '.join(LINES)}; other ones are left out."


def _read_table_of(options: PlateCsvOptions, place: Place) -> tuple[Cells, dict[str, TextColumn]]:
    table = options.read_table()
    columns = _find_columns(table, options, place)
    return options.cells_of(table, [columns[READING].index]), columns


def _find_columns(table: TextTable, options: PlateCsvOptions, place: Place) -> dict[str, TextColumn]:
    among = read_headings(table, options)
    found: dict[str, Heading] = {
        name: heading
        for name in options.column_names
        if (heading := find_heading(name, among, table, options))
    }
    lacking = [name for name in (LINE, STATION, READING) if name not in found]
    if lacking:
        raise InputError([missing_column(name, among, table, options) for name in lacking])
    units = {READING: (ANGLE_UNITS, ARCSECOND)}
    return {
        name: column_with_unit(name, heading, options, units.get(name), place, table)
        for name, heading in found.items()
    }


def _find_gaps(readings: list[Reading], foot: float) -> Iterator[Problem]:
    """Yield the first station of a line that is left out: heights are sums, and none goes on beyond it."""
    by_station = {round(each.target_position / foot): each for each in readings}
    for number, (station, reading) in enumerate(sorted(by_station.items()), 1):
        if station != number:
            yield Problem(
                reading.place,
                f"station {number} of the line is left out; stations are counted from 1, and each has a row "
                "(an empty cell where a reading is missing)",
            )
            return


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of plates."""
    return [PlateCsv()]
