"""What has no name is looked for where it shows, by a measurement in which only that changes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import linear_test
from model.test_statements import LEFT
from zlmreport.model.diagnosis.looking import look_for
from zlmreport.model.diagnosis.random_curves import Course
from zlmreport.plugin import Language

DESIGN = linear_test()


def _said(course: Course, language: Language = Language.ENGLISH) -> tuple[str, str]:
    look = look_for(replace(LEFT, course=course), DESIGN)
    return look.at.in_language(language), look.measure.in_language(language)


def test_what_is_smooth_along_the_axis_is_measured_at_closer_targets_there() -> None:
    at, measure = _said(Course.PLACE)
    assert at == "the residuals over the position, around 250 mm"
    assert "two runs with a target every 12.4 mm from 149.3 mm to 350.7 mm" in measure


def test_what_is_irregular_is_measured_in_fine_steps() -> None:
    _, measure = _said(Course.IRREGULAR)
    assert "a fine run in steps of 1.10 mm from 199.3 mm to 300.7 mm, twice" in measure


def test_fine_run_between_close_targets_has_finer_steps() -> None:
    design = linear_test(41, places=np.linspace(0.0, 0.2, 41))
    measure = look_for(replace(LEFT, course=Course.IRREGULAR), design).measure.in_language(Language.ENGLISH)
    assert "in steps of 0.549 mm" in measure


@pytest.mark.parametrize("distance", [10.0, 25.0, 50.0, 100.0, 250.0])
@pytest.mark.parametrize("period", [5.0, 8.0, 10.0, 12.0, 16.0, 20.0])
def test_fine_run_catches_each_tooth_of_a_belt_four_times_at_other_phases(
    distance: float, period: float
) -> None:
    design = linear_test(5, places=1e-3 * distance * np.arange(5))
    measure = look_for(replace(LEFT, course=Course.IRREGULAR), design).measure.in_language(Language.ENGLISH)
    step = float(measure.split("in steps of ")[1].split(" mm")[0])
    assert step <= period / 4
    assert 0.02 < (period / step) % 1 < 0.98


def test_irregular_at_the_end_stays_within_what_was_measured() -> None:
    at_end = replace(LEFT, course=Course.IRREGULAR, peak=DESIGN.span[1])
    last = float(DESIGN.target_positions[-1]) * 1e3
    assert f"to {last:.4g} mm" in look_for(at_end, DESIGN).measure.in_language(Language.ENGLISH)


def test_what_is_irregular_is_measured_about_its_largest_place() -> None:
    wide = replace(LEFT, course=Course.IRREGULAR, low=0.2, high=0.9, peak=0.25)
    measure = look_for(wide, DESIGN).measure.in_language(Language.ENGLISH)
    assert "from 199.3 mm to 300.7 mm" in measure


def test_what_is_irregular_in_the_reversal_is_measured_in_both_directions() -> None:
    at, measure = _said(Course.IRREGULAR_REVERSAL)
    assert at == "the difference of the two directions over the position, around 250 mm"
    assert measure.startswith("a fine run in both directions in steps of 1.10 mm")


def test_of_two_targets_a_fine_run_stays_between_them() -> None:
    design = linear_test(2, places=np.array([0.1, 0.4]))
    measure = look_for(replace(LEFT, course=Course.IRREGULAR), design).measure.in_language(Language.ENGLISH)
    assert "from 100.0 mm to 400.0 mm" in measure


def test_at_a_single_target_there_is_no_distance_of_targets() -> None:
    design = linear_test(1, places=np.array([0.1]))
    measure = look_for(replace(LEFT, course=Course.TARGET), design).measure.in_language(Language.ENGLISH)
    assert measure.startswith("this target ten times")


@pytest.mark.parametrize(
    ("course", "asked"),
    [
        (Course.REVERSAL, "twice the overrun"),
        (Course.TIME, "one target again and again"),
        (Course.SLOPE, "the first and the last target in turn"),
        (Course.REVERSAL_IN_TIME, "one target from both directions in turn"),
        (Course.RUNS, "three runs more"),
        (Course.TARGET, "ten times from each direction"),
    ],
)
def test_only_that_changes_with_which_the_remainder_does(course: Course, asked: str) -> None:
    assert asked in _said(course)[1]


@pytest.mark.parametrize("course", Course)
def test_every_course_is_said_in_both_languages(course: Course) -> None:
    assert _said(course) != _said(course, Language.GERMAN)
    assert not any("{" in each for each in (*_said(course), *_said(course, Language.GERMAN)))
