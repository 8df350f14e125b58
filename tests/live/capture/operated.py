"""A machine in single block: its operator lets it go from one visit to the next, and back."""

from __future__ import annotations

from bisect import bisect_right

from zlmreport.model.simulation.description import Description
from zlmreport.model.simulation.simulate import make_emulated_machine

#: How fast an operator moves the axis by hand, m/s.
_JOG = 0.5


class OperatedAxis:
    """An axis that goes where its operator says, and stays there.

    Attributes
    ----------
    deviation
        By how much it errs at each visit, m.
    """

    def __init__(self, description: Description) -> None:
        plan = description.plan
        self.deviation = make_emulated_machine(description, 0.0).truth.deviation.tolist()
        self._feed = plan.feed
        self._stops = plan.stops
        self._visits = [index for index, stop in enumerate(self._stops) if stop.target is not None]
        self._block = 0
        self._corners = [(0.0, self._stops[0].position)]

    def position(self, time: float) -> float:
        """Return where the axis is, m, at a time in s."""
        corners = self._corners
        after = bisect_right(corners, (time, float("inf")))
        if after in {0, len(corners)}:
            return corners[min(after, len(corners) - 1)][1]
        (left_at, here), (arrives_at, there) = corners[after - 1 : after + 1]
        return here + (there - here) * (time - left_at) / (arrives_at - left_at)

    def go_back(self, visit: int, now: float) -> float:
        """Go where the way to a visit begins, its index from 0; return when the axis is there, s."""
        here = self.position(now)
        self._block = self._visits[visit] - 1
        there = self._stops[self._block].position
        arrives = now + abs(there - here) / _JOG
        self._corners = [(now, here), (arrives, there)]
        return arrives

    def go_to(self, visit: int, now: float) -> None:
        """Let the program run as far as a visit, over all that lies between."""
        here = self.position(now)
        corners = [(now, here)]
        for block in range(self._block + 1, self._visits[visit] + 1):
            there = self._stops[block].position
            if block == self._visits[visit]:
                there += self.deviation[visit]
            now += abs(there - here) / self._feed
            corners.append((now, there))
            here = there
        self._block = self._visits[visit]
        self._corners = corners
