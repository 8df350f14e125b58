"""How a certificate lies on pages."""

from __future__ import annotations

from dataclasses import replace

from pypdfium2 import PdfDocument

from document.typesetting import samples
from installed import registry
from plugins.renderers.pdf_pages import page_of, read, texts, with_blocks
from zlmreport.plugin.renderer import Align, Column, Paragraph, RowGroup, Section, Table

POINT = 25.4 / 72


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
    letterhead = replace(head, laboratory=laboratory)
    document = samples.certificate(standards=0, sections=(section,), letterhead=letterhead)

    page = PdfDocument(registry().renderer("pdf").render(document))[1]

    text = page.get_textpage()
    top = max(text.get_charbox(number)[3] for number in range(text.count_chars()))
    assert (page.get_height() - top) * POINT > 8


def test_a_report_without_a_laboratory_is_printed() -> None:
    assert "CAL-2026-0117" in texts(read(samples.certificate(standards=0, letterhead=None)))[-1]


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
