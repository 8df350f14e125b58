"""The whole loop by the commands: an emulated axis measured, compensated, measured again; in virtual time."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest

from environments import ROOT
from zlmreport.cli import main
from zlmreport.model.compensation.basis import TableBasis
from zlmreport.model.compensation.confirmation import ConfirmationVerdict, confirm
from zlmreport.model.compensation.curve import ErrorCurve, make_table_of
from zlmreport.plugin import Approach, Axis, FloatArray, Place

sys.path.append(str(ROOT / "benchmarks"))
import closed_loop
import on_linuxcnc

EXAMPLE = ROOT / "configs" / "closed-loop"


@pytest.mark.long
def test_the_error_falls_on_the_machine(tmp_path: Path) -> None:
    loop = closed_loop.closed(tmp_path)
    low, high = loop.forecast
    assert (loop.verdict, loop.wrong) == ("held", "wrong-sign")
    assert low <= loop.after <= high
    assert loop.after < 0.01 * loop.before
    assert loop.wrong_after == pytest.approx(2 * loop.before, rel=0.01)
    for name in ("before", "after"):  # the example is what the loop makes, but for the time of day
        assert _readings(tmp_path / f"{name}.journal") == _readings(EXAMPLE / f"{name}.journal")


def _readings(journal: Path) -> list[object]:
    records = [json.loads(line) for line in journal.read_text(encoding="utf-8").splitlines()]
    return [record["value"] for record in records if "value" in record]


def test_the_recorded_journals_hold_the_forecast(capsys: pytest.CaptureFixture[str]) -> None:
    jobs = [str(EXAMPLE / f"{name}.yaml") for name in ("before", "after")]
    assert main(["compensate", "--confirm", *jobs, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["verdict"] == "held"


def test_the_axis_behind_the_control_has_its_play_and_its_screw(tmp_path: Path) -> None:
    motor = tmp_path / "motor.txt"
    np.savetxt(motor, [*range(101), *range(99, 49, -1)])
    axis = on_linuxcnc.ScrewDriven.behind(motor)
    forward, back = (axis.position(cycle * 1e-3) for cycle in (50, 150))
    assert forward - 0.05 == pytest.approx(on_linuxcnc.screw(0.05) - 6e-6, abs=0.1e-6)
    assert back - forward == pytest.approx(12e-6, abs=0.1e-6)


def test_a_second_test_between_the_targets_is_held_against_all_that_is_known() -> None:
    place, axis = Place("test"), Axis("X")

    def wave(positions: FloatArray) -> FloatArray:
        return np.stack([5e-6 * np.sin(positions / 0.03), 5e-6 * np.sin(positions / 0.03)])

    def curve(positions: FloatArray, left: float) -> ErrorCurve:
        forward, reverse = left * wave(positions)
        return ErrorCurve(positions, forward, reverse, np.full((2, len(positions)), 1e-8), 2, tuple(Approach))

    targets = np.linspace(0, 0.3, 5)
    none, between = np.zeros((2, 5)), targets[:-1] + 0.04
    before = curve(targets, 1.0)
    basis = TableBasis(before, wave, none, (), None, lambda _: wave)
    rows = np.linspace(0, 0.3, 61)
    table = make_table_of(wave(rows), rows, axis, "TEST", place)
    assert confirm(basis, curve(between, 0.0), axis, table, place).verdict is ConfirmationVerdict.HELD
    unchanged = confirm(basis, curve(between, 1.0), axis, table, place).verdict
    assert unchanged is ConfirmationVerdict.NOT_IN_EFFECT
