"""Readings within which the axis stands still."""

from __future__ import annotations

from collections import deque
from math import fsum
from typing import NamedTuple

from zlmreport.capture.events import Mean
from zlmreport.live.reading import LiveReading

#: The last share of the dwell, over which the readings are averaged.
_AVERAGED = 1 / 2


class _Entry(NamedTuple):
    """A reading in the window, and how many before it did not come to be one."""

    value: float
    time: float
    lost: int


class Window:
    """The latest readings that keep within a range, over a dwell at most; older ones drop out.

    Adding a reading takes the same time however many there are.

    Parameters
    ----------
    stability
        Largest − smallest value that is still, m or rad.
    dwell
        How long makes a standstill, s.
    """

    def __init__(self, stability: float, dwell: float) -> None:
        self._stability = stability
        self._dwell = dwell
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
        entry = _Entry(reading.value, reading.time, lost)
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
        return len(self._entries) > 1 and self._entries[-1].time - self._entries[1].time >= self._dwell

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
        """From the first to the last reading, s; 0 for none."""
        return self._entries[-1].time - self._entries[0].time if self._entries else 0.0

    @property
    def is_still(self) -> bool:
        """Whether the axis has stood still for the dwell."""
        return self.duration >= self._dwell

    def mean(self) -> Mean:
        """Return the mean of the readings over the later half of the dwell; there is one at least.

        The earlier half has shown that the axis stands still. The last of its arrival may lie in it, for that
        ends inside the stability range, and would draw the mean towards where the axis came from.
        """
        assert self._latest is not None  # noqa: S101 - the caller has seen that the axis is still
        begin = self._latest.time - _AVERAGED * self._dwell
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
