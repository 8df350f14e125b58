"""Puts the readings of a file in order as a measurement set, and refuses what is no test of an axis."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeAlias

import numpy as np

from zlmreport.errors import InputError, Place, Problem
from zlmreport.language import Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import BoolArray, FloatArray, IntArray, read_only_floats, read_only_integers
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurand import Coordinate
from zlmreport.measurement.measurement_set import CONDITIONS, MeasurementSet
from zlmreport.measurement.provenance import Provenance
from zlmreport.measurement.units import ANGLES, with_unit, write_behind

Check: TypeAlias = Callable[[MeasurementSet, Sequence[Place]], Iterator[Problem]]

#: Steps finer than this (m or rad) are taken within a period of the scale or the screw, where a deviation
#: of several steps is ordinary.
_FINE_STEP = 1e-3
#: What a single target is held against if the job states no travel, m or rad.
_ONE = 1.0
#: Of what is no position: lengths across the motion, m, and angles, rad, beyond which a unit is wrong.
_WIDEST = (0.01, "any deviation across a motion")
_WIDEST_ANGLE = 0.1
#: A full test of so many readings is refused if hardly any of them are there.
_LARGE_TEST = 1_000_000
_HARDLY_ANY = 0.01
#: Part of the smallest interval of a run by which what different runs call a target is one place.
_ONE_PLACE = 0.01
#: Problems of one file that are named one by one.
MOST_NAMED = 20
#: Problems that differ by their numbers alone, up to which each is named; lines that are listed of more.
_MOST_ALIKE, _MOST_LINES = 3, 5
#: Seconds by which clocks go back, and what is said of it; how far from that a reading may lie, s.
_PUT_BACK = {
    3600.0: "did summer time end there? Write times with their offset, as in 2026-10-25T02:10:00+01:00",
    43200.0: "is it a clock of 12 hours? Write AM and PM, or 24 hours",
}
_LOOSELY = 90.0
#: A number in a message, which another message of the same cause has otherwise.
_NUMBER = re.compile(r"[+\-−]?\d+(?:[.,'’ \u00a0\u202f]\d+)*")

#: Relative to the largest target position: positions closer than this are one target, computed twice.
_NOISE = 1e-9
#: Metres or radians; no axis goes so far. Seconds: no test takes so long.
_FARTHEST, _LONGEST = 1e4, 1e8
_MOST_RUNS = 1_000_000

_NO_TIMES = Words("No times were logged: drift and warm-up can only be judged by the order of the readings.")
_MODULO = Words(
    "Whole turns were taken off readings (number: {count}): positions were displayed modulo 360°."
)


@dataclass(frozen=True, slots=True)
class Reading:
    """One reading as a data source hands it on, in SI.

    Attributes
    ----------
    place
        Where it stands in its file.
    target_position
        m or rad.
    approach
        Direction of approach.
    run
        Number of the run; what is no positive integer is refused.
    deviation
        x = actual − target, m or rad; NaN where the file names the reading and leaves it out.
    time
        Seconds from any fixed moment; NaN or None where it was not logged.
    conditions
        What was logged beside it, by name; NaN where it was not.
    """

    place: Place
    target_position: float
    approach: Approach
    run: float
    deviation: float
    time: float | None = None
    conditions: Mapping[str, float] = field(default_factory=dict)


def collect(
    readings: Iterable[Reading],
    axis: Axis,
    provenance: Provenance,
    *,
    place: Place,
    problems: Iterable[Problem] = (),
) -> MeasurementSet:
    """Return the measurement set of the readings, checked.

    Parameters
    ----------
    readings
        In the order in which they were taken.
    axis
        The axis under test.
    provenance
        Where the readings come from; a remark is added if they carry no times.
    place
        The file, for what has no line of its own.
    problems
        What the data source found wrong while it read: reported together with what is found here.

    Raises
    ------
    InputError
        With every defect of the data, up to 20 of them one by one: no readings; target positions,
        deviations or conditions that cannot be; run numbers that are none; duplicates; targets that no
        other run has; times that fall.
    """
    found = list(problems)
    sound = []
    for reading in readings:
        wrong = list(_find_wrong_alone(reading, axis))
        found.extend(wrong)
        if not wrong:
            sound.append(reading)
    if sound:
        measurements = _arrange_readings(sound, axis, provenance)
        places = [reading.place for reading in sound]
        misread = list(_check_columns_are_what_they_say(measurements, places))
        found.extend(misread or (each for check in _CHECKS for each in check(measurements, places)))
        if not found:
            return measurements
    elif not found:
        found.append(Problem(place, "holds no readings"))
    raise InputError(cap_problems(found))


def is_run(number: float) -> bool:
    """Whether a number can be that of a run."""
    return 1 <= number <= _MOST_RUNS and float(number).is_integer()


def say_no_run(number: float) -> str:
    """Return what to say of a number that cannot be that of a run."""
    return f"{number:.9g} is no number of a run; runs are counted 1, 2, 3 and so on"


def _say_too_long(seconds: float) -> str:
    return f"no test takes {seconds:.3g} s; is the unit of its time right?"


def _find_wrong_alone(reading: Reading, axis: Axis) -> Iterator[Problem]:
    """Yield what is wrong with a reading whatever the others are."""
    if axis.measurand.coordinate is Coordinate.TIME:
        if not abs(reading.target_position) <= _LONGEST:
            yield Problem(reading.place, _say_too_long(reading.target_position))
    elif not abs(reading.target_position) <= _FARTHEST:
        unit = axis.position_unit
        position = with_unit(f"{unit.from_si(reading.target_position):.9g}", unit.symbol)
        yield Problem(
            reading.place, f"the target position, {position}, is not on any axis; is its unit right?"
        )
    if not is_run(reading.run):
        yield Problem(reading.place, say_no_run(reading.run))
    quantities = {"the deviation": reading.deviation, "the time": reading.time or 0.0, **reading.conditions}
    for name, value in quantities.items():
        if math.isinf(value):
            yield Problem(reading.place, f"{name} is infinite; a reading is a finite number")


def _arrange_readings(readings: Sequence[Reading], axis: Axis, provenance: Provenance) -> MeasurementSet:
    """Return the readings as a measurement set that nobody has checked yet."""
    positions, target = _find_targets(np.array([reading.target_position for reading in readings]))
    deviation = np.array([reading.deviation for reading in readings])
    if axis.kind is AxisKind.ROTARY and axis.measurand.is_position:
        deviation, wrapped = _unwrap_turns(deviation)
        if wrapped:
            remark = _MODULO.given(count=wrapped)
            provenance = replace(provenance, remarks=(*provenance.remarks, remark))
    names = list(dict.fromkeys(name for reading in readings for name in reading.conditions))
    conditions = {
        name: read_only_floats([reading.conditions.get(name, math.nan) for reading in readings])
        for name in names
    }
    times = np.array([math.nan if reading.time is None else reading.time for reading in readings])
    logged = times[~np.isnan(times)]
    if not logged.size:
        provenance = replace(provenance, remarks=(*provenance.remarks, _NO_TIMES))
    return MeasurementSet(
        axis=axis,
        target_positions=read_only_floats(positions),
        target=read_only_integers(target),
        approach=read_only_integers([reading.approach for reading in readings]),
        run=read_only_integers([int(reading.run) for reading in readings]),
        deviation=read_only_floats(deviation),
        time=read_only_floats(times - logged[0]) if logged.size else None,
        conditions={name: values for name, values in conditions.items() if not np.all(np.isnan(values))},
        provenance=provenance,
    )


def _unwrap_turns(deviation: FloatArray) -> tuple[FloatArray, int]:
    """Return deviations without the whole turns in them, and how many had some.

    A display that counts modulo 360° shows 359.99° for a target of 0°, and 0.01° for one of 360°.
    """
    turns = np.nan_to_num(np.round(deviation / (2 * math.pi)), posinf=0.0, neginf=0.0)
    return np.where(turns == 0, deviation, deviation - 2 * math.pi * turns), int(np.count_nonzero(turns))


def _find_targets(positions: FloatArray) -> tuple[FloatArray, IntArray]:
    """Return the distinct target positions, rising, and for each reading the index of its own.

    Positions that differ by the noise of a computation (0.3 and 0.1 + 0.2) are one target: the one that
    is written most often.
    """
    distinct, spelling, count = np.unique(positions + 0.0, return_inverse=True, return_counts=True)
    noise = _NOISE * np.max(np.abs(distinct))
    cluster = np.concatenate(([0], np.cumsum(np.diff(distinct) > noise)))
    by_frequency = np.lexsort((-count, cluster))
    _, first = np.unique(cluster[by_frequency], return_index=True)
    return distinct[by_frequency[first]], cluster[spelling]


def cap_problems(problems: Iterable[Problem]) -> list[Problem]:
    """Return the first problems in the order of the file, those alike as one, and how many more there are."""
    ordered = join_alike(problems)
    named, more = ordered[:MOST_NAMED], ordered[MOST_NAMED:]
    if more:
        named.append(Problem(more[0].place, f"and {len(more)} more"))
    return named


def join_alike(problems: Iterable[Problem]) -> list[Problem]:
    """Return problems in the order of the file; of many that differ by numbers alone the first, and how many.

    What is wrong in every row of a column has one cause, and is mended once.
    """
    groups: dict[tuple[str, str], list[Problem]] = {}
    for each in sorted(set(problems)):
        groups.setdefault((each.place.file, _NUMBER.sub("0", each.message)), []).append(each)
    return sorted(each for group in groups.values() for each in _join_group(group))


def _join_group(group: Sequence[Problem]) -> Sequence[Problem]:
    if len(group) <= _MOST_ALIKE or not group[0].place.line:
        return group
    lines = [*dict.fromkeys(each.place.line for each in group)]
    listed = ", ".join(map(str, lines[:_MOST_LINES])) + (", …" if len(lines) > _MOST_LINES else "")
    at = f"line{'s' if len(lines) > 1 else ''} {listed}"
    return [replace(group[0], message=f"{group[0].message} ({len(group)} like this: {at})")]


def _check_columns_are_what_they_say(
    measurements: MeasurementSet, places: Sequence[Place]
) -> Iterator[Problem]:
    """Refuse what is no test at all: something else was taken for the target position or the run."""
    targets, runs = len(measurements.target_positions), len(measurements.runs)
    readings = len(measurements.deviation)
    full = len(measurements.approaches) * targets * runs
    if full > _LARGE_TEST and readings < _HARDLY_ANY * full:
        yield Problem(
            Place(places[0].file),
            f"{targets} target positions and {runs} runs would be {full} readings, and there are {readings}; "
            "is the target the commanded position, and the run the number of the cycle?",
        )
    elif runs > 1 and targets == readings >= 4:
        yield Problem(
            Place(places[0].file),
            f"no target position was read twice in {runs} runs; is the target the commanded position, "
            "or are target and actual position exchanged?",
        )
    elif (places_alike := _count_places(measurements)) and 2 * places_alike <= targets:
        yield Problem(
            places[0],
            f"{targets} target positions are {places_alike} places, each written otherwise from run to run; "
            "is the target the commanded position, and not what a display showed?",
        )


def _count_places(measurements: MeasurementSet) -> int:
    """Return how many places targets are, if those that hardly differ are one; 0 of a single one."""
    targets = measurements.target_positions
    read = np.unique(_number_passes(measurements) * len(targets) + measurements.target)
    intervals = np.diff(targets[read % len(targets)])[np.diff(read // len(targets)) == 0]
    return int(np.count_nonzero(np.diff(targets) > _ONE_PLACE * intervals.min()) + 1) if intervals.size else 0


def _check_targets_lie_on_the_travel(
    measurements: MeasurementSet, places: Sequence[Place]
) -> Iterator[Problem]:
    axis = measurements.axis
    if axis.travel is None:
        return
    first, last = sorted(axis.travel)
    noise = _NOISE * max(abs(first), abs(last))
    for index, target in enumerate(measurements.target_positions):
        if not first - noise <= target <= last + noise:
            reading = int(np.argmax(measurements.target == index))
            unit = axis.position_unit
            yield Problem(
                places[reading],
                f"target {_write_position(measurements, index)} lies off the travel "
                "(axis.travel in the job), "
                f"{unit.from_si(first):.9g} to {unit.from_si(last):.9g}{write_behind(unit.symbol)}",
            )


def _check_no_reading_is_there_twice(
    measurements: MeasurementSet, places: Sequence[Place]
) -> Iterator[Problem]:
    passes = _number_passes(measurements)
    key = passes * len(measurements.target_positions) + measurements.target
    _, first, same = np.unique(key, return_index=True, return_inverse=True)
    for reading in np.flatnonzero(first[same] != np.arange(len(key))).tolist():
        earlier = places[first[same[reading]]]
        yield Problem(
            places[reading],
            f"{_name_reading(measurements, reading)}, stands in line {earlier.line} already; "
            f"a repeated run has a number of its own{_say_of_a_turn(measurements, reading)}",
        )


def _say_of_a_turn(measurements: MeasurementSet, reading: int) -> str:
    """Return what may be meant where the end of a full turn stands as its beginning."""
    is_zero = measurements.target_positions[measurements.target[reading]] == 0
    is_rotary = measurements.axis.kind is AxisKind.ROTARY
    return "; the target at the end of a full turn is 360" if is_zero and is_rotary else ""


def _check_no_target_is_off_the_list(
    measurements: MeasurementSet, places: Sequence[Place]
) -> Iterator[Problem]:
    """Refuse a target that most runs do not have, where one that they have was left out."""
    occupied = _find_occupied(measurements)
    regular = _find_regular_targets(occupied)
    if np.all(regular):
        return
    ordinary_pass = 2 * np.count_nonzero(occupied[:, regular], axis=1) >= np.count_nonzero(regular)
    passes = _number_passes(measurements)
    for reading in np.flatnonzero(~regular[measurements.target] & ordinary_pass[passes]).tolist():
        left_out = np.flatnonzero(regular & ~occupied[passes[reading]])
        if left_out.size:
            targets = measurements.target_positions
            index = int(measurements.target[reading])
            meant = int(left_out[np.argmin(np.abs(targets[left_out] - targets[index]))])
            yield Problem(
                places[reading],
                f"target {_write_position(measurements, index)} is on no other run's list, and "
                f"{_write_position(measurements, meant)}, which is, has no reading in this run; "
                "was that meant? (A target that was left out keeps its row, with an empty cell.)",
            )


def _check_deviations_are_credible(
    measurements: MeasurementSet, places: Sequence[Place]
) -> Iterator[Problem]:
    """Refuse deviations that reach the next target: positions given as deviations, or a wrong unit."""
    largest, what = _find_largest_deviation(measurements)
    beyond = np.flatnonzero(np.abs(measurements.deviation) > largest).tolist()
    axis = measurements.axis
    unit = axis.position_unit if axis.measurand.is_position else axis.deviation_unit
    limit = f"{what}, {unit.from_si(largest):.9g}{write_behind(unit.symbol)}"
    advice = "is it a position given as deviation, or a wrong unit?"
    if largest == _FINE_STEP:
        advice = f"{advice[:-1]} (perhaps that of the targets)?"
    if 2 * len(beyond) > np.count_nonzero(~np.isnan(measurements.deviation)) > 2:
        yield Problem(
            places[beyond[0]], f"{len(beyond)} deviations from here on are larger than {limit}; {advice}"
        )
        return
    for reading in beyond:
        value = axis.deviation_unit.from_si(float(measurements.deviation[reading]))
        deviation = with_unit(f"{value:.9g}", axis.deviation_unit.symbol)
        yield Problem(places[reading], f"the deviation, {deviation}, is larger than {limit}; {advice}")


def _check_something_was_read(measurements: MeasurementSet, places: Sequence[Place]) -> Iterator[Problem]:
    if np.all(np.isnan(measurements.deviation)):
        yield Problem(Place(places[0].file), "every reading is missing; there is nothing to evaluate")


def _check_times_are_those_of_a_test(
    measurements: MeasurementSet, places: Sequence[Place]
) -> Iterator[Problem]:
    """Refuse times that fall, and those that lie too far apart."""
    if measurements.time is None:
        return
    logged = np.flatnonzero(~np.isnan(measurements.time))
    longest = int(logged[np.argmax(np.abs(measurements.time[logged]))])
    if abs(measurements.time[longest]) > _LONGEST:
        yield Problem(places[longest], _say_too_long(float(measurements.time[longest])))
        return
    steps = np.diff(measurements.time[logged])
    usual = float(np.median(steps[steps > 0])) if (steps > 0).any() else 0.0
    for later in np.flatnonzero(steps < 0) + 1:
        yield Problem(
            places[logged[later]],
            f"the time is before that of the reading in line {places[logged[later - 1]].line}; "
            f"{_say_why_back(usual - float(steps[later - 1]), usual)}",
        )


def _say_why_back(back: float, usual: float) -> str:
    """Say what may have put a clock back by so many seconds, where readings come in the usual distance."""
    for seconds, why in _PUT_BACK.items():
        if abs(back - seconds) <= max(2 * abs(usual), _LOOSELY):
            return why
    return "readings stand in the order in which they were taken"


def _check_conditions_are_credible(
    measurements: MeasurementSet, places: Sequence[Place]
) -> Iterator[Problem]:
    for name, values in measurements.conditions.items():
        kind = CONDITIONS.get(name)
        if kind is None:
            continue
        lowest, highest = kind.unit.to_si(kind.lowest), kind.unit.to_si(kind.highest)
        beyond = np.flatnonzero((values < lowest) | (values > highest))
        if beyond.size:
            yield Problem(
                places[beyond[0]],
                f"{name} is not between {kind.lowest:g} and {kind.highest:g} {kind.unit.symbol} "
                f"here (readings like this: {beyond.size}); is its unit right, or was a sensor silent?",
            )


_CHECKS: tuple[Check, ...] = (
    _check_targets_lie_on_the_travel,
    _check_no_reading_is_there_twice,
    _check_no_target_is_off_the_list,
    _check_deviations_are_credible,
    _check_something_was_read,
    _check_times_are_those_of_a_test,
    _check_conditions_are_credible,
)


def _number_passes(measurements: MeasurementSet) -> IntArray:
    """Return for each reading the index of its pass over the targets: one run in one direction."""
    _, run = np.unique(measurements.run, return_inverse=True)
    _, index = np.unique(2 * run + (measurements.approach == Approach.POSITIVE), return_inverse=True)
    return np.asarray(index, dtype=np.int64)


def _find_occupied(measurements: MeasurementSet) -> BoolArray:
    """Return which pass has a row for which target, shape (pass, target)."""
    passes = _number_passes(measurements)
    occupied = np.zeros((passes.max() + 1, len(measurements.target_positions)), dtype=np.bool_)
    occupied[passes, measurements.target] = True
    return occupied


def _find_regular_targets(occupied: BoolArray) -> BoolArray:
    """Return which targets more than half of the passes have."""
    return np.asarray(2 * np.count_nonzero(occupied, axis=0) > len(occupied), dtype=np.bool_)


def _find_largest_deviation(measurements: MeasurementSet) -> tuple[float, str]:
    """Return the largest deviation that can be one, m or rad, and what it is."""
    measurand = measurements.axis.measurand
    if not measurand.is_position:
        if measurand.coordinate is Coordinate.TIME:
            return _WIDEST[0], "any displacement over time"
        return (_WIDEST_ANGLE, "any angle of an axis") if measurand.unit in ANGLES else _WIDEST
    regular = _find_regular_targets(_find_occupied(measurements))
    targets = measurements.target_positions
    if np.count_nonzero(regular) > 1:
        targets = targets[regular]
    if len(targets) > 1:
        interval = float(np.min(np.diff(targets)))
        if interval >= _FINE_STEP:
            return interval, "the smallest target interval"
        return _FINE_STEP, "any deviation at steps so fine"
    if measurements.axis.travel is not None:
        first, last = measurements.axis.travel
        return max(abs(last - first), _FINE_STEP), "the travel"
    return _ONE, "any deviation"


def _write_position(measurements: MeasurementSet, index: int) -> str:
    unit = measurements.axis.position_unit
    return with_unit(f"{unit.from_si(float(measurements.target_positions[index])):.9g}", unit.symbol)


def _name_reading(measurements: MeasurementSet, reading: int) -> str:
    arrow = Approach(int(measurements.approach[reading])).arrow
    target = _write_position(measurements, int(measurements.target[reading]))
    return f"target {target} {arrow}, run {measurements.run[reading]}"
