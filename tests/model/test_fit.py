"""The fit: recovery, an independent computation, given values, uncertainty."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import (
    EFFECTS,
    SIGMA,
    USUAL,
    hidden,
    known,
    linear_test,
    model_of,
    noise,
    realistic_noise,
)
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.fitting.blunders import find_outliers
from zlmreport.model.fitting.estimate import InstrumentError, Plausibility
from zlmreport.model.fitting.fit import Assumptions, Fit, fit
from zlmreport.model.fitting.noise import list_noise_parts
from zlmreport.model.fitting.observations import select_readings
from zlmreport.plugin import FloatArray
from zlmreport.plugin.effect import Design

DESIGN = linear_test(targets=11)
READINGS = known(DESIGN) + realistic_noise(DESIGN)
WAVE = 0.23
EVEN = np.ones(len(READINGS))
INDEPENDENT = Assumptions(parts=(), weights=EVEN)


def _columns(fitted: Fit, design: Design) -> FloatArray:
    return np.concatenate([term.effect.columns(design, np.empty(0)) for term in fitted.model.terms], axis=1)


def _value(fitted: Fit, name: str) -> float:
    return next(each.value for each in fitted.estimates if each.parameter.name == name)


def test_generalized_least_squares_is_that_of_the_textbook() -> None:
    fitted = fit(USUAL, DESIGN, READINGS, Assumptions(weights=EVEN))
    columns, parts = _columns(fitted, DESIGN), list_noise_parts(DESIGN)
    shared = sum(fitted.noise.ratios[part.source] * part.factor @ part.factor.T for part in parts)
    inverse = np.linalg.inv(np.eye(len(READINGS)) + shared)
    covariance = np.linalg.inv(columns.T @ inverse @ columns)
    expected = covariance @ columns.T @ inverse @ READINGS
    left = READINGS - columns @ expected
    variance = left @ inverse @ left / (len(READINGS) - len(expected))
    assert [each.value for each in fitted.estimates] == pytest.approx(expected, rel=1e-9)
    assert fitted.noise.sigma == pytest.approx(np.sqrt(variance), rel=1e-9)
    uncertainties = [each.standard_uncertainty for each in fitted.estimates]
    assert uncertainties == pytest.approx(np.sqrt(variance * np.diag(covariance)), rel=1e-8)


def test_readings_without_noise_give_their_parameters_back() -> None:
    fitted = fit(USUAL, DESIGN, known(DESIGN))
    assert _value(fitted, "lost_motion") == pytest.approx(-3e-6, rel=1e-9)


@pytest.mark.parametrize(
    ("effect", "name", "theta"),
    [("periodic", "period", WAVE), ("thermal-drift", "time_constant", 700.0), ("scale-kink", "kink", 0.43)],
)
def test_searched_parameters_are_found_between_the_values_of_the_grid(
    effect: str, name: str, theta: float
) -> None:
    readings = known(DESIGN) + hidden(DESIGN, effect, [theta], size=3.0)
    fitted = fit(USUAL.with_effect(EFFECTS[effect]), DESIGN, readings)
    assert _value(fitted, name) == pytest.approx(theta, rel=1e-6)


def test_two_searched_effects_are_found_together() -> None:
    readings = known(DESIGN) + hidden(DESIGN, "periodic", [WAVE], size=2.0)
    readings = readings + hidden(DESIGN, "thermal-drift", [500.0], size=2.0)
    model = USUAL.with_effect(EFFECTS["periodic"]).with_effect(EFFECTS["thermal-drift"])
    fitted = fit(model, DESIGN, readings + noise(DESIGN, sigma=1e-9))
    assert _value(fitted, "period") == pytest.approx(WAVE, rel=1e-3)
    assert _value(fitted, "time_constant") == pytest.approx(500.0, rel=1e-2)


def test_standard_uncertainties_of_searched_parameters_are_those_of_repeated_tests() -> None:
    model = USUAL.with_effect(EFFECTS["periodic"])
    truth = known(DESIGN) + hidden(DESIGN, "periodic", [WAVE], size=3.0)
    fits = [fit(model, DESIGN, truth + noise(DESIGN, seed), INDEPENDENT) for seed in range(40)]
    spread = np.std([_value(each, "period") for each in fits], ddof=1)
    stated = np.mean(
        [
            each.standard_uncertainty
            for one in fits
            for each in one.estimates
            if each.parameter.name == "period"
        ]
    )
    # A standard deviation of 40 values is known to 11 %.
    assert stated == pytest.approx(spread, rel=0.35)


def test_expanded_uncertainty_of_the_deviation_holds_where_nobody_measured() -> None:
    between = replace(
        DESIGN,
        position=np.linspace(0.05, 0.9, 8),
        direction=np.ones(8),
        run=np.ones(8, dtype=np.int64),
        target=np.zeros(8, dtype=np.int64),
        time=np.zeros(8),
        since_reversal=np.ones(8),
        conditions={},
    )
    truth = known(between)
    holds = []
    for seed in range(60):
        found = fit(USUAL, DESIGN, known(DESIGN) + realistic_noise(DESIGN, seed)).predict(between)
        holds.append(np.abs(found.deviation - truth) <= found.expanded_uncertainty)
    # 95 % at each place; the places of a test go together, so 60 tests know the share to about 3 %.
    assert 0.88 <= np.mean(holds) <= 1.0


def test_given_values_are_kept_and_have_no_uncertainty() -> None:
    model = AxisModel((*USUAL.terms, Term(EFFECTS["thermal-drift"], {"time_constant": 600.0, "drift": 5e-6})))
    fitted = fit(model, DESIGN, READINGS)
    given = [each for each in fitted.estimates if each.is_given]
    assert {each.parameter.name: each.value for each in given} == {"time_constant": 600.0, "drift": 5e-6}
    assert all(each.standard_uncertainty == 0 for each in given)
    assert fitted.degrees == len(READINGS) - 5


def test_a_given_value_is_taken_from_the_readings_before_the_others_are_fitted() -> None:
    model = AxisModel((*USUAL.terms[:1], Term(EFFECTS["backlash"], {"lost_motion": 4e-6})))
    fitted = fit(model, DESIGN, known(DESIGN))
    gap = fitted.residual[DESIGN.direction > 0].mean() - fitted.residual[DESIGN.direction < 0].mean()
    assert gap == pytest.approx(-3e-6 - 4e-6, rel=1e-9)


def test_a_known_period_is_not_searched() -> None:
    fitted = fit(USUAL.with_effect(EFFECTS["screw-pitch"]), DESIGN, READINGS)
    period = next(each for each in fitted.estimates if each.parameter.name == "period")
    assert (period.value, period.is_given) == (0.01, True)


def test_a_step_is_known_to_the_gap_in_which_it_lies() -> None:
    targets = DESIGN.target_positions
    readings = known(DESIGN) + hidden(DESIGN, "scale-joint", [float(targets[4:6].mean())], size=6.0)
    fitted = fit(USUAL.with_effect(EFFECTS["scale-joint"]), DESIGN, readings + noise(DESIGN))
    joint = next(each for each in fitted.estimates if each.parameter.name == "joint")
    half = float(targets[5] - targets[4]) / 2
    # The grid has the middles of the gaps; half-way to the next one is the target but for unequal gaps.
    assert joint.is_scanned
    assert joint.expanded_uncertainty == pytest.approx(half, rel=0.15)
    # A rectangular distribution of this half-width.
    assert joint.standard_uncertainty == pytest.approx(joint.expanded_uncertainty / np.sqrt(3))


def test_a_step_that_hardly_shows_may_lie_in_other_gaps_too() -> None:
    targets = DESIGN.target_positions
    readings = known(DESIGN) + hidden(DESIGN, "scale-joint", [float(targets[9:11].mean())], size=0.4)
    fitted = fit(USUAL.with_effect(EFFECTS["scale-joint"]), DESIGN, readings + noise(DESIGN))
    joint = next(each for each in fitted.estimates if each.parameter.name == "joint")
    assert joint.expanded_uncertainty > 1.4 * float(targets[10] - targets[9])


def test_a_parameter_that_varies_continuously_is_not_scanned() -> None:
    fitted = fit(
        USUAL.with_effect(EFFECTS["scale-kink"]), DESIGN, READINGS + hidden(DESIGN, "scale-kink", [0.5])
    )
    kink = next(each for each in fitted.estimates if each.parameter.name == "kink")
    assert not kink.is_scanned
    assert kink.expanded_uncertainty == pytest.approx(kink.coverage_factor * kink.standard_uncertainty)


def test_error_of_the_instrument_changes_nothing_but_the_uncertainty_of_the_constant() -> None:
    common = 1e-6
    without = fit(USUAL, DESIGN, READINGS)
    with_it = fit(USUAL, DESIGN, READINGS, Assumptions(InstrumentError(common)))
    assert np.array_equal(without.residual, with_it.residual)
    before, after = (
        np.array([each.standard_uncertainty for each in found.estimates]) for found in (without, with_it)
    )
    assert after[0] == pytest.approx(np.hypot(before[0], common), rel=1e-9)
    assert after[1:] == pytest.approx(before[1:], rel=1e-6)


def test_error_of_the_instrument_is_in_every_prediction() -> None:
    before = fit(USUAL, DESIGN, READINGS).predict(DESIGN)
    after = fit(USUAL, DESIGN, READINGS, Assumptions(InstrumentError(1e-6))).predict(DESIGN)
    assert after.standard_uncertainty == pytest.approx(np.hypot(before.standard_uncertainty, 1e-6), rel=1e-9)


def test_error_in_proportion_to_position_adds_to_the_slope() -> None:
    model = model_of("offset", "scale-error", "backlash")
    proportion = 5e-6
    before = fit(model, DESIGN, READINGS).estimates[1].standard_uncertainty
    assumed = Assumptions(InstrumentError(proportional=proportion))
    after = fit(model, DESIGN, READINGS, assumed).estimates[1].standard_uncertainty
    assert after == pytest.approx(np.hypot(before, proportion), rel=1e-9)


def test_error_that_parts_the_directions_is_that_of_the_lost_motion() -> None:
    parting = 4e-6
    model = model_of("offset", "backlash")
    before, after = (
        fit(model, DESIGN, READINGS, Assumptions(assumed)).estimates[1].standard_uncertainty
        for assumed in (InstrumentError(), InstrumentError(between_directions=parting))
    )
    assert after == pytest.approx(np.hypot(before, parting), rel=1e-9)


def test_error_at_each_position_is_that_of_independent_means() -> None:
    """Against the formula of a straight line: u of its level is u/√m, whatever the runs."""
    each, targets = 4e-6, len(np.unique(DESIGN.position))
    model = model_of("offset", "backlash")
    before, after = (
        fit(model, DESIGN, READINGS, Assumptions(assumed)).estimates
        for assumed in (InstrumentError(), InstrumentError(at_each_position=each))
    )
    level = np.hypot(before[0].standard_uncertainty, each / np.sqrt(targets))
    assert after[0].standard_uncertainty == pytest.approx(level, rel=0.05)
    assert after[1].standard_uncertainty == pytest.approx(before[1].standard_uncertainty, rel=0.05)


def test_where_geometry_is_irregular_degrees_of_freedom_are_those_of_the_targets() -> None:
    random = np.random.default_rng(3)
    geometry = 3e-6 * random.standard_normal(11)[DESIGN.target]
    rough = fit(USUAL, DESIGN, READINGS + geometry).estimates[2]
    assert 5 < rough.degrees < 11  # 11 targets, 4 coefficients
    assert rough.coverage_factor > 2.2


def test_where_readings_are_independent_degrees_of_freedom_are_theirs() -> None:
    fitted = fit(USUAL, DESIGN, READINGS, INDEPENDENT)
    assert [each.degrees for each in fitted.estimates] == pytest.approx([fitted.degrees] * 5, rel=1e-9)


def test_a_value_outside_the_plausible_range_is_said_to_be_so() -> None:
    readings = READINGS + 400e-6 * DESIGN.position * (DESIGN.conditions["axis_temperature"] - 293.15)
    fitted = fit(USUAL.with_effect(EFFECTS["scale-expansion"]), DESIGN, readings)
    expansion = fitted.estimates[-1]
    assert expansion.plausibility(time_is_counted=False) is Plausibility.IMPLAUSIBLE


def test_what_the_job_expects_stands_beside_the_estimate() -> None:
    axis = replace(DESIGN.axis, abbe_offset=0.25)
    design = replace(DESIGN, axis=axis)
    angles = axis.angular_errors
    assert angles is not None
    fitted = fit(USUAL.with_effect(EFFECTS["abbe"]), design, READINGS + 0.1 * angles.at(design.position))
    offset = fitted.estimates[-1]
    assert offset.expected == 0.25


def test_where_scatter_grows_the_quiet_end_is_known_as_well_as_its_own_scatter_allows() -> None:
    """Held against generalized least squares with the variances as they truly are."""
    design = linear_test(targets=11)
    model = model_of("offset", "scale-error")
    way = (design.position - design.position.min()) / np.ptp(design.position)
    sigma = 1e-6 * (0.3 + 1.7 * way)
    columns = np.column_stack([np.ones_like(way), design.position])
    known_better = np.linalg.inv(columns.T @ (columns / sigma[:, np.newaxis] ** 2))
    first = select_readings(design, np.flatnonzero(way == 0)[:1])
    (row,) = np.column_stack([np.ones(1), first.position])
    least = 2 * np.sqrt(row @ known_better @ row)
    ratios, held = [], 0
    for seed in range(40):
        readings = sigma * np.random.default_rng(seed).standard_normal(len(sigma))
        predicted = fit(model, design, readings, Assumptions(parts=())).predict(first)
        ratios.append(predicted.expanded_uncertainty[0] / least)
        held += abs(predicted.deviation[0]) <= predicted.expanded_uncertainty[0]
    # Three to five times where all readings weigh alike; ln σ² is no straight line here, which costs a third.
    assert 0.9 < np.median(ratios) < 1.6
    assert held >= 34  # 38 expected; fewer than 34 by chance in a test of a hundred


def test_pooled_scatter_of_a_clean_test_is_its_noise() -> None:
    design = linear_test()
    even = Assumptions(parts=(), weights=np.ones(len(design.position)))
    fitted = fit(USUAL, design, known(design) + noise(design), even)
    assert fitted.noise.sigma == pytest.approx(SIGMA, rel=0.15)


@pytest.mark.parametrize("place", [0.0, 0.1])
def test_a_test_of_one_target_is_fitted(place: float) -> None:
    """Nothing grows along an axis that stood at one place; its readings scatter there, and may stand off."""
    design = linear_test(1, 10, places=np.array([place]))
    readings = 3e-6 + noise(design)
    readings[7] += 30 * SIGMA
    assert find_outliers(design, readings).readings.tolist() == [7]
    found = fit(model_of("offset"), design, 3e-6 + noise(design))
    (offset,) = found.estimates
    assert offset.value == pytest.approx(3e-6, abs=SIGMA)
