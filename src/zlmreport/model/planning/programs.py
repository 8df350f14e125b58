"""The planned motion as a control moves it: feeds, dwells, texts and names that all part programs share."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np
from pydantic import Field

from zlmreport.errors import InputError, Place
from zlmreport.job.types import Options
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.units import SECONDS_PER_MINUTE
from zlmreport.model.planning.methods import RUN_BY_RUN, Method, Stop
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.model.planning.targets import convert_to_users_unit

#: Feed, mm/min or °/min, and dwell, s.
_LEAST_RATE = 0.001
#: Digits after the decimal point of feeds and dwells: what every control takes.
_RATE_DIGITS = 3
_TARGETS_A_LINE = 5
_LONGEST_NAME = 32
#: Addresses of most controls.
_ONE_LETTER = re.compile("[XYZABCUVW]")
#: What nobody takes for the end of a remark or of a text, for an address, or for a word of its own.
_NOT_PLAIN = re.compile(r"[^A-Za-z0-9 ._+-]")
_SIGNS = {Approach.POSITIVE: "+", Approach.NEGATIVE: "-"}


@dataclass(frozen=True, slots=True)
class PlannedReading:
    """A reading that is taken while the axis stands at a target.

    Attributes
    ----------
    number
        In the order of the test, from 1.
    target
        Number of the target, from 1.
    approach
        The direction in which the axis must come there.
    run
        Number of the run, from 1.
    """

    number: int
    target: int
    approach: Approach
    run: int


Begins: TypeAlias = Literal["", "test", "run", "second half"]


@dataclass(frozen=True, slots=True)
class ProgramStop:
    """A point at which the axis stops: to be read, or to turn round.

    Attributes
    ----------
    position
        mm or °.
    reading
        What is read there; None where the axis only turns round.
    begins
        Of a stop before the first reading of the test, of a run that goes over the whole axis, or of the
        second half after a pause: which of them begins from here; empty for any other.
    """

    position: float
    reading: PlannedReading | None = None
    begins: Begins = ""


@dataclass(frozen=True, slots=True)
class Motion:
    """The motion of a planned test.

    Attributes
    ----------
    number
        Of the job.
    axis
        The axis under test.
    method
        The positioning method.
    runs
        How often each target is read in each direction.
    targets
        Target positions, rising, mm or °.
    stops
        Where the axis stops, in this order.
    overrun
        How far beyond a target it turns round, mm or °.
    feed
        Of all motion, mm/min or °/min.
    dwell
        Time at rest at a target, s.
    place
        Where the part program is asked for: for messages about what it cannot do.
    """

    number: str
    axis: Axis
    method: Method
    runs: int
    targets: tuple[float, ...]
    stops: tuple[ProgramStop, ...]
    overrun: float
    feed: float
    dwell: float
    place: Place

    def in_decimals(self, decimals: int) -> Motion:
        """Return the motion as a control carries it out that takes so many digits after the point.

        Turning points are rounded; a stop at which nothing is read and to which nothing moves is left out.

        Raises
        ------
        InputError
            If a target needs more digits, for then the control would go to another one than is evaluated;
            or if a reading would not be approached from its stated side, for want of an overrun that the
            control can tell from nothing.
        """
        for number, target in enumerate(self.targets, start=1):
            if round(target, decimals) != target:
                raise InputError.at(
                    self.place,
                    f"target {number}, {target:.12g} {self._unit}, has more than the {decimals} digits after "
                    "the point that are programmed; state more in the program's key decimals, if the control "
                    "takes them, or fewer in plan.targets.positions",
                )
        rounded = (replace(stop, position=round(stop.position, decimals) + 0.0) for stop in self.stops)
        return replace(self, stops=tuple(self._check_sides(_select_moving(rounded), decimals)))

    def of_run(self, run: int) -> Motion:
        """Return the motion of one run, for a restart: from the start of the test, and back to it.

        Raises
        ------
        InputError
            If there is no such run, or the method reads a target in several runs before the next.
        """
        indices = [index for index, stop in enumerate(self.stops) if stop.reading and stop.reading.run == run]
        if not 1 <= run <= self.runs:
            raise InputError.at(self.place, f"there is no run {run}: state 1 to {self.runs}")
        inside = self.stops[indices[0] : indices[-1] + 1]
        if any(stop.reading and stop.reading.run != run for stop in inside):
            raise InputError.at(
                self.place,
                f"the {self.method.value} method mixes the runs: no single one can be taken again",
            )
        start, before = self.stops[0], replace(self.stops[indices[0] - 1], begins="", reading=None)
        stops = (start, before, *inside, ProgramStop(start.position))
        return replace(self, stops=tuple(_select_moving(stops)))

    def _check_sides(self, stops: Iterable[ProgramStop], decimals: int) -> Iterator[ProgramStop]:
        """Yield stops; refuse a reading that no motion in its direction leads to."""
        before = None
        for stop in stops:
            step = 0.0 if before is None else stop.position - before
            if stop.reading is not None and step * stop.reading.approach <= 0:
                raise InputError.at(
                    self.place,
                    f"with {decimals} digits after the point, an overrun of {self.overrun:.12g} {self._unit} "
                    "leaves no approach; state a larger plan.overrun",
                )
            yield stop
            before = stop.position

    @property
    def _unit(self) -> str:
        return self.axis.position_unit.symbol


def _select_moving(stops: Iterable[ProgramStop]) -> Iterator[ProgramStop]:
    """Yield stops without those that the axis has reached already and where nothing is read."""
    before = None
    for stop in stops:
        if stop.reading is not None or stop.position != before:
            yield stop
        before = stop.position


def plan_motion_of(number: str, axis: Axis, plan: AxisPlan, place: Place) -> Motion:
    """Return the motion of a plan.

    Raises `InputError` if the feed or the dwell is too small for any control.
    """
    feed = axis.position_unit.from_si(plan.feed) * SECONDS_PER_MINUTE
    for key, value in (("measurement.feed", feed), ("measurement.dwell", plan.dwell)):
        if value < _LEAST_RATE:
            message = f"{key}: {value:.6g} is less than can be programmed; state {_LEAST_RATE:g} or more"
            raise InputError.at(place, message)
    stops = plan.stops
    if stops[-1].position != stops[0].position:
        stops = (*stops, Stop(stops[0].position))  # where the datum was taken it is looked at once more
    positions = convert_to_users_unit(axis, np.array([stop.position for stop in stops]))
    targets = convert_to_users_unit(axis, plan.targets)
    readings = (
        PlannedReading(count, visit.target + 1, visit.approach, visit.run)
        for count, visit in enumerate(plan.visits, start=1)
    )
    return Motion(
        number=number,
        axis=axis,
        method=plan.method,
        runs=plan.runs,
        targets=tuple(targets),
        stops=tuple(
            ProgramStop(position, begins=_find_what_begins(stops, index, plan))
            if stop.target is None
            else ProgramStop(targets[stop.target], next(readings))
            for index, (stop, position) in enumerate(zip(stops, positions, strict=True))
        ),
        overrun=convert_to_users_unit(axis, np.array([plan.overrun]))[0],
        feed=feed,
        dwell=plan.dwell,
        place=place,
    )


def _find_what_begins(stops: Sequence[Stop], index: int, plan: AxisPlan) -> Begins:
    """Return what begins from a stop at which nothing is read."""
    if not index:
        return "test"
    after = stops[index + 1] if index + 1 < len(stops) else None
    before = next((stop for stop in reversed(stops[:index]) if stop.target is not None), None)
    is_new = after is not None and before is not None and after.run > before.run
    if plan.method not in RUN_BY_RUN or not is_new or after is None:
        return ""
    return "second half" if plan.pause and after.run == plan.runs // 2 + 1 else "run"


class ProgramOptions(Options):
    """The job keys that part programs share; a dialect states its own number of decimals."""

    axis: str | None = Field(
        None,
        description="Address of the axis in the program, where it is not the axis's name.",
        examples=["X"],
    )
    decimals: int = Field(3, ge=0, le=9, description="Digits after the decimal point of positions.")
    wait: Literal["start", "runs", "never"] = Field(
        "start",
        description="Where the program stops until the operator lets it go on: at its start, for the datum "
        "of a capture, and in a pause half-way; before each run too (linear and unidirectional method); or "
        "nowhere.",
    )

    def waits_at(self, stop: ProgramStop) -> bool:
        """Tell whether the program stops at a stop until the operator lets it go on."""
        at_start = stop.begins in {"test", "second half"}
        return {"start": at_start, "runs": bool(stop.begins), "never": False}[self.wait]


def write_axis_address(
    motion: Motion,
    options: ProgramOptions,
    addresses: re.Pattern[str] = _ONE_LETTER,
    such_as: str = "X, Y, Z, A, B, C, U, V or W",
) -> str:
    """Return how the program addresses the axis.

    Parameters
    ----------
    motion
        Its axis's name serves if the options state nothing.
    options
        The keys of the part program.
    addresses
        What the control takes, in capitals; a single letter, if nothing is stated.
    such_as
        The same for people.

    Raises
    ------
    InputError
        For anything else: no user's text becomes a part of a program.
    """
    address = (options.axis or motion.axis.name).strip().upper()
    if not addresses.fullmatch(address):
        raise InputError.at(
            motion.place,
            f"{address[:_LONGEST_NAME]!r} is no address of an axis on this control; state its key axis: "
            f"{such_as}",
        )
    return address


def write_heading(motion: Motion) -> Iterator[str]:
    """Yield the remarks at the head of a program: plain ASCII, each beginning with a word of its own."""
    unit = motion.axis.position_unit.ascii
    runs = "1 run" if motion.runs == 1 else f"{motion.runs} runs"
    included = {stop.reading.run for stop in motion.stops if stop.reading}
    if len(included) < motion.runs:
        runs = f"run {', '.join(map(str, sorted(included)))} of {motion.runs}"
    count = sum(stop.reading is not None for stop in motion.stops)
    readings = "1 reading" if count == 1 else f"{count} readings"
    yield f"job {write_plain_name(motion.number)}"
    yield f"axis {write_plain_name(motion.axis.name)}, {motion.method.value} method, {runs}, {readings}"
    yield (
        f"feed {write_program_number(motion.feed)} {unit}/min, dwell {write_program_number(motion.dwell)} s, "
        f"overrun {motion.overrun:.12g} {unit}"
    )
    for start in range(0, len(motion.targets), _TARGETS_A_LINE):
        some = motion.targets[start : start + _TARGETS_A_LINE]
        which = f"targets {start + 1} to {start + len(some)}" if len(some) > 1 else f"target {start + 1}"
        yield f"{which}, {' '.join(f'{target:.12g}' for target in some)} {unit}"
    if motion.axis.kind is AxisKind.ROTARY:
        yield "check that the control does not turn a rotary axis by the shorter way"


def write_remark(reading: PlannedReading) -> str:
    """Return what is remarked on a reading."""
    return f"target {reading.target} {_SIGNS[reading.approach]} run {reading.run}"


def write_program_number(value: float) -> str:
    """Write a feed or a dwell as every control reads it: no exponent, no trailing zeros.

    >>> write_program_number(2000.0), write_program_number(4.5)
    ('2000', '4.5')
    """
    text = f"{value:.{_RATE_DIGITS}f}"
    return text.rstrip("0").rstrip(".")


def write_plain_name(text: str) -> str:
    """Return a user's name as every control and probing language takes it: short, ASCII, unquoted.

    >>> write_plain_name("CAL-2026's")
    'CAL-2026_s'
    """
    return _NOT_PLAIN.sub("_", text)[:_LONGEST_NAME]
