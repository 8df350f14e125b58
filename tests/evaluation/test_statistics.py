"""Means, standard deviations and reversal values by position; extremes and means over the positions."""

from __future__ import annotations

import math

import numpy as np
import pytest

from zlmreport.plugin.standard import (
    PositionStatistics,
    largest_over_positions,
    mean_over_positions,
    position_statistics,
    range_over_positions,
    smallest_over_positions,
    span_over_positions,
)

NAN = math.nan


def statistics(*directions: list[list[float]]) -> PositionStatistics:
    return position_statistics(np.array(directions))


TWO_TARGETS = statistics([[1.0, 2.0, 6.0], [4.0, 4.0, 4.0]], [[-1.0, 0.0, 4.0], [5.0, 7.0, 9.0]])


def test_mean_is_taken_over_the_runs_of_one_direction() -> None:
    assert TWO_TARGETS.mean_positive.tolist() == [3.0, 4.0]
    assert TWO_TARGETS.mean_negative.tolist() == [1.0, 7.0]


def test_standard_deviation_has_one_degree_of_freedom_less_than_readings() -> None:
    assert TWO_TARGETS.s_positive.tolist() == [math.sqrt(14 / 2), 0.0]
    assert TWO_TARGETS.s_negative.tolist() == [math.sqrt(14 / 2), 2.0]


def test_reversal_value_is_positive_minus_negative_direction() -> None:
    assert TWO_TARGETS.reversal_value.tolist() == [2.0, -3.0]


def test_bidirectional_mean_is_the_middle_of_the_means_of_both_directions() -> None:
    assert TWO_TARGETS.mean_bidirectional.tolist() == [2.0, 5.5]


def test_a_missing_reading_lowers_n_at_its_position_only() -> None:
    found = statistics([[1.0, NAN, 6.0], [4.0, 4.0, 4.0]], [[-1.0, 0.0, 4.0], [5.0, 7.0, 9.0]])

    assert found.count.tolist() == [[2, 3], [3, 3]]
    assert found.mean.tolist() == [[3.5, 4.0], [1.0, 7.0]]
    assert found.s_positive[0] == pytest.approx(math.sqrt(12.5))


def test_one_reading_has_a_mean_and_no_standard_deviation() -> None:
    found = statistics([[1.0]], [[2.0]])

    assert found.mean.tolist() == [[1.0], [2.0]]
    assert np.isnan(found.standard_deviation).all()


def test_no_reading_has_neither_mean_nor_standard_deviation() -> None:
    found = statistics([[1.0, 3.0]], [[NAN, NAN]])

    assert math.isnan(found.mean_negative[0])
    assert math.isnan(found.s_negative[0])
    assert math.isnan(found.reversal_value[0])


def test_a_large_offset_costs_no_digit_of_the_scatter() -> None:
    scatter = statistics([[1e9 + 1, 1e9 + 2, 1e9 + 3]], [[0.0, 0.0, 0.0]])

    assert scatter.s_positive[0] == 1.0


def test_a_test_is_bidirectional_when_both_directions_have_a_reading_somewhere() -> None:
    stack = np.array(
        [[[[1.0], [NAN]], [[NAN], [2.0]]], [[[1.0], [2.0]], [[NAN], [NAN]]], [[[NAN], [NAN]], [[1.0], [2.0]]]]
    )
    found = position_statistics(stack)

    assert found.is_bidirectional.tolist() == [True, False, False]
    assert found.is_measured.tolist() == [[True, True], [True, False], [False, True]]


def test_values_of_the_single_direction_stand_in_where_only_one_was_measured() -> None:
    stack = np.array([[[[1.0]], [[2.0]]], [[[3.0]], [[NAN]]], [[[NAN]], [[4.0]]]])
    found = position_statistics(stack)

    assert found.of_both_or_single(found.mean_bidirectional, found.mean).tolist() == [[1.5], [3.0], [4.0]]


def test_statistics_cannot_be_altered_and_leave_the_readings_as_they_are() -> None:
    readings = np.array([[[1.0, 2.0]], [[3.0, 4.0]]])
    found = position_statistics(readings)

    for array in (found.deviations, found.count, found.mean, found.standard_deviation):
        assert not array.flags.writeable
    assert readings.flags.writeable


def test_a_single_value_has_no_range() -> None:
    assert math.isnan(span_over_positions(np.array([3.0])))
    assert math.isnan(span_over_positions(np.array([3.0, NAN])))
    assert span_over_positions(np.array([3.0, NAN, 1.0])) == 2.0


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
