from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

pytest.importorskip("starlette", reason="the workbench's extra is not installed")

from installed import registry
from web.browsers import DOOR, enter, pass_by
from web.jobs import lay_out
from zlmreport.web.app import Workbench
from zlmreport.web.guard import Door

if TYPE_CHECKING:
    from starlette.testclient import TestClient


@pytest.fixture(autouse=True)
def cache_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Remember nothing of other tests, and nothing in the folder of whoever runs them."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


@pytest.fixture
def job(tmp_path: Path) -> Path:
    """Return the job of an axis whose model lacks the error of its screw."""
    return lay_out(tmp_path)


@pytest.fixture
def workbench(job: Path) -> Iterator[Workbench]:
    made = Workbench.of([job], registry())
    yield made
    made.end()


@pytest.fixture
def door() -> Door:
    return DOOR


@pytest.fixture
def stranger(workbench: Workbench) -> TestClient:
    return pass_by(workbench)


@pytest.fixture
def browser(workbench: Workbench) -> TestClient:
    return enter(workbench)
