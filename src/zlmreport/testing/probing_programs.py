"""What every writer of probing programs must do.

The checks need a recogniser of its language: a function from the text of a program to the moves that a
machine makes of it. So the tip is seen to go the planned way, whatever the syntax.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from zlmreport.errors import InputError
from zlmreport.plugin.protocols import ProbingProgram
from zlmreport.quantities.units import MILLIMETRE
from zlmreport.step_gauge.path import Probing, ProbingPath
from zlmreport.step_gauge.path_settings import PathKind
from zlmreport.testing.expectations import expect, run_all
from zlmreport.testing.probing_paths import PLACE, sample_path
from zlmreport.testing.program_expectations import (
    expect_defaults,
    expect_named,
    expect_plain_text,
    expect_same_deeds,
)

#: Half a unit of the last digit that the coarsest language writes, mm.
_NEAR = 5.1e-4
#: Of a direction: a millionth.
_PARALLEL = 1e-6
#: Names that would become statements if they were taken as they are.
_HOSTILE = ("X'\nGOTO/9,9,9\n", "A ;\nMV 9 9 9 ;\n", 'T")\r\n00001 Home()\r\n', "$$ $\nENDFIL\n", "Ä" * 300)


@dataclass(frozen=True, slots=True)
class Stated:
    """A move as a program states it.

    Attributes
    ----------
    is_measuring
        Whether it measures.
    point
        Where it leads, mm.
    normal
        The outward normal of the face, where the language states it.
    """

    is_measuring: bool
    point: tuple[float, float, float]
    normal: tuple[float, float, float] | None = None


#: From the text of a program to its moves; it raises for a text that is none of its language.
Recogniser: TypeAlias = Callable[[str], Sequence[Stated]]


def is_named(program: ProbingProgram, _recogniser: Recogniser, _keys: Mapping[str, Any]) -> None:
    """Check that it has an identifier that can be typed, a title in every language, and a file suffix."""
    expect_named(program, ProbingProgram, ".dmi")


def options_are_described(program: ProbingProgram, _recogniser: Recogniser, _keys: Mapping[str, Any]) -> None:
    """Check that its job keys are described, none is a key of the core, and all have defaults."""
    expect_defaults(program)


def leads_along_the_path(program: ProbingProgram, recogniser: Recogniser, keys: Mapping[str, Any]) -> None:
    """Check for both kinds of paths that the program has their moves, in their order, and no other."""
    for kind in PathKind:
        path = sample_path(kind)
        stated = list(recogniser(_written(program, path, keys)))
        where = f"{program.identifier}, {kind.value} path"
        expect(len(stated) == len(path.moves), f"{where}: {len(stated)} moves; expected {len(path.moves)}")
        for number, (is_so, should) in enumerate(zip(stated, _planned(path), strict=True), start=1):
            expect(
                is_so.is_measuring == should.is_measuring and _near(is_so.point, should.point, _NEAR),
                f"{where}: move {number} is {_said(is_so)}; expected {_said(should)}",
            )
            if is_so.normal is not None and should.normal is not None:
                expect(
                    _near(is_so.normal, should.normal, _PARALLEL),
                    f"{where}: move {number} has the normal {is_so.normal}; expected {should.normal}",
                )


def is_plain_text(program: ProbingProgram, _recogniser: Recogniser, keys: Mapping[str, Any]) -> None:
    """Check that the program is ASCII in lines that a machine can hold, and ends with a line."""
    expect_plain_text(_written(program, sample_path(), keys), program.identifier)


def writes_the_same_again(program: ProbingProgram, _recogniser: Recogniser, keys: Mapping[str, Any]) -> None:
    """Check that the same path gives the same program."""
    first, second = (_written(program, sample_path(PathKind.HORIZONTAL), keys) for _ in range(2))
    expect(first == second, f"{program.identifier}: writing the same path again gives another program")


def takes_no_name_for_a_statement(
    program: ProbingProgram, recogniser: Recogniser, keys: Mapping[str, Any]
) -> None:
    """Check that a user's names of job and gauge change nothing of what the program does."""
    plain = list(recogniser(_written(program, sample_path(), keys)))
    for name in _HOSTILE:
        text = _written(program, sample_path(number=name, gauge=name), keys)
        where = f"{program.identifier}: with a gauge called {name[:20]!r}"
        expect_same_deeds(text, recogniser, plain, where, "read")


def minds_the_radius(program: ProbingProgram, _recogniser: Recogniser, keys: Mapping[str, Any]) -> None:
    """Check that a job whose machine corrects the radius gets another program, or is refused at its place.

    A language that cannot say it at all writes the same: then it is set on the machine.
    """
    try:
        text = _written(program, sample_path(radius_correction=True), keys)
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


def _written(program: ProbingProgram, path: ProbingPath, keys: Mapping[str, Any]) -> str:
    return program.write(path, program.options.model_validate(dict(keys)))


def _planned(path: ProbingPath) -> list[Stated]:
    return [
        Stated(is_measuring=True, point=_mm(move.target), normal=move.normal)
        if isinstance(move, Probing)
        else Stated(is_measuring=False, point=_mm(move.to))
        for move in path.moves
    ]


def _mm(point: tuple[float, float, float]) -> tuple[float, float, float]:
    x, y, z = (MILLIMETRE.from_si(at) for at in point)
    return x, y, z


def _near(one: Sequence[float], other: Sequence[float], tolerance: float) -> bool:
    return all(abs(mine - its) <= tolerance for mine, its in zip(one, other, strict=True))


def _said(stated: Stated) -> str:
    where = ", ".join(f"{each:.4f}" for each in stated.point)
    return f"{'measuring' if stated.is_measuring else 'going'} to ({where})"


#: Every check of a writer of probing programs, each called with the writer, a recogniser, and its job keys.
PROBING_PROGRAM_CHECKS = (
    is_named,
    options_are_described,
    leads_along_the_path,
    is_plain_text,
    writes_the_same_again,
    takes_no_name_for_a_statement,
    minds_the_radius,
)


def check_probing_program(
    program: ProbingProgram, recogniser: Recogniser, keys: Mapping[str, Any] | None = None
) -> None:
    """Run every check on a writer of probing programs.

    Parameters
    ----------
    program
        The object that the plugin's hook returns.
    recogniser
        Reads a text of its language.
    keys
        Its job keys; none if they are not given.

    Raises
    ------
    AssertionError
        With a line for every check that fails.
    """
    keys = keys or {}
    is_named(program, recogniser, keys)
    run_all(PROBING_PROGRAM_CHECKS, program, recogniser, keys)
