"""What is simulated: an axis, a plan, effects, conditions and noise; all in SI.

Every random part has a stream of its own, so that changing one leaves the others as they are.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np

from zlmreport.measurement.arrays import BoolArray, FloatArray
from zlmreport.measurement.axis import Axis
from zlmreport.model.effects.axis_model import Term
from zlmreport.model.effects.design import Design
from zlmreport.model.planning.plan import AxisPlan


@dataclass(frozen=True, slots=True)
class ConditionCourse:
    """How a condition changes during the test, and how it is logged."""

    start: float  #: At the first reading, SI.
    #: At the last reading where there is no time constant, else what it tends to; None: it stays.
    end: float | None = None
    time_constant: float | None = None  #: Of the way from start to end, s; None for a straight way.
    swing: float = 0.0  #: Amplitude of a sine that is added.
    swing_period: float = 900.0  #: Its period, s.
    sensor_noise: float = 0.0  #: Standard deviation of what is logged.
    resolution: float = 0.0  #: Of what is logged; 0 for none.
    is_logged: bool = True  #: Whether the condition is logged at all; it acts in any case.


@dataclass(frozen=True, slots=True)
class SimulatedNoise:
    """Everything random about the readings, m or rad, as standard deviations."""

    reading: float = 0.0  #: σ of a single reading.
    unequal: float = 0.0  #: By which share of itself σ differs from target to target, at most.
    position: float = 0.0  #: Fixed in position: geometry that no smooth effect describes.
    position_and_direction: float = 0.0  #: Fixed in position, of opposite sign in the two directions.
    run: float = 0.0  #: Every run a little displaced.
    #: drift and drift_time: Slow random drift, and the time over which it forgets itself, s.
    drift: float = 0.0
    drift_time: float = 600.0
    #: outlier_share and outlier_size: The probability that a reading is off, and by how much, up or down.
    outlier_share: float = 0.0
    outlier_size: float = 0.0
    missing_share: float = 0.0  #: The probability that a reading is missing.
    resolution: float = 0.0  #: Of the instrument; 0 for none.


@dataclass(frozen=True, slots=True)
class Description:
    """A test that is to be simulated."""

    axis: Axis  #: The axis, with its tables.
    plan: AxisPlan  #: How it is tested.
    #: Of everything random: the same description gives the same test. Each random part has a stream of its
    #: own, so that changing one leaves the others as they are.
    seed: int
    #: What makes the axis err, each with the values of its parameters; linear ones that are left out are 0.
    effects: tuple[Term, ...] = ()
    conditions: Mapping[str, ConditionCourse] = field(default_factory=dict)  #: By name.
    noise: SimulatedNoise = field(default_factory=SimulatedNoise)  #: Everything random about the readings.
    time_is_logged: bool = True  #: Whether the readings carry times.


class Stream(IntEnum):
    """A random part; the number belongs to it for ever, or old seeds would give other tests."""

    READING = 1
    UNEQUAL = 2
    POSITION = 3
    POSITION_AND_DIRECTION = 4
    RUN = 5
    DRIFT = 6
    OUTLIER = 7
    MISSING = 8
    LOG = 9
    # 10 are the targets: `zlmreport.model.planning.targets`

    def make_generator(self, seed: int, *further: int) -> np.random.Generator:
        """Return the generator of this part for a seed."""
        return np.random.default_rng([seed, self, *further])


def sample_noise_of(noise: SimulatedNoise, design: Design, seed: int) -> FloatArray:
    """Return the random part of each reading, shape (N,), m or rad; resolution and missing ones apart."""
    targets = int(design.target.max()) + 1
    runs = int(design.run.max()) + 1
    per_target = Stream.POSITION.make_generator(seed).standard_normal(targets)
    per_direction = Stream.POSITION_AND_DIRECTION.make_generator(seed).standard_normal(targets)
    per_run = Stream.RUN.make_generator(seed).standard_normal(runs)
    return np.asarray(
        _sample_readings(noise, design, targets, seed)
        + noise.position * per_target[design.target]
        + noise.position_and_direction * design.direction * per_direction[design.target]
        + noise.run * per_run[design.run]
        + noise.drift * _sample_drift(design.time, noise.drift_time, seed)
        + _sample_outliers(noise, len(design.position), seed)
    )


def is_missing(noise: SimulatedNoise, readings: int, seed: int) -> BoolArray:
    """Return which readings are missing, shape (N,)."""
    return np.asarray(Stream.MISSING.make_generator(seed).random(readings) < noise.missing_share)


def round_as_shown(values: FloatArray, resolution: float) -> FloatArray:
    """Return values as an instrument of some resolution shows them; as they are for 0."""
    if not resolution:
        return values
    with np.errstate(over="ignore"):  # of steps that are finer than a double
        steps = np.round(values / resolution)
    return np.where(np.isfinite(steps), steps * resolution, values)


def _sample_readings(noise: SimulatedNoise, design: Design, targets: int, seed: int) -> FloatArray:
    spread = 1 + noise.unequal * Stream.UNEQUAL.make_generator(seed).uniform(-1, 1, targets)
    single = Stream.READING.make_generator(seed).standard_normal(len(design.position))
    return np.asarray(noise.reading * spread[design.target] * single)


def _sample_drift(time: FloatArray, memory: float, seed: int) -> FloatArray:
    """Return a stationary process of unit variance whose correlation fades as exp(−Δt/memory)."""
    shocks = Stream.DRIFT.make_generator(seed).standard_normal(len(time))
    kept = np.exp(-np.diff(time) / memory)
    drift = shocks.copy()
    for later, share in enumerate(kept, 1):
        drift[later] = share * drift[later - 1] + np.sqrt(1 - share**2) * shocks[later]
    return drift


def _sample_outliers(noise: SimulatedNoise, readings: int, seed: int) -> FloatArray:
    random = Stream.OUTLIER.make_generator(seed)
    is_off = random.random(readings) < noise.outlier_share
    return np.asarray(np.where(is_off, random.choice([-1.0, 1.0], readings), 0.0) * noise.outlier_size)


def compute_true_course(course: ConditionCourse, time: FloatArray) -> FloatArray:
    """Return a condition at each reading, SI, shape (N,)."""
    end = course.start if course.end is None else course.end
    if course.time_constant is None:
        duration = time[-1] or 1.0
        progress = time / duration
    else:
        progress = -np.expm1(-time / course.time_constant)
    swing = course.swing * np.sin(2 * np.pi * time / course.swing_period)
    return np.asarray(course.start + (end - course.start) * progress + swing)


def compute_logged_course(course: ConditionCourse, true: FloatArray, seed: int, sensor: int) -> FloatArray:
    """Return what a sensor logs of a condition.

    `course`: With the sensor's noise and resolution.
    `true`, (N,): The condition, SI.
    `sensor`: Number of the sensor: each has noise of its own.
    """
    noise = course.sensor_noise * Stream.LOG.make_generator(seed, sensor).standard_normal(len(true))
    return round_as_shown(true + noise, course.resolution)
