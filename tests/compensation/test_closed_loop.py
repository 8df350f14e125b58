"""The whole loop by the commands: an emulated axis measured, compensated, measured again; in virtual time."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from environments import ROOT
from zlmreport.cli import main

sys.path.append(str(ROOT / "benchmarks"))
import closed_loop

EXAMPLE = ROOT / "configs" / "closed-loop"


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
