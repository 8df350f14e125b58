"""Conditions during a simulated test."""

from __future__ import annotations

import numpy as np

from zlmreport.model.simulation.description import ConditionCourse, compute_true_course

TIME = np.array([0.0, 100.0, 200.0, 400.0])


def test_without_an_end_a_condition_stays() -> None:
    np.testing.assert_array_equal(compute_true_course(ConditionCourse(5.0), TIME), [5.0, 5.0, 5.0, 5.0])


def test_without_a_time_constant_it_goes_straight_to_its_end() -> None:
    np.testing.assert_allclose(compute_true_course(ConditionCourse(5.0, 9.0), TIME), [5.0, 6.0, 7.0, 9.0])


def test_with_a_time_constant_it_tends_to_its_end() -> None:
    course = compute_true_course(ConditionCourse(5.0, 9.0, time_constant=100.0), TIME)
    np.testing.assert_allclose(course, 9.0 - 4.0 * np.exp(-TIME / 100.0))


def test_a_swing_is_added() -> None:
    course = compute_true_course(ConditionCourse(5.0, swing=2.0, swing_period=400.0), TIME)
    np.testing.assert_allclose(course, [5.0, 7.0, 5.0, 5.0], atol=1e-14)


def test_a_single_reading_has_the_start() -> None:
    np.testing.assert_array_equal(compute_true_course(ConditionCourse(5.0, 9.0), np.zeros(1)), [5.0])
