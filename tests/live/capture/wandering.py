"""Programs that do not go as planned, in virtual time: what was filed is held against where the axis was."""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from random import Random

from live.capture.moves import MM, SETTINGS, listed, planned
from zlmreport.live.capture.events import Event, Missed, Recorded
from zlmreport.live.capture.follower import Follower
from zlmreport.live.capture.progress import Progress
from zlmreport.model.planning.methods import Method
from zlmreport.plugin.instrument import LiveReading

TARGETS = (0, 12, 20, 34, 40)
RUNS = 3
#: Between readings, s; mm/s of the axis.
_STEP, _FEED = 0.04, 25.0
_REST = 3.0
_SETTINGS = replace(SETTINGS, turn=2 * 5 / (1.5 * _FEED), feed=_FEED * MM)
#: What may happen at a visit, and how often.
FAULTS = ("skip", "stall", "repeat", "hold", "short hold", "restart")
_RATE = 0.04
#: How long before and after its arrival the axis must be seen to take a reading, s.
_SEEN_BEFORE, _SEEN_AFTER = 0.25, SETTINGS.dwell + 3 * _STEP


@dataclass
class Machine:
    """A machine under its program, with what goes wrong.

    Attributes
    ----------
    stood
        When it stood at which visit: from, to, index.
    silences
        When nobody saw it: from, to.
    happened
        What went wrong, how often.
    """

    method: Method
    random: Random
    rate: float = _RATE
    faults: tuple[str, ...] = FAULTS
    time: float = 0.0
    position: float = -5.0
    stood: list[tuple[float, float, int]] = field(default_factory=list)
    silences: list[tuple[float, float]] = field(default_factory=list)
    happened: Counter[str] = field(default_factory=Counter)

    def readings(self) -> Iterator[LiveReading]:
        """Yield what arrives."""
        for reading in self._course():
            if not any(begin <= reading.time <= end for begin, end in self.silences[-3:]):
                yield reading

    def _course(self) -> Iterator[LiveReading]:
        plan = planned(self.method, TARGETS, RUNS)
        stops = plan.stops
        visited = [index for index, stop in enumerate(stops) if stop.target is not None]
        numbers = {stop: number for number, stop in enumerate(visited)}
        yield from self._stand(2.0)
        at = 1 if stops[0].target is None else 0
        restarts = 0
        while at < len(stops):
            stop = stops[at]
            there = stop.position / MM
            if stop.target is None:
                yield from self._go(there)
                at += 1
                continue
            fault = self.random.choice(self.faults) if self.random.random() < self.rate else ""
            if fault == "restart" and (restarts == 2 or stops[(at + 1) % len(stops)].run != stop.run):
                fault = ""  # between two runs nothing tells a new beginning from the next run
            if fault == "skip" and numbers[at] == len(numbers) - 1:
                fault = ""  # there the test ends with the first standstill
            self.happened[fault] += 1
            if fault == "stall":
                begin = self.time + self.random.uniform(0.0, 4.0)
                self.silences.append((begin, begin + self.random.uniform(0.3, 9.0)))
            if fault == "hold":
                yield from self._go((self.position + there) / 2)
                yield from self._stand(self.random.choice([0.5, 2.0, 20.0, 300.0]))
            if fault == "short hold":
                yield from self._go(there - 0.6 * (1 if there >= self.position else -1))
                yield from self._stand(self.random.choice([1.5, 20.0]))
            yield from self._go(there)
            yield from self._visit(numbers[at], 0.4 if fault == "skip" else _REST)
            if fault == "repeat":
                side = 1 if stop.position >= stops[at - 1].position else -1
                yield from self._go(there - 2 * side)
                yield from self._go(there)
                yield from self._visit(numbers[at], _REST)
            at += 1
            if fault == "restart":
                restarts += 1
                beginning = self._beginning(stops, visited, at)
                yield from self._go(stops[beginning].position / MM)
                yield from self._stand(self.random.choice([0.2, 5.0]))
                at = beginning + 1
        yield from self._stay(2.0)

    def _beginning(self, stops, visited, at: int) -> int:
        """Return the block before the first visit of the program, or of the run."""
        if self.method in {Method.PENDULUM, Method.QUASI_PILGRIM} or self.random.random() < 0.5:
            return 0
        run = stops[at - 1].run
        return next(index for index in visited if stops[index].run == run) - 1

    def _visit(self, visit: int, seconds: float) -> Iterator[LiveReading]:
        self.stood.append((self.time, self.time, visit))
        yield from self._stay(seconds)

    def _stay(self, seconds: float) -> Iterator[LiveReading]:
        """Stand at the visit at which it is."""
        for reading in self._stand(seconds):
            self.stood[-1] = (self.stood[-1][0], self.time, self.stood[-1][2])
            yield reading

    def _go(self, there: float) -> Iterator[LiveReading]:
        while abs(there - self.position) > _FEED * _STEP:
            self.position += (1 if there > self.position else -1) * _FEED * _STEP
            yield self._reading()
        self.position = there
        yield self._reading()

    def _stand(self, seconds: float) -> Iterator[LiveReading]:
        for _ in range(round(seconds / _STEP)):
            yield self._reading()

    def _reading(self) -> LiveReading:
        self.time += _STEP
        return LiveReading(self.position * MM, self.time)

    def visit_at(self, time: float) -> int | None:
        """Return at which visit it stood at a time."""
        index = bisect_right(self.stood, (time, float("inf"), 0)) - 1
        if index < 0 or time > self.stood[index][1] + _STEP / 2:
            return None
        return self.stood[index][2]

    def seen(self) -> set[int]:
        """Return the visits of which it was seen to arrive, and to stand long enough."""
        return {
            visit
            for arrived, left, visit in self.stood
            if left - arrived > _SEEN_AFTER
            and not any(
                begin < arrived + _SEEN_AFTER and arrived - _SEEN_BEFORE < end for begin, end in self.silences
            )
        }


@dataclass(frozen=True)
class Trial:
    """What came of a test.

    Attributes
    ----------
    misfiled
        Readings that are of another visit, or of none: visit, and where the axis was.
    lost
        Visits without a reading although the axis was seen at them.
    unnamed
        Visits without a reading that were not named, before the last that has one.
    questions
        How often the operator was asked.
    """

    machine: Machine
    events: list[Event]
    misfiled: list[tuple[int, int | None]]
    lost: set[int]
    unnamed: set[int]
    questions: int


def trial(method: Method, seed: int, *, is_watched: bool = True, **changes) -> Trial:
    """Follow a program that does not go as planned; the operator, if there is one, knows where it is."""
    machine = Machine(method, Random(f"{method} {seed}"), **changes)
    visits = listed(method, TARGETS, RUNS)
    follower = Follower(Progress.begin(visits, None), _SETTINGS, is_watched=is_watched)
    events: list[Event] = []
    questions = 0
    for reading in machine.readings():
        new = follower.feed(reading)
        while new:
            events += new
            question = follower.progress.question
            if question is None or not is_watched:
                break
            questions += 1
            truth = machine.visit_at(question.mean.time)
            new = follower.take_answer(None if truth is None else visits[truth])
        if follower.is_halted:
            break
    last = {event.visit.number - 1: event for event in events if isinstance(event, Recorded)}
    misfiled = [
        (visit, machine.visit_at(event.mean.time))
        for visit, event in last.items()
        if machine.visit_at(event.mean.time) != visit
    ]
    missed = {event.visit.number - 1 for event in events if isinstance(event, Missed)}
    furthest = max(last, default=-1)
    lost = {visit for visit in machine.seen() if visit not in last}
    unnamed = set(range(furthest)) - set(last) - missed
    return Trial(machine, events, misfiled, lost, unnamed, questions)
