"""The overview of a fleet in a browser: nothing is loaded, nothing stands over, and nobody is left out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page

from fleet.histories import entry, history, parameter, quarters
from zlmreport.fleet.overview import make_overview
from zlmreport.fleet.printing import Names
from zlmreport.fleet.records import State
from zlmreport.fleet.state import describe_state
from zlmreport.plugin import Language
from zlmreport.plugin.registry import find_plugins

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def page_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return an overview with everything that it can show."""
    day = quarters(8)[-1]
    entries = [
        *history([8.0, 9.12, 10.18, 11.31, 12.4, 13.49]),
        *history([8.0, 8.2, 8.1], axis="Y"),
        entry(day, parameter(21.0, conforms=False), axis="Z", job="z"),
        entry(day, parameter(19.9, conforms=None), parameter(3.0, symbol="R", limit=None), axis="B", job="b"),
        entry(
            day,
            job="hall-2/hmc-500/x-axis.yaml",
            state=State.FAILED,
            message="x.csv:3:4: a long message " + "without an end " * 20,
        ),
        entry(day, job="d", state=State.DRAFT, message="the readings have changed"),
    ]
    state = describe_state("Hall North", entries, [each.job for each in entries], None)
    file = tmp_path_factory.mktemp("overview") / "fleet.html"
    names = Names(find_plugins().standards)
    file.write_text(make_overview(state, Language.GERMAN, names, "."), encoding="utf-8")
    return file


def test_the_path_of_a_job_is_parted_nowhere(window: Callable[..., Page], page_file: Path) -> None:
    page = window(page_file.as_uri(), viewport={"width": 1280, "height": 900})
    path = page.locator("th .content", has_text="hall-2/hmc-500/x-axis.yaml")
    high, line = path.evaluate("it => [it.clientHeight, parseFloat(getComputedStyle(it).lineHeight)]")
    assert high < 1.5 * line


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nobody_is_left_out(window: Callable[..., Page], page_file: Path, scheme: str) -> None:
    found = Axe().run(window(page_file.as_uri(), color_scheme=scheme))
    assert found.violations_count == 0, found.generate_report()


@pytest.mark.parametrize("width", [1280, 820, 390])
def test_the_page_and_its_tables_fit_into_the_window(
    window: Callable[..., Page], page_file: Path, width: int
) -> None:
    page = window(page_file.as_uri(), viewport={"width": width, "height": 900})
    too_wide = "all => all.filter(each => each.scrollWidth > each.clientWidth).length"
    assert page.locator("html, .wide").evaluate_all(too_wide) == 0
    heights = [box["height"] for each in page.locator(".links a").all() if (box := each.bounding_box())]
    assert min(heights, default=24) >= 24


@pytest.mark.parametrize(("width", "most"), [(1280, 2900), (375, 4900)])
@pytest.mark.parametrize("language", Language)
def test_twenty_five_axes_are_looked_through_in_a_few_screens(
    window: Callable[..., Page], tmp_path: Path, language: Language, width: int, most: int
) -> None:
    entries = [
        replace(each, machine=f"Example Works MT 500, serial {machine}", job=f"{machine}/{each.job}")
        for machine in range(5)
        for axis in "XYZBC"
        for each in history([8.0, 8.2, 8.1, 8.3, 8.2, 8.1, 8.15, 8.2], axis=axis)
    ]
    state = describe_state("Hall North", entries, [each.job for each in entries], None)
    file = tmp_path / "fleet.html"
    file.write_text(make_overview(state, language, Names(find_plugins().standards), "."), encoding="utf-8")
    page = window(file.as_uri(), viewport={"width": width, "height": 900})
    wide, high = page.evaluate(
        "(({scrollWidth, scrollHeight}) => [scrollWidth, scrollHeight])(document.documentElement)"
    )
    assert wide == width
    assert high <= most


def test_nothing_is_loaded(window: Callable[..., Page], page_file: Path) -> None:
    page = window("about:blank")
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    page.goto(page_file.as_uri())
    assert [url for url in asked if not url.startswith("data:")] == [page_file.as_uri()]


def test_it_prints_on_a4(window: Callable[..., Page], page_file: Path) -> None:
    printed = window(page_file.as_uri()).pdf(prefer_css_page_size=True)
    # 210 mm × 297 mm in points, as Chromium rounds them.
    assert b"/MediaBox [0 0 594.95996 841.91998]" in printed
