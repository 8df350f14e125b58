"""Shares and p-values are written alike everywhere, and with no more digits than they are known to."""

from __future__ import annotations

import math

import pytest

from zlmreport.language.formatting import write_p_value, write_percentage, write_plain
from zlmreport.language.numbers import write_part, write_significant
from zlmreport.plugin import DecimalSign, Language, fixed_number
from zlmreport.plugin.renderer import notation_spans


def test_a_number_too_large_for_its_decimals_is_written_all_the_same() -> None:
    assert fixed_number(1e31, 2) == f"1{31 * '0'}.00"


@pytest.mark.parametrize(
    ("value", "text"),
    [(1e-9, "p < 0,000001"), (2.34e-5, "p = 0,000023"), (0.0123, "p = 0,012"), (0.4, "p = 0,400")],
)
def test_a_p_value_is_written_as_far_as_it_is_known(value: float, text: str) -> None:
    assert write_p_value(value, DecimalSign.COMMA).replace("\xa0", " ") == text


def test_an_extrapolated_p_value_is_about_so_much() -> None:
    assert write_p_value(2.34e-5, is_extrapolated=True).replace("\xa0", " ") == "p ≈ 0.00002"


@pytest.mark.parametrize(
    ("share", "text"), [(0.0, "0"), (0.004, "< 1"), (0.0099, "< 1"), (0.01, "1"), (0.996, "100")]
)
def test_a_share_below_the_last_digit_is_small_and_not_nothing(share: float, text: str) -> None:
    assert write_percentage(share) == text


def test_a_share_has_the_decimal_sign_and_the_decimals_that_are_asked_for() -> None:
    assert write_percentage(0.1234, DecimalSign.COMMA, 1) == "12,3"
    assert write_percentage(0.0004, DecimalSign.COMMA, 1) == "< 0,1"


@pytest.mark.parametrize(
    ("notation", "italic"),
    [
        ("A·sin(2π·P/Λ + φ)", ["A", "P", "Λ", "φ"]),
        ("Σ c_{k}·p", ["c", "p"]),
        ("x̄_{i}↑ + 2s_{i}↑", ["x̄", "i", "s", "i"]),
        ("P_{s max}", ["P"]),
        ("U(k = 2)", ["U", "k"]),
    ],
)
def test_only_quantities_and_running_indices_are_italic(notation: str, italic: list[str]) -> None:
    assert [span.text for span in notation_spans(notation) if span.italic] == italic


@pytest.mark.parametrize("notation", ["A·sin(2π·P/p_{0} + φ)", "P_{s max}", "½·B·d"])
def test_nothing_is_lost_in_spans(notation: str) -> None:
    assert "".join(span.text for span in notation_spans(notation)) == write_plain(notation)


@pytest.mark.parametrize(
    ("value", "whole", "written"),
    [
        (0.25, 0.5, "0.25"),
        (0.00011, 0.5, "0.00011"),
        (2.5e-8, 0.5, "< 0.0001"),
        (2.5e-8, 3e-5, "0.000000025"),
        (0.0, 0.5, "0"),
    ],
)
def test_a_part_of_an_uncertainty_far_below_a_thousandth_is_small_and_not_nothing(
    value: float, whole: float, written: str
) -> None:
    assert write_part(value, whole).in_language(Language.ENGLISH) == written


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (1234.4, "1234"),
        (123.4, "123"),
        (12.34, "12.3"),
        (0.01234, "0.0123"),
        (-2.5, "−2.50"),
        (9.9999, "10.0"),
        (0.09996, "0.100"),
        (math.inf, "inf"),
    ],
)
def test_a_number_has_three_significant_digits(value: float, text: str) -> None:
    assert write_significant(value).in_language(Language.ENGLISH) == text
