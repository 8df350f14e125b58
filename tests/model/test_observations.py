"""From readings to what the error model works on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import EFFECTS, linear_test, observations
from zlmreport.measurement.axis import find_usual_overrun
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.observations import MOST_TARGETS, make_observations_of, thin
from zlmreport.plugin import Language, MeasurementSet
from zlmreport.testing.measurements import poor_tests, simulated_test

TEST = simulated_test()


def _said(measurements: MeasurementSet) -> str:
    return " ".join(each.in_language(Language.ENGLISH) for each in make_observations_of(measurements).remarks)


def _logged(log: object, measurements: MeasurementSet = TEST) -> MeasurementSet:
    return replace(measurements, conditions={"axis_temperature": np.asarray(log, dtype=np.float64)})


def test_missing_readings_are_dropped_and_the_order_is_kept() -> None:
    measurements = poor_tests()["a missing reading"]
    found = make_observations_of(measurements)
    assert len(found.deviation) == len(measurements.deviation) - 1
    assert np.array_equal(found.deviation, measurements.deviation[found.reading])
    assert np.all(np.diff(found.reading) > 0)


def test_without_times_the_row_is_the_clock_and_this_is_said() -> None:
    found = make_observations_of(poor_tests()["a missing reading"])
    assert found.design.time_is_counted
    assert np.array_equal(found.design.time, found.reading)
    assert "counted in readings" in _said(TEST)


def test_times_count_from_the_first_reading_that_is_there() -> None:
    timed = replace(TEST, time=100.0 + 2.0 * np.arange(len(TEST.deviation)))
    found = make_observations_of(timed)
    assert not found.design.time_is_counted
    assert found.design.time[:3].tolist() == [0.0, 2.0, 4.0]


def test_distance_since_the_reversal_grows_along_each_pass_of_the_linear_method() -> None:
    found = make_observations_of(TEST, overrun=0.003)
    first_pass = found.design.since_reversal[:9]
    assert first_pass == pytest.approx(0.003 + TEST.target_positions - TEST.target_positions[0], rel=1e-12)
    assert found.design.since_reversal[9] == 0.003


def test_an_assumed_overrun_is_said_and_a_known_one_is_not() -> None:
    assert "5 mm" in _said(TEST)
    assert not [
        each for each in make_observations_of(TEST, overrun=0.003).remarks if "overrun" in each.values
    ]


def test_on_a_short_axis_no_more_is_assumed_than_its_plan_takes() -> None:
    short = replace(TEST, axis=replace(TEST.axis, travel=(0.0, 0.02)))
    assert "0.4 mm" in _said(short)
    assert make_observations_of(short).design.since_reversal[0] == find_usual_overrun(short.axis)


def test_gap_of_a_log_is_interpolated_in_time_and_said_where() -> None:
    log = np.linspace(293.0, 295.0, len(TEST.deviation))
    gapped = log.copy()
    gapped[7] = np.nan
    found = make_observations_of(_logged(gapped)).design.conditions["axis_temperature"]
    assert found == pytest.approx(
        make_observations_of(_logged(log)).design.conditions["axis_temperature"], abs=1e-3
    )
    assert "axis_temperature has gaps (readings without it: 1)" in _said(_logged(gapped))
    assert "in the order of the file: 8." in _said(_logged(gapped))


def test_log_of_many_gaps_is_left_out_and_this_is_said() -> None:
    log = np.linspace(293.0, 295.0, len(TEST.deviation))
    log[::4] = np.nan
    assert "axis_temperature" not in make_observations_of(_logged(log)).design.conditions
    assert "and is left out" in _said(_logged(log))


def test_thousands_of_targets_are_thinned_at_uneven_places_and_this_is_said() -> None:
    even = linear_test(700, 1)
    found = thin(observations(even, np.zeros(len(even.position))))
    assert len(found.design.target_positions) == MOST_TARGETS
    assert len(np.unique(np.diff(np.unique(found.design.target)))) > 1
    assert "210 of the 700 target positions" in found.remarks[-1].in_language(Language.ENGLISH)


def test_noise_of_a_log_is_smoothed_away() -> None:
    course = 293.0 + 2.0 * -np.expm1(-np.arange(len(TEST.deviation)) / 30.0)
    random = np.random.default_rng(1)
    found = make_observations_of(_logged(course + 0.05 * random.standard_normal(len(course))))
    left = found.design.conditions["axis_temperature"] - course
    assert np.sqrt(np.mean(left**2)) < 0.025


def test_a_log_that_is_mostly_noise_is_doubted() -> None:
    random = np.random.default_rng(1)
    log = (
        293.0
        + 0.1 * np.sin(np.arange(len(TEST.deviation)) / 15.0)
        + 0.1 * random.standard_normal(len(TEST.deviation))
    )
    assert "The log of axis_temperature is noisy" in _said(_logged(log))


def test_noise_about_a_temperature_that_stays_is_not_told_with_digits_that_say_nothing() -> None:
    log = 293.0 + 0.1 * (np.arange(len(TEST.deviation)) % 5)
    assert "its noise is > 10 times its variation" in _said(_logged(log))


def test_a_coarse_log_is_doubted() -> None:
    log = 293.0 + 0.1 * np.round(np.linspace(0, 4, len(TEST.deviation)))
    assert "The log of axis_temperature is coarse: its resolution is 0.25 of its range" in _said(_logged(log))


def test_a_quiet_fine_log_is_not_doubted() -> None:
    log = 293.0 + np.linspace(0.0, 2.0, len(TEST.deviation)) ** 2
    assert "log of" not in _said(_logged(log))


def test_conditions_of_other_names_are_taken_as_they_are() -> None:
    faces = np.where(TEST.approach > 0, 1.0, -1.0)
    found = make_observations_of(replace(TEST, conditions={"face": faces}))
    assert np.array_equal(found.design.conditions["face"], faces)


def test_without_any_reading_there_is_nothing_to_fit() -> None:
    with pytest.raises(ModelError, match="no reading has a deviation"):
        make_observations_of(poor_tests()["no reading at all"])


def test_readings_that_are_set_aside_leave_the_span_as_it_is() -> None:
    found = make_observations_of(TEST)
    first_target = np.flatnonzero(found.design.target == 0)
    left = found.without(first_target)
    assert left.design.span == found.design.span
    assert len(left.deviation) == len(found.deviation) - len(first_target)


def test_a_humidity_that_was_not_logged_is_taken_to_stay_and_this_is_said() -> None:
    air = {
        "air_temperature": np.full(len(TEST.deviation), 293.15),
        "air_pressure": np.linspace(1e5, 1.003e5, len(TEST.deviation)),
    }
    dry = replace(TEST, conditions=air)
    assert "No relative humidity was logged" in _said(dry)
    assert "No relative humidity" not in _said(TEST)
    humid = replace(dry, conditions={**air, "relative_humidity": np.full(len(TEST.deviation), 0.5)})
    effect, theta = EFFECTS["air-index"], np.empty(0)
    columns, same = (effect.columns(make_observations_of(each).design, theta) for each in (dry, humid))
    assert effect.untestable(make_observations_of(dry).design) is None
    assert columns == pytest.approx(same, rel=1e-12)
