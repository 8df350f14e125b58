"""Every installed writer of probing programs passes every check that a third party's author runs."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from plugins.probing_programs.languages import LANGUAGES
from zlmreport.plugin.protocols import ProbingProgram
from zlmreport.plugins import find_plugins
from zlmreport.testing import PROBING_PROGRAM_CHECKS

PROGRAMS = find_plugins().probing_programs


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.identifier)
@pytest.mark.parametrize("check", PROBING_PROGRAM_CHECKS)
def test_conforms(program: ProbingProgram, check: Callable[..., None]) -> None:
    check(program, LANGUAGES[program.identifier], {})


def test_every_probing_program_has_a_recogniser() -> None:
    assert {program.identifier for program in PROGRAMS} == set(LANGUAGES)
