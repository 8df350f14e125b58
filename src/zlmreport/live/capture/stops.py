"""What a stop is: a target, the datum, a worse repetition, a wrong unit; and how it goes on."""

from __future__ import annotations

from bisect import bisect
from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

from zlmreport.live.capture.display import UNITS, Offsets, find_misread_factor
from zlmreport.live.capture.events import (
    DatumHolds,
    DatumMoved,
    Elsewhere,
    Event,
    Mean,
    NotChecked,
    NotNext,
    ScaleChanged,
    WrongDirection,
    ZeroLost,
)
from zlmreport.live.capture.place import TargetStandstill
from zlmreport.live.capture.progress import Progress
from zlmreport.live.capture.standstill import FROM_RUN, FROM_TARGET, Window, expect_deviation
from zlmreport.live.capture.visits import ListedVisit, Settings
from zlmreport.measurement.approach import Approach

_SHIFTED = "what the display shows is off by the same at two stops in a row: counts are lost, or a zero moved"


def find_target_around(
    lowest: float, highest: float, targets: Sequence[tuple[float, int]], tolerance: float
) -> int | None:
    """Return the target inside whose tolerance all readings are.

    `targets`: The position of each, and its number; the positions rise.
    """
    after = bisect(targets, (lowest, inf))
    for position, target in targets[max(0, after - 1) : after + 1]:
        if max(highest - position, position - lowest) <= tolerance:
            return target
    return None


def is_plausible(stop: TargetStandstill, index: int, progress: Progress, settings: Settings) -> bool:
    """Tell whether the reading of a visit is near enough to those before, and to the plan."""
    visit = progress.visits[index]
    expected, limit = expect_deviation(visit, progress.read, settings)
    return abs(stop.position - visit.position - expected) <= limit


def is_worse(stop: TargetStandstill, index: int, progress: Progress, settings: Settings) -> bool:
    """Tell whether a visit has a reading that is better than a later one.

    A control that corrects its position goes less far, in either direction. Who goes further has left: a
    feed hold beyond the target.
    """
    visit = progress.visits[index]
    earlier = progress.read.get((visit.target, visit.approach))
    is_ordered = progress.again is not None and index >= progress.taken
    if earlier is None or visit.number not in progress.filed or is_ordered:
        return False
    expected, _ = expect_deviation(visit, progress.read, settings)
    further = abs(stop.position - visit.position - expected) - abs(earlier.deviation - expected)
    return further > 0 and abs(stop.position - earlier.position) > FROM_RUN * settings.stability


def check_datum(
    target: int, approach: Approach, position: float, progress: Progress, settings: Settings
) -> Event:
    """Hold the datum against an earlier reading of the same target from the same side."""
    earlier = progress.read.get((target, approach))
    if earlier is None:
        return NotChecked(target, approach)
    difference = position - earlier.position
    if abs(difference) > settings.motion:
        return DatumMoved(earlier.visit, difference, progress.rest_of_part)
    return DatumHolds(earlier.visit, difference)


def name_out_of_turn(stop: TargetStandstill, progress: Progress) -> Event:
    """Return what a standstill is at which nothing may be taken."""
    following = progress.next
    if stop.target == following.target or stop.heading is None:
        return WrongDirection(following, stop.approach)
    return NotNext(stop.target, stop.heading, following)


def name_elsewhere(
    mean: Mean, zero: float, progress: Progress, settings: Settings, offsets: Offsets
) -> Event:
    """Return what a standstill at no target is: a display that was switched, or lost counts; or neither."""
    position = mean.value + zero
    following = progress.visits[progress.taken :]
    near = settings.tolerance
    right = zero if progress.datum is None else progress.datum
    furthest = max((abs(each.deviation) for each in progress.read.values()), default=0.0)
    close = min(near, furthest + FROM_TARGET * settings.stability)
    unit = find_misread_factor(mean.value, zero, right, following, close, UNITS)
    if unit is not None and progress.read:
        return ScaleChanged(unit, _find_visit_of_either_unit(zero, progress, settings))
    if unit is not None:  # in other units from the beginning: so far off are all stops at one target
        return Elsewhere(position, unit)
    if offsets.is_lost(position, progress.taken):
        return ZeroLost(_SHIFTED, progress.rest_of_part)
    return Elsewhere(position, find_misread_factor(mean.value, zero, right, following, near))


def _find_visit_of_either_unit(zero: float, progress: Progress, settings: Settings) -> ListedVisit | None:
    """Return the visit before, if its reading would be at its target by another unit, too."""
    last = max(progress.read.values(), key=lambda each: each.mean.time, default=None)
    if last is None or abs(last.position - zero) > settings.tolerance:
        return None
    return last.visit


@dataclass(slots=True)
class Stay:
    """How the axis stays where a reading was taken: until it leaves, a later one may replace that."""

    index: int  #: Of the visit.
    since: float | None  #: When it came there, s; None if nobody saw.
    taken: float  #: When the first reading was, s.
    position: float  #: Which reading stands, m or rad.
    middle: float  #: Between the smallest and the largest of what it was made of, m or rad.
    looked: float  #: When the standstill was looked at last, s.
    #: last, ahead: The latest standstill after which the axis still stood, and after which it may have gone.
    last: Mean | None = None
    ahead: Mean | None = None

    @classmethod
    def at(cls, index: int, since: float | None, window: Window, stop: TargetStandstill) -> Stay:
        """Begin with the reading that was taken."""
        stay = cls(index, since, stop.mean.time, 0.0, 0.0, 0.0)
        stay.stand(window, stop.mean, stop.position - stop.mean.value)
        return stay

    def stand(self, window: Window, mean: Mean, zero: float) -> None:
        """Take note of the reading that stands now."""
        lowest, highest = window.bounds
        self.position, self.middle = mean.value + zero, (lowest + highest) / 2 + zero
        self.looked, self.last, self.ahead = mean.time, None, None

    def keep(self, window: Window, time: float, every: float) -> None:
        """Keep the mean of a standstill that goes on; of the last one the axis may have begun to leave."""
        if time - self.looked >= every:
            self.looked, self.last, self.ahead = time, self.ahead, window.compute_mean()
