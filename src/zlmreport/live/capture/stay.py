"""A standstill that goes on after its reading was taken: a later mean may replace it."""

from __future__ import annotations

from dataclasses import dataclass

from zlmreport.live.capture.events import Mean
from zlmreport.live.capture.place import TargetStandstill
from zlmreport.live.capture.standstill import Window


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
