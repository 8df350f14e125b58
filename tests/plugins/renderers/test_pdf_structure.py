"""What a reader who cannot see the page is told of its structure."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from io import BytesIO
from itertools import pairwise

import pikepdf
import pytest

from document.typesetting import samples
from installed import registry
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import Align, Column, Graph, Paragraph, RowGroup, Section, Table

_ROWS = (("a", "1"), ("b", "2"))
_TABLE = Table(
    "caption",
    (Column("name"), Column("value", "mm", Align.RIGHT)),
    (RowGroup(_ROWS, "first group", "what it means", "far"), RowGroup(_ROWS, "second group")),
)


@cache
def opened(language: Language = Language.ENGLISH) -> pikepdf.Pdf:
    """A certificate with one table of two groups, and a section on a page of its own."""
    (figure,) = samples.certificate(standards=1).figures[:1]
    sections = (
        Section("near", "Near", (_TABLE,)),
        Section("far", "Far away", (Paragraph("far"), Graph(figure)), new_page=True),
    )
    certificate = samples.certificate(language, standards=0, sections=sections)
    return pikepdf.open(BytesIO(registry().renderer("pdf").render(certificate)))


def elements(kind: str | None = None, below: pikepdf.Object | None = None) -> list[pikepdf.Dictionary]:
    """All elements of the structure in reading order, or those of a kind."""
    found = []
    for child in _children(opened().Root.StructTreeRoot if below is None else below):
        if kind in {None, str(child.S)}:
            found.append(child)
        found += elements(kind, child)
    return found


def _children(element: pikepdf.Object) -> list[pikepdf.Dictionary]:
    kids = element.get("/K", [])
    kids = list(kids) if isinstance(kids, pikepdf.Array) else [kids]
    return [kid for kid in kids if isinstance(kid, pikepdf.Dictionary) and "/S" in kid]


def _table_of_groups() -> pikepdf.Dictionary:
    (table,) = [each for each in elements("/Table") if elements("/THead", each)]
    return table


def _headers(cell: pikepdf.Dictionary) -> list[str]:
    return [str(name) for name in cell.A.Headers]


def test_every_element_can_be_reached() -> None:
    reached = {element.objgen for element in elements()}
    present = [
        each
        for each in opened().objects
        if isinstance(each, pikepdf.Dictionary) and each.get("/Type") == "/StructElem"
    ]
    assert len(present) > 50
    assert {each.objgen for each in present} == reached


def test_all_that_is_marked_as_content_belongs_to_an_element() -> None:
    places = opened().Root.StructTreeRoot.ParentTree.Nums
    of_pages = {int(number): elements for number, elements in zip(places[::2], places[1::2], strict=True)}
    for page in opened().pages:
        of_page = of_pages[int(page.StructParents)]
        marked = [properties for _, properties in _marked(page) if "/MCID" in properties]
        assert len(marked) > 5
        assert {str(of_page[int(each.MCID)].S) for each in marked} <= {"/Span", "/Figure", "/Link"}


def test_the_lines_in_the_margins_are_no_part_of_what_is_read() -> None:
    lines = [
        sum(
            tag == "/Artifact" and properties.get("/Type") == "/Pagination"
            for tag, properties in _marked(page)
        )
        for page in opened().pages
    ]
    # Number and page on each page; laboratory and subject from the second on.
    assert lines == [2, 4]


def _marked(page: pikepdf.Page) -> Iterator[tuple[str, pikepdf.Dictionary]]:
    """The stretches of a page that are marked with properties."""
    for operands, operator in pikepdf.parse_content_stream(page):
        if str(operator) == "BDC":
            yield str(operands[0]), operands[1]


def test_headings_of_columns_groups_and_rows_say_what_they_head() -> None:
    scopes = [str(heading.A.Scope) for heading in elements("/TH", _table_of_groups())]
    assert scopes == ["/Column", "/Column", *(["/Column", "/Row", "/Row"] * 2)]


def test_a_cell_belongs_to_its_column_its_row_and_its_own_group_only() -> None:
    table = _table_of_groups()
    _, value, *others = (str(heading.ID) for heading in elements("/TH", table))
    first, a_of_first, b_of_first, second, a_of_second, b_of_second = others
    assert [_headers(cell) for cell in elements("/TD", table)] == [
        [value, first, a_of_first],
        [value, first, b_of_first],
        [value, second, a_of_second],
        [value, second, b_of_second],
    ]


def test_a_value_belongs_to_the_name_in_its_row() -> None:
    facts = next(table for table in elements("/Table") if not elements("/THead", table))
    names = [str(heading.ID) for heading in elements("/TH", facts)]
    assert [_headers(cell) for cell in elements("/TD", facts)] == [[name] for name in names]


def test_headings_follow_each_other_without_a_gap() -> None:
    levels = [int(str(each.S)[2:]) for each in elements() if str(each.S)[:2] == "/H"]
    assert levels[0] == 1
    assert all(below <= above + 1 for above, below in pairwise(levels))


def test_a_graph_says_where_it_lies_on_its_page() -> None:
    (figure,) = elements("/Figure")
    left, bottom, right, top = map(float, figure.A.BBox)
    page_left, page_bottom, page_right, page_top = map(float, figure.Pg.MediaBox)
    assert page_left < left < right < page_right
    assert page_bottom < bottom < top < page_top
    # It stands below the heading in the upper half of a page that it does not fill.
    assert bottom > page_top / 3
    assert right - left == pytest.approx(170 * 72 / 25.4, abs=0.01)


def test_a_link_leads_to_its_section_and_says_so() -> None:
    (link,) = [annotation for page in opened().pages for annotation in page.get("/Annots", [])]
    assert str(link.Contents) == "Far away"
    (element,) = elements("/Link")
    assert [kid.Obj.objgen for kid in element.K if isinstance(kid, pikepdf.Dictionary)] == [link.objgen]
    targets = opened().Root.Names.Dests.Names
    page, *_ = dict(zip(map(str, targets[::2]), targets[1::2], strict=True))[str(link.Dest)]
    assert page.objgen == opened().pages[-1].objgen


def test_a_link_says_on_paper_on_which_page_its_section_is() -> None:
    from pypdf import PdfReader

    saved = BytesIO()
    opened().save(saved)
    pages = [page.extract_text() for page in PdfReader(saved).pages]
    assert f"first group Page {len(pages)} what it means" in pages[0].replace("\n", " ")
