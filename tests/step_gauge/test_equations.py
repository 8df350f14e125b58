"""Each equation of Pahk and Kim against numbers worked by hand."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from zlmreport_step_gauge import equations

NAN = float("nan")


def test_eq_1_the_effective_radius_is_half_of_what_the_tip_makes_a_block_longer() -> None:
    assert equations.effective_radius(np.array(13.9970), np.array(10.0000)) == pytest.approx(1.9985)


def test_eq_2_a_forward_error_is_the_measured_minus_the_actual_distance_from_the_reference() -> None:
    assert equations.error(np.array(61.0132), np.array(41.0120), np.array(20.0008), np.array(0.0)) == (
        pytest.approx(0.0004)
    )


def test_eq_3_a_reference_that_is_not_the_origin_of_the_gauge_is_taken_off_the_distances() -> None:
    assert equations.error(np.array(50.0), np.array(20.0), np.array(130.001), np.array(100.002)) == (
        pytest.approx(0.001)
    )


def test_eq_4_and_6_the_mean_is_that_of_the_cycles() -> None:
    assert equations.mean(np.array([[1.0, 2.0, 6.0]])) == pytest.approx([3.0])


def test_eq_5_and_7_the_standard_deviation_divides_by_one_less_than_the_cycles() -> None:
    # residuals −2, −1, 3: 14 / 2
    assert equations.standard_deviation(np.array([[1.0, 2.0, 6.0]])) == pytest.approx([7**0.5])


def test_a_single_cycle_has_no_standard_deviation() -> None:
    assert np.isnan(equations.standard_deviation(np.array([[1.0]])))[0]


def test_eq_8_and_10_a_forward_value_at_a_back_face_is_the_mean_of_its_neighbours() -> None:
    forward = equations.interpolate(np.array([1.0, NAN, 4.0, NAN]))
    assert forward[:3] == pytest.approx([1.0, 2.5, 4.0])


def test_eq_9_and_11_a_backward_value_at_a_front_face_is_the_mean_of_its_neighbours() -> None:
    backward = equations.interpolate(np.array([NAN, 2.0, NAN, 3.0]))
    assert backward[1:] == pytest.approx([2.0, 2.5, 3.0])


def test_the_ends_of_the_section_are_not_extrapolated() -> None:
    assert np.isnan(equations.interpolate(np.array([1.0, NAN, 4.0, NAN]))[3])
    assert np.isnan(equations.interpolate(np.array([NAN, 2.0, NAN, 3.0]))[0])


def test_a_step_beside_a_missing_one_is_not_interpolated() -> None:
    assert np.isnan(equations.interpolate(np.array([1.0, NAN, NAN, NAN, 5.0]))[1:4]).all()


def test_eq_12_the_mean_error_is_that_of_both_directions() -> None:
    assert equations.mean_error(np.array([1.0]), np.array([4.0])) == pytest.approx([2.5])


def test_eq_13_the_reversal_error_is_backward_minus_forward() -> None:
    assert equations.reversal_error(np.array([1.0]), np.array([4.0])) == pytest.approx([3.0])


def test_a_stack_of_tests_is_interpolated_test_by_test() -> None:
    stack = np.array([[1.0, NAN, 3.0], [10.0, NAN, 30.0]])
    assert equations.interpolate(stack)[:, 1] == pytest.approx([2.0, 20.0])


def test_the_chain_of_equations_agrees_with_exact_arithmetic() -> None:
    """Two blocks in two cycles, in µm, by fractions."""
    forward = [[Fraction(0), Fraction(1, 3)], [Fraction(5, 7), Fraction(2)]]
    backward = [[Fraction(-1, 2), Fraction(1, 4)], [Fraction(9, 5), Fraction(1, 6)]]
    xf = [sum(cycles) / 2 for cycles in forward]
    xb = [sum(cycles) / 2 for cycles in backward]
    at_2 = (xf[0] + xf[1]) / 2
    exact = {"XM": (at_2 + xb[0]) / 2, "XR": xb[0] - at_2}
    errors = np.array(
        [[float(each) for each in row] for pair in zip(forward, backward, strict=True) for row in pair]
    )
    means = equations.mean(errors)
    is_front = np.arange(4) % 2 == 0
    of_forward = equations.interpolate(np.where(is_front, means, np.nan))
    of_backward = equations.interpolate(np.where(is_front, np.nan, means))
    assert equations.mean_error(of_forward, of_backward)[1] == pytest.approx(float(exact["XM"]), rel=1e-15)
    assert equations.reversal_error(of_forward, of_backward)[1] == pytest.approx(
        float(exact["XR"]), rel=1e-15
    )
