"""Tables line up, whatever stands in them."""

from __future__ import annotations

import pytest

from zlmreport.cli.terminal import lay_out_table


@pytest.mark.parametrize("cell", ["x̄", "é", "\x1b[31mx\x1b[0m", "↑"])
def test_marks_and_colours_take_no_room(cell: str) -> None:
    first, second = lay_out_table([(cell, "|"), ("ab", "|")], indent="")
    assert first == f"{cell}   |"
    assert second == "ab  |"


def test_numbers_stand_on_their_last_digit() -> None:
    assert list(lay_out_table([("a", "1"), ("bcd", "20")], right=(1,), indent="")) == ["a     1", "bcd  20"]


def test_empty_cells_at_the_end_leave_no_blanks() -> None:
    assert list(lay_out_table([("a", ""), ("b", "c")], indent=" ")) == [" a", " b  c"]


def test_table_without_rows_is_nothing() -> None:
    assert list(lay_out_table([])) == []
