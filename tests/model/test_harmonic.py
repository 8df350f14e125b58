"""Sine and cosine as people read them: amplitude and phase."""

from __future__ import annotations

import math

import numpy as np
import pytest

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
