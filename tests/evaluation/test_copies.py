"""Series of readings that are another one once more, and honest ones that only look alike."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from zlmreport.evaluation.copies import group_copies

STEP = 0.01


def honest(seed: int, *, scatter: float = 0.4, step: float = STEP, runs: int = 5) -> np.ndarray:
    """Return 22 readings of each run, µm: a curve of the axis, and its scatter, in steps."""
    generator = np.random.default_rng(seed)
    curve = 3 * np.sin(np.linspace(0, 5, 22))[:, np.newaxis]
    return np.round((curve + scatter * generator.standard_normal((22, runs))) / step) * step


def with_a_digit_changed(series: np.ndarray) -> np.ndarray:
    copied = series.copy()
    copied[:, 3] = copied[:, 1]
    copied[7, 3] += 0.03
    return copied


def moved_by_a_constant(series: np.ndarray) -> np.ndarray:
    copied = series.copy()
    copied[:, 3] = copied[:, 1] + 1.7
    return copied


def moved_where_a_reading_is_missing(series: np.ndarray) -> np.ndarray:
    copied = moved_by_a_constant(series)
    copied[4, 3] = np.nan
    return copied


@pytest.mark.parametrize(
    "copied", [with_a_digit_changed, moved_by_a_constant, moved_where_a_reading_is_missing]
)
def test_a_run_that_was_copied_and_touched_up_is_found(copied: Callable[[np.ndarray], np.ndarray]) -> None:
    assert group_copies(copied(honest(1)), STEP) == ((1, 3),)


def test_runs_that_are_all_copies_of_one_are_one_group() -> None:
    series = np.repeat(honest(2, runs=1), 4, axis=1)
    for run in range(1, 4):
        series[run, run] += 0.05

    assert group_copies(series, STEP) == ((0, 1, 2, 3),)


@pytest.mark.parametrize("step", [0.01, 0.1, 0.4])
def test_honest_runs_whose_scatter_the_last_digit_shows_are_no_copies(step: float) -> None:
    assert [group_copies(honest(seed, step=step), step) for seed in range(200)] == [()] * 200


def test_a_copy_with_many_digits_changed_is_found_among_the_readings_of_a_circle() -> None:
    generator = np.random.default_rng(3)
    series = np.round(3 * generator.standard_normal((7200, 3)), 1)
    series[:, 1] = series[:, 0]
    series[generator.choice(7200, 300, replace=False), 1] += 0.1

    assert group_copies(series, 0.1) == ((0, 1),)


def test_runs_of_one_value_say_nothing() -> None:
    assert group_copies(np.zeros((22, 3)), STEP) == ()
