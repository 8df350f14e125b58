"""What holds of the pages of a certificate, whichever renderer prints them."""

from __future__ import annotations

from types import ModuleType

import pytest

from document.typesetting import samples
from plugins.renderers import pdf_pages, typst_pages
from plugins.renderers.pdf_pages import texts
from zlmreport.plugin.renderer import Facts, Notice, Section


@pytest.fixture(params=[pdf_pages, typst_pages], ids=["pdf", "pdf-typst"])
def press(request: pytest.FixtureRequest) -> ModuleType:
    """What prints a certificate and opens it."""
    module: ModuleType = request.param
    return module


def test_following_pages_name_the_laboratory_and_the_subject(press: ModuleType) -> None:
    for text in texts(press.sample())[1:]:
        assert "Laboratory for Machine Metrology" in text
        assert "Positioning of the X axis" in text


def test_a_table_over_several_pages_repeats_its_headings(press: ModuleType) -> None:
    _, *pages = texts(
        press.read(samples.certificate(standards=0, readings=samples.measurements(targets=150)))
    )
    assert len(pages) > 2
    for text in pages:
        assert text.count("xi1↑") == text.count("xi5↓") == 1


def test_a_caption_stays_with_its_graph(press: ModuleType) -> None:
    for text in texts(press.sample()):
        assert text.count("Figure ") == text.count("Target position in mm")


@pytest.mark.parametrize("groups", [1, 4])
def test_facts_of_any_length_are_all_printed(press: ModuleType, groups: int) -> None:
    facts = tuple(
        Facts(tuple((f"name{g}-{n:02d}", "value " * 80 + f"end{g}-{n:02d}") for n in range(12)), f"group {g}")
        for g in range(groups)
    )
    text = "".join(
        texts(press.read(samples.certificate(standards=0, sections=(Section("facts", "Facts", facts),))))
    )
    for g in range(groups):
        for n in range(12):
            assert text.count(f"end{g}-{n:02d}") == 1


def test_a_notice_of_any_length_is_all_printed(press: ModuleType) -> None:
    notice = Notice("heading", tuple(f"item{n:03d} " + "words " * 40 for n in range(60)))
    text = "".join(
        texts(
            press.read(samples.certificate(standards=0, sections=(Section("notice", "Notice", (notice,)),)))
        )
    )
    for n in range(60):
        assert text.count(f"item{n:03d}") == 1
