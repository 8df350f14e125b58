"""The loop of the error model by clicks alone, in a browser as people use it."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import FloatRect, Page, expect

from browser.pictures import picture
from processes import ZLMREPORT, started

Window = Callable[..., Page]
pytestmark = [pytest.mark.early, pytest.mark.long]


def diagnosed(page: Page, verdict: str) -> None:
    """Wait until the diagnosis of the job as it is has come."""
    expect(page.locator("body")).to_have_attribute("data-state", verdict)


def find_plot(page: Page, number: int) -> FloatRect:
    """Return where a graph lies, once what stands above it is whole: what comes later would move it away."""
    expect(page.get_by_text("By the whole model")).to_be_visible()
    box = page.locator(".plot").nth(number).bounding_box()
    assert box
    return box


def plots(page: Page) -> list[int]:
    """Return how many readings are marked in each graph."""
    return [page.locator(".plot").nth(index).locator(".ring").count() for index in range(2)]


def test_the_hidden_effect_is_found_by_clicks_alone(address: str, job: Path, window: Window) -> None:
    page = window(address)
    diagnosed(page, "missing")
    expect(
        page.locator(".verdict").get_by_text("Missing effect: screw-pitch, which explains the rest.")
    ).to_be_visible()
    expect(page.locator(".wave .plot")).to_be_visible()
    assert page.locator(".wave .tick[text-anchor=end]").count() >= 3
    picture(page, "missing")

    page.get_by_role("button", name="The means of the positions deviate").click()
    assert plots(page) == [5, 5]
    page.get_by_label("over").select_option(label="Run")
    assert plots(page) == [5, 5]
    page.get_by_role("button", name="The residual repeats every 10.0 mm").click()
    expect(page.get_by_label("over")).to_have_value("position")

    page.get_by_role("link", name="screw-pitch").first.click()
    expect(page.get_by_role("heading", name="Equation")).to_be_visible()
    expect(page.locator(".plot .curve").first).to_be_visible()
    picture(page, "effect")
    page.get_by_role("link", name="Back to the workbench").click()

    page.get_by_role("button", name="Add screw-pitch to the model").click()
    diagnosed(page, "adequate")
    fall = page.locator("#part-fall tbody tr")
    assert fall.locator("th").all_inner_texts() == [
        "without model",
        "+ offset",
        "+ scale-error",
        "+ backlash",
        "+ screw-pitch",
        "noise floor",
    ]
    errors = [float(each) for each in fall.locator("td:nth-child(3)").all_inner_texts()]
    assert errors == sorted(errors, reverse=True)
    assert errors[-2] < 1.2 * errors[-1]
    picture(page, "adequate")
    assert "    - screw-pitch\n" in job.read_text(encoding="utf-8")

    page.get_by_role("button", name="Make the certificate").click()
    with page.expect_download() as download:
        page.get_by_role("link", name="EXAMPLE-2026-0007.pdf").click()
    assert Path(download.value.path()).read_bytes().startswith(b"%PDF")

    page.reload()
    diagnosed(page, "adequate")
    page.get_by_role("button", name="Undo: screw-pitch added").click()
    diagnosed(page, "missing")
    assert "screw-pitch" not in job.read_text(encoding="utf-8").partition("model:")[2]


def test_from_a_job_without_pitch_to_table_and_certificate_by_clicks_alone(
    address: str, job: Path, window: Window
) -> None:
    text = job.read_text(encoding="utf-8")
    job.write_text(text.replace(", screw_pitch: 10", ""), encoding="utf-8")
    page = window(address, viewport={"width": 1440, "height": 900})
    diagnosed(page, "missing")
    expect(page.locator("#part-verdict")).to_contain_text("the job states no axis.screw_pitch")
    picture(page, "asks")
    page.get_by_label("Screw pitch").fill("10")
    page.get_by_label("Screw pitch").press("Enter")
    expect(page.locator("#part-verdict")).not_to_contain_text("states no axis.screw_pitch")
    diagnosed(page, "missing")
    page.get_by_role("button", name="Add screw-pitch to the model").click()
    diagnosed(page, "adequate")
    page.get_by_role("button", name="None was active").click()
    page.get_by_label("Control", exact=True).select_option("csv")
    page.get_by_role("button", name="Write the table").click()
    expect(page.get_by_role("link", name="EXAMPLE-2026-0007-compensation.csv")).to_be_visible()
    expect(page.get_by_label("Control", exact=True)).to_have_value("csv")
    page.get_by_role("button", name="Make the certificate").click()
    expect(page.locator("#part-preview img")).to_have_js_property("complete", value=True)
    assert page.locator("#part-preview img").evaluate("picture => picture.naturalWidth") > 500
    expect(page.get_by_text("Sheet: page 1 of 1")).to_be_visible()
    picture(page, "table")
    page.get_by_role("button", name="The next page").click()
    expect(page.get_by_text("Page 1 of")).to_be_visible()


def test_the_page_asks_for_the_pitch_that_nobody_stated(address: str, job: Path, window: Window) -> None:
    text = job.read_text(encoding="utf-8")
    job.write_text(text.replace(", screw_pitch: 10", ""), encoding="utf-8")
    page = window(address)
    diagnosed(page, "missing")
    expect(page.locator("#part-verdict")).to_contain_text(
        "pitch of the screw: 10.0 mm fits, the job states no axis.screw_pitch"
    )
    expect(page.get_by_text("I can test directional-pitch, drive-period")).to_be_visible()
    page.get_by_label("Screw pitch").fill("10")
    page.get_by_label("Screw pitch").press("Enter")
    expect(page.locator("#part-verdict")).not_to_contain_text("states no axis.screw_pitch")
    diagnosed(page, "missing")
    expect(page.locator(".candidates .likely")).to_contain_text("screw-pitch")
    assert job.read_text(encoding="utf-8") == text


def test_verdict_error_and_fall_are_in_sight_wherever_one_reads(address: str, window: Window) -> None:
    page = window(address, viewport={"width": 1440, "height": 900})
    diagnosed(page, "missing")
    for y in (0, 300):
        page.evaluate(f"scrollTo(0, {y})")
        for part in ("#part-verdict .numbers", "#part-fall tr.floor"):
            box = page.locator(part).bounding_box()
            assert box
            assert 0 <= box["y"] < box["y"] + box["height"] <= 900


def test_a_step_that_is_pointed_at_is_seen_before_and_after(address: str, window: Window) -> None:
    page = window(address)
    diagnosed(page, "missing")
    expect(page.locator(".ghost")).to_have_count(0)
    page.get_by_role("button", name="+ backlash").focus()
    expect(page.locator(".plot").first.locator(".curve.ghost")).to_have_count(2)
    expect(page.locator(".plot").nth(1).locator(".mark.ghost")).to_have_count(2)
    expect(page.get_by_text("after this step: backlash")).to_be_visible()
    page.get_by_role("button", name="+ backlash").blur()
    expect(page.locator(".ghost")).to_have_count(0)


def test_a_preview_that_was_not_to_be_had_is_asked_for_again(address: str, window: Window) -> None:
    page = window(address)
    diagnosed(page, "missing")
    page.route("**/api/step?*", lambda route: route.fulfill(status=404, body="not now"))
    with page.expect_response("**/api/step?*"):
        page.get_by_role("button", name="+ backlash").focus()
    page.get_by_role("button", name="+ backlash").blur()
    page.unroute("**/api/step?*")
    page.get_by_role("button", name="+ backlash").focus()
    expect(page.locator(".plot").first.locator(".curve.ghost")).to_have_count(2)


def test_a_click_that_went_wrong_keeps_none_after_it_from_being_done(address: str, window: Window) -> None:
    page = window(address)
    page.evaluate("addEventListener('unhandledrejection', (event) => event.preventDefault())")
    diagnosed(page, "missing")
    page.route(
        "**/api/change",
        lambda route: route.fulfill(json={**route.fetch().json(), "graphs": None}),
        times=1,
    )
    with page.expect_response("**/api/change"):
        page.get_by_role("button", name="Add screw-pitch to the model").click()
    with page.expect_response("**/api/change"):
        page.keyboard.press("Control+z")
    diagnosed(page, "missing")


def test_steps_are_taken_back_and_again_by_keys_with_the_diagnosis_at_once(
    address: str, job: Path, window: Window
) -> None:
    page = window(address)
    diagnosed(page, "missing")
    text = job.read_text(encoding="utf-8")
    page.get_by_role("button", name="Add screw-pitch to the model").click()
    diagnosed(page, "adequate")
    for keys, verdict in (("Control+z", "missing"), ("Control+y", "adequate")):
        with page.expect_response(lambda answer: "/api/diagnosis" in answer.url) as answered:
            page.keyboard.press(keys)
        assert "diagnosis" in answered.value.json()
        diagnosed(page, verdict)
        assert (job.read_text(encoding="utf-8") == text) == (verdict == "missing")


def test_the_deviation_is_rescaled_where_one_looks_closer(address: str, window: Window) -> None:
    page = window(address)
    diagnosed(page, "missing")
    plot = page.locator(".plot").first

    def scale() -> list[str]:
        return plot.locator("text.tick").all_text_contents()

    whole = scale()
    box = find_plot(page, 0)
    page.mouse.move(box["x"] + 100, box["y"] + 100)
    page.mouse.down()
    page.mouse.move(box["x"] + 250, box["y"] + 105)
    page.mouse.up()
    closer = scale()
    assert closer != whole
    heights = [float(each.replace("−", "-")) for each in closer if float(each.replace("−", "-")) < 50]
    assert max(heights) <= 6  # at the lower end of the axis nothing deviates more
    plot.focus()
    page.mouse.wheel(0, -200)
    assert scale() != closer
    page.get_by_role("button", name="Whole axis", exact=True).click()
    assert scale() == whole


def test_however_close_one_looks_no_two_marks_of_an_axis_are_written_alike(
    address: str, window: Window
) -> None:
    page = window(address)
    diagnosed(page, "missing")
    box = find_plot(page, 0)
    plot = page.locator(".plot").first
    plot.focus()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 100)
    for _ in range(60):
        page.mouse.wheel(0, -200)
    marks = plot.locator("text.tick[text-anchor=middle]").all_text_contents()
    assert len(set(marks)) == len(marks) > 2
    assert max(map(len, marks)) > len("300.000")


def test_what_is_seen_can_be_saved_and_read_as_a_table(address: str, window: Window) -> None:
    page = window(address)
    diagnosed(page, "missing")
    page.get_by_text("Save …").click()
    saved = {}
    for kind, index in (("PNG", 0), ("SVG", 1), ("CSV", 0)):
        with page.expect_download() as download:
            page.get_by_role("button", name=kind).nth(index).click()
        saved[download.value.suggested_filename] = Path(download.value.path()).read_bytes()
    assert saved["deviations.png"].startswith(b"\x89PNG")
    assert b"<svg" in saved["residuals.svg"]
    assert b"class=" not in saved["residuals.svg"]
    names, *rows = saved["readings.csv"].decode().splitlines()
    assert names.startswith("Position (mm),Time (min),")
    assert len(rows) == 210
    page.get_by_role("button", name="downwards ↓").click()
    page.get_by_text("The readings in sight as a table").click()
    expect(page.locator(".table tbody tr")).to_have_count(105)


def test_readings_in_a_box_are_set_aside_together(address: str, job: Path, window: Window) -> None:
    page = window(address)
    diagnosed(page, "missing")
    page.get_by_role("button", name="Choose readings").click()
    box = find_plot(page, 1)
    page.mouse.move(box["x"] + 52, box["y"] + 10)
    page.mouse.down()
    page.mouse.move(box["x"] + 80, box["y"] + box["height"] - 36)
    page.mouse.up()
    expect(page.get_by_text("10 readings chosen")).to_be_visible()
    page.get_by_label("Reason, as the certificate will state it").fill("Chips on the scale.")
    page.get_by_role("button", name="Set these readings aside").click()
    expect(page.get_by_role("button", name="Undo: reading set aside: 10 readings")).to_be_visible()
    assert job.read_text(encoding="utf-8").count("Chips on the scale.") == 10


def test_the_page_goes_on_by_itself_when_the_readings_are_back(
    address: str, job: Path, window: Window
) -> None:
    page = window(address)
    expect(page.locator(".plot .mark").first).to_be_visible()
    readings = job.with_name("x-axis.csv")
    readings.rename(readings.with_suffix(".away"))
    expect(page.get_by_role("alert")).to_contain_text("x-axis.csv")
    readings.with_suffix(".away").rename(readings)
    expect(page.get_by_role("alert")).to_contain_text("changed outside of this page")


def test_a_reading_is_found_set_aside_and_brought_back_with_the_keyboard(
    address: str, job: Path, window: Window
) -> None:
    page = window(address)
    expect(page.locator(".plot .mark").first).to_be_visible()
    page.locator(".plot").first.focus()
    page.keyboard.press("End")
    page.keyboard.press("ArrowLeft")
    assert plots(page) == [1, 1]
    page.keyboard.press("Enter")
    details = page.locator(".reading").inner_text()
    for name in ("Target", "Run", "Deviation", "Model", "Residual", "Time", "Air temperature"):
        assert name in details
    page.keyboard.press("Tab")
    page.get_by_label("Reason, as the certificate will state it").focus()
    page.keyboard.type("Air hose touched the reflector.")
    page.keyboard.press("Enter")
    expect(page.get_by_role("heading", name="Readings set aside")).to_be_visible()
    assert "Air hose touched the reflector." in job.read_text(encoding="utf-8")
    back = page.get_by_role("button", name=re.compile("^Bring back"))
    back.focus()
    page.keyboard.press("Enter")
    expect(page.get_by_role("heading", name="Readings set aside")).to_be_hidden()
    assert "excluded: []" in job.read_text(encoding="utf-8")


def test_a_parameter_is_fixed_at_a_value_and_freed(address: str, job: Path, window: Window) -> None:
    page = window(address)
    page.get_by_role("button", name="Fix backlash.lost_motion at this value").click()
    page.get_by_label("backlash.lost_motion (µm)").fill("-3.5")
    page.get_by_label("backlash.lost_motion (µm)").press("Tab")
    expect(page.locator("#part-steps li")).to_have_count(2)
    assert "- backlash: {lost_motion: -3.5}" in job.read_text(encoding="utf-8")
    page.get_by_role("button", name="Estimate backlash.lost_motion from the readings").click()
    expect(page.get_by_role("button", name="Fix backlash.lost_motion at this value")).to_be_visible()
    assert "    - backlash\n" in job.read_text(encoding="utf-8")


def test_a_window_sees_what_an_editor_and_another_window_did(address: str, job: Path, window: Window) -> None:
    first, second = window(address), window(address)
    for page in (first, second):
        expect(page.get_by_role("button", name="Remove backlash from the model")).to_be_visible()
    first.evaluate("() => { globalThis.setInterval = () => 0 }")
    first.get_by_role("button", name="Remove backlash from the model").click()
    expect(first.get_by_role("button", name="Remove backlash from the model")).to_be_hidden()
    expect(second.get_by_role("alert")).to_contain_text("changed outside of this page")
    expect(second.get_by_role("button", name="Remove backlash from the model")).to_be_hidden()

    job.write_text(
        job.read_text(encoding="utf-8").replace("    - offset\n", "    - ofset\n"), encoding="utf-8"
    )
    expect(second.get_by_role("alert")).to_contain_text("did you mean 'offset'?")
    job.write_text(
        job.read_text(encoding="utf-8").replace("    - ofset\n", "    - offset\n"), encoding="utf-8"
    )
    expect(second.get_by_role("alert")).to_contain_text("changed outside of this page")


def test_the_page_can_be_used_by_everybody(address: str, window: Window) -> None:
    found = []
    for scheme in ("light", "dark"):
        page = window(address, color_scheme=scheme, bypass_csp=True)  # the checker is a script of its own
        diagnosed(page, "missing")
        page.locator(".plot").first.focus()
        page.keyboard.press("Home")
        page.keyboard.press("Enter")
        found.append(Axe().run(page))
        page.get_by_role("link", name="screw-pitch").first.click()
        expect(page.get_by_role("heading", name="Equation")).to_be_visible()
        found.append(Axe().run(page))
    assert [each.generate_report() for each in found if each.violations_count] == []


def test_who_works_by_keys_keeps_the_place_and_is_told_the_verdict(address: str, window: Window) -> None:
    page = window(address)
    diagnosed(page, "missing")
    expect(page.locator("body > [role=status]")).to_have_text(
        "Missing effect: screw-pitch, which explains the rest."
    )
    page.get_by_role("button", name="Fix backlash.lost_motion at this value").press("Enter")
    expect(page.get_by_role("button", name="Estimate backlash.lost_motion from the readings")).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.get_by_role("button", name="Fix backlash.lost_motion at this value")).to_be_focused()
    diagnosed(page, "missing")
    page.get_by_role("button", name="Add screw-pitch to the model").press("Enter")
    diagnosed(page, "adequate")
    # The candidates are gone, and the button with them.
    expect(page.get_by_role("heading", name="Verdict")).to_be_focused()
    expect(page.locator("body > [role=status]")).to_contain_text("The model describes the readings")


def test_who_hears_the_page_is_told_which_table_it_is_and_what_is_chosen(
    address: str, window: Window
) -> None:
    page = window(address)
    diagnosed(page, "missing")
    heading = page.get_by_role("heading", level=1)
    assert heading.evaluate("e => e.textContent").startswith("EXAMPLE-2026-0007 Axis X")
    for name in ("How the error falls", "offset", "backlash"):
        expect(page.get_by_role("table", name=name, exact=True)).to_be_visible()
    expect(page.get_by_role("combobox", name="Residuals over")).to_be_visible()


@pytest.mark.parametrize("locale", ["de-DE", "fr-FR"])
def test_at_320_pixels_headings_of_columns_are_whole(address: str, window: Window, locale: str) -> None:
    """As a screen of 1280 pixels shows it at 400 %."""
    page = window(address, locale=locale, viewport={"width": 320, "height": 800})
    diagnosed(page, "missing")
    expect(page.locator(".fall tbody tr").first).to_be_visible()
    broken = page.locator(".fall thead button").evaluate_all(
        """all => all.flatMap(e => {
            const text = document.createTreeWalker(e, NodeFilter.SHOW_TEXT).nextNode();
            return [...text.data.matchAll(/\\S+/g)].filter(found => {
                const range = document.createRange();
                range.setStart(text, found.index);
                range.setEnd(text, found.index + found[0].length);
                return range.getClientRects().length > 1;
            }).map(found => found[0]);
        })"""
    )
    assert broken == []
    assert page.evaluate("document.documentElement.scrollWidth") == 320


def test_a_tablet_in_the_dark_shows_it_all_in_german(address: str, window: Window) -> None:
    page = window(
        address,
        viewport={"width": 820, "height": 1180},
        color_scheme="dark",
        locale="de-DE",
        has_touch=True,
    )
    diagnosed(page, "missing")
    expect(
        page.locator(".verdict").get_by_text(
            "Fehlender Einfluss: Periodischer Steigungsfehler der Spindel; er erklärt den Rest."
        )
    ).to_be_visible()
    assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth")
    controls = page.locator("button:visible, select:visible").all()
    heights = [box["height"] for each in controls if (box := each.bounding_box())]
    assert min(heights) >= 40
    picture(page, "tablet")
    page.get_by_role("combobox", name="Sprache").select_option("en")
    expect(page.get_by_role("heading", name="Where the model fails")).to_be_visible()
    page.get_by_role("combobox", name="Language").select_option("fr")
    remedy = page.locator(".candidate .tell strong").first
    expect(remedy).to_be_visible()
    assert remedy.inner_text().rstrip(" ").endswith("\N{NO-BREAK SPACE}:")
    unseen = page.locator("ul.hidden li").all_text_contents()
    assert any("\N{NO-BREAK SPACE}: " in each for each in unseen)
    assert [each for each in unseen if re.search(r"\S[:;] ", each)] == []


def test_what_a_certificate_lacks_is_filled_in_on_the_page(address: str, job: Path, window: Window) -> None:
    text = job.read_text(encoding="utf-8").replace("kind: report", "kind: certificate")
    kept = [each for each in text.splitlines() if not each.startswith(("customer:", "machine:"))]
    job.write_text("\n".join(kept), encoding="utf-8")
    page = window(address)
    form = page.locator("form.lacking")
    form.get_by_label("Customer", exact=True).fill("Example Customer: Ltd")
    form.get_by_label("Place of the work").select_option(label="at the laboratory")
    form.get_by_label("Date of issue").fill("2026-11-20")
    row = form.locator("dl > div", has_text="Temperature measurement, measuring device")
    row.get_by_label("or negligible because").fill("laser, no length of its own")
    form.get_by_role("button", name="Save into the job").click()
    expect(form.get_by_label("Customer", exact=True)).to_have_count(0)
    expect(form.get_by_label("Its serial number")).to_be_visible()
    written = job.read_text(encoding="utf-8")
    assert 'customer: {name: "Example Customer: Ltd"}' in written
    assert 'uncertainty: {negligible: {device_temperature: "laser, no length of its own"}}' in written


@pytest.mark.parametrize("locale", ["en-GB", "de-DE", "fr-FR", "it-IT", "es-ES"])
def test_nothing_is_cut_on_any_screen(address: str, window: Window, locale: str) -> None:
    page = window(address, locale=locale)
    diagnosed(page, "missing")
    expect(page.locator(".standard tbody tr").first).to_be_visible()
    for width in (375, 768, 1024, 1440, 2560):
        page.set_viewport_size({"width": width, "height": 900})
        cut = page.locator("body, main *:not(select, .unseen, .plot *)").evaluate_all(
            """all => all.filter(e => e.checkVisibility() && e.clientWidth)
                .filter(e => e.scrollWidth > e.clientWidth + 1).map(e => e.outerHTML)"""
        )
        assert cut == [], width


def test_the_pages_of_a_certificate_come_into_view_and_nothing_lies_over_them(
    address: str, window: Window
) -> None:
    page = window(address)
    page.get_by_label("pdf-typst").check()
    page.get_by_role("button", name="Make the certificate").click()
    picture_of_page = page.locator("#part-preview img")
    expect(picture_of_page).to_have_js_property("complete", value=True)
    expect(page.get_by_role("link", name="EXAMPLE-2026-0007-pdf-typst.pdf")).to_be_visible()
    box = picture_of_page.bounding_box()
    assert box
    assert 0 <= box["y"] < box["y"] + box["height"] <= 900
    places = [
        (box["x"] + x * box["width"], box["y"] + y * box["height"]) for x in (0.1, 0.9) for y in (0.1, 0.9)
    ]
    on_top = [
        page.evaluate("([x, y]) => document.elementFromPoint(x, y).className", place) for place in places
    ]
    assert on_top == ["page"] * 4


def test_nothing_moves_when_one_points_and_every_control_is_large_enough(
    address: str, window: Window
) -> None:
    page = window(address)
    diagnosed(page, "missing")
    expect(page.locator(".standard tbody tr").first).to_be_visible()
    expect(page.locator(".candidates .wave .curve").first).to_be_visible()

    def places() -> list[Any]:
        found = (
            page.locator(each).first.bounding_box()
            for each in ("#part-effects", "#part-compensation", ".table")
        )
        return [each and each["y"] for each in found]

    still, seen = places(), []
    box = page.locator(".plot").first.bounding_box()
    assert box
    for step in range(10):
        page.mouse.move(box["x"] + 60 + 60 * step, box["y"] + 60 + 10 * step)
        seen.append(places())
    page.get_by_role("button", name="+ backlash").hover()
    expect(page.locator(".curve.ghost").first).to_be_visible()
    assert [*seen, places()] == [still] * 11
    small = page.locator(
        "button:visible, select:visible, summary:visible, a:visible, label:has(input):visible"
    )
    sizes = [(box["width"], box["height"]) for each in small.all() if (box := each.bounding_box())]
    assert min(map(min, sizes)) >= 24
    standards = page.locator(".standard").first.bounding_box()
    assert standards
    assert standards["y"] + standards["height"] < 450


def test_words_of_german_are_whole_and_titles_of_a_graph_do_not_meet(address: str, window: Window) -> None:
    page = window(address, locale="de-DE", viewport={"width": 1000, "height": 900})
    expect(page.locator(".candidates .wave .curve").first).to_be_visible()
    lines = """e => {
        const text = document.createTreeWalker(e, NodeFilter.SHOW_TEXT).nextNode();
        const range = document.createRange();
        range.setStart(text, text.data.indexOf("Umkehrspanne"));
        range.setEnd(text, text.data.length);
        return range.getClientRects().length;
    }"""
    assert page.get_by_role("button", name="+ Umkehrspanne").evaluate(lines) == 1
    for graph in page.locator(".plot").all():
        x, y = (title.bounding_box() for title in graph.locator(".title").all())
        assert x
        assert y
        assert x["x"] > y["x"] + y["width"] or x["y"] + x["height"] <= y["y"]


def test_a_model_is_built_step_by_step_and_a_step_taken_back(address: str, job: Path, window: Window) -> None:
    page = window(address)
    page.get_by_role("button", name="Build the model").click()
    page.get_by_role("button", name="Take this step: + screw-pitch").click()
    diagnosed(page, "adequate")
    assert "    - screw-pitch\n" in job.read_text(encoding="utf-8")
    page.get_by_role("button", name="One step back").click()
    diagnosed(page, "missing")
    assert "    - screw-pitch\n" not in job.read_text(encoding="utf-8")


def test_numbers_of_many_digits_are_not_cut_where_a_page_is_narrow(
    tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch, window: Window
) -> None:
    """Readings in another unit than the job says have such ones, and this is seen in the graph."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))
    rows = [(t, s, r) for r in (1, 2) for s in (1, -1) for t in (0, 20000, 40000, 60000)[::s]]
    readings = "\n".join(f"{t},{s:+d},{r},{200 * t + 10 * r - 3 * s}" for t, s, r in rows)
    (tmp_path / "x.csv").write_text(f"target,direction,run,deviation\n{readings}\n", encoding="utf-8")
    job = tmp_path / "long.yaml"
    job.write_text(
        "schema: zlmreport/job/1\ncertificate: {number: LONG-1, kind: report}\naxis: {name: X}\n"
        "measurement: {source: {plugin: laser-csv, file: x.csv}}\nevaluate: [nmtba]\n"
        "model: {effects: [offset]}\n",
        encoding="utf-8",
    )
    with started(*ZLMREPORT, "workbench", job, "--no-browser") as workbench:
        page = window(workbench.lines(1)[0].split()[-1], viewport={"width": 360, "height": 800})
        marks = page.locator(".plot").first.locator(".tick[text-anchor=end]")
        expect(marks.filter(has_text="10000000")).to_have_count(1)
        assert min(marks.evaluate_all("all => all.map((each) => each.getBBox().x)")) >= 0
        page.close()
        workbench.ended()
