"""The search for parameters chooses nothing by the last digits, which processors round differently."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest

from model.axis_tests import EFFECTS, SIGMA, linear_test, model_of, noise
from zlmreport.model.fitting.fit import Assumptions, fit


def _kinks(seeds: int) -> list[float]:
    """Return where a kink is found beside a joint in the same interval: every place there fits alike."""
    design = linear_test(9, 3)
    model = model_of("offset", "scale-error", "scale-joint", "scale-kink")
    position, (left, right) = design.position, np.unique(design.position)[4:6]
    middle = (left + right) / 2
    clean = 10e-6 * (position > middle) + 30e-6 * np.maximum(position - middle, 0.0)
    clean = clean + np.random.default_rng(0).normal(0.0, 0.3e-6, len(position))
    found = []
    for seed in range(seeds):
        last = np.random.default_rng(seed).uniform(-1e-19, 1e-19, len(position))
        fitted = fit(model, design, clean + last, Assumptions(parts=(), weights=np.ones(len(position))))
        found += [each.value for each in fitted.estimates if each.parameter.name == "kink"]
    return found


def test_a_place_that_nothing_tells_from_its_neighbours_is_chosen_alike() -> None:
    kinks = _kinks(4)
    np.testing.assert_allclose(kinks, kinks[0], rtol=1e-6)


def test_a_fit_is_as_good_in_whichever_order_the_effects_stand() -> None:
    design = linear_test(9, 2)
    step, wave = EFFECTS["lost-motion-step"], EFFECTS["lost-motion-wave"]
    of_step, of_wave = step.columns(design, np.array([0.683])), wave.columns(design, np.array([0.2313]))
    clean = 3 * of_step[:, 0] / of_step.std() + (of_wave / of_wave.std(axis=0)) @ np.array([-1.8, 1.2])
    readings = SIGMA * clean + noise(design)
    plain = Assumptions(parts=(), weights=np.ones(len(readings)))
    errors = [
        fit(model_of("offset", *both), design, readings, plain).rms for both in ((step, wave), (wave, step))
    ]
    assert errors[0] == pytest.approx(errors[1], rel=1e-6)
    assert errors[0] < 1.2 * SIGMA


def test_four_effects_whose_values_are_searched_are_found_in_whichever_order_they_stand() -> None:
    names = ("lost-motion-step", "datum-step", "scale-kink", "time-periodic")
    design, random = linear_test(21, 3), np.random.default_rng(31)
    readings = noise(design)
    for each in (EFFECTS[name] for name in names):
        grid = each.grid(design)
        columns = each.columns(design, grid[int(random.integers(len(grid)))])
        shape = columns @ random.standard_normal(columns.shape[1])
        readings = readings + random.uniform(2, 4) * SIGMA * shape / shape.std()
    plain = Assumptions(parts=(), weights=np.ones(len(readings)))
    orders = list(permutations(names))
    errors = [fit(model_of("offset", *order), design, readings, plain).rms for order in orders[::3]]
    np.testing.assert_allclose(errors, errors[0], rtol=1e-6)
    assert errors[0] < 1.1 * SIGMA
