"""The count of what a run comes past is of own functions, by room."""

from __future__ import annotations

import re
from pathlib import Path

from processes import PYTHON, run

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


def test_functions_on_the_way_to_a_results_file_are_counted_by_room() -> None:
    done = run(PYTHON, "hops.py", "readings to their results file", cwd=BENCHMARKS, check=True)
    head, *rooms = done.stdout.splitlines()
    files, functions = map(int, re.findall(r"\d+", head))
    counted = [tuple(map(int, line.split()[:2])) for line in rooms]
    assert [sum(each) for each in zip(*counted, strict=True)] == [files, functions]
    assert any(line.endswith("measurement") for line in rooms)
    assert not any(line.endswith("document/typesetting") for line in rooms)
