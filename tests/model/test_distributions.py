"""Tails and quantiles against closed forms, and against values that every table has."""

from __future__ import annotations

import math

import pytest

from zlmreport.model.fitting.distributions import chi_square_tail, f_tail, gamma_tail, normal_tail, t_quantile


@pytest.mark.parametrize("x", [0.1, 1.0, 5.0, 60.0, 600.0])
def test_chi_square_of_two_degrees_is_exponential(x: float) -> None:
    assert chi_square_tail(x, 2) == pytest.approx(math.exp(-x / 2), rel=1e-12)


@pytest.mark.parametrize("shape", [1, 2, 5, 40])
@pytest.mark.parametrize("x", [0.3, 4.0, 45.0])
def test_gamma_of_whole_shape_is_a_sum_of_poisson_terms(shape: int, x: float) -> None:
    expected = math.exp(-x) * sum(x**k / math.factorial(k) for k in range(shape))
    assert gamma_tail(shape, x) == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("ratio", [0.2, 1.0, 7.0, 300.0])
def test_f_of_two_numerator_degrees_is_a_power(ratio: float) -> None:
    assert f_tail(ratio, 2, 9) == pytest.approx((1 + 2 * ratio / 9) ** -4.5, rel=1e-12)


def test_f_of_one_numerator_degree_is_the_square_of_t() -> None:
    assert f_tail(t_quantile(0.95, 12) ** 2, 1, 12) == pytest.approx(0.05, rel=1e-12)


@pytest.mark.parametrize("probability", [0.5, 0.9, 0.99])
def test_t_of_one_degree_is_a_tangent(probability: float) -> None:
    assert t_quantile(probability, 1) == pytest.approx(math.tan(math.pi * probability / 2), rel=1e-10)


@pytest.mark.parametrize(
    ("found", "printed"),
    [
        (chi_square_tail(3.841, 1), 0.050),
        (chi_square_tail(18.307, 10), 0.050),
        (normal_tail(1.960), 0.025),
        (t_quantile(0.95, 10), 2.228),
        (t_quantile(0.99, 30), 2.750),
    ],
)
def test_tables(found: float, printed: float) -> None:
    assert found == pytest.approx(printed, abs=5e-4)


@pytest.mark.parametrize("tail", [lambda x: chi_square_tail(x, 3), lambda x: f_tail(x, 4, 20)])
def test_nothing_is_exceeded_for_certain(tail: object) -> None:
    assert callable(tail)
    assert (tail(0.0), tail(-1.0)) == (1.0, 1.0)


def test_tails_far_out_are_small_and_not_zero() -> None:
    assert 0 < f_tail(1e3, 30, 100) < 1e-100
    assert 0 < chi_square_tail(800.0, 5) < 1e-160
