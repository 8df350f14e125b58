"""What is drawn of a model is what it says, however short its waves are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import AXIS, EFFECTS, formula, linear_test, model_of, noise
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.effects.design import place_at_positions
from zlmreport.model.fitting.curve import find_waves_along, lay_curve_positions, lay_effect_positions
from zlmreport.model.fitting.fit import Fit, fit
from zlmreport.plugin import Approach, FloatArray
from zlmreport.plugin.effect import Effect

_PITCHES = [0.5, 0.01, 0.005]


def _fitted(pitch: float) -> Fit:
    design = linear_test(15, 2, axis=replace(AXIS, screw_pitch=pitch))
    wave = 4e-6 * np.sin(2 * np.pi * design.position / pitch + 0.3)
    return fit(model_of("offset", "screw-pitch"), design, wave + noise(design, sigma=1e-8))


@pytest.mark.parametrize("pitch", _PITCHES)
def test_curve_reaches_as_far_as_the_wave(pitch: float) -> None:
    fitted = _fitted(pitch)
    drawn = _values(fitted, lay_curve_positions(fitted, Approach.POSITIVE))
    assert np.ptp(drawn) == pytest.approx(8e-6, rel=0.03)


@pytest.mark.parametrize("pitch", [0.5, 0.01])
def test_between_what_is_drawn_the_model_does_not_leave_the_line(pitch: float) -> None:
    fitted = _fitted(pitch)
    positions = lay_curve_positions(fitted, Approach.POSITIVE)
    between = (positions[1:] + positions[:-1]) / 2
    drawn, true = (_values(fitted, each) for each in (positions, between))
    np.testing.assert_allclose((drawn[1:] + drawn[:-1]) / 2, true, atol=0.03 * 4e-6)


def test_many_periods_are_drawn_at_few_positions() -> None:
    fitted = _fitted(0.0002)
    assert len(lay_curve_positions(fitted, Approach.POSITIVE)) < 1300


def test_step_of_a_joint_is_drawn_upright() -> None:
    design = linear_test(15, 2)
    model = AxisModel((Term(EFFECTS["offset"]), Term(EFFECTS["scale-joint"])))
    fitted = fit(model, design, 5e-6 * (design.position > 0.5) + noise(design, sigma=1e-8))
    positions = lay_curve_positions(fitted, Approach.POSITIVE)
    step = int(np.argmax(np.abs(np.diff(_values(fitted, positions)))))
    assert positions[step + 1] - positions[step] < 1e-6


def test_smooth_curve_has_even_positions() -> None:
    design = linear_test(15, 2)
    fitted = fit(model_of("offset", "scale-error"), design, 1e-5 * design.position + noise(design))
    np.testing.assert_allclose(
        np.diff(lay_curve_positions(fitted, Approach.POSITIVE)), fitted.design.length / 479
    )


def _values(fitted: Fit, positions: FloatArray) -> FloatArray:
    return fitted.compute_value_at(place_at_positions(fitted.design, positions, Approach.POSITIVE))


def test_effect_alone_is_drawn_as_finely_as_in_a_model() -> None:
    design = linear_test(15, 2)
    interpolation, theta = EFFECTS["encoder-interpolation"], np.array([20e-6])
    positions = lay_effect_positions(interpolation, theta, design, Approach.POSITIVE, design.span)
    drawn = interpolation.columns(place_at_positions(design, positions, Approach.POSITIVE), theta).sum(axis=1)
    turn = np.linspace(0, 2 * np.pi, 1000)
    true = np.sin(turn) + np.cos(turn) + np.sin(2 * turn) + np.cos(2 * turn)
    assert np.ptp(drawn) == pytest.approx(np.ptp(true), rel=0.03)


_PITCH = EFFECTS["screw-pitch"]
_ONE_WAVE = _PITCH.with_settings(_PITCH.options(harmonics=(1,)))
_METRE = linear_test(15, 2, axis=replace(AXIS, screw_pitch=0.005))
_LONG = replace(_METRE, position=3 * _METRE.position, span=(0.0, 3 * _METRE.span[1]))
_MM, _UM = {"unit": "mm", "range": [1, 3000]}, {"unit": "um", "range": [-50, 50]}


@pytest.mark.parametrize(
    ("drawn", "searched"),
    [
        (_ONE_WAVE, [0.005]),
        (formula("a*sin(2*pi*P/L)", a=_UM, L=_MM), [0.005]),
        (
            formula("a*sin(2*pi*P/L + b*cos(4*pi*P/M))", a=_UM, L=_MM, b={"range": [0, 2]}, M=_MM),
            [0.02, 1, 0.1],
        ),
        (formula("a*exp(-P/L)", a=_UM, L=_MM), [0.01]),
        (formula("a*exp(-(P - M)^2/L^2)", a=_UM, L=_MM, M=_MM), [0.015, 1.2345]),
        (formula("a*step(P - 777)*P/L - b*step(P - 123)", a=_UM, b=_UM, L={**_MM, "value": 3000}), [3.0]),
        (formula("a*sign(sin(2*pi*P/L))", a=_UM, L={**_MM, "value": 300}), [0.3]),
        (
            formula(
                "a*abs(P/L - b) + c*min(P/L, 1)", a=_UM, c=_UM, L={**_MM, "value": 1300}, b={"range": [0, 1]}
            ),
            [1.3, 0.7],
        ),
    ],
    ids=["pitch", "wave", "modulated", "fading", "bump", "steps", "square", "kinks"],
)
def test_between_positions_a_curve_is_what_the_model_gives(drawn: Effect, searched: list[float]) -> None:
    """An axis of 3000 mm with waves down to 5 mm: lines between positions, held against the prediction."""
    design, theta = _LONG, np.array(searched)
    deviation = 1e-5 * drawn.columns(design, theta).sum(axis=1) + noise(design, sigma=1e-8)
    names = [each.name for each in drawn.searched]
    known = dict(zip(names, searched, strict=True))
    fitted = fit(AxisModel((Term(drawn, known),)), design, deviation)
    positions = lay_curve_positions(fitted, Approach.POSITIVE)
    asked = np.random.default_rng(5).uniform(*design.span, 20_000)
    true = fitted.predict(place_at_positions(design, asked, Approach.POSITIVE)).deviation
    line = np.interp(asked, positions, _values(fitted, positions))
    np.testing.assert_allclose(line, true, atol=0.03 * np.abs(true).max())


def test_wave_of_a_formula_is_as_long_as_its_period_says() -> None:
    wave = formula("a*sin(6*pi*P/L) + b*cos(2*pi*P/L)", a=_UM, b=_UM, L=_MM)
    fitted = fit(AxisModel((Term(wave, {"L": 0.3}),)), _LONG, noise(_LONG))
    assert find_waves_along(fitted) == {"own": pytest.approx(0.1)}
