"""How a table's columns share the page, and where its numbers stand."""

from __future__ import annotations

import pytest

from zlmreport.document.certificate import columns
from zlmreport.plugin import Figure, Words, same_in_all_languages
from zlmreport.plugin.renderer import (
    Align,
    Cell,
    Column,
    Formulas,
    Graph,
    Mark,
    RowGroup,
    Symbol,
    Table,
    Verdict,
)
from zlmreport.plugin.standard import Panel

NUMBERS = Align.RIGHT


def table(of_columns: tuple[Column, ...], *rows: tuple[Cell, ...], dense: bool = False) -> Table:
    return Table("caption", of_columns, (RowGroup(rows),), dense)


def numbers(*cells: Cell) -> Table:
    return table((Column("x", "µm", NUMBERS),), *((cell,) for cell in cells))


def widths(of_table: Table) -> tuple[float, ...]:
    needs = columns.measure_columns(of_table)
    return columns.share_widths(needs, columns.choose_size(of_table, needs).page_em)


def test_the_widths_fill_the_page() -> None:
    assert sum(
        widths(table((Column("Name"), Column("Value", "µm", NUMBERS)), ("long name", "1.0")))
    ) == pytest.approx(100)


def test_a_column_of_longer_numbers_is_wider() -> None:
    short, long = widths(
        table((Column("a", align=NUMBERS), Column("b", align=NUMBERS)), ("1.0", "−1234.567"))
    )
    assert long > short


@pytest.mark.parametrize("words", ["a sentence of many words " * 20, "W" * 500])
def test_numbers_keep_their_line_beside_long_words(words: str) -> None:
    page = table((Column("Meaning"), Column("Value", "µm", NUMBERS)), (words, "−1234.5"))
    needs = columns.measure_columns(page)
    page_em = columns.choose_size(page, needs).page_em
    assert columns.share_widths(needs, page_em)[1] / 100 * page_em >= needs[1].natural * (1 - 1e-12)


def test_a_verdict_keeps_its_line() -> None:
    need = columns.measure_columns(
        table((Column("Conformity"),), (Verdict(Mark.NOT_MET, "does not conform"),))
    )[0]
    assert need.least == need.natural


def test_words_after_numbers_stand_apart_and_get_the_room_for_it() -> None:
    of_columns = (Column("Value", align=NUMBERS), Column("Name"), Column("Note"))
    assert columns.find_apart(of_columns) == (False, True, False)
    _, name, note = columns.measure_columns(table(of_columns, ("1", "same", "same")))
    assert name.least > note.least


def test_many_columns_are_set_smaller_until_they_fit() -> None:
    of_columns = tuple(Column("x", "µm", NUMBERS) for _ in range(16))
    wide = table(of_columns, ("−1234.5",) * 16)
    needs = columns.measure_columns(wide)
    assert columns.choose_size(wide, needs).name == "finest"
    few = table(of_columns[:3], ("−1234.5",) * 3)
    assert columns.choose_size(few, columns.measure_columns(few)).name == "regular"


def test_a_dense_table_is_set_in_small_type_though_it_would_fit() -> None:
    small = table((Column("x"),), ("1",), dense=True)
    assert columns.choose_size(small, columns.measure_columns(small)).name == "dense"


def test_a_formula_keeps_its_line_beside_a_long_name() -> None:
    formula = "max(x̄_{i}↑ + 2s_{i}↑; x̄_{i}↓ + 2s_{i}↓) − min(x̄_{i}↑ − 2s_{i}↑; x̄_{i}↓ − 2s_{i}↓)"
    rows = ((Symbol("A"), Symbol(formula), "Unidirectional systematic positional deviation, positive " * 2),)
    of_formula = columns.lay_out_table(Formulas("caption", rows)).rooms[1]
    assert of_formula > columns.measure_width(columns.write_cell_text(Symbol(formula)))


def test_a_combining_mark_takes_no_room() -> None:
    with_bar, without = columns.measure_columns(table((Column("x̄"), Column("x")), ("x̄" * 9, "x" * 9)))
    assert with_bar == without


def test_numbers_with_as_many_decimals_stand_in_line_as_they_are() -> None:
    assert columns.pad_decimals(numbers("1.25", "−10.50", "100.00")) == (("",), ("",), ("",))


@pytest.mark.parametrize(
    ("short", "style"), [("1.2", "short-2"), ("1,2", "short-2"), ("−7", "whole-3"), ("–", "whole-3")]
)
def test_a_number_with_fewer_decimals_is_moved_to_the_decimal_sign(short: str, style: str) -> None:
    assert columns.pad_decimals(numbers("0.125", short)) == (("",), (style,))


@pytest.mark.parametrize("cell", ["20 °C", "1.2.3", "", Symbol("P_{i}"), Verdict(Mark.MET, "met")])
def test_what_is_no_number_is_not_moved(cell: Cell) -> None:
    assert columns.pad_decimals(numbers("0.125", cell)) == (("",), ("",))


def test_numbers_in_a_column_of_words_are_not_moved() -> None:
    words = table((Column("x"),), ("1.25",), ("2",))
    assert columns.pad_decimals(words) == (("",), ("",))


def test_a_text_that_wraps_takes_more_lines() -> None:
    page = table((Column("Name"),), ("word " * 30,), ("word",))
    assert columns.count_table_lines(page, [20.0]) > columns.count_table_lines(page, [80.0])


def test_a_heading_of_a_group_takes_a_line() -> None:
    plain = table((Column("Name"),), ("word",))
    headed = Table("caption", plain.columns, (RowGroup(plain.groups[0].rows, "heading"),))
    assert columns.count_table_lines(headed, [20.0]) == columns.count_table_lines(plain, [20.0]) + 1


def test_a_graph_is_higher_by_the_lines_that_a_long_name_adds_to_its_title() -> None:
    title = Words("{test}: circle XY, R 150 mm; dashed, with ∑: what the axes predict")

    def height(name: str) -> float:
        axes = (same_in_all_languages("X"), same_in_all_languages("Y"), "mm", "µm")
        return columns.estimate_height(
            [Graph(Figure("circle", title.given(test=name), same_in_all_languages(""), *axes, (Panel(),)))]
        )

    assert height("n" * 80) - height("n") == pytest.approx(0.944 * 1.3 * 8.1)
