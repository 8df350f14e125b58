"""What every writer of part programs must do.

The checks need an interpreter of its language: a function from the text of a program to the stops of the axis
that runs it. So every reading is seen to be approached from its stated side, whatever the syntax.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

from zlmreport.errors import InputError, Place
from zlmreport.measurement.arrays import read_only_floats
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.model.planning.programs import Motion, plan_motion_of
from zlmreport.plugin.kinds import PART_PROGRAM
from zlmreport.plugin.protocols import PartProgram
from zlmreport.testing.expectations import (
    check,
    expect,
    expect_named,
    expect_options,
    list_checks_of,
    run_all,
)

_LONGEST_LINE = 200
#: By how much a feed may be rounded, mm/min.
_FEED = 0.51


def expect_plain_text(text: str, where: str) -> None:
    """Expect ASCII in lines that a machine can hold, the last of them with an end."""
    expect(isinstance(text, str) and text, f"{where}: write must return the text of a program")
    expect(text.isascii(), f"{where}: the program holds characters beyond ASCII")
    expect(
        all(line.isprintable() for line in text.splitlines()),
        f"{where}: the program holds control characters",
    )
    expect(text.endswith("\n"), f"{where}: the last line has no end")
    longest = max(len(line) for line in text.splitlines())
    expect(longest <= _LONGEST_LINE, f"{where}: a line has {longest} characters; {_LONGEST_LINE} at most")


def expect_same_deeds(
    text: str, understand: Callable[[str], Sequence[Any]], plain: Sequence[Any], where: str, verb: str
) -> None:
    """Expect that a program with a hostile name does what the one with a plain name does.

    `text`: The program.
    `understand`: From a text of its language to what a machine does of it.
    `plain`: What it does with a plain name.
    `where`: Of which program and name, for the message.
    `verb`: What `understand` does with a text: ``run``, ``read``.
    """
    expect(text.isascii(), f"{where}, the program holds characters beyond ASCII")
    try:
        deeds = list(understand(text))
    except Exception as error:
        message = f"{where}, the program cannot be {verb}: {error!r}"
        raise AssertionError(message) from error
    expect(deeds == plain, f"{where}, the program does something else")


#: Of the job, as it must stand in every program.
NUMBER = "KIT-7"
#: Where the kit asks for a program.
PLACE = Place("job.yaml", 12, 15)
_TARGETS = (-20.5, 3.125, 30.002, 58.25)


def sample_motion(
    method: Method = Method.LINEAR,
    *,
    axis: Axis | None = None,
    targets: tuple[float, ...] = _TARGETS,
    runs: int = 2,
    overrun: float = 5.0,
) -> Motion:
    """Return the motion of a test at 1500 mm/min (°/min) with 3.5 s at rest.

    Parameters
    ----------
    method
        The positioning method.
    axis
        A linear one, X, if it is not given.
    targets, overrun
        mm or °.
    runs
        How often each target is read in each direction.
    """
    axis = axis or Axis("X")
    to_si = axis.position_unit.to_si
    plan = AxisPlan(
        targets=read_only_floats([to_si(target) for target in targets]),
        method=method,
        runs=runs,
        overrun=to_si(overrun),
        feed=to_si(1500.0) / 60,
        dwell=3.5,
    )
    return plan_motion_of(NUMBER, axis, plan, PLACE)


#: From the text of a program to the stops: the position, mm or °, the time at rest there, s, and the feed
#: that holds on the way there, mm/min or °/min; NaN where the program has stated none so far.
Interpreter: TypeAlias = Callable[[str], Sequence[tuple[float, float, float]]]

#: Names that would become commands if they were taken as they are.
HOSTILE = ("X) G0 X9999 (", "X\nG0 X9999\n", "X;G0 X9999", "MSG,%\rM3 S9999", "Ä" * 300)


@check
def is_named(program: PartProgram, _interpreter: Interpreter, _keys: Mapping[str, Any]) -> None:
    """Check that it has an identifier that can be typed, a title in every language, and a file suffix."""
    expect_named(program, PART_PROGRAM)


@check
def options_are_described(program: PartProgram, _interpreter: Interpreter, _keys: Mapping[str, Any]) -> None:
    """Check that its job keys are described, none is a key of the core, and all have defaults."""
    expect_options(program, PART_PROGRAM)
    required = [key for key, field in program.options.model_fields.items() if field.is_required()]
    expect(
        not required,
        f"{program.identifier}: job keys {', '.join(required)} need a default: --program has no keys",
    )


@check
def leads_to_every_reading_from_its_side(
    program: PartProgram, interpreter: Interpreter, keys: Mapping[str, Any]
) -> None:
    """Check by each method that the axis stops and rests as it was planned, turning points included."""
    for method in Method:
        motion = sample_motion(method)
        run = list(interpreter(_write_program(program, motion, keys)))
        planned = [(stop.position, motion.dwell if stop.reading else 0.0) for stop in motion.stops]
        where = f"{program.identifier}, {method.value} method"
        expect(len(run) == len(planned), f"{where}: {len(run)} stops; expected {len(planned)}")
        for number, (is_at, should) in enumerate(zip(run, planned, strict=True), start=1):
            expect(
                _is_near(is_at[:2], should),
                f"{where}: stop {number} is at {is_at[0]:g} for {is_at[1]:g} s; expected {should[0]:g} for "
                f"{should[1]:g} s",
            )


@check
def moves_at_the_planned_feed(
    program: PartProgram, interpreter: Interpreter, keys: Mapping[str, Any]
) -> None:
    """Check that a feed is stated before the first motion, and holds for all of them."""
    motion = sample_motion()
    run = list(interpreter(_write_program(program, motion, keys)))
    expect(
        all(len(stop) == 3 for stop in run),
        f"{program.identifier}: let the interpreter return (position, seconds, feed) of each stop, with NaN "
        "for a feed that was not stated yet; nobody else can see a first motion without one",
    )
    for number, (*_, feed) in enumerate(run, start=1):
        expect(
            abs(feed - motion.feed) < _FEED,
            f"{program.identifier}: the motion to stop {number} has the feed {feed:g}; expected "
            f"{motion.feed:g} mm/min, stated before the first motion",
        )


@check
def is_plain_text(program: PartProgram, _interpreter: Interpreter, keys: Mapping[str, Any]) -> None:
    """Check that the program is ASCII in lines that a control can hold, and ends with a line."""
    expect_plain_text(_write_program(program, sample_motion(), keys), program.identifier)


@check
def names_the_job(program: PartProgram, _interpreter: Interpreter, keys: Mapping[str, Any]) -> None:
    """Check that the number of the job stands in the program."""
    expect(
        NUMBER in _write_program(program, sample_motion(), keys).upper(),
        f"{program.identifier}: the program does not name the job, {NUMBER}",
    )


@check
def writes_the_same_again(program: PartProgram, _interpreter: Interpreter, keys: Mapping[str, Any]) -> None:
    """Check that the same motion gives the same program."""
    first, second = (_write_program(program, sample_motion(Method.PENDULUM), keys) for _ in range(2))
    expect(first == second, f"{program.identifier}: writing the same motion again gives another program")


@check
def takes_no_name_for_a_command(
    program: PartProgram, interpreter: Interpreter, keys: Mapping[str, Any]
) -> None:
    """Check that a user's name of an axis changes nothing of what the program does, or is refused."""
    motion = sample_motion()
    plain = list(interpreter(_write_program(program, motion, keys)))
    for name in HOSTILE:
        named = replace(motion, axis=replace(motion.axis, name=name))
        try:
            text = _write_program(
                program, named, {**keys, "axis": "X"} if "axis" in program.options.model_fields else keys
            )
        except InputError:
            continue
        where = f"{program.identifier}: with an axis called {name[:20]!r}"
        expect_same_deeds(text, interpreter, plain, where, "run")


@check
def refuses_what_it_cannot_program(
    program: PartProgram, _interpreter: Interpreter, keys: Mapping[str, Any]
) -> None:
    """Check that a target of too many digits, or an overrun of too few, is refused where it is asked for."""
    cases = {
        "a target of eleven digits": sample_motion(targets=(0.0, 10.12345678901)),
        "an overrun that rounds to nothing": sample_motion(Method.PENDULUM, overrun=1e-11),
    }
    for what, motion in cases.items():
        try:
            _write_program(program, motion, keys)
        except InputError as error:
            expect(
                [problem.place for problem in error.problems] == [PLACE],
                f"{program.identifier}: {what} is refused elsewhere than at motion.place: {error}",
            )
        else:
            message = f"{program.identifier}: {what} is not refused (Motion.in_decimals does it)"
            raise AssertionError(message)


@check
def writes_rotary_axes(program: PartProgram, interpreter: Interpreter, keys: Mapping[str, Any]) -> None:
    """Check that an axis C is led over its angles, in degrees, or refused by a control that has none."""
    motion = sample_motion(axis=Axis("C", AxisKind.ROTARY), targets=(0.0, 90.0, 180.0, 270.0))
    try:
        text = _write_program(program, motion, keys)
    except InputError:
        return
    run = list(interpreter(text))
    expect(
        [stop[0] for stop in run] == [stop.position for stop in motion.stops],
        f"{program.identifier}: an axis C in degrees is not led as planned: {run}",
    )


def _write_program(program: PartProgram, motion: Motion, keys: Mapping[str, Any]) -> str:
    return program.write(motion, program.options.model_validate(dict(keys)))


def _is_near(one: Sequence[float], other: Sequence[float]) -> bool:
    """Return whether two stops agree: no control takes more digits than these."""
    return all(abs(mine - its) < 5e-7 for mine, its in zip(one, other, strict=True))


#: Every check of a writer of part programs, each called with the writer, an interpreter, and its job keys.
PART_PROGRAM_CHECKS = list_checks_of(__name__)


def check_part_program(
    program: PartProgram, interpreter: Interpreter, keys: Mapping[str, Any] | None = None
) -> None:
    """Run every check on a writer of part programs.

    Parameters
    ----------
    program
        The object that the plugin's hook returns.
    interpreter
        Runs a text of its language.
    keys
        Its job keys; none if they are not given.

    Raises
    ------
    AssertionError
        With a line for every check that fails.
    """
    keys = keys or {}
    run_all(PART_PROGRAM, PART_PROGRAM_CHECKS, program, interpreter, keys)
