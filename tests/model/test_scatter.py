"""Repeats: the noise floor, unequal scatter, and readings that stand off."""

from __future__ import annotations

import numpy as np
import pytest

from model.axis_tests import SIGMA, linear_test, noise, pendulum_test
from model.worlds import lasting_noise
from zlmreport.model.fitting.repeats import (
    SpreadFactor,
    compute_weights,
    estimate_lasting_floor,
    estimate_noise_floor,
    is_apart_in_time,
    list_spread_tests,
)
from zlmreport.plugin import FloatArray

DESIGN = linear_test()
PENDULUM = pendulum_test()


def test_repeats_lie_apart_in_time_by_the_linear_method_only() -> None:
    assert is_apart_in_time(DESIGN)
    assert not is_apart_in_time(PENDULUM)


@pytest.mark.parametrize("design", [DESIGN, PENDULUM], ids=["linear", "pendulum"])
def test_noise_floor_is_the_noise(design: object) -> None:
    floors = [estimate_noise_floor(design, noise(design, seed)) for seed in range(30)]  # type: ignore[arg-type]
    # 30 tests of 168 degrees of freedom know σ to 1 %; comparing neighbours costs some of it.
    assert np.sqrt(np.mean(np.square(floors))) == pytest.approx(SIGMA, rel=0.04)


def test_slow_drift_is_not_in_the_noise_floor() -> None:
    drift = 20e-6 * DESIGN.time / DESIGN.duration
    found = estimate_noise_floor(DESIGN, noise(DESIGN) + drift)
    assert found == pytest.approx(estimate_noise_floor(DESIGN, noise(DESIGN)), rel=0.05)


def test_noise_that_lasts_over_a_few_readings_is_in_the_lasting_floor_alone() -> None:
    readings = lasting_noise(DESIGN, 0.6)
    scatter = float(np.std(readings))
    assert estimate_noise_floor(DESIGN, readings) < 0.75 * scatter  # type: ignore[operator]
    assert estimate_lasting_floor(DESIGN, readings) == pytest.approx(scatter, rel=0.15)


def test_slow_drift_is_not_in_the_lasting_floor() -> None:
    drift = 3e-6 * np.sin(2 * np.pi * DESIGN.time / DESIGN.duration)
    found = estimate_lasting_floor(DESIGN, noise(DESIGN) + drift)
    assert found == pytest.approx(estimate_noise_floor(DESIGN, noise(DESIGN)), rel=0.15)


def test_geometry_is_not_in_the_noise_floor() -> None:
    shape = 50e-6 * np.sin(9 * DESIGN.position) + 5e-6 * DESIGN.direction
    assert estimate_noise_floor(DESIGN, noise(DESIGN) + shape) == pytest.approx(
        estimate_noise_floor(DESIGN, noise(DESIGN)), rel=1e-6
    )


def test_a_single_run_has_no_noise_floor() -> None:
    design = linear_test(runs=1)
    assert estimate_noise_floor(design, noise(design)) is None


@pytest.mark.parametrize("target", [0, 10, 20])
def test_a_jump_of_the_zero_while_one_target_is_measured_is_no_scatter(target: int) -> None:
    block = np.flatnonzero(PENDULUM.target == target)
    jump = 20 * SIGMA * (np.arange(len(PENDULUM.target)) > block[len(block) // 2])
    readings = noise(PENDULUM) + jump
    assert estimate_noise_floor(PENDULUM, readings) == pytest.approx(SIGMA, rel=0.1)
    assert np.array_equal(compute_weights(PENDULUM, readings), np.ones(len(readings)))


def test_a_last_digit_that_changes_while_one_target_is_measured_is_scatter() -> None:
    block = np.flatnonzero(PENDULUM.target == 10)
    readings = np.zeros(len(PENDULUM.target))
    readings[block[len(block) // 2 :]] = 1e-7
    assert estimate_noise_floor(PENDULUM, readings) > 0.0  # type: ignore[operator]


WIDE = (DESIGN.target >= 8) & (DESIGN.target < 14)


def _uneven(factor: float) -> FloatArray:
    return noise(DESIGN) * np.where(WIDE, factor, 1.0)


def test_equal_scatter_has_equal_weights() -> None:
    assert np.array_equal(compute_weights(DESIGN, noise(DESIGN)), np.ones(len(DESIGN.position)))


def test_targets_that_scatter_more_have_larger_variances() -> None:
    found = compute_weights(DESIGN, _uneven(4.0))
    wide, narrow = found[WIDE].mean(), found[~WIDE].mean()
    assert 6 < wide / narrow < 20  # 16 in truth, drawn to the pooled variance
    assert found.mean() == pytest.approx(1.0, rel=1e-12)


def test_a_direction_that_scatters_more_has_larger_variances() -> None:
    found = compute_weights(DESIGN, noise(DESIGN) * np.where(DESIGN.direction > 0, 3.0, 1.0))
    assert found[DESIGN.direction > 0].mean() > 5 * found[DESIGN.direction < 0].mean()


@pytest.mark.parametrize("ends", [(0.3, 2.0), (2.0, 0.3)], ids=["growing", "shrinking"])
def test_scatter_that_grows_along_the_axis_is_known_at_both_ends(ends: tuple[float, float]) -> None:
    first, last = ends
    ratios = []
    for seed in range(30):
        design = linear_test(targets=11, seed=seed)
        way = (design.position - design.position.min()) / np.ptp(design.position)
        found = compute_weights(design, noise(design, seed) * first * (last / first) ** way)
        ratios.append(found[design.target == 10].mean() / found[design.target == 0].mean())
    # In truth 44 times the variance, or its 44th part; the median of 30 estimates of ln σ² knows it to 15 %.
    assert np.median(ratios) == pytest.approx((last / first) ** 2, rel=0.45)


@pytest.mark.long
def test_even_scatter_grows_in_one_test_of_a_hundred() -> None:
    p_values = [list_spread_tests(DESIGN, noise(DESIGN, seed))[0].p_value for seed in range(200)]
    assert list_spread_tests(DESIGN, noise(DESIGN))[0].factor is SpreadFactor.GROWTH
    assert sum(p < 0.01 for p in p_values) <= 7  # 2 expected; 8 by chance in a test of a thousand
    assert 8 <= sum(p < 0.1 for p in p_values) <= 34  # 20 expected, with a standard deviation of 4.2


def test_readings_without_any_scatter_are_not_weighted() -> None:
    smooth = 10e-6 * np.cos(3 * DESIGN.position)
    assert np.array_equal(
        compute_weights(DESIGN, smooth + 1e-21 * noise(DESIGN)), np.ones(len(DESIGN.position))
    )


def test_a_fan_that_opens_with_time_is_no_scatter() -> None:
    fan = 10e-6 * DESIGN.position * DESIGN.time / DESIGN.duration
    by_position = next(
        each
        for each in list_spread_tests(DESIGN, noise(DESIGN) + fan)
        if each.factor is SpreadFactor.POSITION
    )
    assert by_position.p_value > 0.01


def test_where_it_scatters_most_is_named() -> None:
    found = list_spread_tests(DESIGN, noise(DESIGN) * np.where(DESIGN.run == 3, 4.0, 1.0))
    by_run = next(each for each in found if each.factor is SpreadFactor.RUN)
    assert by_run.widest == 3
    assert by_run.p_value < 0.01


def test_of_two_runs_none_scatters_more_than_the_other() -> None:
    design = linear_test(runs=2)
    found = list_spread_tests(design, noise(design) * np.where(design.run == 2, 4.0, 1.0))
    assert SpreadFactor.RUN not in {each.factor for each in found}
