"""The part programs that a job names."""

from __future__ import annotations

from pathlib import Path

import pytest

from job.jobs import loaded, mistakes, with_lines


def test_bare_identifier_stands_for_a_program_without_keys(tmp_path: Path) -> None:
    (choice,) = loaded(with_lines("plan: {programs: [exemplary-steps]}"), tmp_path).programs
    assert (choice.identifier, choice.options.axis, choice.options.decimals) == ("exemplary-steps", None, 3)
    assert (choice.place.line, choice.place.column) == (16, 19)


def test_program_has_keys_of_its_own(tmp_path: Path) -> None:
    text = with_lines("plan:", "  programs:", "    - {program: exemplary-steps, axis: X1, decimals: 4}")
    (choice,) = loaded(text, tmp_path).programs
    assert (choice.options.axis, choice.options.decimals) == ("X1", 4)


@pytest.mark.parametrize(
    ("programs", "message"),
    [
        (
            "[exemplary-step]",
            "no plugin provides part program 'exemplary-step'; did you mean 'exemplary-steps'?",
        ),
        ("[{program: exemplary-steps, decimal: 4}]", "did you mean 'decimals'?"),
        ("[{program: exemplary-steps, decimals: many}]", "plan.programs.decimals"),
        ("[exemplary-steps, exemplary-steps]", "exemplary-steps is listed twice; remove one of them"),
        ("exemplary-steps", "plan.programs"),
        ("[{axis: X}]", "program"),
    ],
)
def test_mistake_is_told_at_its_place(programs: str, message: str, tmp_path: Path) -> None:
    (found,) = mistakes(with_lines(f"plan: {{programs: {programs}}}"), tmp_path)
    assert found.startswith("job.yaml:16:")
    assert message in found
