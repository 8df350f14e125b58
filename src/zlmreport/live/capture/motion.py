"""Where the axis turned round, and where the planned program does: so that both can be compared."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import accumulate
from math import inf
from typing import NamedTuple

from zlmreport.live.capture.visits import FASTEST, ListedVisit, Settings
from zlmreport.live.ports.reading import LiveReading
from zlmreport.measurement.approach import Approach

#: Faster than any axis, m/s or rad/s: who is elsewhere sooner was not seen to go there.
_RAPID = 1.0


class Route:
    """Where the axis turned round, from afar: what is less than a threshold is no turn."""

    def __init__(self, threshold: float) -> None:
        self.turns: list[float] = []  #: Turning points so far, m or rad.
        #: breaks, silence: How often the axis was out of sight; for how long in all, s.
        self.breaks = 0
        self.silence = 0.0
        self.heading: Approach | None = None  #: Which way it goes; None as long as that is not known.
        #: first, last: Where it was seen first, and last, m or rad; None before, and after a break.
        self.first: float | None = None
        self.last: float | None = None
        self._threshold = threshold
        self._lowest = self._highest = 0.0
        self._awaited: float | None = None
        self._earlier: LiveReading | None = None

    def lose(self, seconds: float = 0.0) -> None:
        """Take note that nobody sees the axis, or saw it for some seconds."""
        self.breaks += 1
        self.silence += seconds
        self.heading = self.first = self.last = self._awaited = self._earlier = None

    def add(self, position: float) -> None:
        """Take note of where it is, m or rad."""
        if self.first is None:
            self.first = self._lowest = self._highest = position
        self.last = position
        self._lowest = min(self._lowest, position)
        self._highest = max(self._highest, position)
        if self.heading is not Approach.POSITIVE and position > self._lowest + self._threshold:
            self._note_turn(Approach.POSITIVE, self._lowest)
            self._highest = position
        elif self.heading is not Approach.NEGATIVE and position < self._highest - self._threshold:
            self._note_turn(Approach.NEGATIVE, self._highest)
            self._lowest = position
        if self.heading is Approach.POSITIVE:
            self._lowest = self._highest
        elif self.heading is Approach.NEGATIVE:
            self._highest = self._lowest

    def follow(
        self, before: LiveReading, reading: LiveReading, zero: float, seen: float, settings: Settings
    ) -> None:
        """Follow where the axis turns round: of readings that come seldom each counts that can be true.

        That is one which the axis can have come to from the reading before, and left for the one after; and
        not so soon for where it was before, that it had no time to turn round.

        `zero`: The position at which the display shows 0, m or rad.
        `seen`: Where the axis was last seen by several readings, m or rad.
        """
        elapsed = reading.time - before.time
        reach = FASTEST * settings.feed * elapsed + settings.motion
        can_be = abs(reading.value - before.value) <= reach
        awaited, self._awaited = self._awaited, reading.value + zero if can_be else None
        earlier, self._earlier = self._earlier, before
        is_damaged = not can_be or _is_back_at_once(earlier, reading, settings)
        position = seen if awaited is None or is_damaged else awaited
        if self.last is not None:
            furthest = _RAPID * (elapsed + settings.largest_gap) + settings.tolerance
            if abs(position - self.last) > furthest:
                self.lose()
        self.add(position)

    def _note_turn(self, heading: Approach, at: float) -> None:
        if self.heading is not None:
            self.turns.append(at)
        self.heading = heading


def _is_back_at_once(earlier: LiveReading | None, reading: LiveReading, settings: Settings) -> bool:
    """Tell whether the axis is where it was at an earlier reading, too soon to have turned round since."""
    return (
        earlier is not None
        and reading.time - earlier.time < settings.beyond
        and abs(reading.value - earlier.value) <= settings.motion
    )


class TurningPoint(NamedTuple):
    """A turning point of a program, m or rad, and the target beyond which it lies, if it does."""

    position: float
    beyond: float | None


class PlannedRoute:
    """The motion of the plan: where it turns round between two visits, and how long it takes."""

    def __init__(self, visits: Sequence[ListedVisit], settings: Settings) -> None:
        self.visits = tuple(visits)
        first = self.visits[0]
        self.start = first.position - first.approach * first.travelled
        self._turns: list[TurningPoint] = []
        self._turns_before: list[int] = []
        self._corner_before: list[float] = []
        here, heading, beyond = self.start, first.approach, None
        for visit in self.visits:
            for corner in self._list_corners(here, visit):
                self._corner_before[len(self._turns_before) :] = [here]
                if (corner - here) * heading < 0:
                    self._turns.append(TurningPoint(here, beyond))
                    heading = Approach(-heading)
                here, beyond = corner, None if corner == visit.position else visit.position
            self._turns_before.append(len(self._turns))
        self._times = list(
            accumulate(visit.travelled / (settings.feed or inf) + settings.stay for visit in self.visits)
        )
        self._at: dict[tuple[int, Approach], list[int]] = defaultdict(list)
        for index, visit in enumerate(self.visits):
            self._at[visit.target, visit.approach].append(index)

    def _list_corners(self, here: float, visit: ListedVisit) -> Iterator[float]:
        """Yield where the way to a visit leads: over the place where it turns round, if it does."""
        beyond = (visit.travelled - abs(visit.position - here)) / 2
        if beyond > 1e-9 * max(visit.travelled, abs(visit.position)):
            yield visit.position - visit.approach * beyond
        yield visit.position

    def list_visits_at(self, target: int, approach: Approach | None) -> Sequence[int]:
        """Return the indices of the visits of a target from a side, or from both."""
        if approach is not None:
            return self._at[target, approach]
        return sorted(self._at[target, Approach.POSITIVE] + self._at[target, Approach.NEGATIVE])

    def list_turns(self, here: int, there: int) -> Sequence[TurningPoint]:
        """Return the turning points from one visit to a later one; from the start for −1."""
        return self._turns[self._turns_before[here] if here >= 0 else 0 : self._turns_before[there]]

    def compute_time(self, here: int, there: int) -> float:
        """Return the time from one visit to a later one, s."""
        return self._times[there] - (self._times[here] if here >= 0 else 0.0)

    def is_first_of_part(self, index: int) -> bool:
        """Tell whether a part of the test begins with a visit."""
        return index == 0 or self.visits[index - 1].part != self.visits[index].part

    def look_back_to_beginning(self, index: int) -> tuple[int, Sequence[TurningPoint]]:
        """Return how many visits of its part come before one, and the turns from the part's beginning."""
        first = index
        while not self.is_first_of_part(first):
            first -= 1
        return index - first, (TurningPoint(self._corner_before[first], None), *self.list_turns(first, index))
