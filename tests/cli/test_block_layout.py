"""Blocks on a terminal: titles, sentences, tables of what there is, bars in signs that it has."""

from __future__ import annotations

import io
import sys

import pytest

from zlmreport.cli.layout import lay_out_blocks, lay_out_sections
from zlmreport.document.blocks import (
    Align,
    Block,
    Column,
    ColumnKind,
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


def test_a_name_that_is_longer_than_a_line_keeps_both_ends() -> None:
    table = _table(Column("Test"), Column("RMS"), rows=((f"ballbar-{'x' * 100}-cw", "4.7"),))
    *_, line = _lines(table)
    assert line.split()[0] == f"ballbar-{'x' * 22}…{'x' * 27}-cw"
    assert line.endswith("4.7")


def test_columns_that_hold_nothing_are_left_out() -> None:
    columns = (Column("Name"), Column("Nothing"), Column("Dash"), Column("Value", "mm", Align.RIGHT))
    table = _table(*columns, rows=(("a", "", "–", "10"), ("bc", "", "–", "9")))
    assert _lines(table) == ["  Name  Value mm", "  a           10", "  bc           9"]


def test_rows_stand_below_the_heading_of_their_group() -> None:
    assert _lines(_table(Column(""), rows=(("a",), ("b",)), heading="Group")) == ["  Group", "    a", "    b"]


def test_sentences_stand_below_their_row_and_none_where_there_is_none() -> None:
    sentences = ColumnKind.SENTENCES
    columns = (Column("Effect"), Column("Told by", kind=sentences), Column("", kind=sentences))
    table = _table(*columns, rows=(("a", "a test", "explains it"), ("b", "–", "")))
    assert _lines(table) == ["  Effect", "  a", "    Told by: a test", "    explains it", "  b"]


def test_formulas_are_written_plainly() -> None:
    assert _lines(Formulas("", ((Symbol("E_{i}"), Symbol("a·P"), "slope"),))) == ["  Ei  a·P  slope"]


@pytest.mark.parametrize(("encoding", "sign"), [("utf-8", "█"), ("ascii", "#")])
def test_a_bar_is_drawn_in_signs_that_the_terminal_has(
    monkeypatch: pytest.MonkeyPatch, encoding: str, sign: str
) -> None:
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(io.BytesIO(), encoding))
    table = _table(Column("", kind=ColumnKind.BARS), rows=(("100.0",), ("50.0",), ("0.0",)))
    lengths = [line.count(sign) for line in _lines(table)]
    assert lengths == [20, 10, 0]
