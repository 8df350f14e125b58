"""When an axis stands still, which way it moves, and the mean of a standstill."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from math import fsum
from typing import NamedTuple

from zlmreport.live.capture.events import Mean, Recorded
from zlmreport.live.capture.visits import ListedVisit, Settings
from zlmreport.live.ports.reading import LiveReading
from zlmreport.measurement.approach import Approach

#: From so many gaps it is told how far apart the readings of an instrument are.
_GAPS = 10


class Pace:
    """Measures gaps between readings.

    Where an instrument numbers its readings and gives no time, what was dropped shows in the numbers alone:
    so readings that are missing count for the time that they should have taken.
    """

    def __init__(self) -> None:
        self.shortest = 0.0  #: How far apart the first readings were at least, s; 0 before it is known.
        self._first: list[float] = []
        self._elapsed = 0.0
        self._count = 0

    @property
    def least(self) -> float:
        """How far apart the first readings were at least, as far as there are any, s."""
        return min(self._first, default=0.0)

    def measure_gap(self, before: float, now: float, lost: int) -> float:
        """Return how long no reading came, s.

        `before`, `now`: When the last reading was taken, and this one, s.
        `lost`: How many between them did not arrive or were not understood.
        """
        elapsed = now - before
        expected = (lost + 1) * self._elapsed / self._count if self._count and lost else 0.0
        self._elapsed += elapsed
        self._count += lost + 1
        if len(self._first) < _GAPS:
            self._first.append(elapsed)
            self.shortest = self.least if len(self._first) == _GAPS else 0.0
        return max(elapsed, expected)


class Track:
    """Follows the axis by medians of three readings: one that its neighbours do not confirm is no motion.

    The direction is that of the last motion that went further than a threshold; a smaller one back, such as
    an overshoot, does not turn it.

    `motion`: What counts as motion, m or rad.
    """

    def __init__(self, motion: float) -> None:
        #: The median of the last three readings, m or rad; None as long as there are fewer.
        self.position: float | None = None
        self.before: float | None = None  #: The one before.
        self.direction: Approach | None = None  #: None as long as no motion has been seen.
        self._motion = motion
        self._last: list[float] = []
        self._lowest = self._highest = 0.0

    def forget(self) -> None:
        """Begin anew: what the axis did in the meantime nobody saw."""
        self.position = self.before = self.direction = None
        self._last.clear()

    def add(self, value: float) -> None:
        """Take the next reading in, m or rad."""
        self._last.append(value)
        if len(self._last) < 3:
            return
        del self._last[:-3]
        position = sorted(self._last)[1]
        self.before, self.position = self.position, position
        if self.before is None:
            self._lowest = self._highest = position
        self._lowest = min(self._lowest, position)
        self._highest = max(self._highest, position)
        if self.direction is not Approach.POSITIVE and position > self._lowest + self._motion:
            self.direction = Approach.POSITIVE
        elif self.direction is not Approach.NEGATIVE and position < self._highest - self._motion:
            self.direction = Approach.NEGATIVE
        if self.direction is Approach.POSITIVE:
            self._lowest = self._highest
        elif self.direction is Approach.NEGATIVE:
            self._highest = self._lowest


class _Entry(NamedTuple):
    """A reading in the window, and how many before it did not come to be one."""

    value: float
    time: float
    within: float
    lost: int


class Window:
    """The latest readings that keep within a range, over a standstill at most; older ones drop out.

    Adding a reading takes the same time however many there are.

    `stability`: Largest − smallest value that is still, m or rad.
    `still`: How long makes a standstill, s.
    `averaged`: Over how long at its end the readings are averaged, s.
    """

    def __init__(self, stability: float, still: float, averaged: float) -> None:
        self._stability = stability
        self._still = still
        self._averaged = averaged
        self._entries: deque[_Entry] = deque()
        self._falling: deque[_Entry] = deque()  # each lower than all before it: the first is the highest
        self._rising: deque[_Entry] = deque()
        self._latest: LiveReading | None = None

    def clear(self) -> None:
        """Begin anew."""
        self._entries.clear()
        self._falling.clear()
        self._rising.clear()

    def add(self, reading: LiveReading, lost: int) -> None:
        """Take a reading in; `lost` is how many before it did not arrive or were not understood."""
        entry = _Entry(reading.value, reading.time, reading.within, lost)
        while self._falling and self._falling[-1].value <= entry.value:
            self._falling.pop()
        while self._rising and self._rising[-1].value >= entry.value:
            self._rising.pop()
        for each in (self._entries, self._falling, self._rising):
            each.append(entry)
        self._latest = reading
        while self.range > self._stability or self._is_longer_than_needed():
            oldest = self._entries.popleft()
            for each in (self._falling, self._rising):
                if each[0] is oldest:
                    each.popleft()

    def _is_longer_than_needed(self) -> bool:
        return len(self._entries) > 1 and self._bound_time_since(self._entries[1]) >= self._still

    def _bound_time_since(self, first: _Entry) -> float:
        """Return how long ago a reading was taken at least, at the latest one, s."""
        latest = self._entries[-1]
        return latest.time - latest.within - first.time

    @property
    def bounds(self) -> tuple[float, float]:
        """Smallest and largest value, m or rad; there is a reading at least."""
        return self._rising[0].value, self._falling[0].value

    @property
    def range(self) -> float:
        """Largest − smallest value, m or rad; 0 for none."""
        return self._falling[0].value - self._rising[0].value if self._entries else 0.0

    @property
    def duration(self) -> float:
        """From the first to the last reading at least, s; 0 for none."""
        return max(0.0, self._bound_time_since(self._entries[0])) if self._entries else 0.0

    @property
    def is_still(self) -> bool:
        """Whether the axis has stood still for as long as makes a standstill."""
        return self.duration >= self._still

    def holds(self, value: float) -> bool:
        """Tell whether a further value, m or rad, keeps within the range beside all others."""
        if not self._entries:
            return False
        lowest, highest = self.bounds
        return max(highest, value) - min(lowest, value) <= self._stability

    def compute_mean(self) -> Mean:
        """Return the mean of the readings at the end of the standstill; there is one at least.

        What came before has shown that the axis stands still. The last of its arrival may lie in it, for that
        ends inside the stability range, and would draw the mean towards where the axis came from.
        """
        assert self._latest is not None  # noqa: S101 - the caller has seen that the axis is still
        begin = self._latest.time - self._averaged
        averaged = [entry for entry in self._entries if entry.time >= begin]
        first = averaged[0]
        rest = fsum(entry.value - first.value for entry in averaged)
        return Mean(
            value=first.value + rest / len(averaged),
            range=self.range,
            count=len(averaged),
            skipped=sum(entry.lost for entry in averaged) - first.lost,
            time=self._latest.time,
            duration=self._latest.time - first.time,
            conditions=self._latest.conditions,
        )


#: How far a reading may depart from an earlier run's, and from the deviation at the target before, in
#: stability ranges: 50 µm and 200 µm for 1 µm. Axes err by less from run to run and from target to target; a
#: feed hold short of its target, a datum that slipped and a display that fails do not.
FROM_RUN, FROM_TARGET = 50, 200


def expect_deviation(
    visit: ListedVisit, read: Mapping[tuple[int, Approach], Recorded], settings: Settings
) -> tuple[float, float]:
    """Return what a visit should read, as a deviation, and how far it may be off, m or rad.

    `read`: What was read under this datum: the latest reading of each target from each side.
    `settings`: With the stability range, in which the limits count.
    """
    earlier = read.get((visit.target, visit.approach))
    if earlier is not None and earlier.visit.number != visit.number:
        return earlier.deviation, FROM_RUN * settings.stability
    others = [each for each in read.values() if each.visit.number != visit.number]
    nearest = min(
        others,
        key=lambda each: (
            abs(each.visit.position - visit.position),
            each.visit.approach is not visit.approach,
        ),
        default=None,
    )
    return (0.0 if nearest is None else nearest.deviation), FROM_TARGET * settings.stability
