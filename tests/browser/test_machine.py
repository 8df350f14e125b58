"""The loop of a whole machine by clicks alone, in a browser as people use it."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from browser.conftest import ROOT

Window = Callable[..., Page]
pytestmark = [pytest.mark.early, pytest.mark.long]


@pytest.fixture
def job(tmp_path: Path) -> Path:
    """Return the example of a machine: what the page is opened with."""
    shutil.copy(ROOT / "configs" / "laboratory.yaml", tmp_path)
    return shutil.copytree(ROOT / "configs" / "machine", tmp_path / "machine") / "machine.yaml"


def test_the_drive_that_lags_is_added_by_a_click_and_the_error_falls(
    address: str, job: Path, window: Window
) -> None:
    page = window(address)
    expect(page.locator("body")).to_have_attribute("data-state", "missing")
    expect(page.locator("#part-verdict .next")).to_contain_text("Next: add Servo mismatch.")
    expect(page.locator("#part-test .drawing svg")).to_be_visible()

    page.locator("#part-failures button").first.click()
    expect(page.locator(".plot .ring").first).to_be_attached()

    page.get_by_role("button", name="Add servo-mismatch to the model").click()
    expect(page.locator("body")).to_have_attribute("data-state", "adequate")
    fall = page.locator("#part-fall tbody tr")
    expect(fall).to_have_count(4)
    errors = [float(each) for each in fall.locator("td.number").all_inner_texts()]
    assert errors == sorted(errors, reverse=True)
    assert "servo-mismatch]" in job.read_text("utf-8")

    page.get_by_role("button", name="Undo: servo-mismatch added").click()
    expect(page.locator("body")).to_have_attribute("data-state", "missing")
    assert "servo-mismatch]" not in job.read_text("utf-8")


def test_the_page_of_a_machine_fits_a_narrow_screen_in_german(address: str, window: Window) -> None:
    page = window(address, viewport={"width": 390, "height": 844}, locale="de-DE")
    expect(page.locator("#part-machine")).to_contain_text("Arbeitsraum")
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
