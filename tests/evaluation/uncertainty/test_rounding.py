"""The last digit of readings, where it hides the scatter of the axis."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from evaluation.uncertainty.budgets import ISO, MICROMETRE, contribution, expanded, uncertainties
from zlmreport.evaluation.uncertainty.axis_interval import compute_axis_intervals
from zlmreport.evaluation.uncertainty.expanded import compute_mean_uncertainty
from zlmreport.evaluation.uncertainty.rounding import find_hiding_resolution, sample_axes, sample_rounding
from zlmreport.plugin import MeasurementSet, Options
from zlmreport.plugin.extension import Acts, Distribution
from zlmreport.plugin.renderer import Budget
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import simulated_test

STEP = 1.0  # µm
RESOLUTION = replace(
    contribution(STEP / 12**0.5, Acts.AT_EACH_READING, Distribution.RECTANGULAR), contributor="resolution"
)
BUDGET = Budget((RESOLUTION,))
TRIALS = 1000


def quiet(scatter: float, seed: int = 3) -> tuple[MeasurementSet, MeasurementSet]:
    """Return a test of an axis that scatters so much, µm, before its readings were rounded, and after."""
    test = simulated_test(11)
    generator = np.random.default_rng(seed)
    means = np.nanmean(test.deviations(), axis=-1)[np.where(test.approach > 0, 0, 1), test.target]
    true = means + scatter * MICROMETRE * generator.standard_normal(means.shape)
    shown = np.round(true / (STEP * MICROMETRE)) * STEP * MICROMETRE
    return replace(test, deviation=true), replace(test, deviation=shown)


def test_a_scatter_that_rounding_made_is_no_more_than_its_uncertainty() -> None:
    """Means between two steps are shown with s up to 0.55 µm, where the axis has 0.05 µm."""
    true, shown = quiet(0.05)
    of_true, of_shown = (evaluate(ISO, each, Options(), {}) for each in (true, shown))
    found = uncertainties(BUDGET, shown, trials=TRIALS)

    assert (of_shown.value("R_fwd") or 0.0) > 5 * (of_true.value("R_fwd") or 0.0)
    for each in of_true.parameters:
        symbol = each.quantity.symbol
        assert abs((of_shown.value(symbol) or 0.0) - each.value) < found[symbol] * MICROMETRE, symbol


def test_runs_that_are_rounded_alike_do_not_average_it_away() -> None:
    """A mean of five equal readings is known to d/√12, and not to d/√60."""
    test = quiet(0.0)[1]
    found = compute_mean_uncertainty(evaluate(ISO, test, Options(), {}), BUDGET)

    assert found.by_approach == pytest.approx(2 * STEP / 12**0.5 * MICROMETRE, rel=0.1)
    assert found.bidirectional == pytest.approx(2 * STEP / 24**0.5 * MICROMETRE, rel=0.1)


def test_equal_readings_have_no_scatter_that_their_step_would_show() -> None:
    readings = quiet(0.0)[1].deviations()
    axes = sample_axes(RESOLUTION, readings, TRIALS, np.random.default_rng(1))

    assert np.quantile(axes.sigma, 0.9) < 0.1 * STEP * MICROMETRE


@pytest.mark.parametrize("scatter", [0.2, 0.5, 1.0])
def test_the_scatter_behind_rounded_readings_is_found_again(scatter: float) -> None:
    readings = quiet(scatter)[1].deviations()
    axes = sample_axes(RESOLUTION, readings, TRIALS, np.random.default_rng(1))

    assert float(np.median(axes.sigma)) == pytest.approx(scatter * MICROMETRE, rel=0.25)


def test_rounding_moves_no_reading_by_more_than_half_a_step() -> None:
    readings = quiet(0.3)[1].deviations()
    readings = np.where(np.arange(readings.size).reshape(readings.shape) % 7 == 0, np.nan, readings)
    before, shown = sample_rounding(RESOLUTION, readings, TRIALS, np.random.default_rng(1))

    assert np.array_equal(np.isnan(before[0]), np.isnan(readings))
    assert np.nanmax(np.abs(shown - before)) <= STEP / 2 * MICROMETRE * (1 + 1e-9)


def test_a_scatter_of_several_steps_hides_nothing() -> None:
    assert find_hiding_resolution(BUDGET, quiet(3.0)[1].deviations()) is None
    assert find_hiding_resolution(BUDGET, quiet(0.3)[1].deviations()) is RESOLUTION


def test_the_next_test_is_rounded_too() -> None:
    """Equal readings everywhere are no axis that always shows the same: its means may lie near a step."""
    shown = quiet(0.0)[1]
    evaluation = evaluate(ISO, shown, Options(), {})
    arithmetic = partial(ISO.arithmetic, options=Options())
    (found,) = compute_axis_intervals([(evaluation, arithmetic)], TRIALS, BUDGET)

    low, high = found["R_fwd"]
    assert low == 0.0
    assert high > STEP * MICROMETRE


def test_a_coarser_step_makes_a_larger_uncertainty_of_every_parameter() -> None:
    shown = quiet(0.3)[1]
    fine = replace(RESOLUTION, standard_uncertainty=RESOLUTION.standard_uncertainty / 10)
    coarse, finer = (expanded(Budget((each,)), shown, trials=TRIALS) for each in (RESOLUTION, fine))

    assert all(coarse[symbol].uncertainty > each.uncertainty for symbol, each in finer.items())
