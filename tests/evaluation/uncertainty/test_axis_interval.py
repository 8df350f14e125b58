"""Where the next test of the same axis would come out: scatter read back from tests made of known parts."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import pytest

from evaluation.uncertainty.budgets import ISO
from zlmreport.evaluation.evaluate import evaluate
from zlmreport.evaluation.uncertainty.axis_interval import (
    _digamma,
    _inverse_trigamma,
    _make_interval,
    _pool,
    _scatter_of,
    _trigamma,
    compute_axis_intervals,
)
from zlmreport.job.types import Options
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.testing import bidirectional_test

EULER = 0.5772156649015329
RUNS = 40
PAIRS = 20_000
#: Quantiles of so many pairs, each taken both ways, scatter by 1.3 %; how well a scatter is known adds to it.
BY_CHANCE = 0.05
#: Of 95 %: of the normal distribution, for a scatter that is known well; of t with 39 degrees of freedom.
NORMAL, STUDENT = 1.960, 2.023
MICROMETRE = 1e-6
#: ψ′(2): the variance of ln s² of five readings (K. Pearson), by chance alone.
CHANCE = math.pi**2 / 6 - 1
#: Deviations of 40 runs whose mean is 0 and whose standard deviation is 1 µm.
UNIT = np.tile([1.0, -1.0], RUNS // 2) * math.sqrt((RUNS - 1) / RUNS)


def intervals(test: MeasurementSet) -> dict[str, tuple[float, float]]:
    """Return lower and upper ends, less the value, of every parameter of ISO 230-2, µm."""
    evaluation = evaluate(ISO, test, Options(), {})
    (found,) = compute_axis_intervals([(evaluation, partial(ISO.arithmetic, options=Options()))], PAIRS)
    value = {each.quantity.symbol: each.value for each in evaluation.parameters}
    return {
        name: ((low - value[name]) / MICROMETRE, (high - value[name]) / MICROMETRE)
        for name, (low, high) in found.items()
    }


def between(positive: np.ndarray, negative: np.ndarray) -> MeasurementSet:
    """Return a test of two targets, the second 500 µm from the first."""
    far = np.array([[0.0], [500.0]])
    return bidirectional_test([0.0, 100.0], positive + far, negative + far)


OPPOSITE = np.stack([UNIT, -UNIT])
ALIKE = np.stack([UNIT, UNIT])


def about_nothing(width: float) -> tuple[object, object]:
    return pytest.approx(-width, rel=BY_CHANCE), pytest.approx(width, rel=BY_CHANCE)


def test_scatter_of_readings_is_found_where_no_run_stands_apart() -> None:
    """Two targets that deviate oppositely: s² = Σe²/(n − 1) about means of runs that took half of it away."""
    found = _scatter_of(between(OPPOSITE, OPPOSITE).deviations(), np.array([0.0, 0.1]))
    assert found is not None
    assert found.variance / MICROMETRE**2 == pytest.approx(np.full((2, 2), 2.0))
    assert found.freedom == pytest.approx(np.full((2, 2), 4 * (RUNS - 1.0)))
    assert found.mean / MICROMETRE == pytest.approx(np.array([[0.0, 500.0]] * 2))
    assert found.run_variance == pytest.approx([0.0, 0.0], abs=1e-20)


@pytest.mark.parametrize(("negative", "correlation"), [(ALIKE, 1.0), (-ALIKE, -1.0), (0 * ALIKE, 0.0)])
def test_scatter_of_runs_is_found_where_targets_deviate_alike(
    negative: np.ndarray, correlation: float
) -> None:
    found = _scatter_of(between(2 * ALIKE, negative).deviations(), np.array([0.0, 0.1]))
    assert found is not None
    assert found.variance == pytest.approx(np.zeros((2, 2)), abs=1e-20)
    assert found.run_variance[0] / MICROMETRE**2 == pytest.approx(4.0)
    assert found.run_freedom == pytest.approx([RUNS - 1, RUNS - 1])
    assert found.correlation == pytest.approx(correlation)


def test_a_gap_takes_a_reading_and_nothing_else() -> None:
    positive = OPPOSITE.copy()
    positive[1, 39] = np.nan
    found = _scatter_of(between(positive, OPPOSITE).deviations(), np.array([0.0, 0.1]))
    assert found is not None
    assert found.freedom == pytest.approx(np.full((2, 2), 4 * (RUNS - 1.0) - 1))
    assert found.mean[0, 1] / MICROMETRE == pytest.approx(500 - UNIT[0] / 39)
    assert found.run_variance[0] / MICROMETRE**2 == pytest.approx(UNIT[0] ** 2 / (RUNS - 1), rel=0.01)


def test_one_target_has_all_its_scatter_from_the_run() -> None:
    one = bidirectional_test([0.0], [UNIT], [UNIT])
    found = _scatter_of(one.deviations(), one.target_positions)
    assert found is not None
    assert not found.variance.any()
    assert found.run_variance / MICROMETRE**2 == pytest.approx([1.0, 1.0])


def test_one_run_tells_nothing_of_the_scatter() -> None:
    assert intervals(bidirectional_test([0.0, 100.0], [[0.0], [1.0]], [[0.0], [2.0]])) == {}


def test_readings_that_share_no_run_tell_nothing_of_it() -> None:
    nothing = np.full((2, 3), np.nan)
    single = nothing.copy()
    single[0, 0] = single[1, 1] = 1.0
    assert _scatter_of(np.stack([single, nothing]), np.array([0.0, 0.1])) is None


def test_the_next_range_differs_by_the_scatter_of_its_means_in_both_tests() -> None:
    """u² of a mean is 2/n µm², of a range of two 4/n, of the difference between two tests 8/n."""
    found = intervals(between(OPPOSITE, OPPOSITE))
    assert found["E_fwd"] == about_nothing(NORMAL * math.sqrt(8 / RUNS))
    assert found["M"] == about_nothing(NORMAL * math.sqrt(4 / RUNS))


def test_the_next_reversal_differs_by_what_runs_of_one_direction_share() -> None:
    found = intervals(between(ALIKE, 0 * ALIKE))
    assert found["B_mean"] == about_nothing(STUDENT * math.sqrt(2 / RUNS))
    assert found["E_fwd"] == pytest.approx((0.0, 0.0), abs=1e-6)  # both targets move alike


def test_what_both_directions_share_hardly_reaches_the_reversal_and_the_opposite_twice() -> None:
    alike, against = intervals(between(ALIKE, ALIKE)), intervals(between(ALIKE, -ALIKE))
    assert against["B_mean"] == about_nothing(STUDENT * math.sqrt(8 / RUNS))
    assert alike["B_mean"][1] < against["B_mean"][1] / 8


def test_what_cannot_be_negative_ends_at_nothing_and_the_rest_goes_below() -> None:
    found = intervals(between(OPPOSITE, OPPOSITE))  # B and its mean are 0
    assert found["B"][0] == 0.0 < found["B"][1]
    assert found["B_mean"][0] < 0.0


def test_the_interval_is_of_this_test_and_comes_out_alike_again() -> None:
    test = between(OPPOSITE, OPPOSITE)
    assert intervals(test) == intervals(test)


def test_few_cells_are_pooled_by_their_freedom() -> None:
    variance, freedom = _pool(
        np.array([[1.0, 4.0, np.nan]]), np.array([[4.0, 2.0, 0.0]]), np.array([0.0, 0.1, 0.2])
    )
    assert variance == pytest.approx(np.full((1, 3), 2.0))
    assert freedom == pytest.approx(np.full((1, 3), 6.0))


def test_cells_that_differ_by_more_than_chance_are_each_drawn_to_their_common_scale() -> None:
    """Smyth's moments: ψ′(d₀/2) is what ln s² varies beyond ψ′(d/2), and ln s₀² its mean less ψ and ln."""
    logarithms = np.tile([-1.2, -0.4, 0.4, 1.2], 10)
    beyond = logarithms.var(ddof=1) * (1 + math.sqrt(2 / 39)) - CHANCE
    prior = 2 * _inverse_trigamma(beyond)
    variance, freedom = _pool(np.exp(logarithms)[np.newaxis], np.full((1, 40), 4.0), np.zeros(40))
    mean = -(_digamma(2.0) - math.log(2.0))
    scale = math.exp(mean + _digamma(prior / 2) - math.log(prior / 2))
    assert freedom == pytest.approx(np.full((1, 40), 4 + prior))
    assert variance[0] == pytest.approx((4 * np.exp(logarithms) + prior * scale) / (4 + prior))


@pytest.mark.parametrize(("deviations", "is_alone"), [(2.1, False), (2.3, True)])
def test_a_cell_stands_out_by_2_2_standard_deviations_of_chance(deviations: float, *, is_alone: bool) -> None:
    variances = np.ones((2, 11))
    variances[1, 4] = math.exp(deviations * math.sqrt(CHANCE))
    variance, freedom = _pool(variances, np.full((2, 11), 4.0), np.zeros(11))
    alone, common = (variances[1, 4], 1.0), ((21 + variances[1, 4]) / 22,) * 2
    assert (variance[1, 4], variance[0, 0]) == pytest.approx(alone if is_alone else common)
    assert (freedom[1, 4], freedom[0, 0]) == pytest.approx((4, 84) if is_alone else (88, 88))


@pytest.mark.parametrize(("deviations", "is_alone"), [(1.5, False), (1.6, True)])
def test_a_position_stands_out_by_both_directions_together(deviations: float, *, is_alone: bool) -> None:
    """Of two the mean scatters by 1/√2 of one: 2.2/√2 = 1.556. What they tell of their common s is joined."""
    variances = np.ones((2, 11))
    variances[:, 4] = math.exp(deviations * math.sqrt(CHANCE))
    variance, freedom = _pool(variances, np.full((2, 11), 4.0), np.zeros(11))
    assert (freedom[:, 4] == 8.0).all() is np.bool_(is_alone)
    if is_alone:
        assert variance[:, 4] == pytest.approx(variances[:, 4])
        assert freedom[:, 0] == pytest.approx(np.full(2, 80.0))


def test_directions_that_scatter_each_by_its_own_at_a_position_are_not_joined() -> None:
    variances = np.ones((2, 11))
    variances[:, 4] = 10.0, 1000.0
    variance, freedom = _pool(variances, np.full((2, 11), 4.0), np.zeros(11))
    assert variance[:, 4] == pytest.approx([10.0, 1000.0])
    assert freedom[:, 4] == pytest.approx([4.0, 4.0])


def test_a_small_scatter_does_not_stand_out() -> None:
    variances = np.ones((2, 11))
    variances[0, 0] = 0.1
    _, freedom = _pool(variances, np.full((2, 11), 4.0), np.zeros(11))
    assert freedom == pytest.approx(np.full((2, 11), 88.0))


def test_three_of_ten_may_stand_out_and_the_fourth_is_the_rule() -> None:
    variances = np.array([[1.0] * 6 + [1e4, 1e6, 1e8, 1e10]])
    _, freedom = _pool(variances, np.full((1, 10), 4.0), np.zeros(10))
    assert (freedom[0, 7:] == 4.0).all()
    assert (freedom[0, :7] != 4.0).all()


@pytest.mark.parametrize(("slope", "grows"), [(1.55, False), (1.70, True), (-1.55, False), (-1.70, True)])
def test_scatter_grows_where_its_slope_is_three_standard_errors(slope: float, *, grows: bool) -> None:
    """Of 22 cells from −0.5 to 0.5: Σx² = 2.2, and u of the slope √(0.645/2.2) = 0.541."""
    positions = np.linspace(-0.5, 0.5, 11)
    growing = np.broadcast_to(np.exp(slope * positions), (2, 11)).copy()
    variance, _ = _pool(growing, np.full((2, 11), 4.0), positions)
    assert (variance == pytest.approx(growing)) is grows


def test_the_functions_of_variances_agree_with_what_is_known_of_them() -> None:
    assert [_trigamma(x) for x in (0.5, 1.0, 2.0)] == pytest.approx(
        [math.pi**2 / 2, math.pi**2 / 6, math.pi**2 / 6 - 1], abs=1e-7
    )
    assert _trigamma(60.0) == pytest.approx(math.pi**2 / 6 - sum(1 / n**2 for n in range(1, 60)), abs=1e-10)
    assert [_digamma(x) for x in (1.0, 0.5)] == pytest.approx([-EULER, -EULER - 2 * math.log(2)], abs=1e-5)
    assert [_inverse_trigamma(y) for y in (math.pi**2 / 2, math.pi**2 / 6)] == pytest.approx([0.5, 1.0])
    assert _inverse_trigamma(1e-5) == pytest.approx(1e5 + 0.5, rel=1e-6)


def test_a_value_that_reached_nothing_in_a_drawn_test_does_not_go_below() -> None:
    drawn = np.array([0.0, 2.0]), np.array([2.0, 0.0])
    assert _make_interval(1.0, *drawn) == pytest.approx((0.0, 3.0), rel=0.1)
    assert _make_interval(1.0, drawn[0] - 0.1, drawn[1])[0] < -1.0
