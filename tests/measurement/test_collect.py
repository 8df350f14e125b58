"""From readings to a measurement set, and what a set of readings must hold."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st

from plugins.sources.reading import missing_in
from refusals import refused
from zlmreport.plugin import Approach, Axis, AxisKind, InputError, Language, MeasurementSet, Place, Problem
from zlmreport.plugin.source import Provenance, Reading, collect_readings

FILE = Place("x.csv")
MM, UM = 1e-3, 1e-6


def reading(
    line: int,
    target: float = 0.0,
    approach: int = 1,
    run: float = 1,
    deviation: float = 1.0,
    **more: Any,
) -> Reading:
    """Return a reading with its target in mm and its deviation in µm."""
    place = Place("x.csv", line, 1)
    return Reading(place, target * MM, Approach(approach), run, deviation * UM, **more)


def cycle(run: int, targets: Iterable[float] = (0, 100, 200), first_line: int | None = None) -> list[Reading]:
    """Return the readings of a cycle of the linear method, one line a reading."""
    targets = list(targets)
    line = first_line or 2 + 2 * len(targets) * (run - 1)
    steps = [(target, 1) for target in targets] + [(target, -1) for target in reversed(targets)]
    return [reading(line + index, target, way, run) for index, (target, way) in enumerate(steps)]


def collected(readings: Iterable[Reading], axis: Axis | None = None) -> MeasurementSet:
    return collect_readings(readings, axis or Axis("X"), Provenance("test"), place=FILE)


def complaints(readings: Iterable[Reading], axis: Axis | None = None, **more: Any) -> list[str]:
    about = axis or Axis("X")
    found = refused(collect_readings, readings, about, Provenance("test"), place=FILE, **more)
    return [str(problem) for problem in found.problems]


def test_readings_keep_their_order_and_targets_rise() -> None:
    measurements = collected([reading(2, 100, 1), reading(3, 0, 1), reading(4, 50, -1)])
    assert measurements.target_positions.tolist() == [0.0, 0.05, 0.1]
    assert measurements.target.tolist() == [2, 0, 1]
    assert measurements.approach.tolist() == [1, 1, -1]


def test_what_was_read_cannot_be_altered() -> None:
    measurements = collected([reading(2, time=3.0, conditions={"air_temperature": 293.15})])
    for values in (
        measurements.target_positions,
        measurements.deviation,
        measurements.time,
        *measurements.conditions.values(),
    ):
        with pytest.raises(ValueError, match="read-only"):
            values[0] = 0.0  # type: ignore[index]


def test_targets_that_differ_by_the_noise_of_a_computation_are_one() -> None:
    positions = [0.1 + 0.2, 0.3, 0.3, 0.4]
    readings = [
        dataclasses.replace(reading(2, run=run), target_position=position)
        for run, position in enumerate(positions, 1)
    ]
    assert collected(readings).target_positions.tolist() == [0.3, 0.4]


def test_targets_a_nanometre_apart_are_two() -> None:
    readings = [reading(2, 0.001, deviation=0), reading(3, 0.001001, deviation=0)]
    assert len(collected(readings).target_positions) == 2


def test_a_missing_reading_stays_missing_and_is_named() -> None:
    readings = cycle(1)
    readings[1] = dataclasses.replace(readings[1], deviation=math.nan)
    measurements = collected(readings)
    assert np.isnan(measurements.deviation).tolist() == [False, True, False, False, False, False]
    assert missing_in(measurements) == [(0.1, Approach.POSITIVE, 1)]


def test_times_count_from_the_first_that_was_logged() -> None:
    readings = [reading(2, 0), reading(3, 10, time=5.0), reading(4, 20, time=7.5)]
    time = collected(readings).time
    np.testing.assert_array_equal(time, [np.nan, 0.0, 2.5])


def test_without_times_it_is_said_what_cannot_be_judged() -> None:
    measurements = collected([reading(2)])
    assert measurements.time is None
    assert [remark.en for remark in measurements.provenance.remarks] == [
        "No times were logged: drift and warm-up can only be judged by the order of the readings."
    ]


def test_conditions_are_kept_where_they_were_logged() -> None:
    readings = [reading(2, 0, conditions={"feed": 500.0, "empty": math.nan}), reading(3, 10)]
    conditions = collected(readings).conditions
    assert set(conditions) == {"feed"}
    np.testing.assert_array_equal(conditions["feed"], [500.0, np.nan])


def test_no_readings_are_no_measurement() -> None:
    assert complaints([]) == ["x.csv: holds no readings"]


def test_nothing_but_missing_readings_is_no_measurement() -> None:
    assert complaints([reading(2, deviation=math.nan), reading(3, 10, deviation=math.nan)]) == [
        "x.csv: every reading is missing; there is nothing to evaluate"
    ]


@pytest.mark.parametrize("run", [0, -1, 1.5, math.nan, math.inf, 1e7])
def test_runs_are_counted_by_positive_integers(run: float) -> None:
    assert complaints([reading(2, run=run)]) == [
        f"x.csv:2:1: {run:.9g} is no number of a run; runs are counted 1, 2, 3 and so on"
    ]


@pytest.mark.parametrize("target", [math.nan, math.inf, 1e8])
def test_a_target_that_is_on_no_axis_is_refused(target: float) -> None:
    assert complaints([reading(2, target)]) == [
        f"x.csv:2:1: the target position, {target:.9g} mm, is not on any axis; is its unit right?"
    ]


def test_times_that_no_test_takes_are_refused_at_the_farthest() -> None:
    readings = [reading(2, time=0.0), reading(3, 10, time=1e300), reading(4, 20, time=1e301)]
    assert complaints(readings) == ["x.csv:4:1: no test takes 1e+301 s; is the unit of its time right?"]


def test_no_quantity_is_infinite() -> None:
    infinite = [
        reading(2, deviation=math.inf),
        reading(3, 10, time=-math.inf),
        reading(4, 20, conditions={"feed": math.inf}),
    ]
    assert complaints(infinite) == [
        "x.csv:2:1: the deviation is infinite; a reading is a finite number",
        "x.csv:3:1: the time is infinite; a reading is a finite number",
        "x.csv:4:1: feed is infinite; a reading is a finite number",
    ]


def test_a_reading_that_is_there_twice_is_named_with_both_lines() -> None:
    assert complaints([*cycle(1), reading(9, 100, -1), reading(10, 100, -1)]) == [
        f"x.csv:{line}:1: target 100 mm ↓, run 1, stands in line 6 already; "
        "a repeated run has a number of its own"
        for line in (9, 10)
    ]


def test_a_missing_reading_that_is_there_as_well_is_there_twice() -> None:
    assert len(complaints([*cycle(1), reading(9, 100, -1, deviation=math.nan)])) == 1


def test_targets_lie_on_the_travel_that_the_job_states() -> None:
    axis = Axis("X", travel=(0.2, 0.0))
    assert collected(cycle(1), axis).axis is axis
    assert complaints(cycle(1), Axis("X", travel=(0.0, 0.15))) == [
        "x.csv:4:1: target 200 mm lies off the travel (axis.travel in the job), 0 to 150 mm"
    ]


def test_a_target_that_only_one_run_has_in_the_place_of_another_is_off_the_list() -> None:
    readings = [*cycle(1), *cycle(2), *cycle(3)]
    readings[7] = dataclasses.replace(readings[7], target_position=137 * MM)
    assert complaints(readings) == [
        (
            "x.csv:9:1: target 137 mm is on no other run's list, and 100 mm, which is, has no reading in "
            "this run; was that meant? (A target that was left out keeps its row, with an empty cell.)"
        )
    ]


def test_a_zone_that_is_measured_in_more_runs_than_the_travel_is_no_mistake() -> None:
    readings = [*cycle(1, (0, 10, 20, 100, 200)), *cycle(2, (0, 10, 20), 20), *cycle(3, (0, 10, 20), 30)]
    assert collected(readings).target_positions.tolist() == [0.0, 0.01, 0.02, 0.1, 0.2]


def test_targets_of_their_own_in_each_direction_are_no_mistake() -> None:
    readings = [
        reading(2 + 4 * run + index, target, way, run)
        for run in (1, 2, 3)
        for index, (target, way) in enumerate([(0, 1), (100, 1), (150, -1), (50, -1)])
    ]
    assert len(collected(readings).target_positions) == 4


def test_a_deviation_that_reaches_the_next_target_is_a_mistake() -> None:
    readings = [*cycle(1), reading(8, 0, 1, 2, 100_000.0), reading(9, 100, 1, 2, 100_001.0)]
    assert complaints(readings) == [
        (
            "x.csv:9:1: the deviation, 100001 µm, is larger than the smallest target interval, 100 mm; "
            "is it a position given as deviation, or a wrong unit?"
        )
    ]


def test_positions_given_as_deviations_are_named_once() -> None:
    readings = [reading(2 + index, 10 * index, deviation=1e6 * (index + 1)) for index in range(30)]
    assert complaints(readings) == [
        (
            "x.csv:2:1: 30 deviations from here on are larger than the smallest target interval, 10 mm; "
            "is it a position given as deviation, or a wrong unit?"
        )
    ]


def test_a_mistyped_target_does_not_make_the_deviations_of_others_absurd() -> None:
    readings = [dataclasses.replace(each, deviation=3 * MM) for run in (1, 2, 3) for each in cycle(run)]
    readings[7] = dataclasses.replace(readings[7], target_position=102 * MM)
    (complaint,) = complaints(readings)
    assert complaint.startswith("x.csv:9:1: target 102 mm is on no other run's list, and 100 mm")


def test_deviations_of_several_steps_are_ordinary_within_a_period_of_the_scale() -> None:
    readings = [reading(2 + index, 0.002 * index, deviation=15.0) for index in range(11)]
    assert collected(readings).deviation.tolist() == [15.0 * UM] * 11


def test_a_single_target_is_held_against_the_travel_or_against_what_no_deviation_can_be() -> None:
    far = [reading(2, 500, deviation=200_000.0), reading(3, 500, -1, deviation=1.0)]
    assert collected(far).deviation[0] == 200_000 * UM
    assert complaints(far, Axis("X", travel=(0.45, 0.55)))[0].startswith(
        "x.csv:2:1: the deviation, 200000 µm, is larger than the travel, 100 mm; "
    )
    assert len(complaints([reading(2, 500, deviation=1e9)])) == 1


def test_a_rotary_axis_speaks_of_its_own_units() -> None:
    readings = [
        dataclasses.replace(each, target_position=math.radians(index * 10), deviation=0.2)
        for index, each in enumerate([reading(2), reading(3)])
    ]
    assert complaints(readings, Axis("C", AxisKind.ROTARY))[0].startswith(
        "x.csv:2:1: the deviation, 41252.9612″, is larger than the smallest target interval, 10°; "
    )


@pytest.mark.parametrize(
    ("back", "why"),
    [
        (3600, "did summer time end there? Write times with their offset"),
        (3550, "did summer time end there?"),
        (12 * 3600, "is it a clock of 12 hours? Write AM and PM"),
        (60, "readings stand in the order in which they were taken"),
        (7200, "readings stand in the order in which they were taken"),
    ],
)
def test_a_clock_that_was_put_back_is_asked_about(back: int, why: str) -> None:
    times = [0.0, 20.0, 40.0, 60.0 - back, 80.0 - back]
    (found,) = complaints(reading(2 + index, 10 * index, time=time) for index, time in enumerate(times))
    assert found.startswith(f"x.csv:5:1: the time is before that of the reading in line 4; {why}")


def test_times_that_fall_contradict_the_order_of_the_readings() -> None:
    readings = [reading(2, 0, time=1.0), reading(3, 10, time=3.0), reading(4, 20, time=2.0)]
    assert complaints(readings) == [
        (
            "x.csv:4:1: the time is before that of the reading in line 3; "
            "readings stand in the order in which they were taken"
        )
    ]


def test_a_condition_that_cannot_be_is_in_a_wrong_unit() -> None:
    readings = [
        reading(2 + index, 10 * index, conditions={"air_pressure": 101325.0 * 100, "air_temperature": 293.15})
        for index in range(3)
    ]
    assert complaints(readings) == [
        (
            "x.csv:2:1: air_pressure is not between 300 and 1200 hPa here (readings like this: 3); "
            "is its unit right, or was a sensor silent?"
        )
    ]


def test_a_sequence_number_is_not_taken_for_the_run() -> None:
    readings = [reading(2 + index, index, run=index + 1) for index in range(20_000)]
    assert complaints(readings) == [
        (
            "x.csv: 20000 target positions and 20000 runs would be 400000000 readings, and there are 20000; "
            "is the target the commanded position, and the run the number of the cycle?"
        )
    ]


def test_target_and_actual_position_are_not_exchanged() -> None:
    readings = [
        reading(2 + 3 * run + index, 100 * index + 0.001 * run, run=run)
        for run in (1, 2, 3)
        for index in range(3)
    ]
    assert complaints(readings) == [
        (
            "x.csv: no target position was read twice in 3 runs; is the target the commanded position, "
            "or are target and actual position exchanged?"
        )
    ]


@pytest.mark.parametrize("spellings", [2, 4])
def test_a_display_is_not_taken_for_the_commanded_position(spellings: int) -> None:
    readings = [
        reading(2 + 3 * run + index, 100 * index + 0.0001 * ((run + index) % spellings), run=run)
        for run in range(1, 7)
        for index in range(3)
    ]
    assert complaints(readings) == [
        (
            f"x.csv:5:1: {3 * spellings} target positions are 3 places, each written otherwise from run to "
            "run; is the target the commanded position, and not what a display showed?"
        )
    ]


def test_targets_of_a_run_of_their_own_are_no_display() -> None:
    lists = [
        (line, 100 * index + 7 * (run % 2), run)
        for run in range(4)
        for line, index in enumerate(range(3), 4 * run)
    ]
    measurements = collected([reading(2 + line, target, run=run + 1) for line, target, run in lists])
    assert len(measurements.target_positions) == 6


def test_all_problems_come_at_once_in_the_order_of_the_file_with_those_of_the_reader() -> None:
    readings = [*cycle(1), reading(9, 0, run=0), reading(10, 0), reading(12, 300, deviation=1e9)]
    found = [Problem(Place("x.csv", 11, 4), "'abc' stands where a number belongs")]
    lines = [complaint.split(":")[1] for complaint in complaints(readings, problems=found)]
    assert lines == ["9", "10", "11", "12"]


def test_of_very_many_problems_the_first_are_named_and_the_others_counted() -> None:
    words = [Problem(Place("x.csv", 2 + index), f"{'x' * index}y is no number") for index in range(100)]
    found = complaints(cycle(1), problems=words)
    assert len(found) == 20 + 1
    assert found[-1] == "x.csv:22:1: and 80 more"


def test_problems_that_differ_by_numbers_alone_are_one() -> None:
    (found,) = complaints(reading(2 + index, run=index + 0.5) for index in range(100))
    assert found.startswith("x.csv:2:1: ")
    assert found.endswith(" (100 like this: lines 2, 3, 4, 5, 6, …)")


@given(st.permutations(range(12)))
def test_the_order_of_readings_does_not_change_the_grid(order: list[int]) -> None:
    readings = [
        dataclasses.replace(each, deviation=index * UM) for index, each in enumerate([*cycle(1), *cycle(2)])
    ]
    expected = collected(readings).deviations()
    np.testing.assert_array_equal(collected([readings[index] for index in order]).deviations(), expected)


def test_positions_of_a_rotary_axis_count_modulo_a_turn() -> None:
    # 359.99° for a target of 0° is −0.01°, 0.02° for one of 360° is +0.02°; the third is left alone
    turn, shown = 2 * math.pi, math.radians(0.01)
    readings = [
        dataclasses.replace(reading(2), target_position=0.0, deviation=turn - shown),
        dataclasses.replace(reading(3), target_position=turn, deviation=2 * shown - turn),
        dataclasses.replace(reading(4), target_position=turn / 2, deviation=shown),
    ]
    measurements = collected(readings, Axis("C", AxisKind.ROTARY))
    assert measurements.deviation == pytest.approx([-shown, 2 * shown, shown], abs=1e-15)
    remarks = [each.in_language(Language.ENGLISH) for each in measurements.provenance.remarks]
    assert "Whole turns were taken off readings (number: 2): positions were displayed modulo 360°." in remarks


def test_a_full_turn_that_ends_at_its_beginning_is_told_where_it_ends() -> None:
    turned = [dataclasses.replace(each, target_position=0.0) for each in (reading(2), reading(3))]
    with pytest.raises(InputError, match="the target at the end of a full turn is 360"):
        collected(turned, Axis("C", AxisKind.ROTARY))


def test_missing_and_ordinary_readings_of_a_rotary_axis_are_as_they_were() -> None:
    readings = [
        dataclasses.replace(reading(2), target_position=0.0, deviation=math.nan),
        dataclasses.replace(reading(3), target_position=1.0, deviation=1e-5),
    ]
    measurements = collected(readings, Axis("C", AxisKind.ROTARY))
    assert np.isnan(measurements.deviation[0])
    assert measurements.deviation[1] == 1e-5
    assert all("Whole turns" not in each.en for each in measurements.provenance.remarks)
