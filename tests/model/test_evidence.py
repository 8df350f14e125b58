"""Evidence: what averages over searched parameters, and where the finer grid comes in."""

from __future__ import annotations

import math

import numpy as np
import pytest

from model.axis_tests import EFFECTS, SIGMA, USUAL, hidden, known, linear_test, noise, pendulum_test
from zlmreport.model.comparison import _WORTHS, Comparison
from zlmreport.model.design import Design
from zlmreport.model.effect import Effect
from zlmreport.model.evidence import Evidence, evidence_of
from zlmreport.model.observations import of_readings
from zlmreport.quantities.arrays import FloatArray

DESIGN = linear_test()
#: Where the search for a kink begins, and a place in the middle between two of these.
PLACES = EFFECTS["scale-kink"].grid(DESIGN)[:, 0]
STEP = PLACES[8] - PLACES[7]
BETWEEN = PLACES[7] + STEP / 2


def _base(design: Design) -> FloatArray:
    return np.concatenate([term.effect.columns(design, np.empty(0)) for term in USUAL.terms], axis=1)


def _evidence(design: Design, deviation: FloatArray, *effects: Effect) -> Evidence:
    comparison = Comparison.of(design, _base(design), effects, np.ones(len(deviation)))
    return evidence_of(comparison, design, deviation, 1e-6)


def test_evidence_in_independent_noise_is_that_of_a_prior_worth_one_reading() -> None:
    few = np.flatnonzero((DESIGN.run == 1) & (DESIGN.target % 4 == 0))[:11]  # too few for shared parts
    design = of_readings(DESIGN, few)
    effect = EFFECTS["backlash-gradient"]
    deviation = noise(design) + 2e-6 * design.direction * design.position
    found = _evidence(design, deviation, effect).effects[0]

    base = _base(design)
    degrees = len(deviation) - np.linalg.matrix_rank(base / np.linalg.norm(base, axis=0))

    def squares(columns: FloatArray) -> float:
        scaled = columns / np.linalg.norm(columns, axis=0)
        return float(np.sum((deviation - scaled @ np.linalg.lstsq(scaled, deviation, rcond=1e-10)[0]) ** 2))

    alone = squares(base)
    explained = alone - squares(np.column_stack([base, effect.columns(design, np.empty(0))]))
    # One reading's worth, or rarely more: a mixture of priors, each with its own Bayes factor.
    factor = 0.0
    for worth, weight in _WORTHS:
        prior = worth * degrees
        left = alone - explained * prior / (1 + prior)
        factor += weight * (alone / left) ** (degrees / 2) / math.sqrt(1 + prior)
    assert found == pytest.approx(2 * math.log(factor), rel=1e-6)


def test_a_searched_parameter_need_not_lie_on_the_grid() -> None:
    deviation = known(DESIGN) + noise(DESIGN) + hidden(DESIGN, "scale-kink", [BETWEEN], size=2.0)
    effect, theta = _evidence(DESIGN, deviation, EFFECTS["scale-kink"]).best[0]
    assert effect is EFFECTS["scale-kink"]
    assert theta[0] == pytest.approx(BETWEEN, abs=STEP / 4)


def test_what_lies_between_values_of_the_grid_costs_no_evidence() -> None:
    on, between = (
        _evidence(
            DESIGN,
            known(DESIGN) + noise(DESIGN) + hidden(DESIGN, "scale-kink", [place], size=3.0),
            EFFECTS["scale-kink"],
        ).effects[0]
        for place in (PLACES[7], BETWEEN)
    )
    assert between == pytest.approx(on, rel=0.05)


def test_a_jump_within_the_readings_of_one_target_is_found_where_it_is() -> None:
    design = pendulum_test()
    moment = float((design.time[103] + design.time[104]) / 2)
    deviation = known(design) + noise(design) + 8 * SIGMA * (design.time > moment)
    _, theta = _evidence(design, deviation, EFFECTS["datum-step"]).best[0]
    assert design.time[103] < theta[0] < design.time[104]
