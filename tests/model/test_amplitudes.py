"""A wave as people read it: amplitude and phase, with uncertainties that follow from sine and cosine."""

from __future__ import annotations

import math

import numpy as np
import pytest

from document.figures.model_samples import WAVE, WHOLE, fitted, linear_test
from model.hidden_effect import study, written
from zlmreport.model.diagnosis.study import list_waves


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
