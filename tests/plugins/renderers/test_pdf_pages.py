"""How a certificate lies on the pages of a PDF by WeasyPrint: its texts, lines and columns."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pypdfium2 import PdfDocument
from weasyprint import HTML

from document.typesetting import samples
from installed import registry
from plugins.renderers.pdf_pages import page_of, printed_numbers, read, sample, texts, with_blocks
from zlmreport.plugin import InputError, Language
from zlmreport.plugin.renderer import Align, Column, Facts, Notice, Paragraph, RowGroup, Section, Table
from zlmreport_plugins.renderers.pdf.press import find_press

POINT = 25.4 / 72


def test_the_longest_number_stands_whole_on_every_page() -> None:
    number = "N" * 100
    plain = samples.certificate(standards=0)
    long = replace(plain, number=number, page_words=replace(plain.page_words, number=number))
    for text in texts(read(long)):
        assert number in text.replace("\n", "")


def test_the_head_of_a_page_stands_within_its_margin_beside_a_laboratory_of_one_long_word() -> None:
    head = samples.certificate(standards=0).letterhead
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


def test_decimals_are_written_as_the_language_writes_them() -> None:
    assert printed_numbers("\n".join(texts(sample(Language.GERMAN))))["13,8"] == 2
    assert printed_numbers("\n".join(texts(sample(Language.ENGLISH))))["13.8"] == 2


def test_a_name_from_right_to_left_leaves_the_rest_as_it_was() -> None:
    customer = "שלום \u202eabc עולם"
    text = "".join(texts(read(samples.certificate(standards=0, customer=customer))))
    # Readers put right-to-left letters into either order; all of them are there.
    assert set("שלוםעabc") <= set(text)
    assert "Sample Works HMC 500" in text


def test_a_letter_that_no_typeface_has_is_named_and_no_box_stands_for_it(weasyprint_log: list[str]) -> None:
    """Not even a signer would see what the box meant; and programs read none of the letters beside it."""
    document = samples.certificate(standards=0, customer="A \U000f1234 Customer")
    weasyprint_log.append(
        '.notdef glyph rendered for Unicode string unsupported by fonts: "\U000f1234" (U+F1234)'
    )

    with pytest.raises(InputError, match=r"nor one of this system has \(U\+F1234 .*\); install a typeface"):
        read(document)


def test_names_that_stay_whole_stand_beside_each_other_in_a_notice_too() -> None:
    """The line of a notice begins left of the others: a name in it does not."""
    named = "ISO 230-2:2014, ISO 230-2:2006, VDI/VDE 2617; see 4711-D-K-2026"
    notice = Notice("Not met", (named,))
    document = replace(samples.certificate(standards=0), sections=(Section("s", "S", (notice,)),))
    assert named in "\n".join(texts(read(document)))


SENTENCE = "Traceable through the calibration of the instrument (certificate "
NUMBER = "C-1)."


def lay_out(width: float) -> list[Any]:
    """Return the lines of the sentence and its number, which no line parts, in a column so wide, px."""
    find_press()
    page = (
        "<style>@page { size: 600px 200px; margin: 0 }"
        f"body {{ font-size: 10px; margin: 0; overflow-wrap: break-word; width: {width}px }}"
        ".held { display: inline-block }</style>"
        f'<p>{SENTENCE}<span class="held">{NUMBER}</span></p>'
    )
    (sheet,) = HTML(string=page).render().pages
    return list(list_lines(sheet._page_box))


def list_lines(box: Any) -> Iterator[Any]:
    if type(box).__name__ == "LineBox":
        yield box
    else:
        for each in getattr(box, "children", ()):
            yield from list_lines(each)


def count_words(line: Any) -> int:
    return sum(len(each.text.split()) for each in line.descendants() if hasattr(each, "text"))


def test_a_wider_column_never_has_fewer_words_on_its_first_line() -> None:
    """Where the sentence fits but for its last blank, too, at which a line ends anyway."""
    sentence = next(each for each in lay_out(580)[0].descendants() if hasattr(each, "text"))
    words = [count_words(lay_out(sentence.width + more)[0]) for more in np.arange(-6, 2, 0.5)]

    assert words == sorted(words)
    assert {words[0], words[-1]} == {len(SENTENCE.split()) - 1, len(SENTENCE.split())}


@pytest.mark.parametrize("rows_of_last", [1, 2])
def test_a_small_last_group_of_a_table_does_not_stand_alone_on_a_page(rows_of_last: int) -> None:
    rows = [((f"row{n:02d}", "1"),) for n in range(19)]
    last = (*rows[-1], *((("more", "1"),) * (rows_of_last - 1)))
    groups = tuple(RowGroup(each, f"group{n:02d}") for n, each in enumerate((*rows[:-1], last)))
    fillers = tuple(Paragraph("line") for _ in range(2))
    columns = (Column("text"), Column("n", align=Align.RIGHT))
    table = Table("groups", columns, groups)
    reader = read(with_blocks(Section("groups", "Groups", (*fillers, table), new_page=True)))
    pages = [page_of(reader, f"row{n:02d}") for n in range(19)]
    assert pages[0] < pages[-1]
    assert pages[-2] == pages[-1]


_HEBREW = "\u05d4\u05e2\u05e8\u05d4 xyz"


@pytest.mark.parametrize(
    "block",
    [
        Facts((("Remarks", _HEBREW),)),
        Table("Opinions", (Column("Opinion"), Column("Basis")), (RowGroup(((_HEBREW, "basis"),)),)),
        Table("Opinions", (Column("Opinion"), Column("Basis")), (RowGroup((("basis", _HEBREW),)),)),
        Notice("Remarks", (_HEBREW,), is_quoted=True),
    ],
    ids=["fact", "first cell", "cell", "quoted"],
)
def test_what_begins_with_hebrew_is_set_from_right_to_left_as_in_a_browser(
    block: Facts | Table | Notice,
) -> None:
    plain = with_blocks(Section("facts", "Facts", (block,)))
    certificate = replace(plain, look=replace(plain.look, may_lack_letters=True))
    text = PdfDocument(registry().renderer("pdf").render(certificate))[0].get_textpage()
    place = text.get_text_range().index("xyz")
    hebrew, _ = max(
        (text.get_charbox(n)[0], n)
        for n in range(text.count_chars())
        if "\u05d0" <= text.get_text_range(n, 1) <= "\u05ea"
    )
    assert hebrew > text.get_charbox(place)[0]
