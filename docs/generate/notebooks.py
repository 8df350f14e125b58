"""Notebooks run cell by cell, as a page: text, code, and what the last expression of a cell shows."""

from __future__ import annotations

import ast
import html
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib import pyplot as plt

_MARK = "# %%"


def page(notebook: Path) -> str:
    """Return a notebook in the percent format as Markdown, its cells executed."""
    mpl.use("Agg")
    return "\n\n".join(part for cell in cells(notebook, {}) for part in cell if part) + "\n"


def cells(notebook: Path, names: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Execute a notebook's cells one by one in `names`; yield each as Markdown, and what it shows as HTML."""
    for cell in notebook.read_text(encoding="utf-8").split(_MARK)[1:]:
        if cell.startswith(" [markdown]"):
            yield (
                "\n".join(line.removeprefix("#").removeprefix(" ") for line in cell.splitlines()[1:]).strip(),
                "",
            )
        else:
            yield f"```python\n{cell.strip()}\n```", _shown(_value(cell, notebook, names))


def _value(cell: str, notebook: Path, names: dict[str, Any]) -> object:
    """Execute a cell; return the value of its last line if that is an expression."""
    *statements, last = ast.parse(cell).body
    if not isinstance(last, ast.Expr):
        statements.append(last)
    exec(compile(ast.Module(statements, []), str(notebook), "exec"), names)
    if not isinstance(last, ast.Expr):
        return None
    return eval(compile(ast.Expression(last.value), str(notebook), "eval"), names)


def _shown(value: object) -> str:
    if plt.get_fignums():
        drawn = io.StringIO()
        plt.savefig(drawn, format="svg")
        plt.close("all")
        return f"<div>{drawn.getvalue()[drawn.getvalue().index('<svg') :]}</div>"
    if value is None:
        return ""
    rich = getattr(value, "_repr_html_", None)
    return f"<div>{rich()}</div>" if rich else f"<pre>{html.escape(repr(value))}</pre>"
