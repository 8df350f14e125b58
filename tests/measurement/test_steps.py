"""The decimals of values, and the step of their display, which is not always that of their last digit."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport.measurement.arrays import count_decimals_of
from zlmreport.measurement.measurement_set import find_last_digit, find_step
from zlmreport.plugin import Axis, MeasurementSet


@pytest.mark.parametrize(
    ("values", "decimals"),
    [
        ([1.0, -20.0], 0),
        ([1.0, 0.25], 2),
        ([0.1 + 0.2], 1),
        ([np.nan, 0.5], 1),
        ([1 / 3], 3),
        ([], 0),
    ],
)
def test_the_fewest_decimals_that_hold_all_values_count(values: list[float], decimals: int) -> None:
    assert count_decimals_of(np.array(values), most=3) == decimals


TARGETS = np.linspace(0.003, 0.993, 11)


def measured(
    step: float, *, of_positions: bool = False, scatter: float = 20.0, seed: int = 1
) -> MeasurementSet:
    """Return readings of five runs in steps of so many µm, of deviations or of positions."""
    generator = np.random.default_rng(seed)
    target = np.repeat(np.arange(11), 5)
    true = 8 * np.sin(TARGETS[target] * 9) + scatter * generator.standard_normal(target.size)
    offset = 1e6 * TARGETS[target] % step if of_positions else 0.0
    deviation = np.round((true + offset) / step) * step - offset
    return MeasurementSet(
        axis=Axis(name="X"),
        target_positions=TARGETS,
        target=target,
        approach=np.ones_like(target),
        run=np.tile(np.arange(1, 6), 11),
        deviation=1e-6 * np.round(deviation, 3),
    )


@pytest.mark.parametrize("step", [0.1, 0.5, 1.0, 2.0, 5.0, 10.0])
@pytest.mark.parametrize("of_positions", [True, False])
def test_the_step_is_that_of_the_display(step: float, *, of_positions: bool) -> None:
    assert find_step(measured(step, of_positions=of_positions)) == pytest.approx(step)


def test_the_last_digit_may_be_finer_than_the_step() -> None:
    assert find_last_digit(measured(10.0)) == 1.0


@pytest.mark.parametrize("seed", range(50))
def test_no_step_is_seen_that_is_none(seed: int) -> None:
    """Also where the scatter is little more than a digit, or less."""
    for scatter in (0.3, 1.0, 20.0):
        readings = measured(1.0, scatter=scatter, seed=seed)
        assert find_step(readings) == find_last_digit(readings) == 1.0


def test_few_readings_show_no_step() -> None:
    readings = measured(10.0)
    few = MeasurementSet(
        axis=readings.axis,
        target_positions=TARGETS,
        target=readings.target[::5],
        approach=readings.approach[::5],
        run=readings.run[::5],
        deviation=readings.deviation[::5],
    )

    assert find_step(few) == 1.0
