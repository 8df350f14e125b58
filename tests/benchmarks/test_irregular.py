"""Axes that are irregular from target to target: they are, and the benchmark says what they are called."""

from __future__ import annotations

import pytest

from hidden_effects.irregular import diagnose_drawn_axis, main
from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict


def test_a_drawn_axis_is_off_by_far_more_than_its_readings_scatter() -> None:
    found = diagnose_drawn_axis(2000, 7)
    assert found.error.noise_rms is not None
    assert found.error.rms > 2 * found.error.noise_rms
    assert found.verdict is DiagnosisVerdict.UNEXPLAINED


def test_what_is_hidden_beside_the_geometry_is_in_the_readings() -> None:
    alone, beside = (diagnose_drawn_axis(2000, 7, hidden) for hidden in ((), ("backlash",)))
    assert "backlash" in {each.identifier for each in beside.together}
    assert "backlash" not in beside.fit.model.identifiers
    assert beside.error.rms > alone.error.rms


def test_of_each_number_of_targets_it_is_told_what_was_named(capsys: pytest.CaptureFixture[str]) -> None:
    main(["--axes", "2", "--first", "2000", "--targets", "5", "7", "--hidden", "backlash"])
    head, _, *rows = capsys.readouterr().out.splitlines()
    assert head == (
        "| targets | axes | unexplained | adequate | hidden ones named | others named | by what |"
    )
    cells = [[cell.strip() for cell in row.split("|")[1:-1]] for row in rows]
    assert [row[:2] for row in cells] == [["5", "2"], ["7", "2"]]
    for _, axes, unexplained, adequate, named, others, _ in cells:
        assert int(unexplained) + int(adequate) <= int(axes)
        assert int(others) <= int(axes)
        assert named.endswith(" of 2")
