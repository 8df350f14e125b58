"""Requirements that standards share (targets, runs, directions, intervals), each giving a `Finding`."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from zlmreport.evaluation.evaluation import Basis, Finding
from zlmreport.language import Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.units import say_stated, say_with_unit

#: Positions come as decimal numbers of mm or °: what differs less than this is the same.
_ROUNDING = 1e-9
_RIGHT_ANGLE = math.pi / 2
_LENGTH_WITH_A_RULE = 2.0
_MEASURED = {
    (Approach.POSITIVE, Approach.NEGATIVE): Words("both directions"),
    (Approach.POSITIVE,): Words("positive direction only"),
    (Approach.NEGATIVE,): Words("negative direction only"),
    (): Words("no reading at all"),
}
_ONE_SIDED = Words(
    "each target in one direction only; what needs both directions at one target is not reported"
)
_RELATIVE = Words(
    "both directions, brought together by means of the readings themselves: reversal values are relative to "
    "their mean"
)
_ON_EACH_LINE = Words("On each line: {requirement}")
#: Phases that agree within this part of a period show the same point of a periodic deviation.
_SAME_PHASE = 0.01
#: Intervals that agree within this part are alike: their digits were rounded.
_ALIKE = 1e-6


def position_in_words(axis: Axis, value: float) -> Words:
    """Return a position or a distance, m or rad, to its last stated digit: ``250 mm``, ``90°``."""
    return say_stated(float(axis.position_unit.from_si(value)), axis.position_unit.symbol)


def deviation_in_words(axis: Axis, value: float) -> Words:
    """Return a deviation, m or rad, with its unit: ``12.5 µm``, ``3″``."""
    return say_with_unit(float(axis.deviation_unit.from_si(value)), axis.deviation_unit.symbol)


def positions_in_words(number: int) -> Words:
    """Return a number of target positions: ``1 position``, ``21 positions``."""
    return Words("{number} position", plural="{number} positions").given(number=number)


def runs_in_words(number: int) -> Words:
    """Return a number of runs: ``1 run``, ``5 runs``."""
    return Words("{number} run", plural="{number} runs").given(number=number)


def readings_in_words(number: int) -> Words:
    """Return how many readings there are."""
    return Words("{number} reading", plural="{number} readings").given(number=number)


def measured_length(measurements: MeasurementSet) -> float:
    """Return the distance between the first and the last target position, m or rad."""
    return float(measurements.target_positions[-1] - measurements.target_positions[0])


def exceeds(value: float, limit: float) -> bool:
    """Tell whether a length or an angle is above a limit by more than the rounding of its digits."""
    return value > limit * (1 + _ROUNDING)


def positions_in_all(measurements: MeasurementSet, minimum: int, basis: Basis) -> Finding:
    """Ask for a number of target positions, whatever the length."""
    number = len(measurements.target_positions)
    requirement = Words("At least {positions}")
    return Finding(
        requirement.given(positions=positions_in_words(minimum)),
        positions_in_words(number),
        number >= minimum,
        basis,
    )


def positions_per_metre(
    measurements: MeasurementSet, per_metre: int, basis: Basis, *, further: int = 0, minimum: int = 0
) -> Finding:
    """Ask for a density of target positions on a linear axis.

    Parameters
    ----------
    measurements
        The test. The rule is stated for lengths up to 2 m: above, and on a rotary axis, the answer is open.
    per_metre
        Positions for each metre of the measured length; a broken number counts up.
    basis
        Where the requirement is known from.
    further
        To be added once.
    minimum
        Of all positions together, however short the length.
    """
    number = len(measurements.target_positions)
    length = measured_length(measurements)
    requirement = Words("At least {density}{further}{minimum}").given(
        density=Words("{n} positions per metre").given(n=per_metre),
        further=Words(" and {n} more").given(n=further) if further else "",
        minimum=Words(", {n} in all").given(n=minimum) if minimum else "",
    )
    if measurements.axis.kind is not AxisKind.LINEAR:
        not_for_angles = Words("{positions}; the rule is stated for lengths only")
        return Finding(requirement, not_for_angles.given(positions=positions_in_words(number)), None, basis)
    on_length = Words("{positions} on {length}").given(
        positions=positions_in_words(number), length=position_in_words(measurements.axis, length)
    )
    if exceeds(length, _LENGTH_WITH_A_RULE):
        beyond = Words("{on_length}; the rule is stated up to {limit}")
        limit = position_in_words(measurements.axis, _LENGTH_WITH_A_RULE)
        return Finding(requirement, beyond.given(on_length=on_length, limit=limit), None, basis)
    needed = max(minimum, math.ceil(per_metre * length - _ROUNDING) + further)
    return Finding(requirement, on_length, number >= needed, basis)


def positions_per_scale_element(measurements: MeasurementSet, minimum: int, basis: Basis) -> Finding:
    """Ask for a number of positions on each element of the machine's scale.

    Elements are counted from the start of the travel, or from the first target where no travel is
    stated; a target where two elements meet belongs to both, and a last element that the measured length
    covers in part does not count.
    """
    requirement = Words("At least {positions} on each scale element")
    requirement = requirement.given(positions=positions_in_words(minimum))
    targets = measurements.target_positions
    element = measurements.axis.scale_element
    if element is None:
        one_piece = Words("{positions}; scale taken as one piece, no element stated")
        found = one_piece.given(positions=positions_in_words(len(targets)))
        return Finding(requirement, found, len(targets) >= minimum, basis)
    travel = measurements.axis.travel
    start, end = (min(travel), max(travel)) if travel else (float(targets[0]), float(targets[-1]))
    number = max(1, math.floor((end - start) / element + _ROUNDING))
    starts = start + element * np.arange(number)[:, np.newaxis]
    slack = _ROUNDING * max(element, end - start)
    inside = (targets >= starts - slack) & (targets <= starts + element + slack)
    fewest = int(np.count_nonzero(inside, axis=1).min())
    found = Words("{fewest} on the element of {element} that has fewest").given(
        fewest=positions_in_words(fewest), element=position_in_words(measurements.axis, element)
    )
    return Finding(requirement, found, fewest >= minimum, basis)


def positions_by_angle(
    measurements: MeasurementSet, numbers: Mapping[float, int], more: int, basis: Basis
) -> Finding:
    """Ask for a number of positions on a rotary axis.

    Parameters
    ----------
    measurements
        The test.
    numbers
        Least number of positions for measured angles up to the key, rad; keys rising.
    more
        Least number for larger angles.
    basis
        Where the requirement is known from.
    """
    angle = measured_length(measurements)
    number = len(measurements.target_positions)
    needed = next((least for limit, least in numbers.items() if not exceeds(angle, limit)), more)
    written = position_in_words(measurements.axis, angle)
    requirement = Words("At least {positions} on {angle}")
    return Finding(
        requirement.given(positions=positions_in_words(needed), angle=written),
        positions_in_words(number),
        number >= needed,
        basis,
    )


def principal_angles(measurements: MeasurementSet, basis: Basis) -> Finding:
    """Ask that 0°, 90°, 180° and 270° are among the targets, as far as the measured angle holds them."""
    targets = measurements.target_positions
    slack = _ROUNDING * 2 * math.pi
    first = math.ceil((targets[0] - slack) / _RIGHT_ANGLE)
    last = math.floor((targets[-1] + slack) / _RIGHT_ANGLE)
    asked = {turn % 4 for turn in range(first, last + 1)}
    turns = np.rint(targets / _RIGHT_ANGLE)
    among = {int(turn) % 4 for turn in turns[np.abs(targets - turns * _RIGHT_ANGLE) <= slack]}
    lacking = sorted(asked - among)
    requirement = Words("0°, 90°, 180° and 270° among the targets, where the measured angle holds them")
    if not lacking:
        return Finding(requirement, Words("they are"), met=True, basis=basis)
    angles = ", ".join(f"{90 * turn}°" for turn in lacking)
    found = Words("lacking: {angles}").given(angles=angles)
    return Finding(requirement, found, met=False, basis=basis)


def positions_over_travel(measurements: MeasurementSet) -> Finding:
    """Ask that the targets are spread over the travel.

    They are where no more is left at either end than lies between two neighbouring targets.
    """
    requirement = Words("Target positions spread over the whole travel")
    axis, targets = measurements.axis, measurements.target_positions
    covered = Words("{first} to {last}").given(
        first=position_in_words(axis, float(targets[0])), last=position_in_words(axis, float(targets[-1]))
    )
    if axis.travel is None:
        found = Words("{covered}; travel not stated")
        return Finding(requirement, found.given(covered=covered), met=None)
    start, end = min(axis.travel), max(axis.travel)
    interval = float(np.diff(targets).max(initial=0.0))
    left = max(float(targets[0]) - start, end - float(targets[-1]))
    travel = Words("{start} to {end}").given(
        start=position_in_words(axis, start), end=position_in_words(axis, end)
    )
    found = Words("{covered} of {travel}").given(covered=covered, travel=travel)
    return Finding(requirement, found, not exceeds(left, interval))


def measured_approaches(measurements: MeasurementSet) -> tuple[Approach, ...]:
    """Return the directions in which there is a reading, the positive one first.

    A direction that a file names without a single reading is not among them.
    """
    present = np.isfinite(measurements.deviation)
    return tuple(each for each in Approach if np.any(measurements.approach[present] == each))


def both_directions(measurements: MeasurementSet, consequence: Words, basis: Basis) -> Finding:
    """Ask that the targets are approached from both directions.

    Parameters
    ----------
    measurements
        The test.
    consequence
        What becomes of the standard's parameters where only one direction was measured.
    basis
        Where the requirement is known from.
    """
    requirement = Words("Targets approached in the positive and in the negative direction")
    approaches = measured_approaches(measurements)
    measured = _MEASURED[approaches]
    if measurements.one_sided_targets:
        return Finding(requirement, _ONE_SIDED, met=False, basis=basis)
    if measurements.reversal_is_relative:
        return Finding(requirement, _RELATIVE, met=False, basis=basis)
    if len(approaches) == len(Approach):
        return Finding(requirement, measured, met=True, basis=basis)
    found = Words("{measured}; {consequence}")
    given = found.given(measured=measured, consequence=consequence)
    return Finding(requirement, given, met=False, basis=basis)


def number_of_runs(measurements: MeasurementSet, minimum: int, basis: Basis) -> Finding:
    """Ask for a number of runs in each direction that was measured."""
    number = fewest_runs(measurements)
    requirement = Words("At least {runs} in each direction")
    return Finding(
        requirement.given(runs=runs_in_words(minimum)), runs_in_words(number), number >= minimum, basis
    )


def fewest_runs(measurements: MeasurementSet) -> int:
    """Return the number of runs with a reading, in that of the measured directions which has fewer."""
    present = ~np.isnan(measurements.deviations())
    taken = np.count_nonzero(np.any(present, axis=1), axis=-1)
    return min((int(taken[each.index]) for each in measured_approaches(measurements)), default=0)


def no_missing_readings(measurements: MeasurementSet) -> Finding:
    """Ask for a reading at every target in every run; a gap lowers n at its position only."""
    requirement = Words("A reading at every target in every run")
    missing = len(measurements.missing())
    present = ~np.isnan(measurements.deviations())
    total = int(np.count_nonzero(present)) + missing
    if not missing:
        several = Words("all {total} readings").given(total=total)
        complete = Words("the only reading") if total == 1 else several
        return Finding(requirement, complete, met=True)
    count = np.count_nonzero(present, axis=-1)[[approach.index for approach in measurements.approaches]]
    if measurements.one_sided_targets:
        count = count[count > 0]  # the other direction of a target is not missing
    found = Words("{missing} of {total} missing; n from {least} to {most}, evaluated by what is there")
    given = found.given(missing=missing, total=total, least=int(count.min()), most=int(count.max()))
    return Finding(requirement, given, met=False)


def spacing_against_periods(measurements: MeasurementSet, basis: Basis) -> tuple[Finding, ...]:
    """Ask that the spacing is no integer multiple of a period of the axis; one finding for each period.

    Not met where all targets show the same phase of the period. Left open where the job states none.
    """
    axis = measurements.axis
    periods = ((Words("pitch"), axis.screw_pitch), (Words("signal period"), axis.signal_period))
    stated = tuple(
        _check_spacing_against(measurements, name, period, basis)
        for name, period in periods
        if period is not None
    )
    if stated:
        return stated
    requirement = Words("Spacing no integer multiple of a period of the axis")
    return (Finding(requirement, Words("no period stated"), None, basis),)


def _check_spacing_against(measurements: MeasurementSet, name: Words, period: float, basis: Basis) -> Finding:
    """Hold the spacing against one period: the phases of all targets, as seen from the first."""
    requirement = Words("Spacing no integer multiple of the {name} ({period})").given(
        name=name, period=position_in_words(measurements.axis, period)
    )
    turns = (measurements.target_positions - measurements.target_positions[0]) / period
    if len(turns) < 2:
        return Finding(requirement, Words("a single position"), None, basis)
    from_first = np.abs(turns - np.rint(turns))
    if from_first.max() > _SAME_PHASE:
        found = Words("targets at differing phases")
        return Finding(requirement, found, met=True, basis=basis)
    found = Words("all targets at the same phase: a deviation of this period stays hidden")
    return Finding(requirement, found, met=False, basis=basis)


_INTERVALS = Words("intervals from {shortest} to {longest}")
_NO_COMMON_INTERVAL = Words("intervals from {shortest} to {longest}: there is no interval p")
#: Times the usual interval that none is long where there is an interval p.
_NO_INTERVAL = 3.0


def random_fractions(measurements: MeasurementSet, formula: str, basis: Basis) -> Finding:
    """Ask that each target carries a random fraction; equal intervals show that none does.

    A fraction of an interval lengthens none to twice its length; one of three times the usual interval shows
    that there is no interval p.

    Parameters
    ----------
    measurements
        The test.
    formula
        How the standard writes its targets: ``P = N·p + r``.
    basis
        Where the requirement is known from.
    """
    axis = measurements.axis
    requirement = Words("Targets {formula} with a random fraction r at each").given(formula=formula)
    intervals = np.diff(measurements.target_positions)
    if len(intervals) < 2:
        too_few = Words("too few positions to tell")
        return Finding(requirement, too_few, met=None, basis=basis)
    shortest, longest = float(intervals.min()), float(intervals.max())
    if longest - shortest <= _ALIKE * longest:
        found = Words("all intervals alike: {interval}")
        found = found.given(interval=_mean_in_words(axis, float(intervals.mean())))
        return Finding(requirement, found, met=False, basis=basis)
    has_interval = longest <= _NO_INTERVAL * float(np.median(intervals))
    words = _INTERVALS if has_interval else _NO_COMMON_INTERVAL
    found = words.given(shortest=position_in_words(axis, shortest), longest=position_in_words(axis, longest))
    return Finding(requirement, found, has_interval, basis)


def mean_interval(measurements: MeasurementSet, limit: float, basis: Basis) -> Finding:
    """Ask for a mean interval between neighbouring targets of at most `limit`, m or rad."""
    axis, targets = measurements.axis, measurements.target_positions
    requirement = Words("Mean interval at most {limit}")
    requirement = requirement.given(limit=position_in_words(axis, limit))
    interval = float(targets[-1] - targets[0]) / max(1, len(targets) - 1)
    return Finding(requirement, _mean_in_words(axis, interval), interval <= limit * (1 + _ALIKE), basis)


def _mean_in_words(axis: Axis, interval: float) -> Words:
    """Return a mean of intervals, m or rad, rounded as printed: without the digits that nobody stated."""
    unit = axis.position_unit
    return say_stated(float(f"{unit.from_si(interval):.6g}"), unit.symbol)


def worst_of_lines(lines: Mapping[str, MeasurementSet], rule: Callable[[MeasurementSet], Finding]) -> Finding:
    """Return what a rule finds on the one of some lines, one at least, that meets it least, with its name."""
    found = {name: rule(line) for name, line in lines.items()}
    gravity = {False: 0, None: 1, True: 2}
    name = min(found, key=lambda each: gravity[found[each].met])
    worst = found[name]
    said = Words("{found} ({name})").given(found=worst.found, name=name)
    return Finding(_ON_EACH_LINE.given(requirement=worst.requirement), said, worst.met, worst.basis)
