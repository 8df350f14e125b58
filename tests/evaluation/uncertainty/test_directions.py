"""Errors that part the directions, that lie in the datum, and that each approach has for itself."""

from __future__ import annotations

import math

import numpy as np
import pytest

from evaluation.uncertainty.budgets import BY_CHANCE, ISO, MICROMETRE, budget, contribution, uncertainties
from zlmreport.evaluation.uncertainty.expanded import compute_mean_uncertainty
from zlmreport.plugin import Options
from zlmreport.plugin.extension import Acts
from zlmreport.plugin.renderer import Budget
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import bidirectional_test

#: Two targets, 100 µm apart in their means, three runs without scatter.
TEST = bidirectional_test(
    [0.0, 100.0],
    np.array([[0.0] * 3, [100.0] * 3]),
    np.array([[-20.0] * 3, [80.0] * 3]),
)


def test_what_parts_the_directions_reaches_the_reversal_in_full() -> None:
    found = uncertainties(budget(0.5, Acts.BETWEEN_DIRECTIONS), TEST)
    assert found["B_mean"] == pytest.approx(2 * 0.5, rel=BY_CHANCE)
    assert found["B"] == pytest.approx(2 * 0.5, rel=BY_CHANCE)


def test_what_parts_the_directions_reaches_no_parameter_of_a_single_one() -> None:
    found = uncertainties(budget(0.5, Acts.BETWEEN_DIRECTIONS), TEST)
    assert [found[symbol] for symbol in ("E_fwd", "E_bwd", "M", "R_fwd")] == [0.0] * 4


def test_an_error_of_the_datum_reaches_no_range() -> None:
    found = uncertainties(budget(0.5, Acts.AT_THE_DATUM), TEST)
    assert set(found.values()) == {0.0}


def test_an_error_of_each_approach_reaches_ranges_and_reversal_by_two_of_them() -> None:
    found = uncertainties(budget(0.5, Acts.AT_EACH_APPROACH), TEST)
    assert found["E_fwd"] == pytest.approx(2 * 0.5 * math.sqrt(2), rel=BY_CHANCE)
    # the mean over two targets of a difference of two
    assert found["B_mean"] == pytest.approx(2 * 0.5, rel=BY_CHANCE)


@pytest.mark.parametrize(
    ("acts", "positive", "negative", "both"),
    [
        (Acts.BETWEEN_DIRECTIONS, 0.0, 0.5, 0.25),
        (Acts.AT_THE_DATUM, 0.5, 0.5, 0.5),
        (Acts.AT_EACH_APPROACH, 0.5, 0.5, 0.5 / math.sqrt(2)),
    ],
)
def test_the_mean_deviations_have_their_part(
    acts: Acts, positive: float, negative: float, both: float
) -> None:
    evaluation = evaluate(ISO, TEST, Options(), {})
    found = compute_mean_uncertainty(evaluation, Budget((contribution(0.5, acts),)))
    assert found.by_approach[:, 1] / MICROMETRE == pytest.approx([2 * positive, 2 * negative])
    assert found.bidirectional[1] / MICROMETRE == pytest.approx(2 * both)
