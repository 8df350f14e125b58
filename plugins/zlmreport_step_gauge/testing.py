"""The conformance kit of probing programs.

The checks need a recogniser of its language: a function from the text of a program to the moves that a
machine makes of it. So the tip is seen to go the planned way, whatever the syntax.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from zlmreport.plugin import MILLIMETRE, REFERENCE_TEMPERATURE, InputError, Place
from zlmreport.plugin.kinds import PART_PROGRAM
from zlmreport.plugin.program import PartProgram
from zlmreport.testing.expectations import check, expect, list_checks_of, run_all
from zlmreport.testing.part_programs import (
    expect_plain_text,
    expect_same_deeds,
    is_named,
    options_are_described,
)
from zlmreport_step_gauge.gauge import Face, GaugeLocation, Side, StepGauge
from zlmreport_step_gauge.paths.path import PathKind, PathSettings, Probing, ProbingPath
from zlmreport_step_gauge.paths.plan import plan_path

#: Half a unit of the last digit that the coarsest language writes, mm.
_NEAR = 5.1e-4
#: Of a direction: a millionth.
_PARALLEL = 1e-6
#: Names that would become statements if they were taken as they are.
_HOSTILE = ("X'\nGOTO/9,9,9\n", "A ;\nMV 9 9 9 ;\n", 'T")\r\n00001 Home()\r\n', "$$ $\nENDFIL\n", "Ä" * 300)


@dataclass(frozen=True, slots=True)
class Stated:
    """A move as a program states it."""

    is_measuring: bool  #: Whether it measures.
    point: tuple[float, float, float]  #: Where it leads, mm.
    #: The outward normal of the face, where the language states it.
    normal: tuple[float, float, float] | None = None


#: From the text of a program to its moves; it raises for a text that is none of its language.
Recogniser: TypeAlias = Callable[[str], Sequence[Stated]]


@check
def leads_along_the_path(program: PartProgram, recogniser: Recogniser, keys: Mapping[str, Any]) -> None:
    """Check for both kinds of paths that the program has their moves, in their order, and no other."""
    for kind in PathKind:
        path = sample_path(kind)
        stated = list(recogniser(_write_program(program, path, keys)))
        where = f"{program.identifier}, {kind.value} path"
        expect(len(stated) == len(path.moves), f"{where}: {len(stated)} moves; expected {len(path.moves)}")
        for number, (is_so, should) in enumerate(zip(stated, _read_planned(path), strict=True), start=1):
            expect(
                is_so.is_measuring == should.is_measuring and _is_near(is_so.point, should.point, _NEAR),
                f"{where}: move {number} is {_say_stated(is_so)}; expected {_say_stated(should)}",
            )
            if is_so.normal is not None and should.normal is not None:
                expect(
                    _is_near(is_so.normal, should.normal, _PARALLEL),
                    f"{where}: move {number} has the normal {is_so.normal}; expected {should.normal}",
                )


@check
def is_plain_text(program: PartProgram, _recogniser: Recogniser, keys: Mapping[str, Any]) -> None:
    """Check that the program is ASCII in lines that a machine can hold, and ends with a line."""
    expect_plain_text(_write_program(program, sample_path(), keys), program.identifier)


@check
def writes_the_same_again(program: PartProgram, _recogniser: Recogniser, keys: Mapping[str, Any]) -> None:
    """Check that the same path gives the same program."""
    first, second = (_write_program(program, sample_path(PathKind.HORIZONTAL), keys) for _ in range(2))
    expect(first == second, f"{program.identifier}: writing the same path again gives another program")


@check
def takes_no_name_for_a_statement(
    program: PartProgram, recogniser: Recogniser, keys: Mapping[str, Any]
) -> None:
    """Check that a user's names of job and gauge change nothing of what the program does."""
    plain = list(recogniser(_write_program(program, sample_path(), keys)))
    for name in _HOSTILE:
        text = _write_program(program, sample_path(number=name, gauge=name), keys)
        where = f"{program.identifier}: with a gauge called {name[:20]!r}"
        expect_same_deeds(text, recogniser, plain, where, "read")


@check
def minds_the_radius(program: PartProgram, _recogniser: Recogniser, keys: Mapping[str, Any]) -> None:
    """Check that a job whose machine corrects the radius gets another program, or is refused at its place.

    A language that cannot say it at all writes the same: then it is set on the machine.
    """
    try:
        text = _write_program(program, sample_path(radius_correction=True), keys)
    except InputError as error:
        expect(
            [problem.place for problem in error.problems] == [PLACE],
            f"{program.identifier}: radius correction is refused elsewhere than at path.place: {error}",
        )
        return
    expect(
        isinstance(text, str) and text,
        f"{program.identifier}: with radius correction, write must return a program",
    )


def _write_program(program: PartProgram, path: ProbingPath, keys: Mapping[str, Any]) -> str:
    return program.write(path, program.options.model_validate(dict(keys)))


def _read_planned(path: ProbingPath) -> list[Stated]:
    return [
        Stated(is_measuring=True, point=_take_mm(move.target), normal=move.normal)
        if isinstance(move, Probing)
        else Stated(is_measuring=False, point=_take_mm(move.to))
        for move in path.moves
    ]


def _take_mm(point: tuple[float, float, float]) -> tuple[float, float, float]:
    x, y, z = (MILLIMETRE.from_si(at) for at in point)
    return x, y, z


def _is_near(one: Sequence[float], other: Sequence[float], tolerance: float) -> bool:
    return all(abs(mine - its) <= tolerance for mine, its in zip(one, other, strict=True))


def _say_stated(stated: Stated) -> str:
    where = ", ".join(f"{each:.4f}" for each in stated.point)
    return f"{'measuring' if stated.is_measuring else 'going'} to ({where})"


#: Every check of a writer of probing programs, each called with the writer, a recogniser, and its job keys.
PROBING_PROGRAM_CHECKS = (is_named, options_are_described, *list_checks_of(__name__))


def check_probing_program(
    program: PartProgram, recogniser: Recogniser, keys: Mapping[str, Any] | None = None
) -> None:
    """Run every check on a writer of probing programs.

    `program`: The object that the plugin's hook returns.
    `recogniser`: Reads a text of its language.
    `keys`: Its job keys; none if they are not given.

    Raises `AssertionError` with a line for every check that fails.
    """
    run_all(PART_PROGRAM, PROBING_PROGRAM_CHECKS, program, recogniser, keys or {})


#: Where the kit asks for a program.
PLACE = Place("job.yaml", 14, 9)
_STEP = 0.01
#: Not along an axis of the machine: 2, 1, 2 over 3, and a top that looks as far upwards as it can.
_DIRECTION = (2 / 3, 1 / 3, 2 / 3)
_UPWARD = (-2 / 3, 2 / 3, 1 / 3)


def sample_path(
    kind: PathKind = PathKind.VERTICAL,
    *,
    number: str = "KIT-7",
    gauge: str = "Step gauge",
    radius_correction: bool = False,
) -> ProbingPath:
    """Return the path over three blocks of 10 mm, two cycles, askew in the machine.

    `kind`: Over the top, or round the side.
    `radius_correction`: Whether the machine is to report points of the surface.
    """
    faces = tuple(
        Face(index + 1, Side.BACK if index % 2 else Side.FRONT, index * _STEP, index * _STEP, 2e-7)
        for index in range(6)
    )
    whole = StepGauge(gauge, "", "", faces, None, None, REFERENCE_TEMPERATURE, _STEP, _STEP, PLACE)
    begin = (0.3, 0.04, 0.2)
    x, y, z = (at + 4 * _STEP * by for at, by in zip(begin, _DIRECTION, strict=True))
    location = GaugeLocation(begin, (x, y, z), _DIRECTION, _UPWARD, 1e-5)
    settings = PathSettings(
        kind=kind,
        clearance=5e-3,
        approach=2.5e-3,
        search=4e-3,
        retract=2e-3,
        depth=None,
        lead_in=0.0,
        cycles=2,
        tip_radius=2e-3,
        stylus_allowance=5e-4,
        speed=0.03,
        measuring_speed=0.003,
        radius_correction=radius_correction,
        safe_position=(0.0, 0.0, 0.4),
    )
    return plan_path(whole, whole, location, settings, size=(_STEP, _STEP), number=number, place=PLACE).path
