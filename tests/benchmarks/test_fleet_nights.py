"""The benchmark of a fleet runs, on the smallest sizes."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

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
