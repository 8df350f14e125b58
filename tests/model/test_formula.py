"""An effect that is written as a formula is fitted and diagnosed as an installed one is."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from model.axis_tests import EFFECTS, INSTALLED, linear_test, model_of, noise, observations
from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.model.diagnosis.diagnosis import diagnose
from zlmreport.model.effects.formula import FormulaEffect
from zlmreport.model.fitting.fit import fit
from zlmreport.plugin import AxisKind, Language

_DESIGN = linear_test(11, 3)


def _effect(formula: str, **parameters: dict[str, Any]) -> FormulaEffect:
    return FormulaEffect(FormulaKeys(name="own", formula=formula, parameters=parameters), AxisKind.LINEAR)


_DAMPED = _effect("a*D*exp(-P/L)", a={"unit": "um", "range": [-50, 50]}, L={"unit": "mm", "range": [20, 300]})


def test_parameters_come_back_in_si() -> None:
    deviation = 5e-6 * _DESIGN.direction * np.exp(-_DESIGN.position / 0.08) + noise(_DESIGN, sigma=1e-8)
    found = fit(model_of("offset", _DAMPED), _DESIGN, deviation)
    values = {each.parameter.name: each.value for each in found.estimates}
    assert values["a"] == pytest.approx(5e-6, rel=0.01)
    assert values["L"] == pytest.approx(0.08, rel=0.02)


def test_a_step_between_two_targets_is_known_though_its_place_may_be_anywhere_between_them() -> None:
    left, right = _DESIGN.target_positions[4:6]
    place = {"unit": "mm", "range": [float(f"{1e3 * each:.3f}") for each in (left + 1e-3, right - 1e-3)]}
    step = _effect("a*step(P - c)", a={"unit": "um"}, c=place)
    deviation = 5e-6 * (_DESIGN.position > (left + right) / 2) + noise(_DESIGN, sigma=4e-7)
    size, where = fit(model_of("offset", step), _DESIGN, deviation).estimates[1:]
    assert size.value == pytest.approx(5e-6, abs=size.expanded_uncertainty)
    assert size.expanded_uncertainty < 1e-6
    assert where.is_scanned
    assert where.expanded_uncertainty <= right - left


def test_formula_is_named_where_no_installed_effect_explains_as_much() -> None:
    deviation = 6e-6 * np.sin(2 * np.pi * _DESIGN.position**2 / 0.09) + noise(_DESIGN, sigma=4e-7)
    chirp = _effect(
        "a*sin(2*pi*P^2/L^2)", a={"unit": "um", "range": [-50, 50]}, L={"unit": "mm", "range": [250, 350]}
    )
    found = diagnose(model_of("offset", "scale-error"), observations(_DESIGN, deviation), [*INSTALLED, chirp])
    assert found.candidates[0].identifier == "own"


def test_formula_of_a_logged_column_asks_for_it() -> None:
    effect = _effect("k*(oil_temperature - 20)", k={"unit": "um/K"})
    reason = effect.untestable(_DESIGN)
    assert reason is not None
    assert "oil_temperature" in reason.in_language(Language.ENGLISH)


def test_logged_temperature_is_in_degrees_celsius() -> None:
    effect = _effect("k*(axis_temperature - 20)*P", k={"unit": "um/(m K)"})
    expected = (_DESIGN.conditions["axis_temperature"] - 293.15) * _DESIGN.position
    np.testing.assert_allclose(effect.columns(_DESIGN, np.empty(0))[:, 0], expected, rtol=1e-9)


def test_stated_value_of_a_formula_that_is_tried_is_no_search() -> None:
    wave = _effect(
        "a*sin(2*pi*P/L + f)",
        a={"unit": "um", "range": [-20, 20]},
        f={"unit": "deg", "range": [0, 180]},
        L={"unit": "mm", "value": 260},
    )
    deviation = 6e-6 * np.sin(2 * np.pi * _DESIGN.position / 0.26 + 1.0) + noise(_DESIGN, sigma=4e-7)
    found = diagnose(model_of("offset"), observations(_DESIGN, deviation), [EFFECTS["scale-error"], wave])
    phase, length = found.candidates[0].estimates[1:]
    assert phase.value == pytest.approx(1.0, abs=0.05)
    assert (length.value, length.is_given) == (0.26, True)
