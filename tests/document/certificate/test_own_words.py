"""The look of a document, the order of its sections, and texts of one's own."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pypdfium2
import pytest

from document.certificate.documents import COMPLETE, certificate, job
from installed import registry
from refusals import refusal
from zlmreport import pipeline
from zlmreport.plugin.renderer import Notice
from zlmreport.verification.verify import verify

LEAST = ["results", "uncertainty", "conditions"]


def having(**keys: Any) -> Mapping[str, Any]:
    return {**COMPLETE, "certificate": {**COMPLETE["certificate"], **keys}}


@pytest.mark.parametrize("layout", ["standard", "full"])
def test_sections_stand_in_the_order_of_the_job_with_its_texts(tmp_path: Path, layout: str) -> None:
    note = {"title": "On {certificate.number}", "text": "For {customer.name}.\nSecond paragraph."}
    made = certificate(tmp_path, having(layout=layout, sections=["origin", note, *LEAST]))
    keys = [each.key for each in made.sections if each.key != "conditions"]
    assert keys == ["origin", "text-2", "iso230-2-2014", "uncertainty"]
    assert made.sections[1].title == "On CAL-1"
    said = Notice("The laboratory's own words", ("For A Customer.", "Second paragraph."), is_quoted=True)
    assert made.sections[1].blocks == (said,)


def test_a_placeholder_is_looked_up_and_nothing_is_executed(tmp_path: Path) -> None:
    harmless = "{0} {} {certificate} {{customer.name}} %s ${x}"
    made = certificate(tmp_path, having(style={"footer": harmless}))
    assert made.page_words.foot == harmless.replace("{customer.name}", "A Customer")
    for named in ("customer.nme", "customer.name.__class__", "certificate.__init__"):
        assert f"{{{named}}} stands for no value" in refusal(
            certificate, tmp_path, having(style={"header": f"{{{named}}}"})
        )


@pytest.mark.parametrize("written", ["{customer.name", "{ customer.name }", "{customer.name }"])
def test_a_placeholder_that_is_not_closed_or_has_blanks_is_refused(tmp_path: Path, written: str) -> None:
    told = refusal(certificate, tmp_path, having(style={"footer": f"Order 4711 · {written} · A"}))
    assert f"{written!r} stands for no value; write {{customer.name}}" in told


def test_a_long_number_stays_on_the_paper(tmp_path: Path) -> None:
    pdf = registry().renderer("pdf").render(certificate(tmp_path, having(number="N" * 100)))
    page = pypdfium2.PdfDocument(pdf)[0]
    text = page.get_textpage()
    assert max(text.get_charbox(each)[2] for each in range(text.count_chars())) < page.get_width() - 50


@pytest.mark.parametrize(("key", "takes"), [("header", 3), ("footer", 2)])
def test_a_text_that_has_no_room_in_a_margin_is_refused(tmp_path: Path, key: str, takes: int) -> None:
    assert certificate(tmp_path, having(style={key: "W" * 55 * takes}))
    told = refusal(certificate, tmp_path, having(style={key: "W" * 70 * takes}))
    assert f"certificate.style.{key}: a text of {70 * takes} characters takes" in told


def test_what_a_customer_is_called_is_no_placeholder(tmp_path: Path) -> None:
    customer = {**COMPLETE["customer"], "name": "{certificate.number} Ltd"}
    keys = {**having(style={"header": "{customer.name}"}), "customer": customer}
    assert certificate(tmp_path, keys).running_head == "{certificate.number} Ltd"


@pytest.mark.parametrize("name", ["uncertainty", "conditions"])
def test_a_certificate_cannot_leave_out_what_is_mandatory(tmp_path: Path, name: str) -> None:
    sections = [each for each in LEAST if each != name]
    assert f"add {name} to certificate.sections" in refusal(certificate, tmp_path, having(sections=sections))
    assert certificate(tmp_path, having(kind="report", sections=sections))


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"sections": ["uncertainty"]}, "a document has its results"),
        ({"sections": [*LEAST, "results"]}, "more than once: results"),
        ({"sections": LEAST, "layout": "sheet"}, "no sections"),
        ({"style": {"accent": "#ffcc00"}}, "its contrast is 1.5, and 4.5 is the least"),
        ({"style": {"accent": "red; }"}}, "is no colour"),
    ],
)
def test_what_cannot_be_printed_is_refused(tmp_path: Path, keys: Mapping[str, Any], message: str) -> None:
    assert message in refusal(certificate, tmp_path, having(**keys))


@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst", "html"])
def test_each_renderer_has_the_colour_and_the_lines(tmp_path: Path, renderer: str) -> None:
    style = {"accent": "#5c1a33", "logo": "left", "footer": "Order 4711"}
    made = registry().renderer(renderer).render(certificate(tmp_path, having(style=style)))
    if renderer == "html":
        assert b"#5c1a33" in made
        assert b"#0d4a63" not in made
        assert b'class="logo-left"' in made
        return
    document = pypdfium2.PdfDocument(made)
    for page in document:
        assert "Order 4711" in page.get_textpage().get_text_range()
    picture = document[0].render(scale=2).to_numpy().reshape(-1, 3)
    assert (abs(picture.astype(int) - (0x33, 0x1A, 0x5C)).max(axis=1) < 9).any(), "blue, green, red"


@pytest.mark.long
def test_a_certificate_of_a_look_and_an_order_of_its_own_holds(tmp_path: Path) -> None:
    sections = [*LEAST, {"title": "Note", "text": "For {customer.name}."}]
    keys = having(sections=sections, style={"accent": "#5c1a33", "header": "{machine.serial}"})
    (pdf, _) = pipeline.run(job(tmp_path, keys), registry()).documents
    pdf.path.write_bytes(pdf.content)
    assert verify(pdf.path, registry()).holds
