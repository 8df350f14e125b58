"""Each check of a writer of probing programs passes the exemplary one, and finds the sin it is there for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from refusals import failed_checks
from step_gauge.exemplary_program import ExemplaryProbing, read_words
from testing.sinning import list_sins_of_programs, make_sinner, make_tests
from zlmreport.plugin import InputError, Place
from zlmreport_step_gauge import testing as probing_programs
from zlmreport_step_gauge.paths.path import ProbingPath
from zlmreport_step_gauge.testing import PROBING_PROGRAM_CHECKS, check_probing_program


def on_paper(change: Callable[[str], str]) -> Callable[..., str]:
    return lambda _, path, options: change(ExemplaryProbing().write(path, options))


def inwards(text: str) -> str:
    """Turn the normals of a program over."""
    lines = []
    for line in text.splitlines():
        word, *numbers = line.split(" ")
        if word == "TOUCH":
            numbers[3:] = [f"{-float(each):.7f}" for each in numbers[3:]]
        lines.append(" ".join([word, *numbers]))
    return "\n".join(lines) + "\n"


def named(_self: object, path: ProbingPath, options: Any) -> str:
    return f"SAY {path.number}\n{ExemplaryProbing().write(path, options)}"


def elsewhere(_self: object, path: ProbingPath, options: Any) -> str:
    if path.radius_correction:
        raise InputError.at(Place("elsewhere"), "no")
    return ExemplaryProbing().write(path, options)


SINS = [
    *list_sins_of_programs(probing_programs, on_paper),
    (
        probing_programs.leads_along_the_path,
        {"write": on_paper(lambda text: text.replace("GO 0.0000 0.0000 400.0000\n", "", 1))},
        "vertical path: 61 moves; expected 62",
    ),
    (
        probing_programs.leads_along_the_path,
        {"write": on_paper(lambda text: text.replace("400.0000", "399.0000", 1))},
        "move 1 is going to (0.0000, 0.0000, 399.0000); expected going to (0.0000, 0.0000, 400.0000)",
    ),
    (probing_programs.leads_along_the_path, {"write": on_paper(inwards)}, "has the normal"),
    (probing_programs.takes_no_name_for_a_statement, {"write": named}, "the program cannot be read"),
    (probing_programs.minds_the_radius, {"write": elsewhere}, "elsewhere than at path.place"),
]


test_exemplary_passes, test_a_check_finds_its_sin, test_every_check_has_a_sin = make_tests(
    PROBING_PROGRAM_CHECKS, ExemplaryProbing, SINS, lambda *_: (read_words, {})
)


def test_all_failures_are_reported_at_once() -> None:
    sinner = make_sinner(ExemplaryProbing, {"write": on_paper(lambda text: inwards(text).rstrip())})
    checks = failed_checks(check_probing_program, sinner, read_words)
    assert checks == ["leads_along_the_path", "is_plain_text"]
