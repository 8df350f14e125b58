"""Puts the tables of the benchmark of truth into their page: ``python docs/generate/measured.py RESULTS``.

RESULTS is the file that ``./run benchmark hidden-effects`` keeps. Of its results those count that have the
state of the code of the last one. No test compares the tables: to make them takes hours.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

_ROOT = Path(__file__).parents[2]
_PAGE = _ROOT / "docs" / "explanation" / "hidden-effects.md"
_PART = re.compile(r"(<!-- measured: hidden-effects -->\n).*?(<!-- end of what was measured -->)", re.DOTALL)

sys.path.insert(0, str(_ROOT / "benchmarks"))

from hidden_effects import records  # noqa: E402 - found beside this folder
from hidden_effects.tables import report  # noqa: E402 - the same


def fill(page: Path, results: Path) -> None:
    """Write the tables of results into a page."""
    found = records.read(results)
    state = found[-1]["code"]
    tables = report(records.of_state(found, state), state)
    text = page.read_text(encoding="utf-8")
    page.write_text(_PART.sub(lambda part: f"{part[1]}\n{tables}\n\n{part[2]}", text), encoding="utf-8")


if __name__ == "__main__":
    fill(_PAGE, Path(sys.argv[1]))
