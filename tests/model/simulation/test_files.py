"""From a simulation file to its description, and what is said of a file that is wrong."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from model.simulation.files import SOUND, described, mistakes, with_line
from zlmreport.model.planning.methods import Method
from zlmreport.model.simulation.description import ConditionCourse, SimulatedNoise


def test_sound_file_has_no_mistake(tmp_path: Path) -> None:
    assert mistakes(SOUND, tmp_path) == []


def test_lengths_and_feeds_become_metres_and_seconds(tmp_path: Path) -> None:
    plan = described(SOUND, tmp_path).plan
    assert (plan.method, plan.runs, plan.overrun, plan.feed, plan.dwell) == (Method.LINEAR, 3, 4e-3, 0.05, 2)


def test_targets_lie_at_random_fractions_of_the_pitch_and_can_be_typed(tmp_path: Path) -> None:
    targets = described(SOUND, tmp_path).plan.targets
    interval = (0.6 - 0.01) / 12
    fraction = targets - interval * np.arange(13)
    # cut off at a tenth of a micrometre
    assert np.all((fraction > -1.1e-7) & (fraction < 0.01))
    assert np.ptp(fraction) > 0.005
    np.testing.assert_allclose(targets * 1e7, np.round(targets * 1e7), atol=1e-6)


def test_targets_are_even_where_the_file_wants_it(tmp_path: Path) -> None:
    targets = described(with_line(4, "targets: {count: 4, fractions_of: 0}"), tmp_path).plan.targets
    np.testing.assert_allclose(targets, [0.0, 0.2, 0.4, 0.6], atol=1e-15)


def test_even_targets_that_a_double_misses_are_not_cut_off(tmp_path: Path) -> None:
    text = with_line(4, "targets: {count: 26, fractions_of: 0}").replace(
        "travel: [0, 600]", "travel: [0, 580]"
    )
    targets = described(text, tmp_path).plan.targets
    np.testing.assert_allclose(targets * 1e3, 23.2 * np.arange(26), atol=1e-9)  # and not 208.7999


@pytest.mark.parametrize(
    ("targets", "travel", "key"),
    [
        ("{positions: [0, 0.00001, 5]}", "[0, 600]", "positions"),
        ("{count: 26, fractions_of: 0}", "[0, 0.001]", "count"),
    ],
)
def test_targets_that_the_table_cannot_tell_apart_are_refused(
    tmp_path: Path, targets: str, travel: str, key: str
) -> None:
    text = with_line(4, f"targets: {targets}").replace("travel: [0, 600]", f"travel: {travel}")
    (said,) = mistakes(text, tmp_path)
    assert f"targets.{key}: two targets are nearer to each other than 0.0001 mm" in said


def test_targets_may_be_listed(tmp_path: Path) -> None:
    targets = described(with_line(4, "targets: {positions: [5, 100.5, 300]}"), tmp_path).plan.targets
    np.testing.assert_array_equal(targets, [0.005, 0.1005, 0.3])


def test_effects_have_their_values_in_metres(tmp_path: Path) -> None:
    values = [dict(each.fixed) for each in described(SOUND, tmp_path).effects]
    assert values == [{"offset": 1.5e-6}, {"lost_motion": -4e-6}, {"sine": 2e-6}]


def test_noise_and_conditions_become_si(tmp_path: Path) -> None:
    description = described(SOUND, tmp_path)
    assert description.noise == SimulatedNoise(reading=0.5e-6, resolution=0.1 / 1e6)
    assert description.conditions == {
        "axis_temperature": ConditionCourse(293.65, 295.15, 600.0, sensor_noise=0.01)
    }


def test_pressure_and_humidity_are_given_as_in_measurement_files(tmp_path: Path) -> None:
    line = (
        "conditions: {air_pressure: {start: 1010, swing: 2}, relative_humidity: {start: 45, resolution: 1}}"
    )
    conditions = described(with_line(12, line), tmp_path).conditions
    assert conditions["air_pressure"] == ConditionCourse(101_000.0, swing=200.0)
    assert conditions["relative_humidity"] == ConditionCourse(0.45, resolution=0.01)


def test_another_condition_is_taken_as_it_is(tmp_path: Path) -> None:
    conditions = described(with_line(12, "conditions: {oil_level: {start: 7}}"), tmp_path).conditions
    assert conditions == {"oil_level": ConditionCourse(7.0)}


def test_rotary_axis_is_in_degrees_and_arc_seconds(tmp_path: Path) -> None:
    text = with_line(3, "axis: {name: C, kind: rotary, travel: [0, 360]}").replace(
        ", {screw-pitch: {sine: 2}}", ", {eccentricity: {cosine: 3600}}"
    )
    description = described(text, tmp_path)
    assert description.effects[2].fixed["cosine"] == pytest.approx(np.radians(1.0), rel=1e-14)
    assert description.plan.overrun == pytest.approx(np.radians(4.0), rel=1e-14)


# Which line is replaced, by what, where the message points, and what it says.
WRONG = {
    "no seed": (2, "", "1:1", "seed is missing: of everything random: the same file gives the same test"),
    "unknown key": (9, "dwel: 2", "9:1", "unknown key 'dwel'; did you mean 'dwell'?"),
    "unknown method": (5, "method: pendulam", "5:9", "'pendulam' is unknown; did you mean 'pendulum'?"),
    "no runs": (6, "runs: 0", "6:7", "runs: '0' is not a number of at least 1"),
    "no targets": (4, "targets: {}", "4:1", "targets: either a count of targets, or their positions"),
    "targets twice over": (4, "targets: {count: 5, positions: [1]}", "4:1", "either a count of targets, or"),
    "falling targets": (4, "targets: {positions: [1, 3, 2]}", "4:11", "target positions rise, and none is"),
    "too many targets": (4, "targets: {count: 61}", "4:18", "targets.count: 61 targets with fractions of a"),
    "no travel": (3, "axis: {name: X, screw_pitch: 10}", "3:1", "axis.travel is missing: targets are spread"),
    "turned travel": (3, "axis: {name: X, travel: [9, 1], screw_pitch: 1}", "3:17", "must be less than"),
    "unknown effect": (10, "effects: [ofset: {offset: 1}]", "10:11", "did you mean 'offset'?"),
    "unknown parameter": (10, "effects: [offset: {ofset: 1}]", "10:20", "did you mean 'offset'?"),
    "effect without a size": (10, "effects: [backlash]", "10:11", "backlash has no size; give lost_motion"),
    "harmonics without a size": (
        10,
        "effects: [{screw-pitch: {harmonics: [1]}}]",
        "10:11",
        "give sine or cosine, as in {screw-pitch: {sine: 1}} (µm)",
    ),
    "effect without a period": (
        10,
        "effects: [{periodic: {sine: 1}}]",
        "10:11",
        "periodic: period is missing, the period along the axis, mm",
    ),
    "effect without its condition": (
        10,
        "effects: [{screw-expansion: {expansion: 11}}]",
        "10:11",
        "screw-expansion cannot act on this test: no column screw_temperature was logged",
    ),
    "effect of another kind of axis": (
        10,
        "effects: [{eccentricity: {sine: 1}}]",
        "10:11",
        "eccentricity cannot act on this test: for rotary axes only",
    ),
    "negative noise": (11, "noise: {reading: -1}", "11:18", "reading: '-1' is not a number of at least 0"),
    "all readings missing": (11, "noise: {missing_share: 1}", "11:24", "is not a number less than 1"),
    "condition without a start": (12, "conditions: {air_pressure: {}}", "12:14", "start is missing"),
    "folder in a file name": (12, "output: {readings: a/b.csv}", "12:20", "'a/b.csv' is no file's name; the"),
    "wrong model": (12, "model: {effects: [backlush]}", "12:19", "did you mean 'backlash'?"),
}


@pytest.mark.parametrize(("line", "replacement", "place", "core"), WRONG.values(), ids=WRONG)
def test_what_is_wrong_is_said_where_it_stands(
    line: int, replacement: str, place: str, core: str, tmp_path: Path
) -> None:
    found = mistakes(with_line(line, replacement), tmp_path)
    assert [message for message in found if message.startswith(f"{place}: ") and core in message], found


def test_more_readings_than_a_file_may_have_are_refused(tmp_path: Path) -> None:
    text = with_line(6, "runs: 1000").replace("{count: 13}", "{count: 101, fractions_of: 0}")
    (message,) = mistakes(text, tmp_path)
    assert message.startswith("6:1: runs: 1,000 runs over 101 targets are more than 200,000 readings")


def test_a_time_that_nothing_takes_is_refused(tmp_path: Path) -> None:
    line = "conditions: {axis_temperature: {start: 20, end: 21, time_constant: 1.0e-308}}"
    (mistake,) = mistakes(with_line(12, line), tmp_path)
    assert "1e-308 is smaller than anything that is there; 1e-12 is the least" in mistake


def test_everything_wrong_with_the_effects_is_said_at_once(tmp_path: Path) -> None:
    line = "effects: [backlash, {periodic: {sine: 1}}, {eccentricity: {sine: 1}}]"
    assert len(mistakes(with_line(10, line), tmp_path)) == 3


@pytest.mark.parametrize(("line", "key"), [(7, "overrun"), (8, "feed")])
def test_a_way_or_a_feed_that_no_axis_has_is_refused(line: int, key: str, tmp_path: Path) -> None:
    """It would be lost in the rounding of a target's place, or take longer than any number."""
    assert mistakes(with_line(line, f"{key}: 0.001"), tmp_path) == []
    (mistake,) = mistakes(with_line(line, f"{key}: 1.0e-308"), tmp_path)
    assert "'1.0e-308' is not a number of at least 0.001" in mistake
