"""How a certificate lies on pages."""

from __future__ import annotations

from dataclasses import replace

import pytest
from pypdfium2 import PdfDocument

from document.typesetting import samples
from installed import registry
from plugins.renderers.pdf_pages import page_of, read, sample, texts
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import Align, Certificate, Column, Paragraph, RowGroup, Section, Table

MILLIMETRES = {"A4": (210.0, 297.0), "Letter": (215.9, 279.4)}
POINT = 25.4 / 72


def with_blocks(*sections: Section) -> Certificate:
    return samples.certificate(standards=0, sections=sections)


@pytest.mark.parametrize("paper", MILLIMETRES)
def test_pages_are_of_the_size_asked_for(paper: str) -> None:
    for page in read(samples.certificate(standards=0, paper=paper)).pages:
        size = float(page.mediabox.width) * POINT, float(page.mediabox.height) * POINT
        assert size == pytest.approx(MILLIMETRES[paper], abs=0.01)


@pytest.mark.parametrize(
    ("language", "number", "page_of_pages"),
    [
        (Language.ENGLISH, "Calibration certificate CAL-2026-0117", "Page {} of {}"),
        (Language.GERMAN, "Kalibrierschein CAL-2026-0117", "Seite {} von {}"),
    ],
)
def test_every_page_has_the_number_and_its_place(language: Language, number: str, page_of_pages: str) -> None:
    pages = texts(sample(language))
    assert len(pages) > 3
    for count, text in enumerate(pages, start=1):
        assert number in text
        assert page_of_pages.format(count, len(pages)) in text


def test_the_longest_number_stands_whole_on_every_page() -> None:
    number = "N" * 100
    plain = samples.certificate(standards=0)
    long = replace(plain, number=number, page_words=replace(plain.page_words, number=number))
    for text in texts(read(long)):
        assert number in text.replace("\n", "")


def test_the_head_of_a_page_stands_within_its_margin_beside_a_laboratory_of_one_long_word() -> None:
    head = samples.certificate(standards=0).letterhead
    assert head is not None
    laboratory = replace(head.laboratory, name="Präzisionsmaschinenvermessungs" * 4)
    section = Section("item", "Item, method and conditions", (Paragraph("Text"),), new_page=True)
    document = replace(with_blocks(section), letterhead=replace(head, laboratory=laboratory))

    page = PdfDocument(registry().renderer("pdf").render(document))[1]

    text = page.get_textpage()
    top = max(text.get_charbox(number)[3] for number in range(text.count_chars()))
    assert (page.get_height() - top) * POINT > 8


def test_the_end_is_marked_once_on_the_last_page() -> None:
    reader = sample()
    assert page_of(reader, "End of the calibration certificate") == len(reader.pages)


def test_a_report_without_a_laboratory_is_printed() -> None:
    assert "CAL-2026-0117" in texts(read(samples.certificate(standards=0, letterhead=None)))[-1]


def test_a_row_is_never_split() -> None:
    rows = tuple((f"begin{n:02d} " + "words that go on " * 30 + f"end{n:02d}", str(n)) for n in range(30))
    table = Table(
        "rows of several lines", (Column("text"), Column("n", align=Align.RIGHT)), (RowGroup(rows),)
    )
    reader = read(with_blocks(Section("rows", "Rows", (table,))))
    assert len(reader.pages) > 2
    for n in range(30):
        assert page_of(reader, f"begin{n:02d}") == page_of(reader, f"end{n:02d}")


@pytest.mark.parametrize("lines", range(0, 8, 2))
def test_the_heading_of_a_group_stays_with_its_rows(lines: int) -> None:
    filler = tuple(Paragraph(f"line {n}") for n in range(lines))
    groups = tuple(
        RowGroup(((f"row{n:02d}a", "1"), (f"row{n:02d}b", "2")), f"group{n:02d}", "what it means")
        for n in range(20)
    )
    table = Table("groups", (Column("text"), Column("n", align=Align.RIGHT)), groups)
    reader = read(with_blocks(Section("groups", "Groups", (*filler, table))))
    assert len(reader.pages) > 1
    for n in range(20):
        assert page_of(reader, f"group{n:02d}") == page_of(reader, f"row{n:02d}a")


def test_pages_part_columns_of_numbers_between_the_fives() -> None:
    rows = tuple((f"row{n:03d}", "1.0") for n in range(1, 204))
    table = Table(
        "numbers",
        (Column("n", align=Align.RIGHT), Column("x", align=Align.RIGHT)),
        (RowGroup(rows),),
        dense=True,
    )
    reader = read(with_blocks(Section("numbers", "Numbers", (table,))))
    pages = [page_of(reader, f"row{n:03d}") for n in range(1, 204)]
    ends = [n for n in range(1, 203) if pages[n - 1] != pages[n]]
    assert len(ends) > 1
    assert all(end % 5 == 0 for end in ends)


@pytest.mark.parametrize("rows_in_all", [51, 52, 56, 57])
def test_the_last_rows_do_not_stand_alone_on_a_page(rows_in_all: int) -> None:
    rows = tuple((f"row{n:03d}", "1.0") for n in range(1, rows_in_all + 1))
    table = Table("numbers", (Column("text"), Column("x", align=Align.RIGHT)), (RowGroup(rows),), dense=True)
    reader = read(with_blocks(Section("numbers", "Numbers", (table,), new_page=True)))
    assert page_of(reader, f"row{rows_in_all - 2:03d}") == page_of(reader, f"row{rows_in_all:03d}")


@pytest.mark.parametrize("lines", range(12, 21, 2))
def test_a_title_stays_with_what_follows(lines: int) -> None:
    filler = tuple(Paragraph(f"line {n:02d}") for n in range(lines))
    rows = RowGroup(tuple((f"row {n:02d}",) for n in range(30)))
    table = Table("a caption", (Column("heading"),), (rows,))
    reader = read(with_blocks(Section("a", "Filler", filler), Section("b", "A title", (table,))))
    begins, *goes_on = (number for number, page in enumerate(texts(reader), 1) if "A title" in page)
    assert {page_of(reader, text) for text in ("a caption", "row 00", "row 01")} == {begins}
    assert goes_on == list(range(begins + 1, len(reader.pages) + 1)), "the head names what goes on"
