"""The notebooks of the documentation run, cell by cell, and what they assert of their results is true."""

from __future__ import annotations

import runpy
from pathlib import Path

import matplotlib as mpl
import pytest

from environments import ROOT

CELLS = runpy.run_path(str(ROOT / "docs" / "generate" / "notebooks.py"))["cells"]
NOTEBOOKS = sorted((ROOT / "docs" / "notebooks").glob("*.py"))


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda each: each.stem)
def test_notebook_runs_and_its_results_can_be_shown(notebook: Path) -> None:
    mpl.use("Agg")
    shown = list(CELLS(notebook, {}))
    assert any(code.startswith("```python") and "assert " in code for code, _ in shown)
    assert any(html for _, html in shown)


def test_every_notebook_is_named_in_the_guide() -> None:
    guide = (ROOT / "docs" / "how-to" / "use-in-a-notebook.md").read_text(encoding="utf-8")
    assert len(NOTEBOOKS) >= 4
    assert [each.name for each in NOTEBOOKS if f"../notebooks/{each.name}" not in guide] == []
