"""The project's own example of a machine, in a folder of its own."""

import shutil
from pathlib import Path

import pytest

from environments import ROOT


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The example, with what its files extend beside it."""
    shutil.copy(ROOT / "configs" / "laboratory.yaml", tmp_path)
    return shutil.copytree(ROOT / "configs" / "machine", tmp_path / "machine")
