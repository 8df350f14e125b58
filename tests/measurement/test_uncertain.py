"""A value is written to the digits that its uncertainty leaves."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, strategies as st

from zlmreport.plugin import DecimalSign
from zlmreport.plugin.renderer import rounded_pair


@pytest.mark.parametrize(
    ("value", "uncertainty", "written"),
    [
        (-4.01187, 0.1319, ("−4.01", "0.13")),
        (14.806, 4.238, ("14.8", "4.2")),
        (5678.9, 432.1, ("5680", "430")),
        (3.2, 0.0109, ("3.200", "0.011")),
        (0.00123456, 0.0000789, ("0.001235", "0.000079")),
        (12.3456, 0.0996, ("12.35", "0.10")),
        (12.3456, 9.96, ("12", "10")),
    ],
)
def test_two_digits_of_the_uncertainty_are_kept(
    value: float, uncertainty: float, written: tuple[str, str]
) -> None:
    assert rounded_pair(value, uncertainty) == written


def test_a_value_without_uncertainty_keeps_three_decimals() -> None:
    assert rounded_pair(1.23456, 0.0) == ("1.235", "0.000")


def test_an_uncertainty_without_bound_is_said_to_be_so() -> None:
    assert rounded_pair(1.23456, math.inf) == ("1.235", "∞")


def test_the_decimal_sign_is_that_of_the_reader() -> None:
    assert rounded_pair(1.5, 0.25, DecimalSign.COMMA) == ("1,50", "0,25")


@given(st.floats(-1e6, 1e6), st.floats(1e-6, 99.0))
def test_rounding_takes_no_more_than_a_twentieth_of_the_uncertainty(value: float, uncertainty: float) -> None:
    written, half = (float(text.replace("−", "-")) for text in rounded_pair(value, uncertainty))
    # Half a unit of the second digit is at most a twentieth of a number that begins with it.
    assert abs(written - value) <= uncertainty / 20 * (1 + 1e-9) + math.ulp(value)
    assert abs(half - uncertainty) <= uncertainty / 20 * (1 + 1e-9)
