"""What holds of the pages of a certificate, whichever renderer prints them."""

from __future__ import annotations

from dataclasses import replace

import pytest
from pypdfium2 import PdfDocument
from pypdfium2.raw import FPDF_PAGEOBJ_IMAGE

from document.typesetting import samples
from installed import registry
from plugins.renderers.pdf_pages import (
    numbers_of,
    page_of,
    printed_numbers,
    read,
    sample,
    texts,
    unspaced,
    with_blocks,
)
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import (
    Align,
    Column,
    Facts,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Table,
)

_PAPERS = {"A4": (210.0, 297.0), "Letter": (215.9, 279.4)}
_POINT = 25.4 / 72
_TEXT_AND_NUMBER = (Column("text"), Column("n", align=Align.RIGHT))


@pytest.mark.parametrize("paper", _PAPERS)
def test_pages_are_of_the_size_asked_for(press: str, paper: str) -> None:
    for page in sample(paper=paper, press=press).pages:
        size = float(page.mediabox.width) * _POINT, float(page.mediabox.height) * _POINT
        assert size == pytest.approx(_PAPERS[paper], abs=0.03)


@pytest.mark.parametrize(
    ("language", "number", "page_of_pages"),
    [
        (Language.ENGLISH, "Calibration certificate CAL-2026-0117", "Page {} of {}"),
        (Language.GERMAN, "Kalibrierschein CAL-2026-0117", "Seite {} von {}"),
    ],
)
def test_every_page_has_the_number_and_its_place(
    press: str, language: Language, number: str, page_of_pages: str
) -> None:
    pages = texts(sample(language, press=press))
    assert len(pages) > 3
    for count, text in enumerate(pages, start=1):
        assert number in text
        assert page_of_pages.format(count, len(pages)) in text


def test_the_end_is_marked_once_on_the_last_page(press: str) -> None:
    reader = sample(press=press)
    assert page_of(reader, "End of the calibration certificate") == len(reader.pages)


def test_a_row_is_never_split(press: str) -> None:
    rows = tuple((f"begin{n:02d} " + "words that go on " * 30 + f"end{n:02d}", str(n)) for n in range(40))
    table = Table("rows of several lines", _TEXT_AND_NUMBER, (RowGroup(rows),))
    reader = read(with_blocks(Section("rows", "Rows", (table,))), press)
    assert len(reader.pages) > 2
    for n in range(40):
        assert page_of(reader, f"begin{n:02d}") == page_of(reader, f"end{n:02d}")


@pytest.mark.parametrize("lines", range(0, 8, 2))
def test_the_heading_of_a_group_stays_with_its_rows(press: str, lines: int) -> None:
    filler = tuple(Paragraph(f"line {n}") for n in range(lines))
    groups = tuple(
        RowGroup(((f"row{n:02d}a", "1"), (f"row{n:02d}b", "2")), f"group{n:02d}", "what it means")
        for n in range(20)
    )
    table = Table("groups", _TEXT_AND_NUMBER, groups)
    reader = read(with_blocks(Section("groups", "Groups", (*filler, table))), press)
    assert len(reader.pages) > 1
    for n in range(20):
        assert page_of(reader, f"group{n:02d}") == page_of(reader, f"row{n:02d}a")


@pytest.mark.parametrize(
    ("press", "rows_in_all"),
    [*(("pdf", n) for n in (51, 52, 56, 57)), *(("pdf-typst", n) for n in range(46, 62))],
)
def test_the_last_rows_do_not_stand_alone_on_a_page(press: str, rows_in_all: int) -> None:
    rows = tuple((f"row{n:03d}", "1.0") for n in range(1, rows_in_all + 1))
    table = Table("numbers", _TEXT_AND_NUMBER, (RowGroup(rows),), dense=True)
    reader = read(with_blocks(Section("numbers", "Numbers", (table,), new_page=True)), press)
    assert page_of(reader, f"row{rows_in_all - 2:03d}") == page_of(reader, f"row{rows_in_all:03d}")


@pytest.mark.parametrize("lines", range(22, 42, 3))
def test_a_title_stays_with_what_follows(press: str, lines: int) -> None:
    filler = tuple(Paragraph(f"line {n:02d}") for n in range(lines))
    rows = RowGroup(tuple((f"row {n:02d}",) for n in range(30)))
    table = Table("a caption", (Column("heading"),), (rows,))
    reader = read(with_blocks(Section("a", "Filler", filler), Section("b", "A title", (table,))), press)
    begins, *goes_on = (number for number, page in enumerate(texts(reader), 1) if "A title" in page)
    assert {page_of(reader, text) for text in ("a caption", "row 00", "row 01")} == {begins}
    assert goes_on == list(range(begins + 1, len(reader.pages) + 1)), "the head names what goes on"


def test_following_pages_name_the_laboratory_and_the_subject(press: str) -> None:
    for text in texts(sample(press=press))[1:]:
        assert "Laboratory for Machine Metrology" in text
        assert "Positioning of the X axis" in text


def test_a_table_over_several_pages_repeats_its_headings(press: str) -> None:
    many = samples.certificate(standards=0, readings=samples.measurements(targets=150))
    _, *pages = texts(read(many, press))
    assert len(pages) > 2
    for text in pages:
        assert text.count("xi1↑") == text.count("xi5↓") == 1


def test_a_caption_stays_with_its_graph(press: str) -> None:
    for text in texts(sample(press=press)):
        assert text.count("Figure ") == text.count("Target position in mm")


@pytest.mark.parametrize("groups", [1, 4])
def test_facts_of_any_length_are_all_printed(press: str, groups: int) -> None:
    facts = tuple(
        Facts(tuple((f"name{g}-{n:02d}", "value " * 80 + f"end{g}-{n:02d}") for n in range(12)), f"group {g}")
        for g in range(groups)
    )
    text = "".join(texts(read(with_blocks(Section("facts", "Facts", facts)), press)))
    for g in range(groups):
        for n in range(12):
            assert text.count(f"end{g}-{n:02d}") == 1


def test_a_notice_of_any_length_is_all_printed(press: str) -> None:
    notice = Notice("heading", tuple(f"item{n:03d} " + "words " * 40 for n in range(60)))
    text = "".join(texts(read(with_blocks(Section("notice", "Notice", (notice,))), press)))
    for n in range(60):
        assert text.count(f"item{n:03d}") == 1


@pytest.mark.parametrize("paper", _PAPERS)
@pytest.mark.parametrize("language", Language)
def test_every_number_of_every_table_is_printed(press: str, language: Language, paper: str) -> None:
    expected = numbers_of(samples.certificate(language, paper))
    assert expected.total() > 700
    assert not expected - printed_numbers("\n".join(texts(sample(language, paper, press=press))))


def test_rows_of_numbers_are_read_in_order(press: str) -> None:
    text = "\n".join(texts(sample(press=press)))
    assert "\n4 150.000 5 5 3.3 0.6 1.9 0.7 0.8 2.6 2.9 3.3\n" in text


def test_graphs_carry_their_words_as_text(press: str) -> None:
    text = "\n".join(texts(sample(Language.GERMAN, press=press)))
    assert text.count("Zielposition in mm") == 4
    assert text.count("Abweichung in µm") == 4


@pytest.mark.parametrize(
    "customer",
    [
        "<b>Müller & Söhne</b> <script>alert(1)</script>",
        '<img src="file:///etc/passwd">',
        '#read("/etc/passwd") #{ panic() }',
        "$x^2$ *bold* _italic_ `raw` @label <label> // = - + /",
        "\\u{41} \\# \"quoted\" 'quoted' -- --- ... ~",
        "{{ 7 * 7 }} {% raw %} &lt; &amp; &#65; -->]]></style>",
        "x̄ é ñ q̈",
        "Ελληνικά Русский Türkçe",
        "".join(chr(ord("a") + n % 26) for n in range(500)),
    ],
)
def test_a_customers_name_is_printed_as_it_is_typed_and_whole(press: str, customer: str) -> None:
    text = "".join(texts(read(samples.certificate(standards=0, customer=customer), press)))
    assert unspaced(customer) in unspaced(text)


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("size", [(2000, 100), (400, 300), (100, 2000)], ids=["wide", "usual", "tall"])
def test_a_logo_stands_at_its_margin_and_leaves_the_name_its_room(
    press: str, side: str, size: tuple[int, int]
) -> None:
    plain = samples.with_logo(size=size)
    certificate = replace(plain, look=replace(plain.look, logo=side))
    page = PdfDocument(registry().renderer(press).render(certificate))[0]
    (logo,) = page.get_objects(filter=[FPDF_PAGEOBJ_IMAGE])
    left, bottom, right, top = (each * _POINT for each in logo.get_bounds())
    at_margin = left if side == "left" else _PAPERS["A4"][0] - right
    assert at_margin == pytest.approx(20, abs=0.1)
    assert right - left <= 60.1
    assert top - bottom <= 17.1
    assert (right - left) / (top - bottom) == pytest.approx(size[0] / size[1], rel=0.01)
