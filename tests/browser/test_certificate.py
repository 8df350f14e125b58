"""A certificate in a browser, from disk: its readings can be pointed at, and nothing else happens."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Callable
from importlib.resources import files
from pathlib import Path

import pypdfium2
import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, expect

from installed import registry
from model.hidden_effect import job, written
from zlmreport import pipeline
from zlmreport.measurement.units import with_unit

pytestmark = pytest.mark.long

Window = Callable[..., Page]


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the certificate of the example whose model lacks an effect."""
    folder = tmp_path_factory.mktemp("certificate")
    certificate = pipeline.compose(job(written(folder)), registry())
    made = folder / "certificate.html"
    made.write_bytes(registry().renderer("html").render(certificate))
    return made


def marked(page: Page) -> list[int]:
    """Return how many readings are marked in each graph."""
    return [page.locator(".plot").nth(index).locator(".ring").count() for index in range(2)]


def test_a_reading_pointed_at_is_marked_in_both_graphs(window: Window, file: Path) -> None:
    page = window(file.as_uri())
    x, y = page.locator(".plot").first.evaluate(
        """plot => {
            const [, x, y] = plot.querySelector(".mark").getAttribute("d").match(/^M([^,]+),([^h]+)h/);
            return [Number(x) + 4, Number(y) - 3];
        }"""
    )
    page.locator(".plot").first.hover(position={"x": x, "y": y})
    assert marked(page) == [1, 1]
    details = page.get_by_role("status").inner_text()
    for name in ("Target", "Run", "Deviation", "Model", "Residual", "Time", "Air temperature"):
        assert name in details


def test_a_reading_is_reached_by_the_keyboard_too(window: Window, file: Path) -> None:
    page = window(file.as_uri())
    page.locator(".plot").nth(1).focus()
    page.keyboard.press("End")
    assert marked(page) == [1, 1]
    assert "598.0345\u00a0mm" in page.get_by_role("status").inner_text()


def test_a_failure_points_at_its_readings_over_what_shows_them(window: Window, file: Path) -> None:
    page = window(file.as_uri())
    page.get_by_label("Residuals over", exact=True).select_option(label="Run")
    page.get_by_role("button", name="The means of the positions deviate").click()
    expect(page.get_by_label("Residuals over", exact=True)).to_have_value("position")
    assert marked(page) == [5, 5]


def test_nothing_is_loaded(window: Window, file: Path) -> None:
    page = window("about:blank")
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    page.goto(file.as_uri())
    expect(page.locator(".plot .mark").first).to_be_visible()
    assert [url for url in asked if not url.startswith("data:")] == [file.as_uri()]


def test_its_policy_lets_no_other_script_run(chromium: Browser, file: Path) -> None:
    foreign = file.with_name("changed.html")
    text = file.read_text(encoding="utf-8")
    foreign.write_text(text.replace("<main>", "<main><b onclick='document.title = 1'>x</b>"), "utf-8")
    page = chromium.new_page()
    page.goto(foreign.as_uri())
    before = page.title()
    page.locator("main > b").dispatch_event("click")
    assert page.title() == before
    page.close()


def test_without_script_it_is_the_document_that_is_printed(window: Window, file: Path) -> None:
    page = window(file.as_uri(), java_script_enabled=False)
    expect(page.locator("#linked")).to_be_hidden()
    expect(page.locator("#model figure").first).to_be_visible()


def test_nobody_is_left_out(window: Window, file: Path) -> None:
    page = window(file.as_uri())
    expect(page.locator(".plot .mark").first).to_be_visible()
    found = Axe().run(page, context="#linked")
    assert found.violations_count == 0, found.generate_report()


def test_on_paper_there_is_nothing_to_point_at(window: Window, file: Path) -> None:
    page = window(file.as_uri())
    page.emulate_media(media="print")
    expect(page.locator("#linked")).to_be_hidden()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1024, 1440])
def test_it_is_read_on_any_screen(window: Window, file: Path, width: int, scheme: str) -> None:
    page = window(file.as_uri(), viewport={"width": width, "height": 844}, color_scheme=scheme)
    expect(page.locator(".plot .mark").first).to_be_visible()
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    edges = page.locator(".stacks td").evaluate_all("all => all.map(e => e.getBoundingClientRect().right)")
    assert edges
    assert max(edges) <= width
    found = Axe().run(page)
    assert found.violations_count == 0, found.generate_report()


def test_at_400_percent_a_long_name_of_a_condition_makes_no_page_wider(window: Window, file: Path) -> None:
    page = window(file.as_uri(), viewport={"width": 320, "height": 844})
    expect(page.locator(".plot .mark").first).to_be_visible()
    page.locator(".linked option").first.evaluate("e => { e.textContent = 'Temperature of '.repeat(4) }")
    assert page.evaluate("document.documentElement.scrollWidth") == 320


def test_a_phone_shows_the_results_first(window: Window, file: Path) -> None:
    page = window(file.as_uri(), viewport={"width": 390, "height": 844})
    top = "e => e.getBoundingClientRect().top"
    results, facts = (page.locator(f".cover > {each}").first.evaluate(top) for each in (".wide", ".facts"))
    assert results < facts
    label = page.locator(".cover .stacks td").nth(1).evaluate("e => getComputedStyle(e, '::before').content")
    assert "Value (µm)" in label


def test_on_paper_it_is_paged_as_the_pdf_is(window: Window, file: Path) -> None:
    page = window(file.as_uri(), color_scheme="dark")
    printed = pypdfium2.PdfDocument(page.pdf(prefer_css_page_size=True))
    texts = [each.get_textpage().get_text_range() for each in printed]
    for number, text in enumerate(texts, 1):
        assert f"page {number} of {len(texts)}" in text
        assert "Measuring Report EXAMPLE-2026-" in text
    corner = printed[0].render(scale=0.2).to_numpy()[0, 0]
    assert tuple(corner[:3]) == (255, 255, 255), "a dark screen is no dark paper"


def test_a_section_stands_apart_from_what_is_before_it(window: Window, file: Path) -> None:
    page = window(file.as_uri())
    gap = "e => e.getBoundingClientRect().top - e.previousElementSibling.getBoundingClientRect().bottom"
    gaps = page.locator("section.new-page").evaluate_all(f"all => all.map({gap})")
    assert gaps
    assert min(gaps) > 12


def test_a_phone_parts_neither_the_number_nor_a_name(window: Window, file: Path) -> None:
    page = window(file.as_uri(), viewport={"width": 390, "height": 844})
    assert page.locator(".title .number").evaluate("e => e.getClientRects().length") == 1
    longest = page.locator(".facts th").first.evaluate(
        """e => {
            const canvas = document.createElement("canvas").getContext("2d")
            canvas.font = getComputedStyle(e).font
            return e.getBoundingClientRect().width / canvas.measureText("Ausstellungsdatum").width
        }"""
    )
    assert longest > 1


def test_a_phone_parts_no_symbol_of_a_definition(window: Window, file: Path) -> None:
    page = window(file.as_uri(), viewport={"width": 390, "height": 844})
    lines = page.locator(".formulas th").evaluate_all(
        """all => all.map(e => {
            const range = document.createRange()
            range.selectNodeContents(e)
            return range.getBoundingClientRect().height / parseFloat(getComputedStyle(e).fontSize)
        })"""
    )
    assert lines
    assert max(lines) < 2


def test_numbers_have_units_and_digits_as_on_paper(window: Window) -> None:
    module = (files("zlmreport_templates") / "workbench" / "number.js").read_bytes()
    numbers = [("4.2 ± 0.3", "″"), ("20", "″"), ("20", "µm"), ("30", "°"), ("2000", "°/min"), ("1", "″/min")]
    said = window("about:blank").evaluate(
        """async ([address, numbers]) => {
            document.documentElement.lang = "de";
            const { ALL_DIGITS, shortened, withUnit, written } = await import(address);
            const few = [12.3456, 0.12345, -0.00123456, 1e-12].map((each) => written(shortened(each)));
            return [written(2543.175, ALL_DIGITS), ...few, ...numbers.map((each) => withUnit(...each))];
        }""",
        [f"data:text/javascript;base64,{b64encode(module).decode()}", numbers],
    )
    deviations = ["12,35", "0,123", "−0,00123", "0"]
    assert said == ["2543,175", *deviations, *(with_unit(*each) for each in numbers)]
