"""Warnings on the readings themselves: outliers, drift, copies, turned runs, stray targets, coarse steps.

Nothing is changed or set aside for it: the document says what its reader, or an assessor, would see in the
readings too. Sentences are yielded for what chance hardly makes; each test has its own bound.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations

import numpy as np

from zlmreport.evaluation.checks import position_in_words
from zlmreport.evaluation.copies import (
    are_nearly_copies,
    estimate_agreement_by_chance,
    group_alike,
    group_copies,
)
from zlmreport.evaluation.correction.corrections import find_condition_at_readings
from zlmreport.evaluation.stray_targets import find_stray_target, join_found_in_both
from zlmreport.evaluation.turned_runs import (
    Mirrored,
    Turned,
    find_mirrored_run,
    find_run_of_another_reversal,
    measure_counter_directions,
)
from zlmreport.job.job import Job
from zlmreport.language import Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, estimate_robust_deviation
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurement_set import (
    CONDITION_NAMES,
    CONDITIONS,
    MeasurementSet,
    find_last_digit,
    find_step,
)
from zlmreport.measurement.units import ANGLES, MILLIMETRE, Unit, say_stated, say_with_unit

_DRIFTS = Words("Run means {lie} {low} {to} {high}; {stated} counted as the axis's own, and not in U")
_LIE, _AND = Words("lie between"), Words("and")
_RISE, _FALL = Words("rise from"), Words("fall from")
_TO = Words("to")
_AT_REST = Words("{range} is stated of drift at rest: what exceeds it is")
_NEGLECTED = Words("drift at rest is declared negligible: this is")
_NOTHING_STATED = Words("nothing is stated of drift at rest: this is")
_OUTLIER = Words(
    "The reading of run {run} at {target} {arrow} lies {distance} from the others of its target, and is in "
    "the results (measurement.excluded sets it aside)"
)
_ONE_MORE_OUTLIER = Words("One more reading lies as far from the others of its target")
_MORE_OUTLIERS = Words("{count} more readings lie as far from the others of their targets")
_SPIKE = Words(
    "A single reading at {target} lies {distance} from those before and after it, and is in the results"
)
_IDENTICAL = Words("Runs {runs} are identical in every digit: copies, or a resolution that hides the scatter")
_SAME_DIRECTIONS = Words(
    "Both directions are identical in every digit, in {runs}: copies, or a resolution that hides the reversal"
)
_NEARLY_IDENTICAL = Words(
    "Runs {runs} differ by a constant only, but for single digits: copies, or a resolution that hides the "
    "scatter"
)
_NEARLY_SAME_DIRECTIONS = Words(
    "Both directions differ by a constant only, but for single digits, in {runs}, and scatter otherwise: "
    "copies"
)
_COPIED_LINES = Words(
    "The readings of {one} and {other} are identical in every digit: one line may have been read twice"
)
_STRAY = Words(
    "The target at {target} lies {distance} off the line through its neighbours in every run, far more "
    "than any other: a defect of the axis at this place, or readings of another place"
)
_TOO_SMALL = Words(
    "All deviations together span {range} over {length}; if the file has {other}, state "
    "measurement.source.units: {{deviation: {other}}}"
)
_TOO_LARGE = Words(
    "All deviations together span {range} over {length}; if the file has another unit, "
    "state it under measurement.source.units"
)
_MIRRORED = Words("Run {run} mirrors the others: the sign of its deviations seems to be turned")
_IN_REVERSE = Words(
    "Run {run} mirrors the others: its readings seem to stand in reverse order of the targets"
)
_TURNED_EITHER_WAY = Words(
    "Run {run} mirrors the others: the sign of its deviations seems to be turned, or its readings stand in "
    "reverse order of the targets"
)
_INTERCHANGED = Words(
    "The reversal of run {run} is {reversal} in the mean, and {others} in the others: its directions seem to "
    "be interchanged"
)
_ANOTHER_REVERSAL = Words("The reversal of run {run} is {reversal} in the mean, and {others} in the others")
_COUNTER = Words(
    "The two directions run counter to each other along the axis: the signs of one may be turned, its "
    "readings may stand in reverse order, or the reversal changes by {change} along the axis"
)
_TWO_TEMPERATURES = Words("{name}: {stated} °C is stated, and {logged} °C was logged beside the readings")
_SPAN, _SINGLE = Words("{low} … {high}"), Words("{low}")
_COARSER = Words(
    "The resolution is stated as {stated}, and the readings were given in steps of {given}: these are counted"
)

#: Standard deviations of a run's mean that its range may show by chance.
_BY_CHANCE = 5.0
#: Correlation of run means with their order from which they are said to rise or fall.
_STEADY = 0.9
_FEWEST_RUNS = 3
#: Readings that are all alike on no axis.
_FEWEST_EQUAL = 10
#: Readings of a record in which one may be told from all others; how many times as far from its neighbours as
#: is usual, and as any other, it then lies.
_FEWEST_OF_RECORD, _SPIKE_OF_USUAL, _SPIKE_OF_OTHERS = 30, 20.0, 4.0
#: Robust standard deviations from the median of its cell at which a reading stands out.
_OUTLYING = 8.0
_MOST_NAMED = 3
#: Positions at which runs must agree for their agreement to say anything.
_FEWEST_POSITIONS = 3
#: Share of equal differences of two runs below which the last digit shows their scatter.
_TELLS = 0.5
#: Spans of all deviations that no machine reaches over so long a way, m or rad: of a position, of any other.
_LEAST_SPAN, _LEAST_ACROSS, _LONG = 1e-7, 2e-8, 1e-2
#: Spans of positions that none exceeds, m or rad, and as a part of the way.
_LARGEST_SPAN, _LARGEST_PART = {AxisKind.LINEAR: 3e-4, AxisKind.ROTARY: 5e-3}, 5e-4
_TEMPERATURES_AGREE = 0.5
_MOST_DECIMALS = 3


def find_evidence(job: Job, measurements: MeasurementSet) -> tuple[Words, ...]:
    """Return a sentence for each thing that the readings show and the job does not say."""
    readings = measurements.deviations()
    there = np.isfinite(readings)
    if not there.any():
        return ()
    if there.sum() >= _FEWEST_EQUAL and not np.ptp(readings[there]):
        return (Words("All readings are equal: the sensor, or its display, may have stood still"),)
    mirrored, turned = _find_turned_run(measurements, readings)
    wrong = [each.run for each in (mirrored, turned) if each]
    right = readings.copy()
    right[..., wrong] = np.nan  # what follows from such a run is told by it
    return (
        *_tell_turned_runs(measurements, readings, mirrored, turned),
        *_find_drift(job, measurements, np.delete(readings, wrong, axis=-1)),
        *_find_outliers(measurements, right),
        *_find_spike(measurements),
        *_find_stray_targets(measurements, readings),
        *_find_copied_runs(measurements, readings),
        *_find_copied_directions(measurements, readings),
        *_find_other_unit(measurements),
        *_find_other_temperatures(job, measurements),
        *_find_coarser_steps(job, measurements),
    )


def find_lines_read_twice(tests: Mapping[str, MeasurementSet]) -> Iterator[Words]:
    """Yield which of several measured lines have the same readings."""
    for (one, first), (other, second) in combinations(tests.items(), 2):
        if _are_identical(first.deviation, second.deviation):
            yield _COPIED_LINES.given(one=one, other=other)


def find_as_left_once_more(as_found: MeasurementSet, as_left: MeasurementSet) -> Iterator[Words]:
    """Yield whether the readings before an adjustment are those after it."""
    if not as_found.tests and _are_identical(as_found.deviation, as_left.deviation):
        yield Words("The readings are in every digit those of the measurement as left")


def _find_drift(job: Job, measurements: MeasurementSet, readings: FloatArray) -> Iterator[Words]:
    """Yield whether whole runs lie farther apart than scatter and the stated drift at rest explain."""
    count = readings.shape[-1]
    if count < 2 or measurements.reversal_is_relative:
        return
    there = np.isfinite(readings)
    residuals = readings - _compute_mean(readings, axis=-1)[..., np.newaxis]
    of_runs = _compute_mean(residuals.reshape(-1, count), axis=0)
    inner = residuals - of_runs
    numbers = there.reshape(-1, count).sum(axis=0)
    freedom = int(there.sum()) - int((there.sum(axis=-1) > 0).sum()) - count + 1
    if freedom < 1 or numbers.min() < 1:
        return
    own = np.sqrt(float(np.nansum(inner**2)) / freedom)
    full_range = float(np.ptp(of_runs))
    unit = measurements.axis.deviation_unit
    stated = job.keys.uncertainty.environmental_variation
    allowed = _BY_CHANCE * own / np.sqrt(float(numbers.min())) + (unit.to_si(stated) if stated else 0.0)
    order = np.corrcoef(np.arange(count), of_runs)[0, 1] if full_range else 0.0
    steady = count >= _FEWEST_RUNS and abs(order) > _STEADY  # two of them always rise or fall
    if full_range <= allowed or full_range <= unit.to_si(10.0**-_MOST_DECIMALS) or not (stated or steady):
        return
    low, high = (_write_size(measurements, each) for each in (float(of_runs.min()), float(of_runs.max())))
    lie, to = (_LIE, _AND) if not steady else (_RISE if order > 0 else _FALL, _TO)
    first, last = (high, low) if lie is _FALL else (low, high)
    yield _DRIFTS.given(lie=lie, low=first, to=to, high=last, stated=_say_stated_drift(job, unit))


def _say_stated_drift(job: Job, unit: Unit) -> Words:
    """Return what the job says of the drift at rest."""
    keys = job.keys.uncertainty
    if keys.environmental_variation:
        return _AT_REST.given(range=say_with_unit(keys.environmental_variation, unit.symbol))
    return _NEGLECTED if "environmental_variation" in keys.negligible else _NOTHING_STATED


def _find_outliers(measurements: MeasurementSet, readings: FloatArray) -> Iterator[Words]:
    """Yield the readings that lie far from the others of their target and direction."""
    number = np.isfinite(readings).sum(axis=-1, keepdims=True)
    if number.max() < _FEWEST_RUNS:
        return
    with np.errstate(all="ignore"):
        median = _compute_median(readings, axis=-1)[..., np.newaxis]
    distance = np.where(number >= _FEWEST_RUNS, readings - median, np.nan)
    # Whole runs that lie aside are drift, and not outliers: each reading against those of its own run too.
    distance -= _compute_median(distance.reshape(-1, distance.shape[-1]), axis=0)
    known = distance[np.isfinite(distance)]
    if not known.size:
        return
    step = _find_step(measurements)
    # Half of the readings of a small cell lie nearer to its median than to its mean.
    scale = max(estimate_robust_deviation(known[known != 0.0]) if known.any() else 0.0, step)
    # Of readings that scatter from place to place as they may, a large one among large ones is none.
    far = [
        (int(direction), int(position), int(run))
        for direction, position, run in np.argwhere(np.abs(np.nan_to_num(distance)) > _OUTLYING * scale)
        if abs(distance[direction, position, run])
        > _OUTLYING / 2 * _spread_of_others(distance[direction, position], run, scale)
    ]
    far.sort(key=lambda at: -abs(distance[at]))
    for direction, position, run in far[:_MOST_NAMED]:
        yield _OUTLIER.given(
            run=int(measurements.runs[run]),
            target=position_in_words(measurements.axis, float(measurements.target_positions[position])),
            arrow=tuple(Approach)[direction].arrow,
            distance=_write_size(measurements, abs(float(distance[direction, position, run]))),
        )
    further = len(far) - _MOST_NAMED
    if further > 0:
        yield _ONE_MORE_OUTLIER if further == 1 else _MORE_OUTLIERS.given(count=further)


def _find_spike(measurements: MeasurementSet) -> Iterator[Words]:
    """Yield a reading of a record that lies far from both its neighbours, as no other does; or that it stood.

    A machine that jerks does so at several places, and for longer than a reading.
    """
    there = np.isfinite(measurements.deviation)
    known = measurements.deviation[there]
    if not measurements.axis.measurand.is_continuous or known.size < _FEWEST_OF_RECORD:
        return
    off = np.abs(known[1:-1] - (known[:-2] + known[2:]) / 2)
    at = int(off.argmax())
    others = np.delete(off, slice(max(at - 1, 0), at + 2))
    least = max(_SPIKE_OF_USUAL * float(np.median(others)), _SPIKE_OF_OTHERS * float(others.max()))
    if off[at] > least and off[at] > _SPIKE_OF_USUAL * _find_step(measurements):
        target = measurements.target_positions[measurements.target[there][at + 1]]
        yield _SPIKE.given(
            target=position_in_words(measurements.axis, float(target)),
            distance=_write_size(measurements, float(off[at])),
        )


def _spread_of_others(cell: FloatArray, run: int, scale: float) -> float:
    """Return how far the other readings of a cell lie from its median, at least the usual scatter."""
    others = np.delete(cell, run)
    others = others[np.isfinite(others)]
    return max(scale, float(np.abs(others).max())) if others.size else scale


def _find_copied_runs(measurements: MeasurementSet, readings: FloatArray) -> Iterator[Words]:
    """Yield the runs that are copies of each other, where both have a reading: exact ones, or nearly so."""
    series = readings.reshape(-1, readings.shape[-1])
    exact = group_alike(series, _are_identical)
    for group in exact:
        yield _IDENTICAL.given(runs=_list_run_numbers(measurements, group))
    for alike in group_copies(series, _find_step(measurements)):
        if not any(set(alike) <= set(each) for each in exact):
            yield _NEARLY_IDENTICAL.given(runs=_list_run_numbers(measurements, alike))


def _find_copied_directions(measurements: MeasurementSet, readings: FloatArray) -> Iterator[Words]:
    """Yield the runs whose readings of one direction are those of the other: exact ones, or nearly so."""
    if not measurements.is_bidirectional:
        return
    runs = range(readings.shape[-1])
    same = [run for run in runs if _are_identical(*readings[..., run])]
    step = _find_step(measurements)
    by_chance = estimate_agreement_by_chance(readings.reshape(-1, len(runs)), step)
    near = [
        run
        for run in runs
        if by_chance < _TELLS
        and are_nearly_copies(readings[0, :, run], readings[1, :, run], step, by_chance, len(runs))
    ]
    for words, found in (
        (_SAME_DIRECTIONS, same),
        (_NEARLY_SAME_DIRECTIONS, [each for each in near if each not in same]),
    ):
        if found:
            of_runs = _RUN if len(found) == 1 else _RUNS
            yield words.given(runs=of_runs.given(runs=_list_run_numbers(measurements, found)))


def _find_turned_run(
    measurements: MeasurementSet, readings: FloatArray
) -> tuple[Mirrored | None, Turned | None]:
    """Return the run whose curve mirrors the others, or else that whose reversal is not theirs."""
    mirrored = find_mirrored_run(readings)
    tells = measurements.is_bidirectional and not measurements.reversal_is_relative
    return mirrored, find_run_of_another_reversal(readings) if tells and not mirrored else None


def _tell_turned_runs(
    measurements: MeasurementSet, readings: FloatArray, mirrored: Mirrored | None, turned: Turned | None
) -> Iterator[Words]:
    """Yield the run whose sign, order or reversal is not that of the others."""
    if mirrored:
        words = _IN_REVERSE if not mirrored.has_other_sign else _MIRRORED
        words = _TURNED_EITHER_WAY if mirrored.has_other_sign and mirrored.is_in_reverse else words
        yield words.given(run=int(measurements.runs[mirrored.run]))
    if mirrored or not measurements.is_bidirectional or measurements.reversal_is_relative:
        return
    if turned:
        words = _INTERCHANGED if turned.is_interchanged else _ANOTHER_REVERSAL
        yield words.given(
            run=int(measurements.runs[turned.run]),
            reversal=_write_size(measurements, turned.reversal),
            others=_write_size(measurements, turned.of_others),
        )
    change = measure_counter_directions(readings)
    if change is not None:
        yield _COUNTER.given(change=_write_size(measurements, change))


def _list_run_numbers(measurements: MeasurementSet, runs: Sequence[int]) -> str:
    return ", ".join(str(int(measurements.runs[each])) for each in runs)


def _find_stray_targets(measurements: MeasurementSet, readings: FloatArray) -> Iterator[Words]:
    """Yield the target that lies apart from its neighbours in every run, far more than any other."""
    positions, step = measurements.target_positions, _find_step(measurements)
    for stray in join_found_in_both(*(find_stray_target(positions, each, step) for each in readings)):
        yield _STRAY.given(
            target=position_in_words(measurements.axis, float(positions[stray.position])),
            distance=_write_size(measurements, abs(stray.distance)),
        )


def _find_step(measurements: MeasurementSet) -> float:
    """Return the step of the last digit of the readings, m or rad."""
    return measurements.axis.deviation_unit.to_si(find_last_digit(measurements))


_RUN, _RUNS = Words("run {runs}"), Words("runs {runs}")


def _are_identical(one: FloatArray, other: FloatArray) -> bool:
    """Return whether two series of readings are copies wherever both have one, and no row of equal values."""
    if one.shape != other.shape:
        return False
    both = np.isfinite(one) & np.isfinite(other)
    varies = both.any() and bool(np.ptp(one[both]))
    return bool(both.sum() >= _FEWEST_POSITIONS and varies and np.array_equal(one[both], other[both]))


def _find_other_unit(measurements: MeasurementSet) -> Iterator[Words]:
    """Yield whether all deviations are so small, or so large, that they seem to be in another unit."""
    axis = measurements.axis
    known = measurements.deviation[np.isfinite(measurements.deviation)]
    length = float(measurements.target_positions[-1] - measurements.target_positions[0])
    unit = axis.position_unit
    if axis.circle is not None:  # what is small or large on a path is not told by its angle
        length, unit = length * axis.circle.radius, MILLIMETRE
    full_range = float(np.ptp(known))
    is_position = axis.measurand.is_position
    least = _LEAST_SPAN if is_position or axis.circle is not None else _LEAST_ACROSS
    largest = max(_LARGEST_SPAN[axis.kind], _LARGEST_PART * length)
    if length > _LONG and 0 < full_range < least:
        words = _TOO_SMALL.given(other="deg" if axis.deviation_unit in ANGLES else "mm")
    elif is_position and full_range > largest:
        words = _TOO_LARGE
    else:
        return
    yield words.given(
        range=_write_size(measurements, full_range), length=say_stated(unit.from_si(length), unit.symbol)
    )


def _find_other_temperatures(job: Job, measurements: MeasurementSet) -> Iterator[Words]:
    """Yield the temperatures that were logged otherwise than the job states them."""
    for name, kind in CONDITIONS.items():
        stated = getattr(job.keys.environment, name, None)
        logged = (
            find_condition_at_readings(name, job, measurements) if name in measurements.conditions else None
        )
        if not name.endswith("temperature") or not isinstance(stated, float) or logged is None:
            continue
        low, high = (kind.unit.from_si(float(each)) for each in (logged.min(), logged.max()))
        if not low - _TEMPERATURES_AGREE <= stated <= high + _TEMPERATURES_AGREE:
            logged_span = _SPAN if high > low else _SINGLE
            yield _TWO_TEMPERATURES.given(
                name=CONDITION_NAMES[name],
                stated=stated,
                logged=logged_span.given(low=float(f"{low:.4g}"), high=float(f"{high:.4g}")),
            )


def _find_coarser_steps(job: Job, measurements: MeasurementSet) -> Iterator[Words]:
    """Yield whether the readings have coarser steps than the job says."""
    stated = job.keys.uncertainty.resolution
    unit = measurements.axis.deviation_unit
    if not stated or measurements.provenance.corrections:
        return
    given = find_step(measurements)
    if given > stated * (1 + 1e-9):
        yield _COARSER.given(stated=say_stated(stated, unit.symbol), given=say_with_unit(given, unit.symbol))


def _compute_mean(values: FloatArray, axis: int) -> FloatArray:
    there = np.isfinite(values)
    return np.asarray(np.where(there, values, 0.0).sum(axis=axis) / np.maximum(there.sum(axis=axis), 1))


def _compute_median(values: FloatArray, axis: int) -> FloatArray:
    """Return medians of what is there; 0 where nothing is."""
    empty = ~np.isfinite(values).any(axis=axis, keepdims=True)
    return np.asarray(np.nanmedian(np.where(empty, 0.0, values), axis=axis))


def _write_size(measurements: MeasurementSet, value: float) -> Words:
    unit = measurements.axis.deviation_unit
    return say_with_unit(float(f"{unit.from_si(value):.3g}"), unit.symbol)
