"""Several tests of one axis laid over each other, in a browser as people use it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from browser.pictures import picture

pytestmark = pytest.mark.long

Window = Callable[..., Page]
_SECOND = Path(__file__).parents[2] / "configs" / "as-found" / "certificate.yaml"


@pytest.fixture
def others() -> list[Path]:
    """Return the job of an axis that was adjusted: two tests."""
    return [_SECOND]


def test_tests_are_overlaid_and_taken_away_and_everybody_can_use_them(address: str, window: Window) -> None:
    page = window(address, viewport={"width": 1440, "height": 900}, bypass_csp=True)
    tests = page.locator("#part-tests")
    expect(tests.get_by_role("heading", name="Tests of this axis")).to_be_visible()
    above = page.locator(".plot").first
    expect(above.locator(".curve.test-0, .curve.test-2")).to_have_count(4)  # two tests, both directions
    accuracy = tests.locator("tr", has_text="Bidirectional positioning error").first
    expect(accuracy.locator(".trend")).to_be_visible()
    expect(page.locator("body")).to_have_attribute("data-state", "missing")
    picture(page, "tests")
    found = Axe().run(page)
    assert found.violations_count == 0, found.generate_report()
    tests.get_by_role("button", name="certificate, as found").click()
    expect(above.locator(".curve.test-0")).to_have_count(0)
    expect(above.locator(".curve.test-2")).to_have_count(2)


def test_the_difference_at_a_target_is_told_to_who_goes_there_by_keys(address: str, window: Window) -> None:
    page = window(address, viewport={"width": 390, "height": 844})
    tests = page.locator("#part-tests")
    tests.locator(".plot").focus()
    page.keyboard.press("Home")
    expect(tests.get_by_role("status")).to_contain_text("2026-11-17: 55.4 mm ↓: −")
    assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth")
