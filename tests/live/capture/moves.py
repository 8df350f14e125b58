"""An axis that is moved by hand, reading by reading, for tests of the capture."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from zlmreport.live.capture.events import Event, Moving, Recorded, Settling
from zlmreport.live.capture.follower import Follower
from zlmreport.live.capture.progress import Progress
from zlmreport.live.capture.visits import ListedVisit, Settings, number_visits
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.plugin.instrument import LiveReading

MM, UM = 1e-3, 1e-6
#: At 100 mm/s the axis cannot run 5 mm over a target and come back within 0.1 s.
SETTINGS = Settings(tolerance=1 * MM, stability=1 * UM, dwell=1.0, turn=0.1, stay=3.0, feed=100 * MM)


def planned(method: Method = Method.LINEAR, targets=(0, 100, 200), runs: int = 1) -> AxisPlan:
    return AxisPlan(
        targets=np.array(targets) * MM, method=method, runs=runs, overrun=5 * MM, feed=100 * MM, dwell=3.0
    )


def listed(method: Method = Method.LINEAR, targets=(0, 100, 200), runs: int = 1) -> tuple[ListedVisit, ...]:
    return number_visits(planned(method, targets, runs))


@dataclass
class Axis:
    """An axis that moves at 100 mm/s, read 100 times a second; positions in mm, times in s.

    Attributes
    ----------
    position
        Where it is.
    time
        Of its last reading.
    step
        Between readings.
    error
        Deviation at a target, mm.
    """

    position: float = -5.0
    time: float = 100.0
    step: float = 0.01
    error: dict[float, float] = field(default_factory=dict)

    def stand(self, seconds: float = 3.0, **changes) -> Iterator[LiveReading]:
        """Stay where it is."""
        for _ in range(round(seconds / self.step)):
            yield replace(self.reading(), **changes)

    def go(self, *positions: float, stay: float = 3.0) -> Iterator[LiveReading]:
        """Go to positions in turn, and stay at each."""
        for target in positions:
            there = target + self.error.get(target, 0.0)
            while abs(there - self.position) > 100 * self.step:
                self.position += np.sign(there - self.position) * 100 * self.step
                yield self.reading()
            self.position = there
            yield from self.stand(stay)

    def turn(self, position: float) -> Iterator[LiveReading]:
        """Go to a position where it only turns round."""
        yield from self.go(position, stay=self.step)

    def unseen(self, seconds: float, position: float | None = None) -> None:
        """Let time pass, and the axis move, without readings."""
        self.time += seconds
        self.position = self.position if position is None else position

    def reading(self) -> LiveReading:
        """Return what an instrument shows whose zero is that of the axis."""
        self.time += self.step
        return LiveReading(self.position * MM, self.time)


def happened(readings: Iterable[LiveReading], follower: Follower) -> list[Event]:
    """Return what is more than of the moment."""
    events = [event for reading in readings for event in follower.feed(reading)]
    return [event for event in events if not isinstance(event, Moving | Settling)]


def kinds(events: Iterable[Event]) -> list[str]:
    """Return what happened, in the names of the events; of a reading, which visit it is."""
    return [
        f"visit {event.visit.number}" if isinstance(event, Recorded) else type(event).__name__
        for event in events
    ]


def following(
    visits: tuple[ListedVisit, ...],
    datum: float | None = None,
    settings: Settings = SETTINGS,
    *,
    is_watched: bool = False,
) -> Follower:
    """Return a follower at the begin of a test."""
    return Follower(Progress.begin(visits, datum), settings, is_watched=is_watched)
