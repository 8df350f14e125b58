"""Times of readings: by the instrument's own count of samples, or by when its lines came."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import replace
from statistics import median

from zlmreport.live.ports.reading import LiveReading


class SampleClock:
    """The clock of an instrument that numbers its samples and says how many a second it takes.

    Between two samples lies the time that their numbers say, however late and in whatever lumps they arrive.
    It begins when the first of them arrives, by `time.monotonic`, and goes as the instrument's own goes.
    """

    def __init__(self) -> None:
        self.now = float("-inf")  #: Of the latest sample, s.
        self._begun: tuple[int, float] | None = None

    def time(self, number: int, rate: float, arrived: float) -> float:
        """Return when a sample was taken, s.

        `number`: Its own.
        `rate`: How many are taken in a second, 1/s.
        `arrived`: When it did, s; of the first alone it matters.
        """
        if self._begun is None:
            self._begun = number, max(arrived, self.now)
        first, begun = self._begun
        self.now = begun + (number - first) / rate
        return self.now

    def restart(self) -> None:
        """Take note that the numbers begin anew: with the next sample the clock goes on, or jumps ahead."""
        self._begun = None


#: From so many lumps it is told how far apart the lines of an instrument are.
_LUMPS = 15


class ArrivalClock:
    """The clock of an instrument that sends of its own accord and numbers nothing.

    A line was sent at the latest when it arrived. Lines that arrive together, for a computer was busy, were
    sent one after the other: the last of them lately, and each before at the usual distance.
    """

    def __init__(self) -> None:
        self._last: float | None = None
        self._distances: deque[float] = deque(maxlen=_LUMPS)

    def stamp(self, readings: Sequence[LiveReading], now: float, empty: float) -> list[LiveReading]:
        """Return readings that arrived together, each with its time.

        `now`: When they were read, s, which is the time of each.
        `empty`: When the line was looked at last and had nothing, s: they arrived after that.
        """
        count = len(readings)
        since = now - self._last if self._last is not None else 0.0
        if self._last is not None:
            self._distances.append(since / count)
        distance = min(median(self._distances), since / count) if self._distances else 0.0
        self._last = now
        within = max(0.0, min(now - empty, distance or now - empty))
        return [
            replace(reading, time=now - (count - 1 - index) * distance, within=within)
            for index, reading in enumerate(readings)
        ]
