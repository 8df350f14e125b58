"""What a writer of part programs must do that writes circles, too.

As for `PART_PROGRAM_CHECKS`, an interpreter of the language is needed: a function from the text of a program
to the moves of the tool. So every turn is seen to go round in its sense, whatever the syntax.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from zlmreport.errors import InputError
from zlmreport.measurement.circle import PLANES, NominalCircle
from zlmreport.model.planning.circle_path import CirclePath, list_planned_turns
from zlmreport.plugin.kinds import PART_PROGRAM
from zlmreport.plugin.protocols import PartProgram, find_circle_writer
from zlmreport.testing.expectations import check, expect, list_checks_of, run_all
from zlmreport.testing.part_programs import HOSTILE, NUMBER, PLACE, expect_plain_text

#: Digits that every control takes, mm, and what a circle may miss by them.
_NEAR = 2e-3


@dataclass(frozen=True, slots=True)
class CircleMove:
    """A line or an arc, as a control with that language carries it out; mm, in the axes of the plane."""

    end: tuple[float, float]
    feed: float  #: mm/min.
    sense: int = 0  #: 1 of an arc counter-clockwise, −1 of one clockwise, 0 of a line.
    centre: tuple[float, float] = (0.0, 0.0)  #: Of an arc.


#: From the text of a program to the moves of the tool.
CircleInterpreter: TypeAlias = Callable[[str], Sequence[CircleMove]]


def sample_circle_path(
    plane: str = "XY", *, first: float = 0.0, extent: float = 360.0, arc: float = 180.0, runs: int = 2
) -> CirclePath:
    """Return the path of a circular test of 100 mm at 1500 mm/min, 2 mm of run-up, 4 s between its turns."""
    turns = list_planned_turns(first, extent, arc, runs)
    circle = NominalCircle(plane, 0.1, 0.025, (0.25, 0.2, 0.12))
    return CirclePath(NUMBER, circle, 1500.0, turns, 2.0, 4.0, PLACE)


@check
def runs_every_turn_in_its_sense(
    program: PartProgram, interpreter: CircleInterpreter, keys: Mapping[str, Any]
) -> None:
    """Check in each plane that every turn goes round as planned, its arcs before and behind included."""
    for plane in PLANES:
        for path in (sample_circle_path(plane), sample_circle_path(plane, extent=270.0, arc=90.0, runs=1)):
            where = f"{program.identifier}, plane {plane}"
            first, *moves = interpreter(_write_program(program, path, keys))
            expect(
                abs(math.hypot(*first.end) - path.radius - path.run_up) < _NEAR,
                f"{where}: the first move ends at {first.end}; expected {path.run_up:g} mm outside the "
                "circle",
            )
            found, planned = list(_measure_turns(first, moves, where)), list(path.turns)
            expect(len(found) == len(planned), f"{where}: turns: {len(found)}; expected {len(planned)}")
            for number, (is_run, turn) in enumerate(zip(found, planned, strict=True), start=1):
                expect(
                    abs(is_run - (turn.ends - turn.begins)) < 1e-2,
                    f"{where}: turn {number} goes over {is_run:+.2f}°; expected "
                    f"{turn.ends - turn.begins:+.2f}°",
                )


@check
def keeps_to_circle_and_feed(
    program: PartProgram, interpreter: CircleInterpreter, keys: Mapping[str, Any]
) -> None:
    """Check that arcs lie on the nominal circle about the zero, and that all motion has the planned feed."""
    path = sample_circle_path("ZX", first=90.0)
    for move in interpreter(_write_program(program, path, keys)):
        expect(
            move.feed == path.feed,
            f"{program.identifier}: a move at {move.feed:g} mm/min; expected {path.feed:g}",
        )
        radius = math.dist(move.end, move.centre)
        expect(
            not move.sense or (abs(radius - path.radius) < _NEAR and math.hypot(*move.centre) < _NEAR),
            f"{program.identifier}: an arc of {radius:g} mm about {move.centre}; expected {path.radius:g} mm "
            "about the zero",
        )


@check
def writes_circles_as_plain_text(
    program: PartProgram, interpreter: CircleInterpreter, keys: Mapping[str, Any]
) -> None:
    """Check that the program is ASCII, names its job, is the same again, and takes no name for a command."""
    path = sample_circle_path()
    text = _write_program(program, path, keys)
    expect_plain_text(text, program.identifier)
    expect(NUMBER in text.upper(), f"{program.identifier}: the program does not name the job, {NUMBER}")
    expect(
        text == _write_program(program, path, keys),
        f"{program.identifier}: writing the same circle again gives another program",
    )
    plain = list(interpreter(text))
    for name in HOSTILE:
        moves = list(interpreter(_write_program(program, replace(path, number=name), keys)))
        expect(moves == plain, f"{program.identifier}: a job called {name[:20]!r} moves otherwise")


@check
def refuses_points_off_the_circle(
    program: PartProgram, _interpreter: CircleInterpreter, keys: Mapping[str, Any]
) -> None:
    """Check that turns are refused whose ends would lie on no circle with so few digits."""
    if "decimals" not in program.options.model_fields:
        return
    try:
        _write_program(program, sample_circle_path(first=30.0), {**keys, "decimals": 2})
    except InputError as error:
        expect(
            [problem.place for problem in error.problems] == [PLACE],
            f"{program.identifier}: points off the circle are refused elsewhere than at path.place: {error}",
        )
    else:
        message = f"{program.identifier}: points off the circle are not refused (CirclePath.blocks does it)"
        raise AssertionError(message)


def _measure_turns(first: CircleMove, moves: Sequence[CircleMove], where: str) -> Iterator[float]:
    """Yield the angle over which each turn goes, °, rising counter-clockwise: what lies between two lines."""
    at, turned, is_on = first.end, 0.0, False
    for move in moves:
        if move.sense:
            turned, is_on = turned + _measure_angle(at, move), True
        elif is_on:
            yield turned
            turned, is_on = 0.0, False
        at = move.end
    expect(not is_on, f"{where}: the last turn does not leave the circle")


def _measure_angle(start: tuple[float, float], move: CircleMove) -> float:
    before, behind = (
        math.degrees(math.atan2(point[1] - move.centre[1], point[0] - move.centre[0]))
        for point in (start, move.end)
    )
    way = (behind - before) * move.sense % 360.0
    return move.sense * (way if 1e-6 < way < 360.0 - 1e-6 else 360.0)


def _write_program(program: PartProgram, path: CirclePath, keys: Mapping[str, Any]) -> str:
    write = find_circle_writer(program)
    assert write is not None  # noqa: S101 - the function below has seen to it
    return write(path, program.options.model_validate(dict(keys)))


#: Every check of a writer of circles, each called with the writer, an interpreter, and its job keys.
CIRCLE_PROGRAM_CHECKS = list_checks_of(__name__)


def check_circle_program(
    program: PartProgram, interpreter: CircleInterpreter, keys: Mapping[str, Any] | None = None
) -> None:
    """Run every check on a writer of part programs that writes circles.

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
    expect(find_circle_writer(program), f"{program.identifier}: has no write_circle")
    run_all(PART_PROGRAM, CIRCLE_PROGRAM_CHECKS, program, interpreter, keys or {})
