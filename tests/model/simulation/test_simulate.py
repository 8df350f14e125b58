"""A simulated test is the one that is described: effects, noise, logs, gaps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from model.simulation.describing import described, hidden
from zlmreport.model.fitting.observations import make_observations_of
from zlmreport.model.planning.methods import Method
from zlmreport.model.simulation.description import ConditionCourse, SimulatedNoise
from zlmreport.model.simulation.simulate import simulate

FOLLOWING = hidden("datum-temperature", sensitivity=1e-6)
MANY = {"targets": 101, "runs": 50}  # 10,100 readings: a standard deviation is known to 0.7 %


def test_without_noise_the_readings_are_the_effects() -> None:
    effects = (hidden("offset", offset=2e-6), hidden("backlash", lost_motion=4e-6))
    measurements = simulate(described(effects=effects)).measurements
    expected = np.where(measurements.approach > 0, 4e-6, 0.0)
    np.testing.assert_allclose(measurements.deviation, expected, atol=1e-18)


def test_effects_add_up() -> None:
    one, other = hidden("scale-error", slope=1e-5), hidden("backlash-bow", bow=3e-6)
    both = simulate(described(effects=(one, other))).systematic
    apart = simulate(described(effects=(one,))).systematic + simulate(described(effects=(other,))).systematic
    np.testing.assert_allclose(both, apart, atol=1e-20)


def test_period_that_the_axis_states_need_not_be_given() -> None:
    description = described(effects=(hidden("screw-pitch", sine=1e-6),))
    axis = replace(description.axis, screw_pitch=0.16)
    systematic = simulate(replace(description, axis=axis)).systematic
    position = description.plan.targets
    np.testing.assert_allclose(systematic[:11], 1e-6 * np.sin(2 * np.pi * position / 0.16), atol=1e-20)


def test_searched_parameter_without_a_value_is_refused() -> None:
    with pytest.raises(ValueError, match="periodic needs a value of period"):
        simulate(described(effects=(hidden("periodic", sine=1e-6),)))


def test_the_same_description_gives_the_same_test() -> None:
    noise = SimulatedNoise(reading=1e-6, position=1e-6, run=1e-6, drift=1e-6, missing_share=0.1)
    one, other = (simulate(described(noise=noise)).measurements.deviation for _ in range(2))
    np.testing.assert_array_equal(one, other)


def test_another_seed_gives_another_test() -> None:
    one, other = (
        simulate(described(noise=SimulatedNoise(reading=1e-6), seed=seed)).measurements.deviation
        for seed in (1, 2)
    )
    assert not np.any(one == other)


def test_one_part_of_the_noise_leaves_the_others_as_they_are() -> None:
    def deviation(**parts: float) -> NDArray[np.float64]:
        return simulate(described(noise=SimulatedNoise(**parts))).measurements.deviation

    together = deviation(reading=1e-6, position=1e-6, drift=1e-6)
    apart = deviation(reading=1e-6) + deviation(position=1e-6) + deviation(drift=1e-6)
    np.testing.assert_allclose(together, apart, atol=1e-19)


@pytest.mark.parametrize(
    ("part", "share_of_a_standard_deviation"),
    [
        # 1/sqrt(2·number of independent values) is the uncertainty of a standard deviation; 4 of them
        ("reading", 4 / np.sqrt(2 * 10_100)),
        ("position", 4 / np.sqrt(2 * 101)),
        ("position_and_direction", 4 / np.sqrt(2 * 101)),
        ("run", 4 / np.sqrt(2 * 50)),
    ],
)
def test_size_of_noise_is_the_stated_one(part: str, share_of_a_standard_deviation: float) -> None:
    deviation = simulate(described(**MANY, noise=SimulatedNoise(**{part: 1e-6}))).measurements.deviation
    assert np.sqrt(np.mean(deviation**2)) == pytest.approx(1e-6, rel=share_of_a_standard_deviation)


def test_noise_fixed_in_position_is_the_same_in_all_runs_and_directions() -> None:
    grid = simulate(described(noise=SimulatedNoise(position=1e-6))).measurements.deviations()
    assert np.ptp(grid, axis=(0, 2)).max() == 0.0
    assert np.ptp(grid[0, :, 0]) > 0.0


def test_noise_fixed_in_direction_is_opposite_in_the_two() -> None:
    grid = simulate(described(noise=SimulatedNoise(position_and_direction=1e-6))).measurements.deviations()
    np.testing.assert_array_equal(grid[0], -grid[1])


def test_noise_of_a_run_is_the_same_within_it() -> None:
    grid = simulate(described(noise=SimulatedNoise(run=1e-6))).measurements.deviations()
    assert np.ptp(grid, axis=(0, 1)).max() == 0.0
    assert np.ptp(grid[0, 0]) > 0.0


def test_slow_drift_forgets_itself_over_its_time() -> None:
    test = simulate(described(**MANY, noise=SimulatedNoise(drift=1e-6, drift_time=60.0)))
    drift, time = test.measurements.deviation, test.design.time
    lag = 7
    product = np.mean(drift[lag:] * drift[:-lag]) / np.mean(drift**2)
    expected = np.mean(np.exp(-(time[lag:] - time[:-lag]) / 60.0))
    # some 1000 memories pass: the correlation is known to about 0.03
    assert product == pytest.approx(expected, abs=0.1)


def test_unequal_spread_differs_from_target_to_target_within_its_share() -> None:
    grid = simulate(
        described(targets=20, runs=2000, noise=SimulatedNoise(reading=1e-6, unequal=0.25))
    ).measurements
    spread = np.std(grid.deviations(), axis=(0, 2))
    assert spread.min() < 0.85e-6
    assert spread.max() > 1.15e-6
    assert np.all(np.abs(spread / 1e-6 - 1) < 0.25 * (1 + 4 / np.sqrt(2 * 4000)))


def test_missing_readings_keep_their_places() -> None:
    measurements = simulate(described(**MANY, noise=SimulatedNoise(missing_share=0.02))).measurements
    assert len(measurements.deviation) == 10_100
    # binomial: 202 ± 14
    assert 146 < np.count_nonzero(np.isnan(measurements.deviation)) < 258


def test_outliers_are_off_by_their_size_up_or_down() -> None:
    deviation = simulate(
        described(**MANY, noise=SimulatedNoise(outlier_share=0.01, outlier_size=2e-5))
    ).measurements.deviation
    assert set(deviation.tolist()) == {-2e-5, 0.0, 2e-5}
    assert 61 < np.count_nonzero(deviation) < 141


def test_instrument_shows_its_resolution() -> None:
    deviation = simulate(
        described(noise=SimulatedNoise(reading=1e-6, resolution=1e-7))
    ).measurements.deviation
    np.testing.assert_allclose(deviation / 1e-7, np.round(deviation / 1e-7), atol=1e-9)
    assert np.ptp(deviation) > 0


def test_effects_follow_the_true_condition_and_the_log_has_noise() -> None:
    course = ConditionCourse(294.15, 297.15, sensor_noise=0.05)
    test = simulate(described(effects=(FOLLOWING,), conditions={"axis_temperature": course}))
    true = test.design.conditions["axis_temperature"]
    np.testing.assert_allclose(test.systematic, 1e-6 * (true - 293.15), atol=1e-18)
    logged = test.measurements.conditions["axis_temperature"]
    assert 0.03 < np.std(logged - true) < 0.07


def test_condition_that_is_not_logged_acts_all_the_same() -> None:
    course = ConditionCourse(294.15, is_logged=False)
    test = simulate(described(effects=(FOLLOWING,), conditions={"axis_temperature": course}))
    assert test.measurements.conditions == {}
    np.testing.assert_allclose(test.systematic, 1e-6, atol=1e-18)


def test_sensor_shows_its_resolution() -> None:
    test = simulate(
        described(conditions={"axis_temperature": ConditionCourse(293.0, 294.0, resolution=0.25)})
    )
    assert set(test.measurements.conditions["axis_temperature"].tolist()) == {
        293.0,
        293.25,
        293.5,
        293.75,
        294.0,
    }


def test_each_sensor_has_noise_of_its_own() -> None:
    course = ConditionCourse(293.15, sensor_noise=1.0)
    logs = simulate(described(conditions={"axis_temperature": course, "oil": course})).measurements.conditions
    assert not np.any(logs["axis_temperature"] == logs["oil"])


def test_times_may_be_left_out() -> None:
    assert simulate(described(time_is_logged=False)).measurements.time is None


def test_the_origin_of_the_readings_is_said() -> None:
    provenance = simulate(described()).measurements.provenance
    assert provenance.source == "simulation"
    assert provenance.remarks[0].values == {"seed": 1}


@pytest.mark.parametrize("method", Method)
def test_the_error_model_sees_the_readings_as_they_were_planned(method: Method) -> None:
    test = simulate(described(method=method))
    seen = make_observations_of(test.measurements, overrun=5e-3).design
    for name in ("position", "direction", "run", "target", "time"):
        np.testing.assert_array_equal(getattr(seen, name), getattr(test.design, name))
    np.testing.assert_allclose(seen.since_reversal, test.design.since_reversal, atol=1e-12)
