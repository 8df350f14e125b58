"""Puts the tables of two benchmarks into their page: ``python docs/generate/measured.py NAME RESULTS``.

RESULTS is the file that ``./run benchmark NAME`` keeps, of ``hidden-effects`` or ``experiments``. Of its
results those count that have the state of the code of the last one. To make them takes hours: tests only hold
the tables against the results that stand beside the benchmarks.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

_ROOT = Path(__file__).parents[2]
_PAGE = _ROOT / "docs" / "explanation" / "hidden-effects.md"

sys.path.insert(0, str(_ROOT / "benchmarks"))

from hidden_effects import records  # noqa: E402 - found beside this folder
from hidden_effects.tables import experiments, report  # noqa: E402 - the same

_REPORTS = {"hidden-effects": report, "experiments": experiments.report}


def filled(text: str, name: str, results: Path) -> str:
    """Return the text of a page with the tables of results."""
    found = records.read(results)
    state = found[-1]["code"]
    tables = _REPORTS[name](records.of_state(found, state), state)
    part = re.compile(rf"(<!-- measured: {name} -->\n).*?(<!-- end of what was measured -->)", re.DOTALL)
    return part.sub(lambda part: f"{part[1]}\n{tables}\n\n{part[2]}", text)


if __name__ == "__main__":
    text = filled(_PAGE.read_text(encoding="utf-8"), sys.argv[1], Path(sys.argv[2]))
    _PAGE.write_text(text, encoding="utf-8")
