"""Who drifts: textbook examples of the methods, and false alarms counted."""

from __future__ import annotations

import math

import numpy as np
import pytest

from fleet.histories import entry, history, judged, parameter, quarters
from zlmreport.fleet.drifts import (
    FALSE_SHARE,
    Trend,
    adjust_by_holm,
    choose_by_benjamini_hochberg,
    name_in_families,
)
from zlmreport.fleet.trend import fit_line_through, list_series_of

#: The fifteen p-values of the paper of Benjamini and Hochberg (1995), section 4.
PUBLISHED = [
    *(0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344),
    *(0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000),
]


def test_the_published_example_chooses_four() -> None:
    assert choose_by_benjamini_hochberg(PUBLISHED, 0.05) == 4


def test_the_published_example_keeps_three_by_the_stricter_count() -> None:
    adjusted = adjust_by_holm(dict(enumerate(PUBLISHED)))
    assert sum(p <= 0.05 for p in adjusted.values()) == 3


def test_holms_values_are_multiplied_by_the_number_that_is_left_and_never_fall() -> None:
    adjusted = adjust_by_holm({7: 0.01, 8: 0.04, 9: 0.03})
    assert adjusted == pytest.approx({7: 0.03, 9: 0.06, 8: 0.06})


def test_a_larger_p_value_is_chosen_along_with_a_smaller_one_that_alone_would_not_be() -> None:
    assert choose_by_benjamini_hochberg([0.03, 0.04], 0.05) == 2


def test_nothing_tested_is_nothing_named() -> None:
    assert name_in_families([], 0.05) == frozenset()


def test_within_a_chosen_family_the_level_is_that_of_the_chosen_share() -> None:
    # One of two families is chosen, so its tests are held to 0.05·1/2: 0.012·2 is named, 0.03 is not.
    families = [{0: 0.012, 1: 0.03}, {2: 0.9}]
    assert name_in_families(families, 0.05) == {0}


def test_a_drift_towards_its_limit_has_a_date() -> None:
    (trend,) = judged(history([8.0, 9.1, 9.9, 11.0, 12.1, 12.9]))
    assert trend.forecast


def test_a_drift_without_a_limit_has_no_date() -> None:
    (trend,) = judged(history([8.0, 9.1, 9.9, 11.0, 12.1, 12.9], limit=None))
    assert trend.drifts
    assert trend.forecast is None


def test_scatter_is_no_drift() -> None:
    (trend,) = judged(history([8.0, 9.1, 8.2, 8.9, 8.1, 9.0]))
    assert not trend.drifts


@pytest.mark.parametrize("number", [1, 2, 3, 4])
def test_few_calibrations_are_not_tested(number: int) -> None:
    (trend,) = judged(history([8.0, 9.0, 10.0, 11.0][:number]))
    assert (trend.line, trend.p_value, trend.drifts) == (None, None, False)


def test_many_calibrations_of_few_days_are_not_tested() -> None:
    days = [day for day in quarters(3) for _ in range(2)]
    entries = [entry(day, parameter(8.0 + index), job=f"{index}.yaml") for index, day in enumerate(days)]
    (trend,) = judged(entries)
    assert trend.line is None


def test_a_single_step_is_no_drift_although_a_line_through_it_is_steep() -> None:
    (trend,) = judged(history([1.0, 0.9, 0.8, 5.2, 5.1, 5.0]))
    assert trend.course
    assert [each.index for each in trend.course.steps] == [3]
    assert not trend.drifts


TRIALS = 4000
#: Five standard deviations of a binomial count: once in some million runs, and the seed is fixed anyway.
DEVIATIONS = 5


@pytest.mark.parametrize("number", [5, 8])
def test_the_chance_of_a_slope_is_kept_by_series_that_do_not_drift(number: int) -> None:
    values = np.random.default_rng(number).normal(10.0, 0.7, (TRIALS, number))
    p_values = []
    for index, row in enumerate(values.tolist()):
        (trend,) = (
            Trend(each, fit_line_through(each)) for each in list_series_of(history(row, axis=str(index)))
        )
        p_values.append(trend.p_value)
    for level in (0.01, 0.05, 0.5):
        count = sum(p is not None and p <= level for p in p_values)
        allowed = DEVIATIONS * math.sqrt(TRIALS * level * (1 - level))
        assert abs(count - TRIALS * level) <= allowed


FLEETS = 300


@pytest.mark.long
def test_a_fleet_that_does_not_drift_names_somebody_no_more_often_than_stated() -> None:
    """Twelve axes with three parameters each, which are read off the same readings."""
    random = np.random.default_rng(20261121)
    alarms = 0
    for _ in range(FLEETS):
        entries = []
        for axis in range(12):
            common = random.normal(0, 0.5, (7, 1))
            for day, row in zip(quarters(7), common + random.normal(9, 0.3, (7, 3)), strict=True):
                stated = [parameter(value, symbol=f"A{index}") for index, value in enumerate(row.tolist())]
                entries.append(entry(day, *stated, axis=str(axis), job=f"{axis}/{day}.yaml"))
        alarms += any(trend.drifts for trend in judged(entries))
    most = FLEETS * FALSE_SHARE + DEVIATIONS * math.sqrt(FLEETS * FALSE_SHARE * (1 - FALSE_SHARE))
    assert alarms <= most


@pytest.mark.long
def test_of_the_axes_that_are_named_few_are_named_by_accident() -> None:
    """Two of ten axes drift by 2 µm a year; the others are named in no more than the stated share."""
    random = np.random.default_rng(7)
    shares = []
    found = 0
    for _ in range(FLEETS):
        entries = []
        for axis in range(10):
            slope = 0.5 if axis < 2 else 0.0
            values = 9 + slope * np.arange(8) + random.normal(0, 0.4, 8)
            entries += history(values.tolist(), axis=str(axis))
        named = [int(trend.series.axis) for trend in judged(entries) if trend.drifts]
        shares.append(sum(axis >= 2 for axis in named) / max(1, len(named)))
        found += sum(axis < 2 for axis in named)
    mean, deviation = float(np.mean(shares)), float(np.std(shares) / math.sqrt(FLEETS))
    assert mean <= FALSE_SHARE + DEVIATIONS * deviation
    assert found > 2 * FLEETS * 0.9


@pytest.mark.long
def test_a_drift_of_one_scatter_a_quarter_is_found_in_two_years_as_often_as_documented() -> None:
    """Of 25 axes with twelve parameters one drifts; a quarter of the variance is a parameter's own."""
    random = np.random.default_rng(8)
    fleets, share = 60, 0.70
    found = 0
    for _ in range(fleets):
        entries = []
        for axis in range(25):
            scatter = random.normal(0, 0.5, (8, 12)) + random.normal(0, math.sqrt(0.75), (8, 1))
            values = 10 + scatter + (np.arange(8)[:, None] if axis == 0 else 0)
            for day, row in zip(quarters(8), values, strict=True):
                stated = [parameter(value, symbol=f"A{index}") for index, value in enumerate(row.tolist())]
                entries.append(entry(day, *stated, axis=str(axis), job=f"{axis}/{day}.yaml"))
        found += any(trend.drifts and trend.series.axis == "0" for trend in judged(entries))
    # The documentation's own figure comes from 60 fleets.
    deviation = math.sqrt(share * (1 - share) * (2 / fleets))
    assert abs(found / fleets - share) <= DEVIATIONS * deviation
