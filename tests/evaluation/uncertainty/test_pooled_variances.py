"""Variances of few readings each: which inform each other, and by how much."""

from __future__ import annotations

import math

import numpy as np
import pytest

from zlmreport.evaluation.uncertainty.pooled_variances import (
    compute_digamma,
    compute_inverse_trigamma,
    compute_trigamma,
    pool_variances,
)

EULER = 0.5772156649015329
#: ψ′(2): the variance of ln s² of five readings (K. Pearson), by chance alone.
CHANCE = math.pi**2 / 6 - 1


def test_few_cells_are_pooled_by_their_freedom() -> None:
    variance, freedom = pool_variances(
        np.array([[1.0, 4.0, np.nan]]), np.array([[4.0, 2.0, 0.0]]), np.array([0.0, 0.1, 0.2])
    )
    assert variance == pytest.approx(np.full((1, 3), 2.0))
    assert freedom == pytest.approx(np.full((1, 3), 6.0))


def test_cells_that_differ_by_more_than_chance_are_each_drawn_to_their_common_scale() -> None:
    """Smyth's moments: ψ′(d₀/2) is what ln s² varies beyond ψ′(d/2), and ln s₀² its mean less ψ and ln."""
    logarithms = np.tile([-1.2, -0.4, 0.4, 1.2], 10)
    beyond = logarithms.var(ddof=1) * (1 + math.sqrt(2 / 39)) - CHANCE
    prior = 2 * compute_inverse_trigamma(beyond)
    variance, freedom = pool_variances(np.exp(logarithms)[np.newaxis], np.full((1, 40), 4.0), np.zeros(40))
    mean = -(compute_digamma(2.0) - math.log(2.0))
    scale = math.exp(mean + compute_digamma(prior / 2) - math.log(prior / 2))
    assert freedom == pytest.approx(np.full((1, 40), 4 + prior))
    assert variance[0] == pytest.approx((4 * np.exp(logarithms) + prior * scale) / (4 + prior))


@pytest.mark.parametrize(("deviations", "is_alone"), [(2.1, False), (2.3, True)])
def test_a_cell_stands_out_by_2_2_standard_deviations_of_chance(deviations: float, *, is_alone: bool) -> None:
    variances = np.ones((2, 11))
    variances[1, 4] = math.exp(deviations * math.sqrt(CHANCE))
    variance, freedom = pool_variances(variances, np.full((2, 11), 4.0), np.zeros(11))
    alone, common = (variances[1, 4], 1.0), ((21 + variances[1, 4]) / 22,) * 2
    assert (variance[1, 4], variance[0, 0]) == pytest.approx(alone if is_alone else common)
    assert (freedom[1, 4], freedom[0, 0]) == pytest.approx((4, 84) if is_alone else (88, 88))


@pytest.mark.parametrize(("deviations", "is_alone"), [(1.5, False), (1.6, True)])
def test_a_position_stands_out_by_both_directions_together(deviations: float, *, is_alone: bool) -> None:
    """Of two the mean scatters by 1/√2 of one: 2.2/√2 = 1.556. What they tell of their common s is joined."""
    variances = np.ones((2, 11))
    variances[:, 4] = math.exp(deviations * math.sqrt(CHANCE))
    variance, freedom = pool_variances(variances, np.full((2, 11), 4.0), np.zeros(11))
    assert (freedom[:, 4] == 8.0).all() is np.bool_(is_alone)
    if is_alone:
        assert variance[:, 4] == pytest.approx(variances[:, 4])
        assert freedom[:, 0] == pytest.approx(np.full(2, 80.0))


def test_directions_that_scatter_each_by_its_own_at_a_position_are_not_joined() -> None:
    variances = np.ones((2, 11))
    variances[:, 4] = 10.0, 1000.0
    variance, freedom = pool_variances(variances, np.full((2, 11), 4.0), np.zeros(11))
    assert variance[:, 4] == pytest.approx([10.0, 1000.0])
    assert freedom[:, 4] == pytest.approx([4.0, 4.0])


def test_a_small_scatter_does_not_stand_out() -> None:
    variances = np.ones((2, 11))
    variances[0, 0] = 0.1
    _, freedom = pool_variances(variances, np.full((2, 11), 4.0), np.zeros(11))
    assert freedom == pytest.approx(np.full((2, 11), 88.0))


def test_three_of_ten_may_stand_out_and_the_fourth_is_the_rule() -> None:
    variances = np.array([[1.0] * 6 + [1e4, 1e6, 1e8, 1e10]])
    _, freedom = pool_variances(variances, np.full((1, 10), 4.0), np.zeros(10))
    assert (freedom[0, 7:] == 4.0).all()
    assert (freedom[0, :7] != 4.0).all()


@pytest.mark.parametrize(("slope", "grows"), [(1.55, False), (1.70, True), (-1.55, False), (-1.70, True)])
def test_scatter_grows_where_its_slope_is_three_standard_errors(slope: float, *, grows: bool) -> None:
    """Of 22 cells from −0.5 to 0.5: Σx² = 2.2, and u of the slope √(0.645/2.2) = 0.541."""
    positions = np.linspace(-0.5, 0.5, 11)
    growing = np.broadcast_to(np.exp(slope * positions), (2, 11)).copy()
    variance, _ = pool_variances(growing, np.full((2, 11), 4.0), positions)
    assert (variance == pytest.approx(growing)) is grows


def test_the_functions_of_variances_agree_with_what_is_known_of_them() -> None:
    assert [compute_trigamma(x) for x in (0.5, 1.0, 2.0)] == pytest.approx(
        [math.pi**2 / 2, math.pi**2 / 6, math.pi**2 / 6 - 1], abs=1e-7
    )
    assert compute_trigamma(60.0) == pytest.approx(
        math.pi**2 / 6 - sum(1 / n**2 for n in range(1, 60)), abs=1e-10
    )
    assert [compute_digamma(x) for x in (1.0, 0.5)] == pytest.approx(
        [-EULER, -EULER - 2 * math.log(2)], abs=1e-5
    )
    assert [compute_inverse_trigamma(y) for y in (math.pi**2 / 2, math.pi**2 / 6)] == pytest.approx(
        [0.5, 1.0]
    )
    assert compute_inverse_trigamma(1e-5) == pytest.approx(1e5 + 0.5, rel=1e-6)


def test_scatter_that_grows_along_the_axis_is_pooled_about_its_growth() -> None:
    """ln σ² = 4x: its slope is known to ψ′(2)/Σx² = 0.293, which adds 0.073 to ψ′(44) at the ends."""
    positions = np.linspace(-0.5, 0.5, 11)
    growing = np.broadcast_to(np.exp(4 * positions), (2, 11)).copy()
    variance, freedom = pool_variances(growing, np.full((2, 11), 4.0), positions)
    assert variance == pytest.approx(growing, rel=1e-9)
    assert freedom.max() == pytest.approx(88.0)  # 22 places with 4 each
    assert freedom.min() == pytest.approx(21.8, abs=0.1)  # ψ′(10.9) = 0.096
    assert np.argmin(freedom[0]) in {0, 10}  # farthest from the middle, where the slope is known worst


def test_equal_variances_grow_nowhere() -> None:
    variance, freedom = pool_variances(np.full((2, 11), 2.5), np.full((2, 11), 4.0), np.linspace(0, 1, 11))
    assert variance == pytest.approx(np.full((2, 11), 2.5))
    assert freedom == pytest.approx(np.full((2, 11), 88.0))
