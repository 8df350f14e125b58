"""A display that fails during a capture: frozen, in another unit, without its counts."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from zlmreport.live.capture.visits import FASTEST, ListedVisit, Settings
from zlmreport.live.ports.reading import LiveReading

#: Factors of units that a display can be switched to while a test goes on: inches, and a thousand times.
UNITS = (25.4, 1 / 25.4, 1000.0, 1 / 1000.0)
#: Of degrees that are read as millimetres: what shows an angle is rarely told so.
DEGREES = 1000 * math.pi / 180
#: What a display does wrong by a factor: it counts the wrong way, in other units, without or with twice the
#: optics' path.
FACTORS = (-1.0, *UNITS, DEGREES, 2.0, 0.5)
#: Faster than any axis gains speed, m/s² or rad/s².
_ACCELERATION = 50.0
#: Readings after a jump that must be the same; a single damaged one is none.
_CONFIRMED = 3
#: How much larger than what the readings leave open a jump must be, to be by the factor of a unit.
_CLEARLY, _FAR = 100, 5
#: How many visits ahead a misread stop may be.
_AHEAD = 3


@dataclass(frozen=True, slots=True)
class Jump:
    """What a display shows has jumped while the axis stood still.

    `factor`: By which what it shows now must be multiplied to be what it showed; None if by no unit.
    """

    factor: float | None


class JumpWatch:
    """Notices what a display does and no axis: a jump by the factor of a unit, or from rest to rest at once.

    `settings`: With the range within which an axis stands still, and its feed.
    """

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._before: LiveReading | None = None
        self._after: list[LiveReading] = []
        self._was_at_rest = False
        #: Whether the reading before went on from the one before it: a damaged one does not.
        self._is_sound = False

    def add(self, before: LiveReading, reading: LiveReading, *, is_at_rest: bool) -> Jump | None:
        """Take the next reading in; return the jump that it confirms.

        `before`: The one before.
        `is_at_rest`: Whether the axis has stood still until that one.
        """
        goes_on = abs(reading.value - before.value) <= self._estimate_reach(before, reading)
        if self._before is None or not self._is_confirmed_by(before, reading):
            is_sound, self._is_sound = self._is_sound, goes_on
            self._before = before if is_sound and not goes_on else None
            self._after, self._was_at_rest = [reading], is_at_rest
            return None
        self._after.append(reading)
        if len(self._after) < _CONFIRMED:
            return None
        began, self._before, self._is_sound = self._before, None, True
        return self._judge(began, self._after)

    def _estimate_reach(self, before: LiveReading, reading: LiveReading) -> float:
        """Return how far the axis may go between two readings, m or rad."""
        elapsed = _bound_elapsed(before, reading)
        return max(FASTEST * self._settings.feed * elapsed + self._settings.stability, self._settings.motion)

    def _find_unit(self, before: LiveReading, first: LiveReading) -> float | None:
        """Return the factor of a unit by which the first reading after a jump is the one before it."""
        stability = self._settings.stability
        reach = stability if self._was_at_rest else self._estimate_reach(before, first)
        if abs(first.value - before.value) < max(_CLEARLY * stability, _FAR * reach):
            return None
        for factor in UNITS:
            near = reach * max(1.0, factor)  # near the display's own zero, everything would be by any unit
            if abs(first.value * factor - before.value) <= near <= abs(before.value):
                return factor
        return None

    def _is_confirmed_by(self, before: LiveReading, reading: LiveReading) -> bool:
        """Tell whether a reading goes on from what was shown after the jump; by its unit, if it is one."""
        first = self._after[0]
        assert self._before is not None  # noqa: S101 - the caller has seen it
        step, factor = abs(reading.value - before.value), self._find_unit(self._before, first)
        if self._was_at_rest and abs(reading.value - first.value) > self._settings.stability:
            return False  # it has begun to move
        return step <= self._estimate_reach(before, reading) / min(1.0, factor or 1.0)

    def _judge(self, before: LiveReading, after: list[LiveReading]) -> Jump | None:
        first = after[0]
        factor = self._find_unit(before, first)
        if factor is not None:
            return Jump(factor)
        step, elapsed = abs(first.value - before.value), _bound_elapsed(before, first)
        is_sudden = self._was_at_rest and 4 * step > _ACCELERATION * elapsed**2
        return Jump(None) if is_sudden and step > self._settings.motion else None


class FreezeWatch:
    """Notices a display that shows the same to its last digit for longer than an axis rests.

    `longest`: That an axis rests, s.
    """

    def __init__(self, longest: float) -> None:
        self._longest = longest
        self._since: float | None = None
        self._is_told = False

    def add(self, before: LiveReading | None, reading: LiveReading, *, is_followed: bool) -> float | None:
        """Take the next reading in; return for how long the display has been frozen, s, once.

        `before`: The one before; None where there is none.
        `is_followed`: Whether the axis should move: it need not before its first visit.
        """
        if before is None or before.value != reading.value or self._since is None:
            self._since, self._is_told = reading.time, False
        seconds = reading.time - self._since
        if not is_followed or seconds < self._longest or self._is_told:
            return None
        self._is_told = True
        return seconds

    def forget(self) -> None:
        """Forget since when: nobody saw."""
        self._since = None


def _bound_elapsed(before: LiveReading, reading: LiveReading) -> float:
    """Return how long ago a reading was taken at most, s: on a busy computer its answer may have waited."""
    return reading.time - before.time + before.within


def find_misread_factor(  # noqa: PLR0913, PLR0917 - what is shown, by which zeros, and what may be meant
    value: float,
    zero: float,
    right: float,
    following: Iterable[ListedVisit],
    near: float,
    factors: Iterable[float] = FACTORS,
) -> float | None:
    """Return the factor by which a display reads wrong, if its stop were at one of the next visits by it.

    `value`: What the display shows, by its own zero, m or rad.
    `zero`: The position at which it shows 0, m or rad.
    `right`: Where it was last known to be right: the datum, or its own zero, m or rad.
    `near`: How far off a stop may be, m or rad: where it is, and in what the display would show of it.
    """
    position = value + zero
    targets = [visit.position for visit, _ in zip(following, range(_AHEAD), strict=False)]
    for factor in factors:
        allowed = near * min(1.0, abs(factor))
        for true in (right + (position - right) * factor, value * factor + zero):
            if abs(true - position) > near and any(abs(true - target) <= allowed for target in targets):
                return factor
    return None


class Offsets:
    """Notices a display that is off by the same at two stops in a row, as it is without some counts.

    `visits`: Of the test.
    `alike`: How far apart two offsets may be that are the same, m or rad.
    """

    def __init__(self, visits: tuple[ListedVisit, ...], alike: float) -> None:
        self._visits = visits
        self._alike = alike
        self._last: tuple[int, int, float] | None = None

    def is_lost(self, position: float, taken: int) -> bool:
        """Take in a stop that is at no target; return whether it is off as the one before was.

        `position`: Where it seems to be, m or rad.
        `taken`: How many visits are taken or missed: the stops are those that follow.
        """
        before, self._last = self._last, None
        index = before[1] + 1 if before and before[0] == taken else taken
        if index >= len(self._visits):
            return False
        offset = position - self._visits[index].position
        self._last = taken, index, offset
        return index > taken and before is not None and abs(offset - before[2]) <= self._alike
