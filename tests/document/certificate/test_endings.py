"""What ends before a page that begins anew, or before the end, is enough to begin a page with."""

from __future__ import annotations

from dataclasses import replace

import pytest

from document.certificate.documents import certificate
from zlmreport.plugin.renderer import (
    Block,
    Certificate,
    Column,
    Ending,
    Paragraph,
    RowGroup,
    Section,
    Table,
    endings,
)


@pytest.fixture(scope="module")
def document(tmp_path_factory: pytest.TempPathFactory) -> Certificate:
    return certificate(tmp_path_factory.mktemp("endings"))


def table(rows: int) -> Table:
    return Table("Numbers", (Column("Number"),), (RowGroup((("1",),) * rows),))


def section(*blocks: Block, new_page: bool = False) -> Section:
    return Section("a", "A section", blocks, new_page)


LINE = Paragraph("A line.")
NOTE = Paragraph("A note.", fine=True)
#: Its height is about a sixth of a page.
SMALL = table(6)


def ended(of: Certificate, *sections: Section) -> tuple[Ending, ...]:
    return endings(replace(of, sections=sections))


def test_blocks_at_the_end_stay_together_until_they_are_a_quarter_of_a_page(document: Certificate) -> None:
    (ending,) = ended(document, section(*[SMALL] * 6))
    assert ending.kept == 2
    assert not ending.is_joined


def test_a_short_section_stays_with_the_end_of_the_one_before_it(document: Certificate) -> None:
    before, last = ended(document, section(*[SMALL] * 6), section(LINE))
    assert last == Ending(1, is_joined=True)
    assert before.kept > 1


def test_what_stands_before_a_page_that_begins_anew_is_an_end_as_well(document: Certificate) -> None:
    before, last = ended(document, section(*[SMALL] * 6), section(*[SMALL] * 6, new_page=True))
    assert before.kept == last.kept == 2


def test_a_section_that_begins_a_page_stays_with_nothing_before_it(document: Certificate) -> None:
    before, last = ended(document, section(*[SMALL] * 6), section(LINE, new_page=True))
    assert not last.is_joined
    assert before.kept == 2


@pytest.mark.parametrize(("rows", "kept"), [(4, 6), (20, 3)])
def test_notes_stay_with_their_table_at_the_end_or_before_it(
    document: Certificate, rows: int, kept: int
) -> None:
    blocks = table(20), table(rows), NOTE, NOTE, table(9), NOTE, NOTE
    (ending,) = ended(document, section(*blocks))
    assert ending.kept == kept


def test_a_table_that_pages_may_part_stays_whole_with_nothing(document: Certificate) -> None:
    (ending,) = ended(document, section(SMALL, table(40), LINE))
    assert ending.kept == 1
