from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("playwright", reason="playwright is not installed")
pytest.importorskip("starlette", reason="the workbench's extra is not installed")

from playwright.sync_api import Browser, BrowserContext, Page, expect, sync_playwright

from processes import PATIENCE, ZLMREPORT, started
from web.jobs import lay_out

ROOT = Path(__file__).parents[2]
_NAMES = ("chromium", "chromium-browser", "google-chrome-stable", "google-chrome")
_ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]
#: The longest that is waited for what a page shows, ms: a diagnosis that needs 9 s of a processor takes 100 s
#: beside six busy processes.
_PATIENCE = 1000 * PATIENCE
_ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/\?token=\S+")


expect.set_options(timeout=_PATIENCE)


@pytest.fixture(scope="module")
def chromium() -> Iterator[Browser]:
    """Return the system's browser, without a window.

    It ends with the module: Playwright keeps an event loop running in the thread as long as it lives, and
    other tests that the same process takes in turn have loops of their own.
    """
    path = next((found for name in _NAMES if (found := shutil.which(name))), None)
    if path is None:
        pytest.skip("no Chromium is installed (Debian, Ubuntu: apt-get install chromium)")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=_ARGUMENTS)
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return where pages remember diagnoses: what one test has seen made, the next finds there."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def job(tmp_path: Path) -> Path:
    """Return the job of an axis whose model lacks the error of its screw."""
    return lay_out(tmp_path)


@pytest.fixture
def others() -> list[Path]:
    """Return the jobs of other tests that the page is opened with: none, unless a test names some."""
    return []


@pytest.fixture
def address(job: Path, others: list[Path], cache: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """Return what the command prints: where the page of the job is."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))
    with started(*ZLMREPORT, "workbench", job, *others, "--no-browser") as workbench:
        found = _ADDRESS.search(workbench.lines(1)[0])
        assert found
        yield found[0]
        workbench.ended()


@pytest.fixture
def window(chromium: Browser) -> Iterator[Callable[..., Page]]:
    """Return what opens a window of its own: of another person, in another language, in the dark."""
    contexts: list[BrowserContext] = []
    complaints: list[str] = []

    def opened(address: str, **settings: Any) -> Page:
        usual = {"viewport": {"width": 1280, "height": 900}, "locale": "en-GB", "reduced_motion": "reduce"}
        context = chromium.new_context(**{**usual, **settings})
        context.set_default_timeout(_PATIENCE)
        contexts.append(context)
        page = context.new_page()
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("console", lambda message: message.type == "error" and complaints.append(message.text))
        page.goto(address)
        return page

    yield opened
    for context in contexts:
        context.close()
    assert [each for each in complaints if "status of 4" not in each] == []
