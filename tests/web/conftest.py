from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("starlette", reason="the workbench's extra is not installed")

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # it asks for a successor of httpx that is not packaged everywhere
    from starlette.testclient import TestClient

from web.jobs import lay_out, registry
from zlmreport.web.app import Workbench
from zlmreport.web.guard import Door

PORT = 8420


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
    return Door.at(PORT)


@pytest.fixture
def stranger(workbench: Workbench, door: Door) -> TestClient:
    """Return a browser that has not been given the token."""
    return TestClient(workbench.make_app(door), base_url=f"http://127.0.0.1:{PORT}", follow_redirects=False)


@pytest.fixture
def browser(stranger: TestClient, door: Door) -> TestClient:
    """Return a browser that came by the address on the terminal."""
    assert stranger.get(door.address).status_code == 303
    stranger.headers["Origin"] = f"http://127.0.0.1:{PORT}"
    return stranger
