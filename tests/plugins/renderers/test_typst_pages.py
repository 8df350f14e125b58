"""Pages by Typst: what goes on over pages, what stays together, and what is too wide or too long."""

from __future__ import annotations

from dataclasses import replace

import pytest
from pypdf import PdfReader

from plugins.renderers.pdf_pages import page_of, read, texts, with_blocks
from zlmreport.plugin.page import FontFace, text_advance
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

_POINTS = 72 / 25.4


def _ends(reader: PdfReader) -> float:
    """The rightmost place at which a stretch of text ends, in points."""
    places = []

    def visit(text: str, _cm: object, matrix: list[float], _font: object, size: float) -> None:
        widest = max(text_advance(line, FontFace.REGULAR) for line in text.strip().split("\n"))
        places.append(matrix[4] + abs(matrix[0]) * size * widest)

    for page in reader.pages:
        page.extract_text(visitor_text=visit)
    return max(places)


def test_a_row_longer_than_a_page_is_all_printed() -> None:
    rows = (("begin " + "words that go on " * 600 + "end", "1"),)
    table = Table("a row", (Column("text"), Column("n", align=Align.RIGHT)), (RowGroup(rows),))
    text = "".join(texts(read(with_blocks(Section("rows", "Rows", (table,))), "pdf-typst")))
    assert text.count("words that go on") + text.count("words that go\non") > 400
    assert "end" in text


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
    reader = read(certificate, "pdf-typst")
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
    reader = read(with_blocks(Section("near", "Near", (table,)), far), "pdf-typst")
    assert "first group Page 2" in texts(reader)[0].replace("\n", " ")
    (link,) = [each.get_object() for page in reader.pages for each in page.get("/Annots", [])]
    target = reader.named_destinations[link["/Dest"]]
    assert reader.get_destination_page_number(target) == 1


@pytest.mark.parametrize("rows_before", [1, 3])
@pytest.mark.parametrize("rows_of_last", [1, 2])
def test_a_small_last_group_of_a_table_does_not_stand_alone_on_a_page(
    rows_before: int, rows_of_last: int
) -> None:
    sizes = [*(1,) * 19, rows_before, rows_of_last]  # the last one began a page
    groups = tuple(
        RowGroup(tuple((f"group{place}row{number}", "1") for number in range(size)), f"group{place}:")
        for place, size in enumerate(sizes)
    )
    table = Table("groups", (Column("text"), Column("n", align=Align.RIGHT)), groups)
    reader = read(with_blocks(Section("groups", "Groups", (table,), new_page=True)), "pdf-typst")
    together = ("group20:", "group20row0", f"group19row{rows_before - 1}")
    assert len({page_of(reader, each) for each in together}) == 1
    assert page_of(reader, "group0:") < page_of(reader, "group20:")
