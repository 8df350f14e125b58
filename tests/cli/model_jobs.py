"""The example whose model lacks an effect, in a folder to work in, with a command line."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.commands import Shop
from model.hidden_effect import written
from replacing import replace_in


def opened(folder: Path, monkeypatch: pytest.MonkeyPatch, capture: pytest.CaptureFixture[str]) -> Shop:
    """Return the folder with a copy of the example, as the one to work in."""
    monkeypatch.chdir(folder)
    monkeypatch.setenv("COLUMNS", "110")
    written(folder)
    return Shop(folder, capture)


def change(shop: Shop, *changes: tuple[str, str]) -> None:
    """Change the job's text."""
    replace_in(shop.folder / "job.yaml", *changes)


def keep(shop: Shop, readings: int) -> None:
    """Leave only the first readings of the table, below its three lines of head."""
    table = shop.folder / "x-axis.csv"
    lines = table.read_text(encoding="utf-8").splitlines(keepends=True)
    table.write_text("".join(lines[: 3 + readings]), encoding="utf-8")
