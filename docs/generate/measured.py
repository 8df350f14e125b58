"""Puts the tables of a benchmark into their page: ``python docs/generate/measured.py NAME RESULTS``.

RESULTS is the file that ``./run benchmark NAME`` keeps, of ``hidden-effects``, ``experiments``, ``worlds`` or
``quantities``.
Of results that name the state of their code those of the last one count. To make them takes hours: tests only
hold the tables against the results that stand beside the benchmarks.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

_ROOT = Path(__file__).parents[2]
_PAGES = _ROOT / "docs" / "explanation"

sys.path.insert(0, str(_ROOT / "benchmarks"))

import coverage_of_quantities  # noqa: E402 - found beside this folder
import coverage_of_worlds  # noqa: E402 - the same
from hidden_effects import records  # noqa: E402 - the same
from hidden_effects.tables import experiments, report  # noqa: E402 - the same

_OF_COVERAGE = ("worlds", "quantities")
_REPORTS = {"hidden-effects": report, "experiments": experiments.report}


def page_of(name: str) -> Path:
    """Return the page on which the tables of a benchmark stand."""
    return _PAGES / ("uncertainty.md" if name in _OF_COVERAGE else "hidden-effects.md")


def filled(text: str, name: str, results: Path) -> str:
    """Return the text of a page with the tables of results."""
    part = re.compile(rf"(<!-- measured: {name} -->\n).*?(<!-- end of what was measured -->)", re.DOTALL)
    return part.sub(lambda part: f"{part[1]}\n{_tables(name, results)}\n\n{part[2]}", text)


def _tables(name: str, results: Path) -> str:
    if name == "worlds":
        return coverage_of_worlds.tables(coverage_of_worlds.read(results))
    if name == "quantities":
        return coverage_of_quantities.tables(coverage_of_quantities.read(results))
    found = records.read(results)
    state = found[-1]["code"]
    return _REPORTS[name](records.of_state(found, state), state)


if __name__ == "__main__":
    page = page_of(sys.argv[1])
    text = filled(page.read_text(encoding="utf-8"), sys.argv[1], Path(sys.argv[2]))
    page.write_text(text, encoding="utf-8")
