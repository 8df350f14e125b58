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


def test_of_each_number_of_targets_it_is_told_how_many_were_named(capsys: pytest.CaptureFixture[str]) -> None:
    main(["--axes", "2", "--first", "2000", "--targets", "5", "7"])
    head, _, *rows = capsys.readouterr().out.splitlines()
    assert head == "| targets | axes | unexplained | adequate | named | by what |"
    counts = [[int(cell) for cell in row.split("|")[1:6]] for row in rows]
    assert [(targets, axes) for targets, axes, *_ in counts] == [(5, 2), (7, 2)]
    assert all(sum(verdicts) == axes for _, axes, *verdicts in counts)
