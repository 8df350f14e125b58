"""What the tests of data sources share."""

from __future__ import annotations

from pathlib import Path

import pytest

from plugins.sources.reading import File


@pytest.fixture
def file(tmp_path: Path) -> File:
    """A table for laser-csv, the source of most tests; the tests of other sources have their own."""
    return File("laser-csv", tmp_path / "x.csv")
