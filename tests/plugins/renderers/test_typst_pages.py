"""Pages by Typst: what goes on over pages, what stays together, and what is too wide or too long."""

from __future__ import annotations

from dataclasses import replace

import pytest
from pypdf import PdfReader

from document.typesetting import samples
from plugins.renderers.pdf_pages import page_of, texts
from plugins.renderers.typst_pages import read, sample
from zlmreport.plugin import Language
from zlmreport.plugin.page import FontFace, text_advance
from zlmreport.plugin.renderer import (
    Align,
    Certificate,
    Column,
    Facts,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Table,
)

_POINTS = 72 / 25.4
_PAPERS = {"A4": (210.0, 297.0), "Letter": (215.9, 279.4)}


def with_blocks(*sections: Section) -> Certificate:
    return replace(samples.certificate(standards=0), cover=(), sections=sections)


def _ends(reader: PdfReader) -> float:
    """The rightmost place at which a stretch of text ends, in points."""
    places = []

    def visit(text: str, _cm: object, matrix: list[float], _font: object, size: float) -> None:
        widest = max(text_advance(line, FontFace.REGULAR) for line in text.strip().split("\n"))
        places.append(matrix[4] + abs(matrix[0]) * size * widest)

    for page in reader.pages:
        page.extract_text(visitor_text=visit)
    return max(places)


@pytest.mark.parametrize("paper", _PAPERS)
def test_pages_have_the_size_that_is_asked_for(paper: str) -> None:
    width, height = _PAPERS[paper]
    for page in sample(paper=paper).pages:
        assert float(page.mediabox.width) == pytest.approx(width * _POINTS, abs=0.1)
        assert float(page.mediabox.height) == pytest.approx(height * _POINTS, abs=0.1)


@pytest.mark.parametrize(
    ("language", "page_of_pages"), [(Language.ENGLISH, "Page {} of {}"), (Language.GERMAN, "Seite {} von {}")]
)
def test_each_page_has_the_number_of_the_certificate_and_its_own(
    language: Language, page_of_pages: str
) -> None:
    pages = texts(sample(language))
    assert len(pages) > 3
    for count, text in enumerate(pages, start=1):
        assert samples.NUMBER in text
        assert page_of_pages.format(count, len(pages)) in text


def test_the_end_is_marked_once_on_the_last_page() -> None:
    assert page_of(sample(), "End of the calibration certificate") == len(sample().pages)


def test_a_row_is_never_split() -> None:
    rows = tuple((f"begin{n:02d} " + "words that go on " * 20 + f"end{n:02d}", str(n)) for n in range(40))
    table = Table("long rows", (Column("text"), Column("n", align=Align.RIGHT)), (RowGroup(rows),))
    reader = read(with_blocks(Section("rows", "Rows", (table,))))
    assert len(reader.pages) > 2
    for n in range(40):
        assert page_of(reader, f"begin{n:02d}") == page_of(reader, f"end{n:02d}")


def test_a_row_longer_than_a_page_is_all_printed() -> None:
    rows = (("begin " + "words that go on " * 600 + "end", "1"),)
    table = Table("a row", (Column("text"), Column("n", align=Align.RIGHT)), (RowGroup(rows),))
    text = "".join(texts(read(with_blocks(Section("rows", "Rows", (table,))))))
    assert text.count("words that go on") + text.count("words that go\non") > 400
    assert "end" in text


@pytest.mark.parametrize("rows_in_all", range(46, 62))
def test_the_last_rows_do_not_stand_alone_on_a_page(rows_in_all: int) -> None:
    rows = tuple((f"row{n:03d}", "1.0") for n in range(1, rows_in_all + 1))
    table = Table("numbers", (Column("text"), Column("x", align=Align.RIGHT)), (RowGroup(rows),), dense=True)
    reader = read(with_blocks(Section("numbers", "Numbers", (table,), new_page=True)))
    assert page_of(reader, f"row{rows_in_all - 2:03d}") == page_of(reader, f"row{rows_in_all:03d}")


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


@pytest.mark.parametrize("lines", range(11, 21, 3))
def test_a_title_stays_with_what_follows(lines: int) -> None:
    filler = tuple(Paragraph(f"line {n:02d}") for n in range(2 * lines))
    rows = RowGroup(tuple((f"row {n:02d}",) for n in range(30)))
    table = Table("a caption", (Column("heading"),), (rows,))
    reader = read(with_blocks(Section("a", "Filler", filler), Section("b", "A title", (table,))))
    begins, *goes_on = (number for number, page in enumerate(texts(reader), 1) if "A title" in page)
    assert {page_of(reader, text) for text in ("a caption", "row 00")} == {begins}
    assert goes_on == list(range(begins + 1, len(reader.pages) + 1)), "the head names what goes on"


@pytest.mark.parametrize("word", ["0ff1ce" * 40, "Positioniergenauigkeitsmessunsicherheitsbilanz"])
def test_a_word_wider_than_its_place_is_parted_and_stays_inside(word: str) -> None:
    blocks = (
        Paragraph(word),
        Facts(((word, word), ("name", word))),
        Facts(((word, word),), "one"),
        Facts(((word, word),), "two"),
        Notice(word, (word,)),
        Table(
            word,
            (Column(word), Column("text"), Column("other")),
            (RowGroup(((word, word, "x"),), word, word),),
        ),
    )
    certificate = replace(
        with_blocks(Section("words", word, blocks)), title=word, subtitle=word, number=word[:100]
    )
    reader = read(certificate)
    assert _ends(reader) < (210 - 20) * _POINTS
    assert "".join("".join(texts(reader)).split()).replace("\u00ad", "").replace("-", "").count(word) >= 10


def test_a_group_leads_to_its_section_and_names_its_page() -> None:
    rows = (("a", "1"), ("b", "2"))
    table = Table(
        "caption",
        (Column("name"), Column("value", "mm", Align.RIGHT)),
        (RowGroup(rows, "first group", "", "far"),),
    )
    far = Section("far", "Far away", (Paragraph("far"),), new_page=True)
    reader = read(with_blocks(Section("near", "Near", (table,)), far))
    assert "first group Page 2" in texts(reader)[0].replace("\n", " ")
    (link,) = [each.get_object() for page in reader.pages for each in page.get("/Annots", [])]
    target = reader.named_destinations[link["/Dest"]]
    assert reader.get_destination_page_number(target) == 1
