"""Sine and cosine as people read them: amplitude and phase, with uncertainties that follow from both."""

from __future__ import annotations

import math

import numpy as np
import pytest

from document.figures.model_samples import WAVE, WHOLE, fitted, linear_test
from model.hidden_effect import study, written
from zlmreport.model.diagnosis.study import list_waves
from zlmreport.model.effects.harmonic import find_harmonics, make_harmonic_columns, make_harmonic_parameters

PARAMETERS = make_harmonic_parameters([1, 3], 5e-6)


def test_amplitude_and_phase_are_those_of_the_wave() -> None:
    values = np.array([2.0 * math.cos(0.7), 2.0 * math.sin(0.7), 0.0, -1.0])
    first, third = find_harmonics(PARAMETERS, values, np.zeros((4, 4)))
    assert (first.order, third.order) == (1, 3)
    assert (first.amplitude, first.phase) == (pytest.approx(2.0), pytest.approx(0.7))
    assert (third.amplitude, third.phase) == (pytest.approx(1.0), pytest.approx(-math.pi / 2))


def test_the_wave_of_amplitude_and_phase_is_that_of_the_columns() -> None:
    angle = np.linspace(-7.0, 7.0, 40)
    values = np.array([0.3, -1.1, 0.4, 0.9])
    found = find_harmonics(PARAMETERS, values, np.zeros((4, 4)))
    waves = sum(each.amplitude * np.sin(each.order * angle + each.phase) for each in found)
    np.testing.assert_allclose(make_harmonic_columns(angle, [1, 3]) @ values, waves, atol=1e-14)


def test_uncertainty_is_along_the_amplitude_and_across_it_for_the_phase() -> None:
    values = np.array([3.0, 0.0, 1.0, 0.0])
    covariance = np.diag([0.01, 0.04, 0.0, 0.0])
    first, _ = find_harmonics(PARAMETERS, values, covariance)
    assert first.amplitude_uncertainty == pytest.approx(0.1)
    assert first.phase_uncertainty == pytest.approx(0.2 / 3.0)


def test_uncertainties_are_those_of_many_draws() -> None:
    covariance = np.array([[0.02, 0.01], [0.01, 0.03]])
    values = np.array([2.0, 1.5])
    (harmonic,) = find_harmonics(make_harmonic_parameters([1], 1.0), values, covariance)
    draws = np.random.default_rng(1).multivariate_normal(values, covariance, 100_000)
    # at A/u of about 15 the linear propagation is good to half a percent; so is 1/sqrt(2·100000)
    assert harmonic.amplitude_uncertainty == pytest.approx(np.hypot(*draws.T).std(), rel=0.01)
    assert harmonic.phase_uncertainty == pytest.approx(np.arctan2(*draws.T[::-1]).std(), rel=0.01)


def test_wave_of_no_size_has_no_phase() -> None:
    (harmonic,) = find_harmonics(make_harmonic_parameters([1], 1.0), np.zeros(2), np.eye(2))
    assert harmonic.amplitude == 0.0
    assert harmonic.phase_uncertainty == math.inf


def test_parameters_that_are_no_pair_are_no_harmonic() -> None:
    assert find_harmonics(PARAMETERS[:1], np.ones(1), np.eye(1)) == ()


def test_the_wave_of_the_screw_has_its_amplitude_and_phase() -> None:
    first, second = list_waves(fitted(*WHOLE).fit)
    assert (first.effect, first.harmonic.order, second.harmonic.order) == ("screw-pitch", 1, 2)
    u = first.harmonic.amplitude_uncertainty
    assert first.harmonic.amplitude == pytest.approx(WAVE, abs=4 * u)
    assert first.harmonic.phase == pytest.approx(0.0, abs=4 * first.harmonic.phase_uncertainty)


def test_the_uncertainty_is_that_of_the_sine_where_the_phase_is_zero() -> None:
    found = fitted(*WHOLE).fit
    first = list_waves(found)[0]
    sine, cosine = (
        next(each for each in found.estimates if each.parameter.name == name) for name in ("sine", "cosine")
    )
    # The wave is nearly a sine: the amplitude is as uncertain as its coefficient, to the square of the angle.
    angle = math.atan2(cosine.value, sine.value)
    assert first.harmonic.amplitude_uncertainty == pytest.approx(
        sine.standard_uncertainty, rel=2 * abs(angle) + 1e-9
    )
    assert first.coverage_factor == sine.coverage_factor


def test_a_model_without_waves_has_none() -> None:
    assert list_waves(fitted("offset", "scale-error", "backlash").fit) == ()


def test_a_wave_with_a_given_parameter_is_left_out(tmp_path) -> None:
    path = written(tmp_path, ("    - backlash\n", "    - screw-pitch: {sine: 2.0}\n"))
    assert list_waves(study(path).fit_whole().fit) == ()


def test_a_wave_beside_a_given_parameter_is_found(tmp_path) -> None:
    path = written(tmp_path, ("    - backlash\n", "    - backlash: {lost_motion: -4.0}\n    - screw-pitch\n"))
    first = list_waves(study(path).fit_whole().fit)[0]
    assert first.harmonic.amplitude == pytest.approx(math.hypot(2.1, 0.9) * 1e-6, rel=0.1)


def test_the_wave_is_the_one_that_was_fitted() -> None:
    found = fitted(*WHOLE).fit
    first, second = (each.harmonic for each in list_waves(found))
    turn = 2 * np.pi * linear_test().position / 10e-3
    wave = sum(each.amplitude * np.sin(each.order * turn + each.phase) for each in (first, second))
    term = found.model.terms[3].effect
    fitted_wave = term.columns(linear_test(), found.solution.thetas[3]) @ found.solution.coefficients[3]
    np.testing.assert_allclose(wave, fitted_wave, atol=1e-15)
