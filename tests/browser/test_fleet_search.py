"""The overview of a large fleet: axes are searched, chosen and ordered in a browser, from a file."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from playwright.sync_api import Page

from fleet.histories import entry, history, parameter, quarters
from zlmreport.fleet.overview import make_overview
from zlmreport.fleet.printing import Names
from zlmreport.fleet.records import PastNight
from zlmreport.fleet.state import Rules, describe_state
from zlmreport.plugin import Language
from zlmreport.plugin.registry import find_plugins

pytestmark = pytest.mark.long

MACHINES = 40
BEGAN = datetime(2026, 10, 20, tzinfo=UTC)


@pytest.fixture(scope="module")
def page_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return an overview of forty machines: one drifts, one exceeds its limit, ten are due soon."""
    entries = history([8.0, 9.12, 10.18, 11.31, 12.4, 13.49], axis="Drifts")
    first = quarters(8)[-1]
    for number in range(MACHINES):
        value = 21.0 if number == 7 else 2 + number / 10
        entries.append(
            entry(
                first - timedelta(days=number),
                parameter(value, conforms=value < 20),
                machine=f"Example Works MC 500 EX-{number:03}",
                job=f"m{number}.yaml",
                number=f"CAL-{number:03}",
                interval=80 if number < 10 else 1000,
            )
        )
    state = describe_state("Hall North", entries, [], PastNight(BEGAN, BEGAN), Rules())
    file = tmp_path_factory.mktemp("overview") / "fleet.html"
    file.write_text(
        make_overview(state, Language.ENGLISH, Names(find_plugins().standards), "."), encoding="utf-8"
    )
    return file


@pytest.fixture
def page(window: Callable[..., Page], page_file: Path) -> Page:
    return window(page_file.as_uri(), viewport={"width": 390, "height": 844})


def shown(page: Page) -> list[str]:
    """Return the machines that are shown, by the last word before what is noted of them, in order."""
    heads = page.locator("table.machine tbody:visible tr.name th")
    names = heads.evaluate_all(
        "all => all.map(each => each.textContent.replace(each.lastElementChild.textContent, ''))"
    )
    return [name.split()[-1] for name in names]


def test_all_are_shown_at_first(page: Page) -> None:
    assert len(shown(page)) == MACHINES + 1
    assert page.locator("#search output").inner_text() == "41 of 41 axes"


def test_what_is_typed_is_searched_in_all_tables(page: Page) -> None:
    page.locator("input[name=search]").fill("ex-007 mc")
    assert shown(page) == ["EX-007"]
    assert page.locator("#search output").inner_text() == "1 of 41 axes"
    assert page.locator("#not-met").is_visible()
    assert not page.locator("#drifting").is_visible()


@pytest.mark.parametrize("number", ["CAL-011", "cal-011 ex"])
def test_an_axis_is_found_by_its_certificate(page: Page, number: str) -> None:
    page.locator("input[name=search]").fill(number)
    assert shown(page) == ["EX-011"]


def test_the_scale_of_a_graph_is_not_searched(page: Page) -> None:
    page.locator("input[name=search]").fill("2025-01")
    assert len(shown(page)) == 0


def test_a_word_that_is_nowhere_leaves_nothing(page: Page) -> None:
    page.locator("input[name=search]").fill("<b>")
    assert shown(page) == []


def test_axes_are_chosen_by_what_they_need(page: Page) -> None:
    options = page.locator("select[name=choice] option").all_inner_texts()
    assert options == ["All axes", "Limit not met (1)", "Drifting (1)", "Due soon (10)"]
    page.locator("select[name=choice]").select_option("not-met")
    assert shown(page) == ["EX-007"]
    page.locator("select[name=choice]").select_option("due")
    assert len(shown(page)) == 10


def test_axes_are_ordered_by_limit_by_date_and_by_machine_again(page: Page) -> None:
    machines = shown(page)
    page.locator("select[name=order]").select_option("used")
    assert shown(page)[:3] == ["EX-007", "1", "EX-039"]
    page.locator("select[name=order]").select_option("due")
    assert shown(page)[:2] == ["EX-009", "EX-008"]
    page.locator("select[name=order]").select_option("measured")
    assert shown(page)[1:3] == ["EX-039", "EX-038"]
    page.locator("select[name=order]").select_option("machine")
    assert shown(page) == machines


def test_without_scripts_everything_is_shown(window: Callable[..., Page], page_file: Path) -> None:
    page = window(page_file.as_uri(), java_script_enabled=False)
    assert page.locator("table.machine tbody:visible").count() == MACHINES + 1
    assert not page.locator("#search, #choices").first.is_visible()


def test_what_is_due_is_a_list_with_the_earliest_first(page: Page) -> None:
    assert page.locator("section#due tbody th .content").all_inner_texts()[:2] == ["CAL-009", "CAL-008"]
