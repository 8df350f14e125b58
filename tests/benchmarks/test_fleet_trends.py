"""The benchmark of steps and drifts, in small: what it plants is named, and hardly anything else."""

from __future__ import annotations

import sys

import pytest

from environments import ROOT

sys.path.append(str(ROOT / "benchmarks"))
import fleet_trends


def test_a_fleet_in_which_nothing_changes_raises_few_alarms(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fleet_trends, "SCATTERS", dict(list(fleet_trends.SCATTERS.items())[-1:]))
    ((_, named),) = fleet_trends.alarms(5, 300, 3)
    assert named <= 1  # a fleet that spoke for its wild axes, too, named two a night


def test_a_step_of_ten_scatters_is_seen_at_once_and_a_steep_drift_soon() -> None:
    assert fleet_trends.seen(1 / 3, 1 / 30, 1, 30, 1) == (1, 1)
    assert fleet_trends.quarters_to_name(1 / 15, 1 / 30, 1, 20, 1) <= 8


def test_the_tables_are_printed(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(fleet_trends, "alarms", lambda *_: [("1/15, all alike", 0.7)])
    monkeypatch.setattr(fleet_trends, "_rows", lambda *_: [("steps", "1", "2")])
    monkeypatch.setattr(fleet_trends, "found", lambda *_: 0.5)
    fleet_trends.main(["--fleets", "1"])
    assert "| 8 | 50 % | 50 % | 50 % | 50 % |" in capsys.readouterr().out
