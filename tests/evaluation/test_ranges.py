"""Extremes and means over the positions, with positions that take no part."""

from __future__ import annotations

import math

import numpy as np
import pytest

from zlmreport.plugin.standard import (
    largest_over_positions,
    mean_over_positions,
    range_over_positions,
    smallest_over_positions,
    span_over_positions,
)

NAN = math.nan
STACK = np.array([[1.0, NAN, -4.0], [NAN, NAN, 5.0]])


def test_a_position_without_value_takes_no_part() -> None:
    assert largest_over_positions(STACK).tolist() == [1.0, 5.0]
    assert smallest_over_positions(STACK).tolist() == [-4.0, 5.0]
    assert mean_over_positions(STACK).tolist() == [-1.5, 5.0]


@pytest.mark.parametrize(
    "over_positions", [largest_over_positions, smallest_over_positions, mean_over_positions]
)
def test_without_any_value_the_result_is_undefined_and_not_zero(over_positions: object) -> None:
    assert callable(over_positions)
    assert math.isnan(over_positions(np.array([NAN, NAN])))


def test_width_runs_from_the_smallest_lower_to_the_largest_upper_value() -> None:
    assert range_over_positions(np.array([2.0, 7.0, NAN]), np.array([-1.0, 0.0, -3.0])) == 10.0


def test_span_is_the_range_of_several_values_and_undefined_of_one() -> None:
    # 5 − (−4), one value alone, one among undefined ones, none
    values = np.array([[1.0, 5.0, -4.0], [NAN, NAN, 5.0], [NAN, NAN, NAN]])
    assert span_over_positions(values)[0] == 9.0
    assert np.isnan(span_over_positions(values)[1:]).all()
