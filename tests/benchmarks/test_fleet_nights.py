"""The benchmarks of a fleet run on the smallest sizes, and what is planted in its trends is named."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path

import pytest

import fleet_trends
from environments import ROOT
from processes import PYTHON, run

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.mark.long
@pytest.mark.early
def test_the_nights_of_a_fleet_are_measured(tmp_path: Path) -> None:
    file = tmp_path / "results.json"
    sizes = ("--certificates", "1", "--sample", "0", "--kills", "1")
    run(PYTHON, BENCHMARKS, "fleet", *sizes, "--json", file, check=True)
    lines = json.loads(file.read_text("utf-8"))["results"]["fleet"]
    assert all(math.isfinite(line["value"]) for line in lines)
    assert lines[-1] == {
        "name": "certificates lost, doubled or half-written by it",
        "value": 0,
        "unit": "",
        "target": 0,
    }


@pytest.mark.long
@pytest.mark.early
def test_unchanged_nights_are_measured() -> None:
    text = "import fleet_unchanged as each; each._STEPS = (4, 2, 1); each.main(['--jobs', '4'])"
    done = run(PYTHON, "-c", text, cwd=BENCHMARKS, check=True)
    assert "4 jobs: CPU" in done.stdout
    assert "exponent of the growth of CPU" in done.stdout


sys.path.append(str(ROOT / "benchmarks"))


@pytest.mark.long
def test_a_fleet_in_which_nothing_changes_raises_few_alarms_and_shows_steps() -> None:
    found = fleet_trends.night("1/40, and 1/8 of every fiftieth axis", 7, 5, 300, 3)
    assert found.alarms.mean <= 1  # a fleet that spoke for its wild axes, too, named two a night
    assert found.seen.mean > 0.99
    assert found.promised.mean > 0.9


def test_a_step_of_ten_scatters_is_seen_at_once_and_a_steep_drift_soon() -> None:
    assert fleet_trends.seen(1 / 3, 1 / 30, 1, 30, 1) == (1, 1)
    assert fleet_trends.quarters_to_name(1 / 15, 1 / 30, 1, 20, 1) <= 8


def test_the_tables_are_printed(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    share = fleet_trends.Share.of([0.5, 0.5, 0.8])
    monkeypatch.setattr(fleet_trends, "night", lambda *_: fleet_trends.Night(share, share, share))
    monkeypatch.setattr(fleet_trends, "unchanged", lambda *_: fleet_trends.Unchanged(0.012, 0.034))
    monkeypatch.setattr(fleet_trends, "seen", lambda *_: (0.25, 0.75))
    monkeypatch.setattr(fleet_trends, "quarters_to_name", lambda *_: 8.0)
    monkeypatch.setattr(fleet_trends, "found", lambda *_: 0.5)
    fleet_trends.main(["--fleets", "1"])
    printed = capsys.readouterr().out
    assert "| False drifts named in a year of an axis | 0.034 | 0.034 |" in printed
    assert "| A step of 1/5 is seen at once; within a year | 25 %; 75 % | 25 %; 75 % |" in printed
    assert "| A drift of 1/15 a quarter is named after | 8 quarters | 8 quarters |" in printed
    assert "| 1/15, all alike | 4 | 0.6 ± 0.1 |" in printed
    assert "| 60.0 ± 10.0 % |" in printed
    assert "| 8 | 50 % | 50 % | 50 % | 50 % |" in printed
