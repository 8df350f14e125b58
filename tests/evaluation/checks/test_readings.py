"""Directions, runs and missing readings."""

from __future__ import annotations

import numpy as np
import pytest

from evaluation.checks.findings import said
from zlmreport.evaluation.checks.readings import (
    both_directions,
    fewest_runs,
    measured_approaches,
    no_missing_readings,
    number_of_runs,
)
from zlmreport.evaluation.requirements import Basis
from zlmreport.language import Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.testing import bidirectional_test, simulated_test

CONSEQUENCE = Words("no reversal", "keine Umkehrspanne")


def with_missing(*places: tuple[int, int, int]) -> MeasurementSet:
    grid = np.zeros((2, 3, 5))
    for place in places:
        grid[place] = np.nan
    return bidirectional_test([0, 100, 200], grid[0], grid[1])


def test_both_directions_are_asked_for() -> None:
    found = both_directions(simulated_test(), CONSEQUENCE, Basis.PUBLISHED)

    assert said(found)[1:] == ("both directions", True)


@pytest.mark.parametrize(
    ("approach", "words"),
    [
        (Approach.POSITIVE, "positive direction only; no reversal"),
        (Approach.NEGATIVE, "negative direction only; no reversal"),
    ],
)
def test_a_test_in_one_direction_falls_short_with_its_consequence(approach: Approach, words: str) -> None:
    found = both_directions(simulated_test(approaches=[approach]), CONSEQUENCE, Basis.PUBLISHED)

    assert said(found)[1:] == (words, False)


def test_a_direction_that_is_named_without_a_reading_was_not_measured() -> None:
    named = with_missing(*((1, target, run) for target in range(3) for run in range(5)))

    assert named.approaches == (Approach.POSITIVE, Approach.NEGATIVE)
    assert measured_approaches(named) == (Approach.POSITIVE,)
    assert both_directions(named, CONSEQUENCE, Basis.PUBLISHED).met is False


@pytest.mark.parametrize(("runs", "met"), [(4, False), (5, True), (10, True)])
def test_runs_are_counted(runs: int, met: bool) -> None:  # noqa: FBT001 - a column of a table
    found = number_of_runs(simulated_test(runs=runs), 5, Basis.APPLIED)

    assert said(found) == ("At least 5 runs in each direction", f"{runs} runs", met)


def test_the_direction_with_fewer_runs_counts() -> None:
    lacking = with_missing(*((1, target, 4) for target in range(3)))

    assert fewest_runs(lacking) == 4


def test_a_missing_reading_at_one_target_leaves_the_run_a_run() -> None:
    assert fewest_runs(with_missing((1, 2, 4))) == 5


def test_a_full_test_misses_nothing() -> None:
    assert said(no_missing_readings(with_missing()))[1:] == ("all 30 readings", True)


def test_missing_readings_are_counted_with_n_by_position() -> None:
    found = no_missing_readings(with_missing((0, 1, 0), (0, 1, 3), (1, 2, 2)))

    assert said(found)[1:] == ("3 of 30 missing; n from 3 to 5, evaluated by what is there", False)
