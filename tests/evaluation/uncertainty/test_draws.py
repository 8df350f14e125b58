"""Errors drawn from the distributions of contributions."""

from __future__ import annotations

import math

import numpy as np
import pytest

from evaluation.uncertainty.budgets import MICROMETRE, contribution
from zlmreport.evaluation.uncertainty.monte_carlo import shorten
from zlmreport.evaluation.uncertainty.sampling import draw_singly, sample_singly, sample_stratified
from zlmreport.plugin.extension import Acts, Distribution

COUNT = 20_000
#: Four standard deviations of a root mean square of so many draws: 1/√(2·COUNT) if they are normal, less
#: for distributions with ends.
BY_CHANCE = 4 / math.sqrt(2 * COUNT)


def drawn(*distributions: Distribution) -> np.ndarray:
    contributions = [contribution(0.5, Acts.AT_EACH_READING, each) for each in distributions]
    return sample_singly(contributions, (COUNT,), np.random.default_rng(7)) / MICROMETRE


def stratified(*distributions: Distribution) -> np.ndarray:
    contributions = [contribution(0.5, Acts.ALONG_THE_LENGTH, each) for each in distributions]
    return sample_stratified(contributions, COUNT, np.random.default_rng(7)) / MICROMETRE


@pytest.mark.parametrize("distribution", Distribution)
def test_the_root_mean_square_of_errors_is_the_standard_uncertainty(distribution: Distribution) -> None:
    assert math.sqrt(np.mean(drawn(distribution) ** 2)) == pytest.approx(0.5, rel=BY_CHANCE)
    assert math.sqrt(np.mean(stratified(distribution) ** 2)) == pytest.approx(0.5, rel=1e-3)


@pytest.mark.parametrize(
    ("distribution", "low", "high"),
    [
        (Distribution.RECTANGULAR, -math.sqrt(3), math.sqrt(3)),
        (Distribution.TRIANGULAR, -math.sqrt(6), math.sqrt(6)),
        (Distribution.ONE_SIDED, 0.0, math.sqrt(3)),
    ],
)
def test_errors_fill_their_range_and_never_leave_it(
    distribution: Distribution, low: float, high: float
) -> None:
    for found in (drawn(distribution), stratified(distribution)):
        assert 0.5 * low <= found.min() < found.max() <= 0.5 * high
        assert found.max() - found.min() == pytest.approx(0.5 * (high - low), rel=0.02)


def test_a_triangular_error_is_the_mean_of_two_rectangular_ones() -> None:
    # The distribution function of a triangle over ± a at a/2 is 7/8.
    share = np.mean(drawn(Distribution.TRIANGULAR) < 0.5 * math.sqrt(6) / 2)

    assert share == pytest.approx(7 / 8, abs=4 * math.sqrt(7 / 8 / 8 / COUNT))


@pytest.mark.parametrize("errors", [drawn, stratified])
def test_independent_errors_add_by_their_squares(errors) -> None:
    found = errors(Distribution.NORMAL, Distribution.RECTANGULAR, Distribution.NORMAL)

    assert math.sqrt(np.mean(found**2)) == pytest.approx(0.5 * math.sqrt(3), rel=BY_CHANCE)


def test_without_contributions_there_is_no_error() -> None:
    assert not drawn().any()


def test_an_uncertainty_keeps_six_digits() -> None:
    assert shorten(1.23456789e-6) == 1.23457e-6


def test_errors_are_the_same_whatever_stood_before_where_they_are_drawn() -> None:
    contributions = [contribution(0.5, Acts.AT_EACH_READING, each) for each in Distribution]
    total, errors = np.full((2, COUNT), np.nan)
    draw_singly(contributions, total, errors, np.random.default_rng(7))
    np.testing.assert_array_equal(total, sample_singly(contributions, (COUNT,), np.random.default_rng(7)))
