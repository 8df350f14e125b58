"""Drifts of the environment: their course in time, and what they leave in a mean deviation."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from evaluation.uncertainty.budgets import MICROMETRE, contribution
from zlmreport.evaluation.uncertainty.budget import find_full_range
from zlmreport.evaluation.uncertainty.drift import (
    Drift,
    compute_mean_drift_variance,
    compute_reading_times,
    sample_drifts,
)
from zlmreport.plugin.extension import Acts, Distribution
from zlmreport.testing import bidirectional_test

#: One target from each side, three runs: six readings, one after the other.
TEST = bidirectional_test([0.0], [[0.0] * 3], [[0.0] * 3])
ORDER = np.arange(6) / 5
COUNT = 4_000


def drawn(kind: Drift, times: np.ndarray) -> np.ndarray:
    return sample_drifts(kind, times, COUNT, np.random.default_rng(3))


def test_a_range_is_that_of_the_rectangle_with_its_standard_uncertainty() -> None:
    drifting = contribution(1 / math.sqrt(12), Acts.IN_TIME, Distribution.RECTANGULAR)
    assert find_full_range(drifting) == pytest.approx(MICROMETRE)


def test_readings_have_their_own_times_as_shares_of_the_test() -> None:
    timed = replace(TEST, time=np.array([100.0, 101.0, 102.0, 103.0, 109.0, 110.0]))
    assert sorted(compute_reading_times(timed).ravel()) == pytest.approx([0.0, 0.1, 0.2, 0.3, 0.9, 1.0])


def test_where_one_reading_has_no_time_their_order_counts() -> None:
    timed = replace(TEST, time=np.array([100.0, 101.0, np.nan, 103.0, 109.0, 110.0]))
    assert sorted(compute_reading_times(timed).ravel()) == pytest.approx(ORDER)
    assert sorted(compute_reading_times(replace(TEST, time=None)).ravel()) == pytest.approx(ORDER)


def test_of_a_clock_that_stood_only_the_order_of_the_readings_is_left() -> None:
    timed = replace(TEST, time=np.full(6, 7.0))
    assert sorted(compute_reading_times(timed).ravel()) == pytest.approx(ORDER)


def test_readings_of_one_time_lie_evenly_up_to_the_next() -> None:
    of_runs = replace(TEST, time=np.array([100.0, 100.0, 100.0, 109.0, 109.0, 109.0]))
    assert sorted(compute_reading_times(of_runs).ravel()) == pytest.approx(ORDER)
    stood = replace(TEST, time=np.array([100.0, 101.0, 102.0, 102.0, 104.0, 104.0]))
    assert sorted(compute_reading_times(stood).ravel()) == pytest.approx(
        [0.0, 0.2, 0.4, 0.6, 0.8, 1.0], abs=1e-12
    )


def test_noise_fills_its_range_about_nothing_and_forgets_itself() -> None:
    found = drawn(Drift.NOISE, ORDER)
    assert found.shape == (COUNT, 6)
    assert -0.5 <= found.min() < -0.499
    assert 0.499 < found.max() <= 0.5
    assert np.corrcoef(found.T)[0, 1:] == pytest.approx(np.zeros(5), abs=4 / math.sqrt(COUNT))


def test_a_ramp_goes_up_or_down_by_its_range_over_the_test() -> None:
    found = drawn(Drift.RAMP, ORDER)
    rising = found[:, -1] > 0
    assert rising.mean() == pytest.approx(0.5, abs=4 * 0.5 / math.sqrt(COUNT))
    assert found[rising] == pytest.approx(np.broadcast_to(ORDER - 0.5, (rising.sum(), 6)))
    assert found[~rising] == pytest.approx(np.broadcast_to(0.5 - ORDER, ((~rising).sum(), 6)))


@pytest.mark.parametrize(("kind", "periods"), [(Drift.ONE_PERIOD, 1), (Drift.THREE_PERIODS, 3)])
def test_a_wave_has_its_range_and_its_periods_over_the_test(kind: Drift, periods: int) -> None:
    found = drawn(kind, np.linspace(0, 1, 241))
    assert np.ptp(found, axis=1) == pytest.approx(np.ones(COUNT), abs=2e-3)
    assert found.mean(axis=1) == pytest.approx(found[:, 0] / 241, abs=1e-9)  # whole periods
    assert found[:, 0] == pytest.approx(found[:, 240 // periods])
    assert found[:, 0].mean() == pytest.approx(0.0, abs=4 * 0.5 / math.sqrt(2 * COUNT))  # at any phase


def test_a_random_walk_has_its_range_over_the_test_and_steps_with_the_root_of_time() -> None:
    found = drawn(Drift.RANDOM_WALK, np.array([0.0, 0.1, 0.5, 1.0]))
    assert np.ptp(found, axis=1) == pytest.approx(np.ones(COUNT))
    assert not found[:, 0].any()  # it begins at the first reading
    steps = np.sqrt(np.mean(np.diff(found, axis=1) ** 2, axis=0))
    assert steps[2] > steps[1] > steps[0]
    assert steps[1] / steps[0] == pytest.approx(2.0, rel=0.25)  # √(0.4/0.1), but for what the range takes


def test_a_random_walk_walks_in_time_and_leaves_out_what_was_not_read() -> None:
    found = drawn(Drift.RANDOM_WALK, np.array([[1.0, np.nan], [0.0, 0.5]]))
    assert np.isnan(found[:, 0, 1]).all()
    assert not found[:, 1, 0].any()
    assert np.ptp(found[:, [0, 1, 1], [0, 0, 1]], axis=1) == pytest.approx(np.ones(COUNT))


def test_a_single_reading_does_not_walk() -> None:
    assert not drawn(Drift.RANDOM_WALK, np.zeros(1)).any()


def test_the_worst_kind_of_drift_is_left_in_a_mean() -> None:
    """At the beginning a ramp stands at half its range, always: no other kind leaves more than its 1/4."""
    times = np.array([[[0.0, 0.0], [0.5, 0.5]], [[0.0, 0.0], [1.0, 1.0]]])
    by_approach, both = compute_mean_drift_variance(times)
    assert by_approach[0] == pytest.approx(0.25)
    assert both[0] == pytest.approx(0.25)
    assert by_approach[1] >= 0.25
    assert both[1] < by_approach[1]


def test_a_mean_is_of_the_readings_that_there_are() -> None:
    by_approach, _ = compute_mean_drift_variance(np.array([[[0.0, np.nan]], [[0.0, 0.0]]]))
    assert by_approach == pytest.approx([0.25])


def test_what_was_read_from_one_side_only_is_disturbed_there() -> None:
    by_approach, _ = compute_mean_drift_variance(np.array([[[0.0, 0.0]], [[np.nan, np.nan]]]))
    assert by_approach == pytest.approx([0.25])
