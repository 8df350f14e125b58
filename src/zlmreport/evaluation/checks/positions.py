"""How many target positions, and where along the axis."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from zlmreport.evaluation import printed
from zlmreport.evaluation.requirements import Basis, Finding
from zlmreport.language import Words
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurement_set import MeasurementSet

#: Positions come as decimal numbers of mm or °: what differs less than this is the same.
_ROUNDING = 1e-9
_RIGHT_ANGLE = math.pi / 2
_LENGTH_WITH_A_RULE = 2.0


def measured_length(measurements: MeasurementSet) -> float:
    """Return the distance between the first and the last target position, m or rad."""
    return float(measurements.target_positions[-1] - measurements.target_positions[0])


def exceeds(value: float, limit: float) -> bool:
    """Tell whether a length or an angle is above a limit by more than the rounding of its digits."""
    return value > limit * (1 + _ROUNDING)


def positions_in_all(measurements: MeasurementSet, minimum: int, basis: Basis) -> Finding:
    """Ask for a number of target positions, whatever the length."""
    number = len(measurements.target_positions)
    requirement = Words("At least {positions}", "Mindestens {positions}")
    return Finding(
        requirement.given(positions=printed.positions(minimum)),
        printed.positions(number),
        number >= minimum,
        basis,
    )


def positions_per_metre(
    measurements: MeasurementSet,
    per_metre: int,
    basis: Basis,
    *,
    further: int = 0,
    minimum: int = 0,
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
    requirement = Words(
        "At least {density}{further}{minimum}", "Mindestens {density}{further}{minimum}"
    ).given(
        density=Words("{n} positions per metre", "{n} Positionen je Meter").given(n=per_metre),
        further=Words(" and {n} more", " und {n} weitere").given(n=further) if further else "",
        minimum=Words(", {n} in all", ", insgesamt {n}").given(n=minimum) if minimum else "",
    )
    if measurements.axis.kind is not AxisKind.LINEAR:
        not_for_angles = Words(
            "{positions}; the rule is stated for lengths only",
            "{positions}; die Regel ist nur für Längen angegeben",
        )
        return Finding(requirement, not_for_angles.given(positions=printed.positions(number)), None, basis)
    on_length = Words("{positions} on {length}", "{positions} auf {length}").given(
        positions=printed.positions(number), length=printed.position(measurements.axis, length)
    )
    if exceeds(length, _LENGTH_WITH_A_RULE):
        beyond = Words(
            "{on_length}; the rule is stated up to {limit}",
            "{on_length}; die Regel ist bis {limit} angegeben",
        )
        limit = printed.position(measurements.axis, _LENGTH_WITH_A_RULE)
        return Finding(requirement, beyond.given(on_length=on_length, limit=limit), None, basis)
    needed = max(minimum, math.ceil(per_metre * length - _ROUNDING) + further)
    return Finding(requirement, on_length, number >= needed, basis)


def positions_per_scale_element(measurements: MeasurementSet, minimum: int, basis: Basis) -> Finding:
    """Ask for a number of positions on each element of the machine's scale.

    Elements are counted from the start of the travel, or from the first target where no travel is
    stated; a target where two elements meet belongs to both, and a last element that the measured length
    covers in part does not count.
    """
    requirement = Words(
        "At least {positions} on each scale element", "Mindestens {positions} je Maßstabselement"
    )
    requirement = requirement.given(positions=printed.positions(minimum))
    targets = measurements.target_positions
    element = measurements.axis.scale_element
    if element is None:
        one_piece = Words(
            "{positions}; scale taken as one piece, no element stated",
            "{positions}; Maßstab als ein Stück angenommen, kein Element angegeben",
        )
        found = one_piece.given(positions=printed.positions(len(targets)))
        return Finding(requirement, found, len(targets) >= minimum, basis)
    travel = measurements.axis.travel
    start, end = (min(travel), max(travel)) if travel else (float(targets[0]), float(targets[-1]))
    number = max(1, math.floor((end - start) / element + _ROUNDING))
    starts = start + element * np.arange(number)[:, np.newaxis]
    slack = _ROUNDING * max(element, end - start)
    inside = (targets >= starts - slack) & (targets <= starts + element + slack)
    fewest = int(np.count_nonzero(inside, axis=1).min())
    found = Words(
        "{fewest} on the element of {element} that has fewest",
        "{fewest} auf dem am schwächsten besetzten Element von {element}",
    ).given(fewest=printed.positions(fewest), element=printed.position(measurements.axis, element))
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
    written = printed.position(measurements.axis, angle)
    requirement = Words("At least {positions} on {angle}", "Mindestens {positions} auf {angle}")
    return Finding(
        requirement.given(positions=printed.positions(needed), angle=written),
        printed.positions(number),
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
    requirement = Words(
        "0°, 90°, 180° and 270° among the targets, where the measured angle holds them",
        "0°, 90°, 180° und 270° unter den Sollpositionen, soweit der Messbereich sie enthält",
    )
    if not lacking:
        return Finding(requirement, Words("they are", "enthalten"), met=True, basis=basis)
    angles = ", ".join(f"{90 * turn}°" for turn in lacking)
    found = Words("lacking: {angles}", "es fehlen: {angles}").given(angles=angles)
    return Finding(requirement, found, met=False, basis=basis)


def positions_over_travel(measurements: MeasurementSet) -> Finding:
    """Ask that the targets are spread over the travel.

    They are where no more is left at either end than lies between two neighbouring targets.
    """
    requirement = Words(
        "Target positions spread over the whole travel", "Sollpositionen über den ganzen Verfahrweg verteilt"
    )
    axis, targets = measurements.axis, measurements.target_positions
    covered = Words("{first} to {last}", "{first} bis {last}").given(
        first=printed.position(axis, float(targets[0])), last=printed.position(axis, float(targets[-1]))
    )
    if axis.travel is None:
        found = Words("{covered}; travel not stated", "{covered}; Verfahrweg nicht angegeben")
        return Finding(requirement, found.given(covered=covered), met=None)
    start, end = min(axis.travel), max(axis.travel)
    interval = float(np.diff(targets).max(initial=0.0))
    left = max(float(targets[0]) - start, end - float(targets[-1]))
    travel = Words("{start} to {end}", "{start} bis {end}").given(
        start=printed.position(axis, start), end=printed.position(axis, end)
    )
    found = Words("{covered} of {travel}", "{covered} von {travel}").given(covered=covered, travel=travel)
    return Finding(requirement, found, not exceeds(left, interval))
