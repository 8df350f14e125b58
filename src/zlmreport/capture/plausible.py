"""What a reading may be by all that is known of the axis, and how a display that fails is known."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from zlmreport.capture.events import Recorded
from zlmreport.capture.visits import ListedVisit, Settings
from zlmreport.measurement.approach import Approach

#: How far a reading may depart from an earlier run's, and from the deviation at the target before, in
#: stability ranges: 50 µm and 200 µm for 1 µm. Axes err by less from run to run and from target to target; a
#: feed hold short of its target, a datum that slipped and a display that fails do not.
_FROM_RUN, _FROM_TARGET = 50, 200
#: What a display does wrong by a factor: it counts the wrong way, in inches for millimetres or the other way
#: round, in units a thousand times as large or small, without or with twice the optics' path.
FACTORS = (-1.0, 25.4, 1 / 25.4, 1000.0, 1 / 1000.0, 2.0, 0.5)
#: How many visits ahead a misread stop may be.
_AHEAD = 3


def expected_deviation(
    visit: ListedVisit, read: Mapping[tuple[int, Approach], Recorded], settings: Settings
) -> tuple[float, float]:
    """Return what a visit should read, as a deviation, and how far it may be off, m or rad.

    Parameters
    ----------
    visit
        The visit.
    read
        What was read under this datum: the latest reading of each target from each side.
    settings
        With the stability range, in which the limits count.
    """
    earlier = read.get((visit.target, visit.approach))
    if earlier is not None and earlier.visit.number != visit.number:
        return earlier.deviation, _FROM_RUN * settings.stability
    others = [each for each in read.values() if each.visit.number != visit.number]
    nearest = min(
        others,
        key=lambda each: (
            abs(each.visit.position - visit.position),
            each.visit.approach is not visit.approach,
        ),
        default=None,
    )
    return (0.0 if nearest is None else nearest.deviation), _FROM_TARGET * settings.stability


def misread_by(
    value: float, zero: float, right: float, following: Iterable[ListedVisit], near: float
) -> float | None:
    """Return the factor by which a display reads wrong, if its stop were at one of the next visits by it.

    Parameters
    ----------
    value
        What the display shows, by its own zero, m or rad.
    zero
        The position at which it shows 0, m or rad.
    right
        Where it was last known to be right: the datum, or its own zero, m or rad.
    following
        The visits that are next.
    near
        How far off a stop may be, m or rad.
    """
    position = value + zero
    targets = [visit.position for visit, _ in zip(following, range(_AHEAD), strict=False)]
    for factor in FACTORS:
        for true in (right + (position - right) * factor, value * factor + zero):
            if abs(true - position) > near and any(abs(true - target) <= near for target in targets):
                return factor
    return None
