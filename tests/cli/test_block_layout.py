"""Blocks on a terminal: titles, sentences, tables of what there is, bars in signs that it has."""

from __future__ import annotations

import io
import sys

import pytest

from zlmreport.cli.layout import lay_out_blocks, lay_out_sections
from zlmreport.cli.terminal import lay_out_heading
from zlmreport.document.blocks import ColumnKind
from zlmreport.plugin.renderer import (
    Align,
    Block,
    Column,
    Facts,
    Formulas,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
)


@pytest.fixture(autouse=True)
def narrow(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "60")


def _table(*columns: Column, rows: tuple[tuple[str, ...], ...], heading: str = "") -> Table:
    return Table("a caption", columns, (RowGroup(rows, heading),))


def _lines(block: Block, title: str = "") -> list[str]:
    return list(lay_out_blocks(block, title))


def test_a_section_stands_below_its_title_after_an_empty_line() -> None:
    assert list(lay_out_sections([Section("key", "Title", (Paragraph("Text."),))])) == [
        "",
        "Title",
        "  Text.",
    ]


def test_a_heading_that_repeats_the_title_is_left_out() -> None:
    notice = Notice("What to do", ("this", "that"))
    assert _lines(notice, "What to do") == ["  this", "  that"]
    assert _lines(notice, "Other") == ["  What to do:", "    this", "    that"]


def test_a_name_is_not_parted_from_its_value() -> None:
    facts = Facts((("Root mean square error", "5.59 µm"), ("Runs predicted from the others", "5.5 µm")))
    assert _lines(facts) == ["  Root mean square error 5.59 µm", "    Runs predicted from the others 5.5 µm"]


def test_a_fact_that_is_longer_than_a_line_is_broken_between_words() -> None:
    said = "a stretch displaced as a whole, 93.2 mm long, alike in both directions, around 238 mm"
    lines = _lines(Facts((("Place", "239 mm"), ("Beside it", said))))
    assert max(map(len, lines)) <= 60
    assert lines == [line.rstrip() for line in lines]
    assert " ".join(line.strip() for line in lines) == f"Place 239 mm   Beside it {said}"


def test_a_name_that_is_longer_than_a_line_keeps_both_ends() -> None:
    table = _table(Column("Test"), Column("RMS"), rows=((f"ballbar-{'x' * 100}-cw", "4.7"),))
    *_, line = _lines(table)
    assert line.split()[0] == f"ballbar-{'x' * 18}…{'x' * 23}-cw"
    assert line.endswith("4.7")
    assert len(line) <= 60


def test_columns_that_hold_nothing_are_left_out() -> None:
    columns = (Column("Name"), Column("Nothing"), Column("Dash"), Column("Value", "mm", Align.RIGHT))
    table = _table(*columns, rows=(("a", "", "–", "10"), ("bc", "", "–", "9")))
    assert _lines(table) == ["  Name  Value mm", "  a           10", "  bc           9"]


@pytest.mark.parametrize("cell", ["x̄", "\x1b[31mx\x1b[0m", "↑"])
def test_marks_and_colours_take_no_room(cell: str) -> None:
    table = _table(Column(""), Column(""), rows=((cell, "|"), ("ab", "|")))
    assert _lines(table) == [f"  {cell}   |", "  ab  |"]


def test_rows_stand_below_the_heading_of_their_group() -> None:
    assert _lines(_table(Column(""), rows=(("a",), ("b",)), heading="Group")) == ["  Group", "    a", "    b"]


def test_sentences_stand_below_their_row_and_none_where_there_is_none() -> None:
    sentences = ColumnKind.SENTENCES
    columns = (Column("Effect"), Column("Told by", kind=sentences), Column("", kind=sentences))
    table = _table(*columns, rows=(("a", "a test", "explains it"), ("b", "–", "")))
    assert _lines(table) == ["  Effect", "  a", "    Told by: a test", "    explains it", "  b"]


def test_formulas_are_written_plainly() -> None:
    assert _lines(Formulas("", ((Symbol("E_{i}"), Symbol("a·P"), "slope"),))) == ["  Ei  a·P  slope"]


FALL = (
    Column("Effect"), Column("", kind=ColumnKind.BARS), Column("RMS error", "µm", Align.RIGHT),
    Column("Cross-validated", "µm", Align.RIGHT),
)  # fmt: skip


def test_headings_take_two_lines_and_bars_shrink_where_a_line_has_no_room() -> None:
    table = _table(
        *FALL, rows=(("without model", "100.0", "5.77", "5.76"), ("+ offset", "50.0", "3.1", "3.1"))
    )
    assert _lines(table) == [
        "                                           RMS        Cross-",
        "  Effect                              error µm  validated µm",
        f"  without model  {'█' * 19}      5.77          5.76",
        f"  + offset       {'█' * 9}▌                3.1           3.1",
    ]


def test_a_text_for_which_a_line_has_no_room_stands_below_its_row() -> None:
    columns = (Column("Effect"), Column("Probability", "%", Align.RIGHT), Column("Evidence"))
    table = _table(
        *columns, rows=(("a-long-name-of-an-effect", "100", "p < 0.000001 (extrapolated from far)"),)
    )
    assert _lines(table) == [
        "  Effect                    Probability %",
        "  a-long-name-of-an-effect            100",
        "    Evidence: p < 0.000001 (extrapolated from far)",
    ]


@pytest.mark.parametrize("length", [1, 30, 80])
def test_every_line_of_a_table_fits_whatever_the_name_of_a_row(length: int) -> None:
    table = _table(*FALL, Column("p"), rows=(("n" * length, "100.0", "5.77", "5.76", "p < 0.001"),))
    assert max(map(len, _lines(table))) <= 60


def test_a_heading_goes_on_further_in_where_a_line_has_no_room() -> None:
    assert list(lay_out_heading("CAL-7", "axis X: " + " + ".join(["backlash"] * 6))) == [
        "CAL-7  axis X: backlash + backlash + backlash + backlash +",
        "  backlash + backlash",
    ]


@pytest.mark.parametrize(("encoding", "sign"), [("utf-8", "█"), ("ascii", "#")])
def test_a_bar_is_drawn_in_signs_that_the_terminal_has(
    monkeypatch: pytest.MonkeyPatch, encoding: str, sign: str
) -> None:
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(io.BytesIO(), encoding))
    table = _table(Column("", kind=ColumnKind.BARS), rows=(("100.0",), ("50.0",), ("0.0",)))
    lengths = [line.count(sign) for line in _lines(table)]
    assert lengths == [20, 10, 0]
