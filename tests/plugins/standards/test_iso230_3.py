"""ISO 230-3: how far a machine drifts while it stands, from sensors over hours."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

from installed import registry
from zlmreport.measurement.measurement_set import join_lines
from zlmreport.plugin import DISPLACEMENT, Axis, Evaluation, Language, MeasurementSet
from zlmreport.plugin.standard import evaluate

ARCSECOND = np.pi / 180 / 3600
HOURS = np.arange(0.0, 24.25, 0.25)
STANDARD = registry().standard("iso230-3")
(DRIFT,) = STANDARD.measurands


def sensor(name: str, values: np.ndarray, hours: np.ndarray = HOURS) -> MeasurementSet:
    """Return what a sensor read at some hours, µm."""
    count = len(hours)
    return MeasurementSet(
        axis=Axis(name, quantity=DISPLACEMENT),
        target_positions=3600 * hours,
        target=np.arange(count),
        approach=np.ones(count, dtype=np.int64),
        run=np.ones(count, dtype=np.int64),
        deviation=1e-6 * np.asarray(values, dtype=float),
    )


def together(*sensors: MeasurementSet, **keys: object) -> Evaluation:
    options = STANDARD.options.model_validate(keys)
    tests = {each.axis.name: each for each in sensors}
    return evaluate(STANDARD, join_lines(Axis(" ".join(tests), quantity=DRIFT), tests), options, {})


def values(evaluation: Evaluation) -> dict[str, float]:
    return {each.quantity.symbol: each.value for each in evaluation.parameters}


def found(evaluation: Evaluation, beginning: str) -> tuple[str, bool | None]:
    """Return what was found of the requirement that begins so, and whether it is met."""
    (finding,) = (
        each
        for each in evaluation.findings
        if each.requirement.in_language(Language.ENGLISH).startswith(beginning)
    )
    return finding.found.in_language(Language.ENGLISH), finding.met


def wave(size: float, phase: float = 0.0) -> np.ndarray:
    return size * np.sin(2 * np.pi * HOURS / 24 + phase)


@given(st.integers(0, 2**32 - 1), st.integers(0, 40), st.integers(4, 50))
def test_the_drift_is_the_range_of_the_readings_in_the_stated_hours(
    seed: int, first: int, quarters: int
) -> None:
    """Against a loop over single readings that shares nothing with the program."""
    readings = np.random.default_rng(seed).normal(0, 5, len(HOURS))
    start, hours = first / 4, quarters / 4
    inside = [value for hour, value in zip(HOURS, readings, strict=True) if start <= hour <= start + hours]
    evaluation = together(sensor("X", readings), start=start, hours=hours)
    assert values(evaluation)["E_X"] * 1e6 == pytest.approx(max(inside) - min(inside))


@given(st.integers(0, 2**32 - 1), st.floats(-500, 500), st.floats(0.1, 20))
def test_the_zero_of_a_sensor_is_nothing_and_its_scale_everything(
    seed: int, zero: float, scale: float
) -> None:
    readings = np.random.default_rng(seed).normal(0, 5, len(HOURS))
    usual = values(together(sensor("Y", readings)))["E_Y"]
    assert values(together(sensor("Y", zero + readings)))["E_Y"] == pytest.approx(usual, abs=1e-12)
    assert values(together(sensor("Y", scale * readings)))["E_Y"] == pytest.approx(scale * usual)


def test_a_record_that_is_longer_than_the_stated_hours_counts_in_them_only() -> None:
    readings = np.where(HOURS <= 4, HOURS, 4 + 10 * (HOURS - 4))
    assert values(together(sensor("Z", readings), hours=4))["E_Z"] * 1e6 == pytest.approx(4.0)
    assert values(together(sensor("Z", readings)))["E_Z"] * 1e6 == pytest.approx(204.0)


def test_a_record_that_is_shorter_than_the_stated_hours_has_no_drift_in_them() -> None:
    evaluation = together(sensor("X", HOURS), sensor("Z", HOURS[:13], HOURS[:13]), hours=4)
    assert values(evaluation).keys() == {"E_X"}
    said, met = found(evaluation, "Readings over all these hours")
    assert said.startswith("Z: 3 h of 4 h")
    assert met is False


def test_averages_stand_in_the_middles_of_intervals_and_cover_the_hours_all_the_same() -> None:
    middles = np.arange(96) / 4 / 6 + 1 / 48  # of 2.5 minutes over 4 hours
    evaluation = together(sensor("X", middles, middles), hours=4)
    assert "E_X" in values(evaluation)


def test_a_coarse_record_may_not_lack_a_whole_interval() -> None:
    coarse = np.arange(4.0)  # 0, 1, 2, 3 h: an hour of four is not there
    assert not values(together(sensor("X", coarse, coarse), hours=4))


def test_hours_that_begin_behind_the_record_give_nothing() -> None:
    assert not values(together(sensor("X", HOURS), sensor("X1", HOURS), start=30))


@given(st.integers(0, 2**32 - 1), st.floats(20, 900))
def test_a_tilt_is_the_range_of_the_difference_over_the_distance(seed: int, distance: float) -> None:
    scatter = np.random.default_rng(seed)
    near, far = scatter.normal(0, 5, (2, len(HOURS)))
    evaluation = together(sensor("X1", near), sensor("X2", far), distance={"X": distance})
    differences = [(one - other) * 1e-3 / distance for one, other in zip(near, far, strict=True)]
    assert values(evaluation)["tilt_X"] == pytest.approx(max(differences) - min(differences))


def test_what_both_sensors_do_alike_is_no_tilt() -> None:
    alone = together(sensor("Y1", wave(2)), sensor("Y2", wave(0)), distance={"Y": 200})
    moved = together(sensor("Y1", wave(2) + wave(9, 1)), sensor("Y2", wave(9, 1)), distance={"Y": 200})
    assert values(moved)["tilt_Y"] == pytest.approx(values(alone)["tilt_Y"])
    assert values(moved)["tilt_Y"] / ARCSECOND == pytest.approx(4e-6 / 0.2 / ARCSECOND)


def test_sensors_that_were_read_one_after_the_other_are_compared_at_the_same_time() -> None:
    later = HOURS + 1 / 60
    straight = together(
        sensor("X1", 3 * HOURS), sensor("X2", 3 * later, later), distance={"X": 200}
    )  # the same ramp: no tilt, though the readings differ by 0.05 µm
    assert values(straight)["tilt_X"] == pytest.approx(0.0, abs=1e-12)


def test_a_tilt_needs_both_sensors_and_their_distance() -> None:
    without = together(sensor("X1", HOURS), sensor("X2", 2 * HOURS))
    assert "tilt_X" not in values(without)
    assert found(without, "Tilt from X1 and X2")[1] is None
    single = together(sensor("X1", HOURS), distance={"X": 200})
    assert "tilt_X" not in values(single)
    assert found(single, "Tilt from X1 and X2")[1] is False


def test_hours_that_nobody_stated_are_those_of_the_record_and_said() -> None:
    said, met = found(together(sensor("X", HOURS)), "Hours over which")
    assert said == "not stated (hours); the whole record is taken: 24 h from 0 h on"
    assert met is None


def test_one_channel_lacks_the_other_directions() -> None:
    said, met = found(together(sensor("X", HOURS)), "Sensors in X, Y and Z")
    assert said == "X; none in Y, Z"
    assert met is False


@pytest.mark.parametrize(("hours", "met"), [(3.75, False), (4.0, True), (24.0, True)])
def test_a_test_of_less_than_four_hours_falls_short(hours: float, *, met: bool) -> None:
    record = np.arange(0.0, hours + 0.01, 0.25)
    assert found(together(sensor("X", record, record)), "A test of at least 4 h")[1] is met


def test_a_gap_in_the_record_is_found() -> None:
    broken = np.concatenate([HOURS[:20], HOURS[30:]])  # from 4.75 to 7.5 h
    said, met = found(together(sensor("X", HOURS), sensor("Y", broken, broken)), "No time without")
    assert said == "165 min at most (Y), usually 15 min"
    assert met is False


def test_a_reading_that_is_missing_is_counted_and_not_filled_in() -> None:
    readings = wave(5)
    readings[24] = np.nan  # of the peak
    evaluation = together(sensor("X", readings))
    assert found(evaluation, "No reading missing") == (
        "1 of 97 missing (X); evaluated by what is there",
        False,
    )
    assert values(evaluation)["E_X"] * 1e6 == pytest.approx(np.nanmax(readings) - np.nanmin(readings))


def test_displacements_and_temperatures_share_one_axis_of_time() -> None:
    line = sensor("X", wave(5))
    logged = {"air_temperature": 293.15 + HOURS / 10, "spindle_temperature": 21 + HOURS / 8, "load": HOURS}
    evaluation = together(replace(line, conditions=logged))
    (figure,) = STANDARD.figures(evaluation, STANDARD.options())
    assert [figure.value_axis(panel)[1] for panel in figure.panels] == ["µm", "°C"]
    air, spindle = figure.panels[1].curves  # and not the load, which is no temperature
    np.testing.assert_allclose(air.y, 20 + HOURS / 10, atol=1e-9)
    np.testing.assert_allclose(spindle.y, 21 + HOURS / 8)
    np.testing.assert_allclose(air.x, figure.panels[0].curves[0].x)


@pytest.mark.parametrize(
    ("language", "told"),
    [
        (Language.ENGLISH, "Air temperature 2.4 K; spindle temperature 3 K"),
        (Language.FRENCH, "Température de l’air 2,4 K\N{NO-BREAK SPACE}; spindle temperature 3 K"),
    ],
)
def test_the_ranges_of_temperatures_are_parted_as_each_language_parts_them(
    language: Language, told: str
) -> None:
    logged = {"air_temperature": 293.15 + HOURS / 10, "spindle_temperature": 21 + HOURS / 8}
    findings = together(replace(sensor("X", wave(5)), conditions=logged)).findings
    texts = [(each.requirement.in_language(Language.ENGLISH), each.found) for each in findings]
    (ranges,) = (text for requirement, text in texts if requirement.startswith("Temperatures recorded"))
    assert ranges.in_language(language) == told


def test_curves_begin_at_zero_whatever_the_sensors_showed() -> None:
    evaluation = together(sensor("X", 300 + wave(5)), sensor("Y", -80 + wave(2)))
    (figure,) = STANDARD.figures(evaluation, STANDARD.options())
    assert [curve.y[0] for curve in figure.panels[0].curves] == [0.0, 0.0]
