"""What each effect does to a reading, against its equation in plain Python and in the users' units."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from plugins.effects.installed import EFFECTS, design_for
from plugins.effects.plain import EQUATIONS, readings
from zlmreport.model.effects.effect import find_unit_of
from zlmreport.plugin.effect import Design, Effect, Parameter
from zlmreport.testing import full_designs

#: Vapour pressures of the two arithmetics differ by 5e-5 of 1200 Pa at most, which is 2e-5 ppm of about 1.
TOLERANCE = {"air-index": 1e-4, "dead-path": 1e-4}


def _in_users_units(parameter: Parameter, value: float, design: Design) -> float:
    return value * find_unit_of(parameter.dimension, design.axis.kind).per_si


def _compared(effect: Effect, design: Design) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return deviations in µm (″), by the effect and by its equation, for θ in the middle of the grid."""
    grid = effect.grid(design)
    theta = grid[len(grid) // 2]
    gamma = np.random.default_rng(3).uniform(0.5, 2.0, len(effect.linear)) * 1e-6
    computed = design.axis.deviation_unit.from_si(effect.columns(design, theta) @ gamma)
    values = {
        each.name: _in_users_units(each, float(value), design)
        for each, value in [
            *zip(effect.linear, gamma, strict=True),
            *zip(effect.searched, theta, strict=True),
        ]
    }
    equation = EQUATIONS[effect.identifier]
    return computed, np.array([equation(reading, values) for reading in readings(design)])


@pytest.mark.parametrize("identifier", EFFECTS)
@pytest.mark.parametrize("method", ["linear", "pendulum", "quasi-pilgrim"])
def test_effect_follows_its_equation(identifier: str, method: str) -> None:
    computed, expected = _compared(EFFECTS[identifier], design_for(identifier, method))
    size = np.abs(expected).max()
    assert size > 0
    np.testing.assert_allclose(computed, expected, rtol=0, atol=size * TOLERANCE.get(identifier, 1e-9))


@pytest.mark.parametrize("identifier", ["polynomial", "screw-pitch", "encoder-interpolation"])
def test_every_order_and_every_choice_of_harmonics_follows_the_equation(identifier: str) -> None:
    for form in EFFECTS[identifier].forms():
        computed, expected = _compared(form, design_for(identifier))
        np.testing.assert_allclose(computed, expected, rtol=0, atol=np.abs(expected).max() * 1e-9)


@pytest.mark.parametrize(
    "identifier",
    [
        *("offset", "polynomial", "encoder-interpolation", "periodic", "scale-joint"),
        *("compensation-sign", "compensation-shift", "backlash", "backlash-bow", "reversal-relaxation"),
        *("directional-pitch", "thermal-drift", "datum-temperature", "time-periodic", "datum-step"),
        "first-run",
    ],
)
def test_effect_that_rotary_axes_have_too_is_in_arc_seconds_there(identifier: str) -> None:
    computed, expected = _compared(EFFECTS[identifier], full_designs()["a complete rotary test"])
    np.testing.assert_allclose(computed, expected, rtol=0, atol=np.abs(expected).max() * 1e-9)


def test_every_equation_is_that_of_an_effect() -> None:
    assert EQUATIONS.keys() == EFFECTS.keys()
