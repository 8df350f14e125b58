"""The path of a planned circular test: up to the circle, round it in both senses, and away from it.

Each turn has an arc before and an arc behind what is evaluated, so that the machine runs at the feed of the
test wherever it is read. A turn clockwise is the turn counter-clockwise run backwards: each begins where the
one before it ended, and a ballbar stays where it is.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

from zlmreport.errors import InputError, Place, count_in_words
from zlmreport.job.circle_keys import CirclePlanKeys
from zlmreport.job.job import Job
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.circle import NominalCircle
from zlmreport.measurement.units import MILLIMETRE, SECONDS_PER_MINUTE
from zlmreport.model.planning.programs import ProgramOptions, write_plain_name, write_program_number

_FULL_TURN = 360.0
#: Turns in each sense where a job states none.
_USUAL_RUNS = 2
_LEAST_FEED = 0.001
#: By how much the radius may change at most by the digits that are programmed, mm.
_EXACT = 1e-4
#: What each sense is called in part programs.
SENSES = {Approach.POSITIVE: "ccw", Approach.NEGATIVE: "cw"}

Point: TypeAlias = tuple[float, float]
#: What begins at a block: the test, a turn, or nothing.
BlockBegins: TypeAlias = Literal["", "test", "turn"]


@dataclass(frozen=True, slots=True)
class PlannedTurn:
    """One turn in one sense; angles go on beyond 360°, from the plane's first axis towards its second."""

    sense: Approach
    run: int
    first: float  #: Where it is evaluated from, °.
    last: float  #: And to, °.
    arc: float  #: That is run before and behind, °.

    @property
    def begins(self) -> float:
        """Where the tool comes up to the circle, °."""
        return self.first - self.sense * self.arc

    @property
    def ends(self) -> float:
        """Where it leaves the circle, °."""
        return self.last + self.sense * self.arc

    @property
    def angles(self) -> tuple[float, ...]:
        """The ends of its arcs one after another, °."""
        found = (self.first, self.last, self.ends) if self.arc else (self.last,)
        return (self.begins, *found)


@dataclass(frozen=True, slots=True)
class PathBlock:
    """A straight line or an arc from one point to the next, from the centre of the circle, mm."""

    start: Point | None  #: None of the first, which comes from wherever the tool is.
    end: Point
    sense: Approach | None = None  #: Of an arc; None of a line.
    begins: BlockBegins = ""
    remark: str = ""
    stops: bool = False  #: Whether the tool comes to rest at its end.

    @property
    def centre(self) -> Point:
        """From the start of an arc to the centre of the circle, mm."""
        assert self.start is not None  # noqa: S101 - no arc is the first block
        return 0.0 - self.start[0], 0.0 - self.start[1]


@dataclass(frozen=True, slots=True)
class CirclePath:
    """The motion of a planned circular test.

    Attributes
    ----------
    number
        Of the job.
    circle
        The nominal circle.
    feed
        Along the path, mm/min.
    turns
        In the order of the test.
    run_up
        How far outside the circle the tool begins and ends, mm.
    rest
        Time at rest between two turns, s.
    place
        Where the part program is asked for: for messages about what it cannot do.
    """

    number: str
    circle: NominalCircle
    feed: float
    turns: tuple[PlannedTurn, ...]
    run_up: float
    rest: float
    place: Place

    @property
    def radius(self) -> float:
        """Of the circle, mm."""
        return MILLIMETRE.from_si(self.circle.radius)

    @property
    def duration(self) -> float:
        """Of motion and rest together, s, but for the way to the first point."""
        way = sum(
            math.radians(abs(turn.ends - turn.begins)) * self.radius + 2 * self.run_up for turn in self.turns
        )
        return way / self.feed * SECONDS_PER_MINUTE + self.rest * len(self.turns)

    @property
    def acceleration(self) -> float:
        """Towards the centre, v²/R, m/s²: where a control allows less, it runs slower than it is told."""
        return float((MILLIMETRE.to_si(self.feed) / SECONDS_PER_MINUTE) ** 2 / self.circle.radius)

    def of_run(self, run: int) -> CirclePath:
        """Return the path of the turns of one run.

        Raises `InputError` if there is no such run.
        """
        turns = tuple(turn for turn in self.turns if turn.run == run)
        if not turns:
            last = max(turn.run for turn in self.turns)
            raise InputError.at(self.place, f"there is no run {run}: state 1 to {last}")
        return replace(self, turns=turns)

    def blocks(self, decimals: int) -> tuple[PathBlock, ...]:
        """Return the lines and arcs as a control carries them out that takes so many digits.

        Raises `InputError` where rounded points would not lie on the circle of the nominal radius.
        """
        for turn in self.turns:
            for angle in turn.angles:
                reached = math.hypot(*self._place_point(angle, self.radius, decimals))
                if abs(reached - self.radius) > _EXACT:
                    raise InputError.at(
                        self.place,
                        f"at {angle % _FULL_TURN:g}° a point of {decimals} digits after the point lies on a "
                        f"radius of {reached:.5f} mm, and not of {self.radius:.12g} mm; let turns and arcs "
                        "begin and end at multiples of 90° (plan.circle), or state more in the program's key "
                        "decimals, if the control takes them",
                    )
        return tuple(self._list_blocks(decimals))

    def _list_blocks(self, decimals: int) -> Iterator[PathBlock]:
        outside = self.radius + self.run_up
        at: Point | None = None
        for number, turn in enumerate(self.turns, start=1):
            name = f"turn {number}, {SENSES[turn.sense]}, run {turn.run}"
            before = self._place_point(turn.begins, outside, decimals)
            if at is None:
                yield PathBlock(None, before, begins="test", remark=name, stops=True)
            first, *ends = turn.angles
            at = self._place_point(first, self.radius, decimals)
            if self.run_up or number > 1:
                begins: BlockBegins = "turn" if number > 1 else ""
                yield PathBlock(before, at, begins=begins, remark=name if begins else "", stops=True)
            remarks = ("run-in", "evaluated", "run-out") if turn.arc else ("evaluated",)
            for angle, remark in zip(ends, remarks, strict=True):
                end = self._place_point(angle, self.radius, decimals)
                yield PathBlock(at, end, turn.sense, remark=remark)
                at = end
            away = self._place_point(turn.ends, outside, decimals)
            yield PathBlock(at, away, stops=True)
            at = away

    def _place_point(self, angle: float, radius: float, decimals: int) -> Point:
        """Return a point as it is programmed, mm; right angles are exact."""
        quarter, rest = divmod(angle % _FULL_TURN, 90.0)
        along, across = math.cos(math.radians(rest)), math.sin(math.radians(rest))
        turned = ((along, across), (-across, along), (-along, -across), (across, -along))[int(quarter) % 4]
        x, y = (round(radius * each, decimals) + 0.0 for each in turned)
        return x, y


def plan_circle_path(job: Job, place: Place, feed: float | None) -> CirclePath:
    """Return the path of a job's circular test.

    `feed`: Of the path, mm/min; that of the circle if it is not given.

    Raises `InputError` if the feed is too small for any control.
    """
    circle, keys = job.keys.circle, job.keys.plan.circle or CirclePlanKeys()
    assert circle is not None and job.axis.circle is not None  # noqa: S101, PT018 - the caller has seen to it
    feed = circle.feed if feed is None else feed
    if feed < _LEAST_FEED:
        message = f"circle.feed: {feed:g} is less than can be programmed; state {_LEAST_FEED:g} or more"
        raise InputError.at(place, message)
    turns = list_planned_turns(keys.start, keys.extent, keys.arc, job.keys.plan.runs or _USUAL_RUNS)
    number = job.keys.certificate.number
    return CirclePath(number, job.axis.circle, feed, turns, keys.run_up, keys.rest, place)


def list_planned_turns(first: float, extent: float, arc: float, runs: int) -> tuple[PlannedTurn, ...]:
    """Return so many turns in each sense, one to and one fro; angles in °."""
    last = first + extent
    return tuple(
        PlannedTurn(sense, run, *((first, last) if sense is Approach.POSITIVE else (last, first)), arc)
        for run in range(1, runs + 1)
        for sense in Approach
    )


def write_circle_heading(path: CirclePath, options: ProgramOptions) -> Iterator[str]:
    """Yield the remarks at the head of a program: plain ASCII, each beginning with a word of its own.

    Raises `InputError` where the keys of the program give an axis another name: two axes run a circle.
    """
    first, second = path.circle.axes
    if options.axis is not None:
        raise InputError.at(
            path.place, f"axis: a circle is run by {first} and {second}, called so; take it out"
        )
    third = next(axis for axis in "XYZ" if axis not in path.circle.axes)
    turn = path.turns[0]
    low, high = sorted((turn.first, turn.last))
    place = " ".join(
        f"{axis} {MILLIMETRE.from_si(value):.12g}"
        for axis, value in zip("XYZ", path.circle.centre, strict=True)
    )
    yield f"job {write_plain_name(path.number)}"
    yield (
        f"circle {path.circle.plane}, radius {path.radius:.12g} mm, "
        f"feed {write_program_number(path.feed)} mm/min, {count_in_words(len(path.turns), 'turn')}"
    )
    yield (
        f"evaluated {low:.12g} to {high:.12g} deg from {first} to {second}, "
        f"{turn.arc:.12g} deg before and behind"
    )
    yield f"begins {path.run_up:.12g} mm outside the circle"
    yield f"zero is the centre of the circle, at {place} mm of the machine"
    yield f"only {first} and {second} move, {third} must stand at its zero"
