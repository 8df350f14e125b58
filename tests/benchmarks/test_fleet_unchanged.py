"""The benchmark of a night in which nothing changed runs, on the smallest size."""

from __future__ import annotations

from pathlib import Path

import pytest

from processes import PYTHON, run

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.mark.long
@pytest.mark.early
def test_unchanged_nights_are_measured() -> None:
    text = "import fleet_unchanged as each; each._STEPS = (4, 2, 1); each.main(['--jobs', '4'])"
    done = run(PYTHON, "-c", text, cwd=BENCHMARKS, check=True)
    assert "4 jobs: CPU" in done.stdout
    assert "exponent of the growth of CPU" in done.stdout
