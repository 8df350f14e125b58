"""The uncertainty of mean deviations by position: from each way of acting, and the readings there are."""

from __future__ import annotations

import numpy as np
import pytest

from evaluation.uncertainty.budgets import ISO, MICROMETRE, contribution
from zlmreport.evaluation.uncertainty.expanded import compute_mean_uncertainty
from zlmreport.plugin import Approach, Evaluation, Options
from zlmreport.plugin.extension import Acts
from zlmreport.plugin.renderer import Budget
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import bidirectional_test, simulated_test

ALL_WAYS = Budget(
    (
        contribution(0.5, Acts.ALONG_THE_LENGTH),
        contribution(0.3, Acts.AT_EACH_POSITION),
        contribution(0.4, Acts.AT_EACH_READING),
    )
)


def evaluation_with_a_gap() -> Evaluation:
    """Return an evaluation of three targets and four runs, where one reading downwards is missing."""
    positive, negative = np.zeros((3, 4)), np.zeros((3, 4))
    negative[1, 2] = np.nan
    return evaluate(ISO, bidirectional_test([0.0, 100.0, 400.0], positive, negative), Options(), {})


def test_each_way_of_acting_has_its_part() -> None:
    found = compute_mean_uncertainty(evaluation_with_a_gap(), ALL_WAYS)

    share = np.array([0.0, 0.25, 1.0])
    readings = np.array([[4, 4, 4], [4, 3, 4]])
    expected = 2 * np.sqrt((0.5 * share) ** 2 + 0.3**2 + 0.4**2 / readings)
    assert found.by_approach / MICROMETRE == pytest.approx(expected, rel=1e-12)
    assert found.coverage_factor == 2.0


def test_the_mean_of_both_directions_has_the_readings_of_both() -> None:
    found = compute_mean_uncertainty(evaluation_with_a_gap(), ALL_WAYS)

    share = np.array([0.0, 0.25, 1.0])
    of_readings = (1 / np.array([4, 4, 4]) + 1 / np.array([4, 3, 4])) / 4
    expected = 2 * np.sqrt((0.5 * share) ** 2 + 0.3**2 + 0.4**2 * of_readings)
    assert found.bidirectional / MICROMETRE == pytest.approx(expected, rel=1e-12)


def test_where_there_is_no_mean_there_is_no_uncertainty_of_it() -> None:
    one_way = evaluate(ISO, simulated_test(approaches=[Approach.NEGATIVE]), Options(), {})

    found = compute_mean_uncertainty(one_way, ALL_WAYS)

    assert np.isnan(found.by_approach[Approach.POSITIVE.index]).all()
    assert np.isfinite(found.by_approach[Approach.NEGATIVE.index]).all()
    assert np.isnan(found.bidirectional).all()
