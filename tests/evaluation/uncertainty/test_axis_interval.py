"""Where the next test of the same axis would come out: scatter read back from tests made of known parts."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import pytest

from evaluation.uncertainty.budgets import ISO
from zlmreport.evaluation.uncertainty.axis_interval import (
    compute_axis_intervals,
    estimate_scatter,
)
from zlmreport.plugin import MeasurementSet, Options
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import bidirectional_test

RUNS = 40
PAIRS = 20_000
#: Quantiles of so many pairs, each taken both ways, scatter by 1.3 %; how well a scatter is known adds to it.
BY_CHANCE = 0.05
#: Of 95 %: of the normal distribution, for a scatter that is known well; of t with 39 degrees of freedom.
NORMAL, STUDENT = 1.960, 2.023
MICROMETRE = 1e-6
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
    found = estimate_scatter(between(OPPOSITE, OPPOSITE).deviations(), np.array([0.0, 0.1]))
    assert found.variance / MICROMETRE**2 == pytest.approx(np.full((2, 2), 2.0))
    assert found.freedom == pytest.approx(np.full((2, 2), 4 * (RUNS - 1.0)))
    assert found.mean / MICROMETRE == pytest.approx(np.array([[0.0, 500.0]] * 2))
    assert found.run_variance == pytest.approx([0.0, 0.0], abs=1e-20)


@pytest.mark.parametrize(("negative", "correlation"), [(ALIKE, 1.0), (-ALIKE, -1.0), (0 * ALIKE, 0.0)])
def test_scatter_of_runs_is_found_where_targets_deviate_alike(
    negative: np.ndarray, correlation: float
) -> None:
    found = estimate_scatter(between(2 * ALIKE, negative).deviations(), np.array([0.0, 0.1]))
    assert found.variance == pytest.approx(np.zeros((2, 2)), abs=1e-20)
    assert found.run_variance[0] / MICROMETRE**2 == pytest.approx(4.0)
    assert found.run_freedom == pytest.approx([RUNS - 1, RUNS - 1])
    assert found.correlation == pytest.approx(correlation)


def test_a_gap_takes_a_reading_and_nothing_else() -> None:
    positive = OPPOSITE.copy()
    positive[1, 39] = np.nan
    found = estimate_scatter(between(positive, OPPOSITE).deviations(), np.array([0.0, 0.1]))
    assert found.freedom == pytest.approx(np.full((2, 2), 4 * (RUNS - 1.0) - 1))
    assert found.mean[0, 1] / MICROMETRE == pytest.approx(500 - UNIT[0] / 39)
    assert found.run_variance[0] / MICROMETRE**2 == pytest.approx(UNIT[0] ** 2 / (RUNS - 1), rel=0.01)


def test_one_target_has_all_its_scatter_from_the_run() -> None:
    one = bidirectional_test([0.0], [UNIT], [UNIT])
    found = estimate_scatter(one.deviations(), one.target_positions)
    assert not found.variance.any()
    assert found.run_variance / MICROMETRE**2 == pytest.approx([1.0, 1.0])


def test_one_run_tells_nothing_of_the_scatter() -> None:
    assert intervals(bidirectional_test([0.0, 100.0], [[0.0], [1.0]], [[0.0], [2.0]])) == {}


def test_readings_that_share_no_run_tell_nothing_of_it() -> None:
    nothing = np.full((2, 3), np.nan)
    single = nothing.copy()
    single[0, 0] = single[1, 1] = 1.0
    assert estimate_scatter(np.stack([single, nothing]), np.array([0.0, 0.1])) is None


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
