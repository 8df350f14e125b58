"""The notebooks of the documentation run, cell by cell, and what they assert of their results is true."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import Any

import matplotlib as mpl
import pytest

from environments import ROOT

NOTEBOOKS = sorted((ROOT / "docs" / "notebooks").glob("*.py"))


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda each: each.stem)
def test_notebook_runs_and_its_results_can_be_shown(notebook: Path) -> None:
    mpl.use("Agg")
    names: dict[str, Any] = {}
    cells = notebook.read_text(encoding="utf-8").split("# %%")[1:]
    asserted = 0
    for cell in cells:
        if cell.startswith(" [markdown]"):
            assert all(line.startswith("#") for line in cell.splitlines()[1:] if line)
            continue
        *statements, last = ast.parse(cell).body
        asserted += sum(isinstance(each, ast.Assert) for each in (*statements, last))
        exec(compile(ast.Module(statements, []), str(notebook), "exec"), names)
        if isinstance(last, ast.Expr):
            shown = eval(compile(ast.Expression(last.value), str(notebook), "eval"), names)
            assert getattr(shown, "_repr_html_", shown.__repr__)()
        else:
            exec(compile(ast.Module([last], []), str(notebook), "exec"), names)
    assert asserted


def test_every_notebook_is_named_in_the_guide() -> None:
    guide = (ROOT / "docs" / "how-to" / "use-in-a-notebook.md").read_text(encoding="utf-8")
    assert len(NOTEBOOKS) >= 4
    assert [each.name for each in NOTEBOOKS if f"../notebooks/{each.name}" not in guide] == []
