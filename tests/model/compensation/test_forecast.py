"""What a second test will show: against sums of variances that are known beforehand."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport.model.compensation.basis import DeviationPart, ReadingScatter, TableBasis
from zlmreport.model.compensation.curve import ErrorCurve
from zlmreport.model.compensation.forecast import ExpectedFigure, forecast
from zlmreport.plugin import Approach, Axis, Place, same_in_all_languages as same
from zlmreport.plugin.controller import CompensationTable
from zlmreport.plugin.extension import Acts, Contribution, Distribution
from zlmreport.plugin.renderer import Budget

RUNS, SINGLE = 4, 2e-6
#: u of a mean.
OWN = SINGLE / 2
TARGETS = np.array([0.0, 0.1, 0.3])
#: Of |x|, x normal with mean 0: 97.5 % lie below 2.24 standard deviations.
HIGH = 2.2414


def second_test(
    *parts: DeviationPart, budget: Budget | None = None, single: float = SINGLE
) -> dict[str, ExpectedFigure]:
    """Return what a second test shows in one direction, where a table leaves nothing that is known."""
    none = np.zeros((2, len(parts[0].directions)))
    targets = TARGETS[: none.shape[1]]
    curve = ErrorCurve(targets, none[0], none[1], np.full_like(none, single), RUNS, (Approach.POSITIVE,))
    scatter = ReadingScatter(single, 0.0, 1_000_000)
    basis = TableBasis(
        curve, lambda at: np.zeros((2, len(at))), none, parts, scatter, lambda _: np.zeros_like
    )
    table = CompensationTable(Axis("X"), "T", targets, none[0], none[0], Place("test"))
    return forecast(basis, table, table, None, budget).second_test


def mean_range(*parts: DeviationPart, budget: Budget | None = None, single: float = SINGLE) -> ExpectedFigure:
    return second_test(*parts, budget=budget, single=single)["M"]


def known_by_means(targets: int) -> DeviationPart:
    return DeviationPart(np.eye(targets), 1.0)


def test_a_table_of_means_leaves_their_scatter_and_the_second_test_adds_as_much() -> None:
    found = mean_range(known_by_means(2))
    assert found.high == pytest.approx(HIGH * np.sqrt(2 * 2) * OWN, rel=0.05)


def test_what_a_model_and_its_residuals_both_describe_is_counted_once() -> None:
    # residuals far beyond their scatter are believed whole: then means and model know the same
    slope = (TARGETS - TARGETS.mean()) / np.linalg.norm(TARGETS - TARGETS.mean())
    found = mean_range(DeviationPart(slope[:, np.newaxis], 1.0))
    by_means = mean_range(known_by_means(3))
    assert (found.low, found.high) == pytest.approx((by_means.low, by_means.high), rel=0.06)


def test_residuals_no_larger_than_their_scatter_leave_the_scatter_of_the_model() -> None:
    # of two means along their difference alone: the offset is no error of the model's
    apart = np.array([[1.0], [-1.0]]) / np.sqrt(2)
    found = mean_range(DeviationPart(apart, 0.0))
    assert found.high == pytest.approx(HIGH * np.sqrt(2 * 2) * OWN, rel=0.05)
    alike = mean_range(DeviationPart(np.abs(apart), 0.0))
    assert alike.high == pytest.approx(HIGH * np.sqrt(2) * OWN, rel=0.05)  # the second test's scatter alone


def test_what_both_directions_share_and_what_parts_them_scatter_like_a_mean() -> None:
    """(e↑ ± e↓)/√2 turns the two by 45°: both parts have the variance of a mean, and give it back."""
    none = np.zeros((2, 3))
    curve = ErrorCurve(TARGETS, none[0], none[1], np.full_like(none, SINGLE), RUNS, tuple(Approach))
    scatter = ReadingScatter(SINGLE, 0.0, 1_000_000)
    parts = (known_by_means(3),) * 2
    basis = TableBasis(
        curve, lambda at: np.zeros((2, len(at))), none, parts, scatter, lambda _: np.zeros_like
    )
    table = CompensationTable(Axis("X"), "T", TARGETS, none[0], none[0], Place("test"))
    found = forecast(basis, table, table, None, None).second_test["E"]
    random = np.random.default_rng(4)
    spans = np.ptp(OWN * np.sqrt(2) * random.standard_normal((200_000, 6)), axis=1)  # both tests scatter
    assert (found.low, found.high) == pytest.approx(np.quantile(spans, [0.025, 0.975]), rel=0.06)


def test_both_tests_have_the_errors_of_a_set_up_of_their_own() -> None:
    scale = Contribution(same("scale"), 1e-6, Acts.ALONG_THE_LENGTH, Distribution.NORMAL, same(""), same(""))
    found = mean_range(known_by_means(3), budget=Budget((scale,)), single=1e-12)
    assert found.high == pytest.approx(HIGH * np.sqrt(2) * 1e-6, rel=0.05)


def test_what_fluctuates_in_the_set_up_is_in_the_scatter_already() -> None:
    noise = Contribution(same("noise"), 1e-6, Acts.AT_EACH_READING, Distribution.NORMAL, same(""), same(""))
    alone, more = (mean_range(known_by_means(3), budget=each) for each in (None, Budget((noise,))))
    assert more.high == pytest.approx(alone.high, rel=1e-6)


def test_accuracy_of_a_second_test_is_that_of_tests_that_are_drawn_by_its_definition() -> None:
    random = np.random.default_rng(2)
    axes = OWN * random.standard_normal((100_000, 2, 1))
    tests = axes + SINGLE * random.standard_normal((100_000, 2, RUNS))
    mean, reach = tests.mean(axis=-1), 2 * tests.std(axis=-1, ddof=1)
    accuracy = (mean + reach).max(axis=-1) - (mean - reach).min(axis=-1)
    found = second_test(known_by_means(2))
    assert (found["A"].low, found["A"].high) == pytest.approx(np.quantile(accuracy, [0.025, 0.975]), rel=0.04)
    assert found["E"] == found["M"]  # one direction
