"""A folder to work in, with the exemplary plugins."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.commands import Shop, use
from offers import exemplary_registry


@pytest.fixture
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Shop:
    monkeypatch.chdir(tmp_path)
    use(monkeypatch, exemplary_registry())
    return Shop(tmp_path, capsys)
