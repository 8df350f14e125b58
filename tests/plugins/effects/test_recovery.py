"""Each effect is found again in a simulated test of its own, by least squares."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from hidden_effects.drawn_axes import drawn_linear_test, drawn_rotary_test
from hidden_effects.sizes import scaled_effect
from plugins.effects.installed import EFFECTS, ROTARY_ONLY, design_for
from zlmreport.model.effects.axis_model import Term
from zlmreport.model.planning.methods import Method
from zlmreport.model.simulation.description import ConditionCourse, Description, SimulatedNoise
from zlmreport.model.simulation.simulate import compute_deviation_by, simulate
from zlmreport.plugin.effect import Design, Effect

SIGMA = 0.5e-6
#: Which face of a gauge is touched is no course of a condition, and no plan pauses: nothing simulates these.
OF_GAUGES = ["gauge-misalignment", "growth-after-pause", "probe-radius"]
NOT_OF_GAUGES = sorted(EFFECTS.keys() - set(OF_GAUGES))
SEARCHED = sorted(name for name, effect in EFFECTS.items() if effect.searched and name not in OF_GAUGES)


def _described(identifier: str) -> Description:
    random = np.random.default_rng([7, *identifier.encode()])
    drawn = drawn_rotary_test if identifier in ROTARY_ONLY else drawn_linear_test
    found = drawn(random, Method.LINEAR)
    axis = replace(found.axis, scale_element=0.25, pole_pitch=0.024)
    conditions = {**found.conditions, "material_temperature": ConditionCourse(293.0, 296.0)}
    return replace(found, axis=axis, conditions=conditions, noise=SimulatedNoise(reading=SIGMA))


def _solved(
    effect: Effect, design: Design, deviation: NDArray[np.float64], theta: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Return γ by least squares, its standard uncertainties for the known σ, and the sum of squares."""
    columns = effect.columns(design, theta)
    lengths = np.linalg.norm(columns, axis=0)
    scaled = columns / lengths
    solution = np.linalg.lstsq(scaled, deviation, rcond=None)[0]
    spread = SIGMA * np.sqrt(np.diag(np.linalg.inv(scaled.T @ scaled)))
    residual = deviation - scaled @ solution
    return solution / lengths, spread / lengths, float(residual @ residual)


@pytest.mark.parametrize("identifier", NOT_OF_GAUGES)
def test_size_is_recovered_within_its_uncertainty(identifier: str) -> None:
    description = _described(identifier)
    empty = simulate(description).design
    random = np.random.default_rng(1)
    hidden = scaled_effect(EFFECTS[identifier], empty, np.zeros((len(empty.position), 1)), 3 * SIGMA, random)
    test = simulate(replace(description, effects=(hidden,)))
    theta = np.array([hidden.fixed[each.name] for each in hidden.effect.searched])
    estimate, uncertainty, _ = _solved(hidden.effect, test.design, test.measurements.deviation, theta)
    truth = np.array([hidden.fixed[each.name] for each in hidden.effect.linear])
    # 4.5 standard deviations are exceeded in 7 of a million draws
    assert np.all(np.abs(estimate - truth) < 4.5 * uncertainty)


@pytest.mark.parametrize("identifier", OF_GAUGES)
def test_size_of_an_effect_of_a_gauge_is_recovered(identifier: str) -> None:
    effect, design = EFFECTS[identifier], design_for(identifier)
    noise = SIGMA * np.random.default_rng(2).standard_normal(len(design.position))
    theta = effect.grid(design)[-1]
    deviation = effect.columns(design, theta) @ np.full(len(effect.linear), 4e-6) + noise
    estimate, uncertainty, _ = _solved(effect, design, deviation, theta)
    assert np.all(np.abs(estimate - 4e-6) < 4.5 * uncertainty)


@pytest.mark.parametrize("identifier", SEARCHED)
def test_searched_parameter_is_recovered_from_the_grid(identifier: str) -> None:
    effect, description = EFFECTS[identifier], _described(identifier)
    design = simulate(description).design
    grid = effect.grid(design)
    place = len(grid) // 2
    sizes = dict.fromkeys((each.name for each in effect.linear), 1.0)
    searched = dict(zip((each.name for each in effect.searched), grid[place].tolist(), strict=True))
    unit = compute_deviation_by(effect, design, {**sizes, **searched})
    factor = 10 * SIGMA / np.sqrt(np.mean((unit - unit.mean()) ** 2))
    hidden = Term(effect, {**dict.fromkeys(sizes, factor), **searched})
    deviation = simulate(replace(description, effects=(hidden,))).measurements.deviation
    squares = [_solved(effect, design, deviation, theta)[2] for theta in grid]
    assert int(np.argmin(squares)) == place
