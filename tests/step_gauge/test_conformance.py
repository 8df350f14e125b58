"""Every installed writer of probing programs passes every check that a third party's author runs."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from step_gauge.languages import LANGUAGES
from zlmreport.plugin.program import PartProgram
from zlmreport.plugin.registry import find_plugins
from zlmreport_step_gauge.paths.path import ProbingPath
from zlmreport_step_gauge.testing import PROBING_PROGRAM_CHECKS

PROGRAMS = find_plugins().list_programs_for(ProbingPath)


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.identifier)
@pytest.mark.parametrize("check", PROBING_PROGRAM_CHECKS)
def test_conforms(program: PartProgram, check: Callable[..., None]) -> None:
    check(program, LANGUAGES[program.identifier], {})


def test_every_probing_program_has_a_recogniser() -> None:
    assert {program.identifier for program in PROGRAMS} == set(LANGUAGES)
