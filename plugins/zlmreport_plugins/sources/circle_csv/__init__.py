"""Data source ``circle-csv``: tables of circles, a reading a row, in the order of time.

A circle becomes a measurement set of the usual shape: the target positions are angles, rad from the plane's
first axis towards its second, in [0, 2π); the positive approach is counter-clockwise and the negative one
clockwise; runs are turns, counted in each sense; the deviation is actual − nominal radius.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from zlmreport.plugin import (
    Approach,
    Axis,
    FloatArray,
    InputError,
    MeasurementSet,
    NominalCircle,
    Options,
    Place,
    Problem,
    Words,
    counted,
    hookimpl,
)
from zlmreport.plugin.source import (
    Averaging,
    DataSource,
    Provenance,
    Reading,
    SourceContext,
    SourceProposal,
    cap_problems,
    collect_readings,
)
from zlmreport.plugin.table import Cells, TextColumn, days_of_readings, folded, heading_of, read_headings
from zlmreport_plugins.logged_columns import list_spellings
from zlmreport_plugins.sources.circle_csv.averaging import average_turns, count_arcs_of, look_at_averages
from zlmreport_plugins.sources.circle_csv.options import COLUMN_NAMES, CircleCsvOptions
from zlmreport_plugins.sources.circle_csv.rows import (
    CircleColumns,
    CircleRow,
    find_circle_columns,
    find_misread,
    read_circle_rows,
)
from zlmreport_plugins.sources.circle_csv.turns import (
    TURN,
    CircleTurn,
    choose_evaluated_part,
    find_common_angles,
    find_strays,
    put_one_after_another,
)

#: What a circle is taken for while nobody has said how it was run, m and m/s.
_USUAL_RADIUS, _USUAL_FEED = 0.15, 1 / 60
#: Readings of a turn at the least: a circle through fewer says nothing of its form.
_FEWEST = 8
#: Readings of a turn that are kept as they are.
_MOST_KEPT = 3600
_FROM = Words("Angles from {angles}, {quantity} from the column “{column}” ({unit}).")
_RECKONED = Words("time and feed: each turn begins at {start}° and goes on with {feed} mm/min")
_QUANTITIES = {
    "deviation": Words("radial deviations"),
    "radius": Words("radii, less the nominal one,"),
}
_ONE_SENSE = Words("The sense is not in the file; the job states it ({sense}).")
_ARCS = Words(
    "Evaluated of each turn: one round at most; {before}° before it and {behind}° behind it are set aside "
    "as feed-in and feed-out ({why})."
)
_FOLLOW = Words(
    "The times begin anew with each turn: the turns are taken to follow each other without a pause."
)
_STATED = Words("as stated")
_HALVED = Words("half of what goes beyond a full turn, as nothing is stated")
_AVERAGED = Words(
    "{readings} readings were averaged over arcs of {arc}°. What the averages leave out has a root mean "
    "square of {left} µm; {vibration}."
)
_VIBRATION = Words(
    "the strongest vibration in it has {frequency} Hz (by the stated feed) and an amplitude of {amplitude} µm"
)


#: Columns of circles as they are called beside their own names, folded.
_CALLED: Mapping[str, str] = MappingProxyType(
    {
        name: column
        for column, names in {
            "sense": "drehsinn umlaufsinn drehrichtung sens_de_rotation sens_de_parcours senso_di_rotazione "
            "sentido_de_giro sentido_de_rotación rotation_sense",
            "run": "lauf umlauf umdrehung kreis turn cycle tour passe giro passata vuelta pasada",
            "angle": "winkel polarwinkel angolo ángulo phi φ",
            "deviation": "abweichung radialabweichung fehler error radial_deviation écart écart_radial "
            "scostamento scostamento_radiale desviación desviación_radial",
            "radius": "radien rayon raggio radio",
            "time": "zeit temps tempo tiempo",
        }.items()
        for name in list_spellings(names)
    }
)


class CircleCsv:
    """Tables of circles: text with a header row."""

    identifier = "circle-csv"
    title = Words("Table of a circular test (CSV)")
    options: type[Options] = CircleCsvOptions
    suffixes = ()

    def proposals(self, file: Path) -> Iterable[SourceProposal]:
        """Return the keys by which a file may be read, if it has the columns of a circular test."""
        for keys in ({}, _find_columns_called_otherwise(file), _find_keys_of_one_turn(file)):
            options = CircleCsvOptions(file=file, **keys)
            circle = NominalCircle("XY", _USUAL_RADIUS, _USUAL_FEED)
            try:
                cells, layout = _read_table_of(
                    options, SourceContext(Axis("XY", circle=circle), Place(str(file)))
                )
            except InputError:
                continue
            if layout.sense is None and not keys:
                continue
            if layout.value.name == "radius":
                circle = replace(circle, radius=_guess_radius(cells, layout.value))
            return [SourceProposal(keys, asks=(_say_asked(layout),), circle=circle)]
        return []

    def read(self, options: CircleCsvOptions, context: SourceContext) -> MeasurementSet:
        """Read a table; raise `InputError` with every defect and its place."""
        circle = context.axis.circle
        if circle is None:
            raise InputError.at(
                context.place,
                "circle-csv reads circular tests, and this job has no circle; say which was run: "
                "circle: {plane: XY, radius: 150, feed: 1000}, instead of axis",
            )
        cells, layout = _read_table_of(options, context)
        table = cells.table
        rows = list(read_circle_rows(cells, layout, options))
        problems = [*table.problems, *cells.problems]
        if rows and not problems:
            problems = list(find_misread(rows, layout, table, circle, options))
        if problems or not rows:
            raise InputError(cap_problems(problems) or [Problem(table.source.place(), "holds no readings")])
        turns = _collect_turns(rows, layout, circle, options)
        problems = [*_find_wrong_turns(turns)]
        if problems:
            raise InputError(cap_problems(problems))
        turns, follows = put_one_after_another(turns)
        readings, averaging, remarks = _choose_evaluated(turns, circle, options)
        provenance = Provenance(
            self.identifier,
            (table.source.source,),
            (*_list_remarks(layout, circle, options), *([_FOLLOW] if follows else []), *remarks),
            averaging=averaging,
            days=days_of_readings(cells, layout.time),
        )
        return collect_readings(readings, context.axis, provenance, place=table.source.place())


def _read_table_of(options: CircleCsvOptions, context: SourceContext) -> tuple[Cells, CircleColumns]:
    table = options.read_table()
    layout = find_circle_columns(table, options, context)
    return options.cells_of(table, [column.index for column in layout.list_number_columns()]), layout


def _find_columns_called_otherwise(file: Path) -> dict[str, Any]:
    """Return the keys by which a table with headings of another language is read; none for others."""
    options = CircleCsvOptions(file=file)
    try:
        among = read_headings(options.read_table(_is_called_otherwise), options)
    except InputError:
        return {}
    called = {column: each.name for each in among if (column := _CALLED.get(folded(each.name)))}
    return {"columns": called} if "sense" in called else {}


def _is_called_otherwise(name: str) -> bool:
    return folded(heading_of(name).name) in {*_CALLED, *COLUMN_NAMES}


def _find_keys_of_one_turn(file: Path) -> dict[str, Any]:
    """Return the keys by which a table of one turn is read that does not name its sense; none for others.

    It has angles and a column that is called radial; the sense is that in which the angles go on.
    """
    options = CircleCsvOptions(file=file, sense="ccw")
    try:
        table = options.read_table(lambda name: options.names_column(name) or _is_radial(name))
        among = read_headings(table, options)
        radial = [each.text for each in among if _is_radial(each.text)]
        if len(radial) != 1:
            return {}
        options = CircleCsvOptions(file=file, sense="ccw", columns={"deviation": radial[0]})
        circle = NominalCircle("XY", _USUAL_RADIUS, _USUAL_FEED)
        cells, layout = _read_table_of(options, SourceContext(Axis("XY", circle=circle), Place(str(file))))
    except InputError:
        return {}
    if layout.angle is None:
        return {}
    angles = np.array([cells.number(row, layout.angle) or 0.0 for row in cells.table.rows])
    if len(angles) < 2:
        return {}
    way = "ccw" if float(np.median(np.diff(angles))) > 0 else "cw"
    return {"sense": way, "columns": {"deviation": radial[0]}}


def _guess_radius(cells: Cells, column: TextColumn) -> float:
    """Return the nominal radius that radii tell, in whole mm, m; the usual one where they tell none."""
    numbers = (cells.number(row, column) for row in cells.table.rows)
    radii = [each for each in numbers if each is not None and math.isfinite(each)]
    found = round(float(np.median(radii)), 3) if radii else 0.0
    return found if found > 0 else _USUAL_RADIUS


def _is_radial(text: str) -> bool:
    return "radial" in folded(text)


def _say_asked(layout: CircleColumns) -> str:
    """Return what a table of a circle leaves open: some of it can be seen only by who ran it."""
    radius = "" if layout.value.name == "radius" else ", with which nominal radius"
    return (
        f"In which plane{radius} and at which feed (mm/min) was the circle run? The file does not tell; "
        "write it into 'circle' of the job."
    )


def _collect_turns(
    rows: Sequence[CircleRow], layout: CircleColumns, circle: NominalCircle, options: CircleCsvOptions
) -> list[CircleTurn]:
    """Return the turns of a table in the order in which they begin."""
    found: dict[tuple[Approach, int], list[CircleRow]] = {}
    for row in rows:
        found.setdefault((row.sense, row.run), []).append(row)
    nominal = 0.0 if layout.value.name == "deviation" else circle.radius
    start = math.radians(options.start)
    turns = []
    for (way, run), own in found.items():
        time = np.array([row.time for row in own])
        if layout.angle:
            angle = np.unwrap(np.array([row.angle for row in own]))
        else:
            angle = start + float(way) * circle.angular_speed * (time - time[0])
        conditions = {
            column.name: np.array([row.conditions[index] for row in own])
            for index, column in enumerate(layout.conditions)
        }
        deviation = np.array([row.value for row in own]) - nominal
        turns.append(CircleTurn(way, run, angle, deviation, time, conditions, [row.place for row in own]))
    return turns


def _find_wrong_turns(turns: Sequence[CircleTurn]) -> Iterator[Problem]:
    for turn in turns:
        place, name = turn.places[0], _NAMES[turn.sense]
        if len(turn.angle) < _FEWEST:
            yield Problem(
                place,
                f"run {turn.run} {name} has {counted(len(turn.angle), 'reading')}; the form of a circle "
                f"needs {_FEWEST} at least",
            )
            continue
        if np.any(np.diff(turn.time) < 0):
            later = int(np.argmax(np.diff(turn.time) < 0)) + 1
            yield Problem(
                turn.places[later],
                "the time is before that of the reading above; readings stand in the order of time",
            )
        for message in find_strays(turn):
            yield Problem(place, f"run {turn.run} {name}: {message}")


_NAMES = {Approach.POSITIVE: "ccw", Approach.NEGATIVE: "cw"}


def _choose_evaluated(
    turns: Sequence[CircleTurn], circle: NominalCircle, options: CircleCsvOptions
) -> tuple[list[Reading], Averaging | None, tuple[Words, ...]]:
    """Return the readings that are evaluated, what was averaged, and what is to be said of both."""
    stated = [math.radians(arc) if arc is not None else None for arc in (options.feed_in, options.feed_out)]
    parts = [choose_evaluated_part(turn, *stated) for turn in turns]
    before, behind = max(part[1] for part in parts), max(part[2] for part in parts)
    remarks = []
    if before > 0 or behind > 0:
        is_stated = options.feed_in is not None or options.feed_out is not None
        remarks.append(
            _ARCS.given(
                before=float(f"{math.degrees(before):.4g}"),
                behind=float(f"{math.degrees(behind):.4g}"),
                why=_STATED if is_stated else _HALVED,
            )
        )
    kept = [part[0] for part in parts]
    shared = None if options.readings_per_turn else find_common_angles(kept, _MOST_KEPT)
    if shared is not None:
        return [reading for turn in kept for reading in _list_as_they_are(turn, shared)], None, tuple(remarks)
    number = options.readings_per_turn or count_arcs_of(kept)
    averages = average_turns(kept, number)
    averaging = look_at_averages(averages, circle.angular_speed)
    remarks.append(_say_averaging(averaging, number))
    readings = [
        Reading(
            each.turn.places[int(each.central[index])],
            float(each.angle[index]),
            each.turn.sense,
            each.turn.run,
            float(each.deviation[index]),
            None if math.isnan(each.time[index]) else float(each.time[index]),
            {name: float(values[index]) for name, values in each.conditions.items()},
        )
        for each in averages
        for index in range(len(each.angle))
    ]
    return readings, averaging, tuple(remarks)


def _list_as_they_are(turn: CircleTurn, shared: FloatArray) -> Iterator[Reading]:
    """Yield the readings of a turn at the angles that all turns share."""
    own = np.mod(turn.angle, TURN)
    half_way = (shared + np.append(shared[1:], shared[0] + TURN)) / 2
    nearest = np.searchsorted(half_way, own) % len(shared)
    for index, target in enumerate(nearest.tolist()):
        yield Reading(
            turn.places[index],
            float(shared[target]),
            turn.sense,
            turn.run,
            float(turn.deviation[index]),
            None if math.isnan(turn.time[index]) else float(turn.time[index]),
            {name: float(values[index]) for name, values in turn.conditions.items()},
        )


def _say_averaging(averaging: Averaging, number: int) -> Words:
    vibration = Words("no vibration stands out of it")
    if averaging.amplitude:
        vibration = _VIBRATION.given(
            frequency=float(f"{averaging.frequency:.3g}"), amplitude=float(f"{averaging.amplitude * 1e6:.2g}")
        )
    return _AVERAGED.given(
        readings=averaging.readings,
        arc=float(f"{360 / number:.6g}"),
        left=float(f"{averaging.left_out * 1e6:.2g}"),
        vibration=vibration,
    )


def _list_remarks(layout: CircleColumns, circle: NominalCircle, options: CircleCsvOptions) -> Iterator[Words]:
    """Yield what a reader of the results must know of the table."""
    if layout.angle:
        angles = Words("the column “{column}” ({unit})").given(
            column=layout.angle.text, unit=layout.angle.unit.symbol if layout.angle.unit else ""
        )
    else:
        angles = _RECKONED.given(start=options.start, feed=float(f"{circle.feed * 60e3:.6g}"))
    yield _FROM.given(
        angles=angles,
        quantity=_QUANTITIES[layout.value.name],
        column=layout.value.text,
        unit=layout.value.unit.symbol if layout.value.unit else "",
    )
    if options.sense:
        yield _ONE_SENSE.given(sense=options.sense)
    if layout.run is None:
        yield Words("The file names no runs: all readings of a sense were taken as one turn.")


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of circles."""
    return [CircleCsv()]
