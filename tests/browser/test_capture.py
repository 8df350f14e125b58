"""A capture in a browser: begun by a click, followed, and then the workbench of what was read."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, Route, expect

from browser.conftest import _ADDRESS
from cli.test_capture import JOB, PLUGIN, WHOLE
from environments import ROOT
from processes import ZLMREPORT, started

pytestmark = pytest.mark.long

Window = Callable[..., Page]


@pytest.fixture
def address(tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """Return where the page of a job is whose readings are still to be captured."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join((str(ROOT / "tests"), os.environ.get("PYTHONPATH", ""))))
    job = tmp_path / "job.yaml"
    job.write_text(JOB.replace("MOVES", WHOLE), encoding="utf-8")
    with started(*ZLMREPORT, "workbench", job, "--plugin", PLUGIN, "--no-browser") as workbench:
        found = _ADDRESS.search(workbench.lines(1)[0])
        assert found
        yield found[0]
        workbench.ended()


def test_a_capture_is_begun_by_a_click_and_ends_in_the_workbench(address: str, window: Window) -> None:
    page = window(address, bypass_csp=True)
    expect(page.get_by_text("Start the program at visit 1: 0.000 mm from below, run 1.")).to_be_visible()
    found = Axe().run(page)
    assert found.violations_count == 0, found.generate_report()
    page.get_by_role("button", name="Begin").click()
    expect(page.get_by_text("All visits are taken.")).to_be_visible()
    expect(page.locator("tr.taken")).to_have_count(4)
    page.get_by_role("link", name="To the results").click()
    expect(page.locator("#part-standards")).to_contain_text("ISO 230-2:2014")


def test_what_was_wrong_with_a_click_stands_until_the_next(address: str, window: Window) -> None:
    page = window(address)
    refusal = {"status": 422, "json": {"problems": ["the line is taken"]}}
    page.route("**/api/capture", lambda route: _refuse_clicks(route, refusal))
    page.get_by_role("button", name="Begin").click()
    told = page.get_by_text("the line is taken")
    expect(told).to_be_visible()
    for _ in range(2):
        with page.expect_response(lambda each: each.request.method == "GET"):
            pass
    page.wait_for_timeout(100)
    expect(told).to_be_visible()


def _refuse_clicks(route: Route, refusal: dict[str, Any]) -> None:
    if route.request.method == "POST":
        route.fulfill(**refusal)
    else:
        route.continue_()
