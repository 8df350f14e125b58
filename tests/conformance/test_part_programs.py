"""Every installed writer of part programs passes every check that a third party's author runs."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from plugins.part_programs.controls import CONTROLS
from zlmreport.plugin.protocols import PartProgram
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import PART_PROGRAM_CHECKS

PROGRAMS = find_plugins().list_programs_for()


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.identifier)
@pytest.mark.parametrize("check", PART_PROGRAM_CHECKS)
def test_conforms(program: PartProgram, check: Callable[..., None]) -> None:
    control = CONTROLS[program.identifier]

    def run(text: str) -> list[tuple[float, float, float]]:
        machine = control(text)
        return [(*stop, feed) for stop, feed in zip(machine.stops, machine.feeds, strict=True)]

    check(program, run, {})


def test_every_part_program_has_a_control() -> None:
    assert {program.identifier for program in PROGRAMS} == set(CONTROLS)
