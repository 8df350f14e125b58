"""What a fleet knows of the scatter between tests, and what an axis knows of its own."""

from __future__ import annotations

import math
from statistics import NormalDist

import numpy as np
import pytest

from zlmreport.fleet.scatter import ScatterLikelihood, learn_scatter
from zlmreport.model.fitting.distributions import chi_square_tail, t_quantile

NORMAL = NormalDist()

#: Degrees of freedom of the tests of an axis.
DEGREES = 4


def fleet_of(deviations: np.ndarray, seed: int = 7) -> list[tuple[float, int]]:
    """Return the sums of squares of axes with these standard deviations."""
    rng = np.random.default_rng(seed)
    return [(float(each), DEGREES) for each in deviations**2 * rng.chisquare(DEGREES, len(deviations))]


def part_between(scatter: ScatterLikelihood, low: float, high: float) -> float:
    inside = (scatter.deviations >= low) & (scatter.deviations <= high)
    return float(scatter.weights[inside].sum())


def test_an_axis_without_others_is_judged_by_students_t() -> None:
    """With ignorance of the logarithm of σ: P(y > t·s) is that of Student's t with its degrees of freedom."""
    (unknown,) = learn_scatter([(0.05**2 * DEGREES, DEGREES)])
    known = unknown.update(0.05**2 * DEGREES, DEGREES)
    for chance in (0.05, 0.003):
        assert known.compute_quantile(chance) == pytest.approx(
            0.05 * t_quantile(1 - 2 * chance, DEGREES), rel=0.03
        )


def test_axes_that_scatter_alike_know_the_scatter_together() -> None:
    found = learn_scatter(fleet_of(np.full(400, 0.06)))[0]
    assert found.deviation == pytest.approx(0.06, rel=0.05)
    # A normal quantile: four tests alone would have 4.6 instead of 2.6.
    assert found.compute_quantile(0.005) == pytest.approx(-0.06 * NORMAL.inv_cdf(0.005), rel=0.05)


def test_two_kinds_of_axes_are_told_apart() -> None:
    found = learn_scatter(fleet_of(np.repeat([1 / 60, 1 / 15], 200)))[0]
    assert part_between(found, 1 / 80, 1 / 45) == pytest.approx(0.5, abs=0.1)
    assert part_between(found, 1 / 20, 1 / 11) == pytest.approx(0.5, abs=0.1)
    calm, wild = (found.update(DEGREES * each**2, DEGREES) for each in (1 / 60, 1 / 15))
    assert calm.compute_quantile(0.05) < 2 / 60  # one in a hundred of these may be a wild one
    assert wild.compute_quantile(0.003) == pytest.approx(-NORMAL.inv_cdf(0.003) / 15, rel=0.08)


def test_a_scatter_that_no_other_axis_has_is_believed_nevertheless() -> None:
    found = learn_scatter(fleet_of(np.full(400, 1 / 40)))[0]
    assert found.update(DEGREES * 0.3**2, DEGREES).deviation > 0.2


def test_an_axis_is_not_asked_for_what_it_says_itself() -> None:
    calm = [(DEGREES * 0.02**2, DEGREES)] * 5
    of_wild, of_calm = learn_scatter([(DEGREES * 0.5**2, DEGREES), *calm])[:2]
    assert part_between(of_wild, 0.2, 1.0) < 0.05
    assert of_wild.degrees == of_calm.degrees == 5 * DEGREES


def test_a_fleet_of_first_tests_knows_nothing() -> None:
    (found, _) = learn_scatter([(0.0, 0), (0.0, 0)])
    assert found.degrees == 0
    assert len(set(found.weights.tolist())) == 1


def test_the_sum_of_squares_of_a_known_scatter_is_that_of_chi_squared() -> None:
    known = ScatterLikelihood(np.array([0.1]), np.array([1.0]), 100)
    assert known.compute_chance_of_squares(0.05, 3) == pytest.approx(chi_square_tail(5, 3))
    assert known.compute_chance_of_change(0.2) == pytest.approx(NORMAL.cdf(-2))
    assert known.compute_quantile(0.01) == pytest.approx(-0.1 * NORMAL.inv_cdf(0.01), rel=1e-3)


def test_the_evidence_of_two_scatters_is_their_mean() -> None:
    known = ScatterLikelihood(np.array([0.1, 0.2]), np.array([0.25, 0.75]), 9)
    likely = 0.25 * 0.1**-3 * math.exp(-0.02 / 0.02) + 0.75 * 0.2**-3 * math.exp(-0.02 / 0.08)
    assert known.compute_evidence(0.02, 3) == pytest.approx(math.log(likely))
