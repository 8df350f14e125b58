"""Programs say what their languages can say, are read alike, and pass the checks of the kit."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from installed import registry
from step_gauge.languages import LANGUAGES, LanguageError, dmis, ippdme, mv_ms
from step_gauge.paths import PLACE, planned
from zlmreport.plugin import InputError
from zlmreport.plugin.program import PartProgram
from zlmreport_step_gauge.paths.path import ProbingPath
from zlmreport_step_gauge.testing import PROBING_PROGRAM_CHECKS, sample_path

REGISTRY = registry()
DATA = Path(__file__).parents[1] / "data"


def written(identifier: str, keys: dict[str, Any] | None = None, **changes: Any) -> str:
    """Return the program of a path; `changes` are those of its settings."""
    program = REGISTRY.part_program(identifier, takes=ProbingPath)
    return program.write(planned(**changes).path, program.options.model_validate(keys or {}))


def sample(name: str) -> str:
    return (DATA / name).read_bytes().decode("ascii")


def test_the_recognisers_read_the_samples_alike() -> None:
    by_commands = ippdme(sample("ippdme/stepgauge.prg"))
    text = re.sub(r"PO 1 ;\n", "", sample("dmis/stepgauge.mvms"))
    by_code = [line.split() for line in text.splitlines()[:-1]]
    assert len(by_commands) == len(by_code)
    for command, (word, *numbers, _) in zip(by_commands, by_code, strict=True):
        assert command.is_measuring == (word == "MS")
        assert command.point == pytest.approx([float(each) for each in numbers], abs=6e-4)


def test_a_damaged_sample_is_refused() -> None:
    with pytest.raises(LanguageError):
        ippdme(sample("ippdme/bad.prg"))
    with pytest.raises(LanguageError):
        mv_ms(sample("dmis/stepgauge.mvms").replace("END;", ""))


def test_statements_that_no_public_program_shows_are_refused() -> None:
    with pytest.raises(LanguageError):
        dmis(sample("dmis/stepgauge.dmi"))


def test_dmis_leaves_the_radius_to_the_evaluation_unless_the_machine_corrects_it() -> None:
    assert "\nPRCOMP/OFF\n" in written("dmis")
    assert "\nPRCOMP/ON\n" in written("dmis", radius_correction=True)


def test_dmis_states_diameter_distances_and_speed() -> None:
    text = written("dmis")
    assert ",-1.0,4.000\n" in text
    assert "\nSNSET/APPRCH,2.500\nSNSET/SEARCH,4.000\nSNSET/RETRCT,2.000\n" in text
    assert "\nFEDRAT/POSVEL,MPM,1.800\n" in text  # 30 mm/s


def test_dmis_names_each_point_by_face_and_cycle() -> None:
    names = re.findall(r"OUTPUT/FA\((\w+)\)", written("dmis", blocks=2, cycles=2))
    assert names == ["F001_1", "F003_1", "F004_1", "F002_1", "F001_2", "F003_2", "F004_2", "F002_2"]


def test_dmis_continues_a_line_of_more_than_80_characters() -> None:
    program = REGISTRY.part_program("dmis", takes=ProbingPath)
    lines = program.write(sample_path(), program.options()).splitlines()
    assert max(map(len, lines)) <= 80
    first = next(index for index, line in enumerate(lines) if line.startswith("F("))
    assert lines[first].endswith(", $")
    assert lines[first][:-2] + lines[first + 1] == (
        "F(F001_1)=FEAT/POINT,CART,296.6667,38.3333,196.6667,-0.6666667,-0.3333333,-0.6666667"
    )


def test_ippdme_states_distances_in_mm_and_speeds_in_mm_a_second() -> None:
    lines = written("ippdme").split("\r\n")
    assert lines[:4] == ["00010 StartSession()", "\\\\", "00020 Home()", "\\\\"]
    assert "00050 SetProp(Tool.PtMeasPar.Speed(3))" in lines
    assert "00060 SetProp(Tool.PtMeasPar.Approach(2.5))" in lines
    assert lines[-5:] == ["99999 EndSession()", "\\\\", ":", ":", ""]


def test_ippdme_takes_the_tool_of_the_job() -> None:
    assert 'ChangeTool("Star 2")' in written("ippdme", {"tool": "Star 2"})
    with pytest.raises(ValueError, match="String should match pattern"):
        written("ippdme", {"tool": 'A")\nHome('})


def test_ippdme_refuses_a_machine_that_corrects_the_radius() -> None:
    with pytest.raises(InputError, match="reports centres of the tip") as caught:
        written("ippdme", radius_correction=True)
    assert caught.value.problems[0].place == PLACE


def test_ippdme_numbers_a_long_path_one_by_one_and_refuses_one_that_is_too_long() -> None:
    program = REGISTRY.part_program("ippdme", takes=ProbingPath)
    path = planned(blocks=3).path  # 30 moves
    text = program.write(replace(path, moves=path.moves * 400), program.options())
    assert text.startswith("00001 StartSession()")
    assert len(ippdme(text)) == 400 * 30
    with pytest.raises(InputError, match="are more than can be numbered; state fewer cycles"):
        program.write(replace(path, moves=path.moves * 3400), program.options())


def test_mv_ms_has_the_digits_that_are_asked_for() -> None:
    assert "MS    300.0000    195.0000    200.0000 ;" in written("mv-ms", {"decimals": 4})


PROGRAMS = registry().list_programs_for(ProbingPath)


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.identifier)
@pytest.mark.parametrize("check", PROBING_PROGRAM_CHECKS)
def test_conforms(program: PartProgram, check: Callable[..., None]) -> None:
    check(program, LANGUAGES[program.identifier], {})


def test_every_probing_program_has_a_recogniser() -> None:
    assert {program.identifier for program in PROGRAMS} == set(LANGUAGES)
