"""A certificate set as HTML that is XML as well."""

from __future__ import annotations

import re
from dataclasses import replace
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from document.typesetting.samples import NUMBER, certificate, measurements
from zlmreport.document.blocks import write_cell_text
from zlmreport.document.certificate.document import Party
from zlmreport.document.typesetting.templates import set_symbol
from zlmreport.plugin import Figure, Language, same_in_all_languages
from zlmreport.plugin.html import HtmlSetting, compose_html
from zlmreport.plugin.renderer import (
    Block,
    Certificate,
    Column,
    Facts,
    Graph,
    Letterhead,
    Mark,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
    Verdict,
)
from zlmreport.plugin.standard import Curve, Panel, Role

#: Texts that mean something to some reader of a page; here they mean themselves.
TEXTS = {
    "markup": "<b>bold</b> & <script>alert(1)</script>",
    "a picture from a file": '<img src="file:///etc/passwd"/>',
    "a template": "{{ 7 * 7 }} {% include 'x' %} {# gone #}",
    "a format": "%s {0} ${HOME} \\u0041",
    "an entity": "&lt; &nbsp; &#65; &xxe;",
    "quotes": "\"double\" 'single' `back`",
    "the end of a comment": "--> ]]> */ <!--",
    "right to left": "שלום \u202eabc\u202c עולם",
    "combining": "x̄ é ñ̃",
    "emoji": "🙂 👩‍🔬",
    "Chinese": "中文测试",
    "a style": "</style><style>body{display:none}",
    "500 characters": "Wolkenkratzerbaumaschine" * 20 + "x" * 20,
}


def tree(of_certificate: Certificate, setting: HtmlSetting | None = None) -> ET.Element:
    return ET.fromstring(compose_html(of_certificate, setting or HtmlSetting()))


def text(element: ET.Element | None) -> str:
    assert element is not None
    return "".join(element.itertext())


def structure(document: ET.Element) -> list[str]:
    """The elements in order, but for those that set the letters of a symbol or keep blocks on one page."""
    return [
        element.tag
        for element in document.iter()
        if element.tag not in {"i", "sub"} and (element.tag, element.get("class")) != ("div", "whole")
    ]


def with_everywhere(words: str) -> Certificate:
    """A certificate that has the same words in every place that can hold words."""
    table = Table(
        words,
        (Column(words, words), Column(Symbol(words))),
        (RowGroup(((words, Verdict(Mark.OPEN, words)), (Symbol(words), words)), words, words, "key"),),
    )
    blocks = (Paragraph(words), Facts(((words, words),), words), Notice(words, (words,)), table)
    plain = certificate(standards=0)
    return replace(
        plain,
        number=words,
        title=words,
        subtitle=words,
        letterhead=Letterhead(Party(words, (words,)), words),
        cover=blocks,
        sections=(Section("key", words, blocks),),
        page_words=replace(plain.page_words, number=words, page=words, of=words, end=words),
        description=words,
        keywords=(words,),
        generator=words,
    )


@pytest.mark.parametrize("words", TEXTS.values(), ids=TEXTS)
def test_text_is_data_wherever_it_stands(words: str) -> None:
    of_words = tree(with_everywhere(words))
    assert structure(of_words) == structure(tree(with_everywhere("harmless")))
    assert text(of_words.find(".//p[@class='subtitle']")) == words
    assert [text(item) for item in of_words.iter("li")] == [words, words]
    assert of_words.find("body").get("data-number") == words  # type: ignore[union-attr]


@pytest.mark.parametrize("character", ["\x00", "\x07", "\x1b", "\ud800", "\ufffe", "\x0b"])
def test_a_character_that_xml_cannot_hold_is_shown_as_replaced(character: str) -> None:
    set_text = tree(certificate(customer=f"before{character}after"))
    assert "before\N{REPLACEMENT CHARACTER}after" in text(set_text)


def test_the_heading_of_a_group_leads_to_its_section() -> None:
    link = tree(with_everywhere("words")).find(".//div[@class='cover']//a")
    assert link is not None
    assert (link.get("href"), text(link)) == ("#key", "words")


def test_metadata_tell_title_author_dates_and_program() -> None:
    document = tree(certificate())
    metadata = {element.get("name"): element.get("content") for element in document.iter("meta")}
    assert text(document.find("head/title")) == f"Calibration certificate {NUMBER}"
    assert metadata["author"] == "Laboratory for Machine Metrology"
    assert metadata["keywords"] == "positioning, SAMPLE 1:2026"
    assert metadata["generator"] == "zlmreport 0.1.0"
    assert metadata["dcterms.created"] == metadata["dcterms.modified"] == "2026-11-20"


def test_a_document_without_a_date_of_issue_has_no_date() -> None:
    names = [element.get("name") for element in tree(certificate(issued=None)).iter("meta")]
    assert not [name for name in names if name and name.startswith("dcterms")]


def test_a_report_without_a_laboratory_has_no_letterhead() -> None:
    document = tree(certificate(letterhead=None))
    assert document.find(".//header[@class='letterhead']") is None
    assert not [element for element in document.iter("meta") if element.get("name") == "author"]


def test_sections_are_numbered_and_can_be_linked_to() -> None:
    sections = list(tree(certificate()).iter("section"))
    assert [section.get("id") for section in sections] == [
        "conditions",
        "standard-1",
        "standard-2",
        "readings",
    ]
    assert [text(section.find("h2/span[@class='count']")) for section in sections] == ["1", "2", "3", "4"]


def test_sections_that_ask_for_a_new_page_get_one_and_what_ends_before_it_stays_together() -> None:
    sections = list(tree(certificate()).iter("section"))
    assert [section.get("class") for section in sections] == ["whole", "new-page", "new-page", None]


def test_headings_descend_without_a_gap() -> None:
    levels = [element.tag for element in tree(certificate()).iter() if element.tag in {"h1", "h2", "h3"}]
    assert levels == ["h1", "h2", "h2", "h2", "h2"]


@pytest.mark.parametrize(("language", "word"), [(Language.ENGLISH, "Figure"), (Language.GERMAN, "Bild")])
def test_figures_are_numbered_in_reading_order(language: Language, word: str) -> None:
    figures = list(tree(certificate(language)).iter("figure"))
    assert [text(figure.find("figcaption/span")) for figure in figures] == [
        f"{word} {n}" for n in (1, 2, 3, 4)
    ]


def test_tables_and_definitions_share_one_count() -> None:
    captions = tree(certificate()).iterfind(".//table/caption/span[@class='label']")
    assert [text(caption) for caption in captions] == [f"Table {n}" for n in range(1, 9)]


def test_each_graph_names_its_drawing_and_tells_what_it_shows() -> None:
    set_certificate = certificate()
    pictures = list(tree(set_certificate).iter("img"))
    assert [picture.get("src") for picture in pictures] == ["graph:0", "graph:1", "graph:2", "graph:3"]
    alternatives = [figure.alternative.in_language(Language.ENGLISH) for figure in set_certificate.figures]
    assert [picture.get("alt") for picture in pictures] == alternatives


def test_drawings_that_are_handed_over_stand_in_the_document() -> None:
    drawings = tuple(f'<svg id="drawing-{n}"/>' for n in range(4))
    document = tree(certificate(), HtmlSetting(drawings=drawings))
    assert [drawing.get("id") for drawing in document.iter("svg")] == [f"drawing-{n}" for n in range(4)]
    assert not list(document.iter("img"))


def test_every_cell_of_every_table_is_set() -> None:
    set_certificate = certificate(Language.GERMAN)
    tables = [
        block for section in set_certificate.sections for block in section.blocks if isinstance(block, Table)
    ]
    rows = [
        [text(cell) for cell in row]
        for sheet in tree(set_certificate).iterfind(".//table[@class]")
        if sheet.find("thead") is not None
        for row in sheet.iterfind("tbody/tr")
        if row.find("td") is not None
    ]
    cells = [
        [write_cell_text(cell) for cell in row]
        for table in tables
        for group in table.groups
        for row in group.rows
    ]
    assert rows == cells


@pytest.mark.parametrize(
    ("notation", "as_set"),
    [
        ("P_{i}", "<i>P</i><sub><i>i</i></sub>"),
        ("P_{s max}", "<i>P</i><sub>s max</sub>"),
        ("x̄_{i}↑ + 2s_{i}↑", "<i>x̄</i><sub><i>i</i></sub>↑ + 2<i>s</i><sub><i>i</i></sub>↑"),
        ("a < b", "<i>a</i> &lt; <i>b</i>"),
    ],
)
def test_symbols_are_set_in_italics_and_subscripts(notation: str, as_set: str) -> None:
    assert set_symbol(notation) == f'<span class="symbol">{as_set}</span>'


@pytest.mark.parametrize(
    ("mark", "shape"), [(Mark.MET, "met"), (Mark.NOT_MET, "not-met"), (Mark.OPEN, "open")]
)
def test_a_verdict_has_a_shape_and_a_word(mark: Mark, shape: str) -> None:
    table = Table("caption", (Column("Result"),), (RowGroup(((Verdict(mark, "word"),),)),))
    cell = tree(certificate(cover=(table,), standards=0)).find(".//td[@class]")
    assert cell is not None
    assert (cell.get("class"), text(cell)) == (f"verdict {shape}", "word")


def test_the_first_cell_of_a_row_heads_it_where_there_are_others() -> None:
    rows = RowGroup((("a", "1"), ("b", "2")))
    table = Table("caption", (Column("name"), Column("value")), (rows,))
    set_rows = tree(certificate(cover=(table,), standards=0)).findall(".//div[@class='cover']//tbody/tr")
    assert [[(cell.tag, cell.get("scope"), text(cell)) for cell in row] for row in set_rows] == [
        [("th", "row", "a"), ("td", None, "1")],
        [("th", "row", "b"), ("td", None, "2")],
    ]


def test_the_unit_stands_in_the_heading() -> None:
    table = tree(certificate(standards=1)).find(".//section[@id='standard-1']//table")
    assert table is not None
    units = [text(unit) for unit in table.iterfind("thead//span[@class='unit']")]
    assert units == ["µm", "µm"]


def test_numbers_without_decimals_stand_under_the_decimal_sign() -> None:
    table = tree(certificate(standards=1)).find(".//section[@id='standard-1']//table")
    assert table is not None
    limits = {text(row[3]): row[3].get("class") for row in table.iterfind("tbody/tr[td]")}
    assert limits == {"20.0": "right", "–": "right whole-1", "1.5": "right"}


def test_rows_stand_in_fives() -> None:
    (table,) = tree(certificate(standards=0)).iterfind(".//section[@id='readings']//table")
    places = [row.get("class") for row in table.iterfind("tbody/tr")]
    assert [n for n, place in enumerate(places, start=1) if place == "fifth"] == [5, 10, 15, 20]
    assert places[20] == "after-fifth last-few"


def test_a_short_table_stays_on_a_page_and_a_long_one_does_not() -> None:
    def whole(targets: int) -> bool:
        readings = tree(certificate(standards=0, readings=measurements(targets))).find(
            ".//section[@id='readings']/div"
        )
        assert readings is not None
        return "whole" in readings.get("class", "").split()

    assert whole(5)
    assert not whole(60)


_SYMBOLS = ("U_{max}",)


@pytest.mark.parametrize(
    "block",
    [
        Table("Umax, Umaximum", (), (), symbols=_SYMBOLS),
        Table("Found", (Column("Found"),), (RowGroup((("Umax, Umaximum",),)),), symbols=_SYMBOLS),
        Notice("To be noted", ("Umax, Umaximum",), symbols=_SYMBOLS),
        Paragraph("Umax, Umaximum", symbols=_SYMBOLS),
    ],
    ids=["caption", "cell", "notice", "paragraph"],
)
def test_a_symbol_of_which_a_text_speaks_is_set_as_one(block: Block) -> None:
    document = compose_html(replace(certificate(), sections=(Section("s", "S", (block,)),)))
    assert "<i>U</i><sub>max</sub></span>, Umaximum" in document


def test_a_caption_of_a_graph_knows_the_symbols_that_are_drawn() -> None:
    panel = Panel(curves=(Curve("G_{b}", Role.MEAN_POSITIVE, np.zeros(2), np.zeros(2)),))
    figure = Figure(
        "g",
        same_in_all_languages("Circles of Gb"),
        *[same_in_all_languages("told")] * 3,
        "mm",
        "µm",
        (panel,),
    )
    document = compose_html(replace(certificate(), sections=(Section("s", "S", (Graph(figure),)),)))
    assert "Circles of <span" in document


def test_no_line_parts_a_number_from_its_unit_or_a_number_or_a_name_in_itself() -> None:
    said = Paragraph("12.5 µm/m at 20 °C by ISO 230-2, 5 runs (No. 4711-D-/K-2026-03).")
    document = compose_html(replace(certificate(), sections=(Section("s", "S", (said,)),)))
    assert (
        '<span class="held">12.5\N{NO-BREAK SPACE}µm/m</span> at 20\N{NO-BREAK SPACE}°C by '
        '<span class="held">ISO 230-2,</span> 5 runs (No. <span class="held">4711-D-/K-2026-03).</span>'
    ) in document
    assert "\N{WORD JOINER}" not in document  # who copies a number gets it to the letter


def test_the_title_of_a_page_is_words_only() -> None:
    document = compose_html(replace(certificate(), number="K-2026-03-D"))
    assert re.search(r"<title>[^<]*K-2026-03-D", document)
