"""The overview of a fleet so large that a browser is not handed all its graphs at once."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from fleet.histories import entry, parameter, quarters
from zlmreport.fleet.overview import make_overview
from zlmreport.fleet.printing import Names
from zlmreport.fleet.state import describe_state
from zlmreport.plugin import Language
from zlmreport.plugin.registry import find_plugins

pytestmark = pytest.mark.long

MACHINES = 300
EXCEEDS = 250


@pytest.fixture(scope="module")
def page_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return an overview of three hundred machines, of which one exceeds its limit."""
    entries = [
        entry(
            day,
            parameter(21.0 if number == EXCEEDS else 8 + number / 100, conforms=number != EXCEEDS),
            machine=f"MC 500 EX-{number:03}",
            job=f"{number}-{test}.yaml",
            number=f"CAL-{number:03}-{test}",
        )
        for number in range(MACHINES)
        for test, day in enumerate(quarters(2))
    ]
    file = tmp_path_factory.mktemp("overview") / "fleet.html"
    state = describe_state("Hall North", entries, [each.job for each in entries], None)
    names = Names(find_plugins().standards)
    file.write_text(make_overview(state, Language.ENGLISH, names, "."), encoding="utf-8")
    return file


@pytest.fixture
def page(window: Callable[..., Page], page_file: Path) -> Page:
    return window(page_file.as_uri(), viewport={"width": 1280, "height": 800})


def rows_of(number: int) -> str:
    return f"table.machine tbody:has-text('EX-{number:03}')"


def test_a_graph_is_drawn_when_it_comes_in_sight(page: Page) -> None:
    last = page.locator(rows_of(MACHINES - 1))
    assert last.locator("svg").count() == 0
    last.scroll_into_view_if_needed()
    expect(last.locator("svg")).to_be_visible()


def test_a_graph_is_drawn_of_what_is_searched_and_leads_to_its_trend(page: Page) -> None:
    page.locator("input[name=search]").fill("ex-123")
    page.locator(rows_of(123)).locator("a.to-trend").click()
    trend = page.locator("article.trend:target")
    expect(trend).to_contain_text("X of MC 500 EX-123")
    expect(trend).to_contain_text("CAL-123-0")
    page.keyboard.press("Escape")
    expect(trend).to_have_count(0)


def test_the_address_of_a_trend_that_is_packed_leads_to_it(
    window: Callable[..., Page], page_file: Path
) -> None:
    page = window(f"{page_file.as_uri()}#trend-200")
    expect(page.locator("article.trend:target")).to_be_visible()


def test_without_scripts_every_axis_is_shown_and_the_graph_of_what_needs_somebody(
    window: Callable[..., Page], page_file: Path
) -> None:
    page = window(page_file.as_uri(), java_script_enabled=False)
    assert page.locator("table.machine tbody").count() == MACHINES
    assert page.locator("#needs a.to-trend svg").count() == 1
    page.locator("#needs a.to-trend").click()
    expect(page.locator("article.trend:target")).to_contain_text(f"X of MC 500 EX-{EXCEEDS}")


def test_only_what_is_in_sight_is_laid_out(page: Page) -> None:
    skipped = "all => all.filter(each => !each.rows[1].checkVisibility({contentVisibilityAuto: true})).length"
    assert page.locator("table.machine tbody").evaluate_all(skipped) > MACHINES / 2


@pytest.mark.parametrize("width", [1280, 390])
def test_machines_not_yet_laid_out_take_the_height_that_they_will_have(
    window: Callable[..., Page], page_file: Path, width: int
) -> None:
    page = window(page_file.as_uri(), viewport={"width": width, "height": 800})
    high = "table => table.getBoundingClientRect().height"
    table = page.locator("table.machine")
    expected = table.evaluate(high)
    page.add_style_tag(content=".machine tbody { content-visibility: visible !important }")
    assert table.evaluate(high) == pytest.approx(expected, rel=0.15)


def test_nobody_is_left_out(page: Page) -> None:
    found = Axe().run(page)
    assert found.violations_count == 0, found.generate_report()
