"""Readings that stand off: what is a blunder, and what is evidence of something else."""

from __future__ import annotations

import math

import numpy as np
import pytest

from model.axis_tests import INSTALLED, SIGMA, linear_test, model_of, noise, observations, pendulum_test
from zlmreport.model.diagnosis.diagnosis import diagnose
from zlmreport.model.fitting.blunders import find_outliers

DESIGN = linear_test()
PENDULUM = pendulum_test(21, 3)


def test_clean_readings_do_not_stand_off() -> None:
    flagged = [len(find_outliers(DESIGN, noise(DESIGN, seed)).readings) for seed in range(20)]
    assert sum(flagged) <= 4  # of 4200 normal readings


@pytest.mark.parametrize("runs", [3, 4, 5])
def test_chance_sets_readings_aside_no_more_often_than_p_says(runs: int) -> None:
    """A median of three is one of them: held against that, one test in six lost good readings."""
    design, tests = linear_test(21, runs), 100
    found = [find_outliers(design, noise(design, seed)) for seed in range(tests)]
    assert sum(len(each.readings) > 0 for each in found) <= 3
    likely = 0.05 * tests
    assert sum(each.p_value < 0.05 for each in found) <= likely + 3 * math.sqrt(likely)


@pytest.mark.parametrize("runs", [3, 5])
def test_a_reading_far_off_draws_none_of_its_repeats_after_it(runs: int) -> None:
    design = linear_test(21, runs)
    readings = noise(design)
    readings[57] += 40 * SIGMA
    assert find_outliers(design, readings).readings.tolist() == [57]


def test_readings_of_a_stretch_that_scatters_more_are_evidence() -> None:
    there = (DESIGN.position > 0.3) & (DESIGN.position < 0.55)
    moving = np.where(there, 10 * SIGMA * DESIGN.direction * np.sin(DESIGN.time / 200.0), 0.0)
    assert len(find_outliers(DESIGN, moving + noise(DESIGN)).readings) <= 4  # of 50 that are there


def test_a_reading_far_off_is_flagged_and_no_other() -> None:
    readings = noise(DESIGN)
    readings[57] += 15 * SIGMA
    found = find_outliers(DESIGN, readings)
    assert found.readings.tolist() == [57]
    assert found.p_value < 1e-10


def test_a_first_run_that_stands_off_is_no_outlier() -> None:
    readings = noise(DESIGN) + np.where(DESIGN.run == 1, 12 * SIGMA, 0.0)
    assert not len(find_outliers(DESIGN, readings).readings)


def test_targets_after_each_reversal_that_stand_off_are_no_outliers() -> None:
    readings = noise(DESIGN) + 30 * SIGMA * DESIGN.direction * np.exp(-DESIGN.since_reversal / 0.02)
    assert not len(find_outliers(DESIGN, readings).readings)


def test_where_a_reading_of_every_place_stands_off_all_are_evidence() -> None:
    design = linear_test(8, 3)
    readings = noise(design, sigma=1e-9) + np.where(design.run == 2, 1e-3, 0.0)
    assert not len(find_outliers(design, readings).readings)


def test_readings_without_any_scatter_have_no_outliers() -> None:
    assert not len(find_outliers(DESIGN, np.zeros(len(DESIGN.position))).readings)


def test_good_readings_at_the_noisy_end_are_kept() -> None:
    grown = 1.0 + 8.0 * DESIGN.position
    flagged = [len(find_outliers(DESIGN, grown * noise(DESIGN, seed)).readings) for seed in range(10)]
    assert sum(flagged) <= 3  # of 2100 normal readings


def test_scatter_that_grows_between_two_targets_is_a_line_without_a_bend() -> None:
    design = linear_test(2, 8)
    readings = (1.0 + 200.0 * (design.position > design.middle)) * noise(design)
    assert not len(find_outliers(design, readings).readings)


def test_a_blunder_at_the_quiet_end_is_found_where_the_other_scatters_more() -> None:
    readings = (1.0 + 8.0 * DESIGN.position) * noise(DESIGN)
    quiet = int(np.argmin(DESIGN.position))
    readings[quiet] += 12 * SIGMA
    assert quiet in find_outliers(DESIGN, readings).readings.tolist()


def test_two_of_a_block_before_something_happened_are_evidence() -> None:
    readings = noise(PENDULUM)
    block = np.flatnonzero(PENDULUM.target == 10)
    readings[block[:2]] -= 12 * SIGMA
    assert not len(find_outliers(PENDULUM, readings).readings)


def test_first_readings_of_many_blocks_are_evidence() -> None:
    first = (PENDULUM.run == 1) & (PENDULUM.direction > 0)
    readings = noise(PENDULUM) + 9 * SIGMA * first
    assert not len(find_outliers(PENDULUM, readings).readings)


def test_what_the_model_explains_is_no_blunder() -> None:
    """The zero jumps within a block: the two readings before it decide when it was."""
    block = np.flatnonzero(PENDULUM.target == 10)
    moment = float(PENDULUM.time[block[1]] + PENDULUM.time[block[2]]) / 2
    jump = -10 * SIGMA * (PENDULUM.time > moment)
    found = diagnose(
        model_of("offset", "scale-error"), observations(PENDULUM, noise(PENDULUM) + jump), INSTALLED
    )
    assert [each.identifier for each in found.together] == ["datum-step"]
    assert not set(block[:2].tolist()) & set(found.outliers.tolist())
