"""Numbers as files write them."""

from __future__ import annotations

import contextlib
import math
import re

import pytest
from hypothesis import given, strategies as st

from zlmreport.plugin import DecimalSign
from zlmreport.plugin.source import parse_number

COMMA = DecimalSign.COMMA


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("13.23", 13.23),
        ("-.0033", -0.0033),
        ("+5.", 5.0),
        ("-1e-05", -1e-05),
        ("2E3", 2000.0),
        ("−0.5", -0.5),
        ("-19.994500000000000001", -19.9945),
    ],
)
def test_a_number_may_lack_the_zero_and_have_an_exponent_a_true_minus_or_many_digits(
    text: str, value: float
) -> None:
    assert parse_number(text) == value


def test_the_decimal_sign_is_that_of_the_file() -> None:
    assert parse_number("-13,23", COMMA) == -13.23


@pytest.mark.parametrize(
    ("text", "sign", "complaint"),
    [
        ("abc", ".", "'abc' stands where a number belongs"),
        ("", ".", "'' stands where a number belongs"),
        ("1 2", ".", "'1 2' stands where a number belongs"),
        ("1_000", ".", "'1_000' stands where a number belongs"),
        ("١٢", ".", "'١٢' stands where a number belongs"),
        ("0x1F", ".", "'0x1F' stands where a number belongs"),
        ("nan", ".", "'nan' is no number; a missing reading is an empty cell"),
        ("N/A", ".", "'N/A' is no number; a missing reading is an empty cell"),
        ("--", ".", "'--' is no number; a missing reading is an empty cell"),
        ("-Inf", ".", "'-Inf' is infinite, and no reading is; a missing reading is an empty cell"),
        ("∞", ".", "'∞' is infinite, and no reading is; a missing reading is an empty cell"),
        ("1.#INF", ".", "'1.#INF' is infinite, and no reading is; a missing reading is an empty cell"),
        ("1e999", ".", "'1e999' is too large to be a reading"),
        ("12,5", ".", "'12,5' is no number with a decimal point; write '12.5' if that is meant"),
        ("12.5", ",", "'12.5' is no number with a decimal comma; write '12,5' if that is meant"),
        ("- 1.5", ".", "'- 1.5' has a blank behind its sign; write '-1.5' if that is meant"),
        ("1,5-", ",", "'1,5-' has its sign behind it; write '-1,5' if that is meant"),
        (
            "(2.14)",
            ".",
            "'(2.14)' stands in brackets, as a negative number does; write '-2.14' if that is meant",
        ),
        ("3/8", ".", "'3/8' is a fraction; write '0.375' if that is meant"),
        ('-1 1/2"', ".", "'-1 1/2\"' is a fraction; write '-1.5' if that is meant"),
        ("12-5/16", ".", "'12-5/16' is a fraction; write '12.3125' if that is meant"),
        ("1/3", ".", "'1/3' stands where a number belongs"),
        ("1,234.5", ".", "'1,234.5' has thousands separators; write the digits without them"),
        ("1.234,5", ",", "'1.234,5' has thousands separators; write the digits without them"),
        ("1,234,567", ".", "'1,234,567' has thousands separators; write the digits without them"),
        ("1'234.5", ".", '"1\'234.5" has thousands separators; write the digits without them'),
        ("1\u00a0234", ".", "'1\\xa0234' has thousands separators; write the digits without them"),
    ],
)
def test_what_is_no_number_is_answered_with_what_would_be_right(text: str, sign: str, complaint: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(complaint)}$"):
        parse_number(text, DecimalSign(sign))


def test_endless_digits_are_refused_and_shown_shortened() -> None:
    with pytest.raises(ValueError, match=r"^'1{60}'… \(100,001 characters\) is too long to be a number$"):
        parse_number("1" * 100_000 + "x")


@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(DecimalSign))
def test_every_finite_number_is_read_as_it_was_written(value: float, sign: DecimalSign) -> None:
    assert parse_number(repr(value).replace(".", sign), sign) == value


@given(st.text(), st.sampled_from(DecimalSign))
def test_any_text_is_a_finite_number_or_refused(text: str, sign: DecimalSign) -> None:
    with contextlib.suppress(ValueError):
        assert math.isfinite(parse_number(text, sign))
