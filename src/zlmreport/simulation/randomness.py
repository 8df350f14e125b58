"""Random parts of a simulated test, each with a stream of its own."""

from __future__ import annotations

from enum import IntEnum

import numpy as np

from zlmreport.model.design import Design
from zlmreport.quantities.arrays import BoolArray, FloatArray
from zlmreport.simulation.description import Noise


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
    TARGETS = 10

    def generator(self, seed: int, *further: int) -> np.random.Generator:
        """Return the generator of this part for a seed."""
        return np.random.default_rng([seed, self, *further])


def noise_of(noise: Noise, design: Design, seed: int) -> FloatArray:
    """Return the random part of each reading, shape (N,), m or rad; resolution and missing ones apart."""
    targets = int(design.target.max()) + 1
    runs = int(design.run.max()) + 1
    per_target = Stream.POSITION.generator(seed).standard_normal(targets)
    per_direction = Stream.POSITION_AND_DIRECTION.generator(seed).standard_normal(targets)
    per_run = Stream.RUN.generator(seed).standard_normal(runs)
    return np.asarray(
        _readings(noise, design, targets, seed)
        + noise.position * per_target[design.target]
        + noise.position_and_direction * design.direction * per_direction[design.target]
        + noise.run * per_run[design.run]
        + noise.drift * _drift(design.time, noise.drift_time, seed)
        + _outliers(noise, len(design.position), seed)
    )


def is_missing(noise: Noise, readings: int, seed: int) -> BoolArray:
    """Return which readings are missing, shape (N,)."""
    return np.asarray(Stream.MISSING.generator(seed).random(readings) < noise.missing_share)


def rounded(values: FloatArray, resolution: float) -> FloatArray:
    """Return values as an instrument of some resolution shows them; as they are for 0."""
    return np.asarray(np.round(values / resolution) * resolution) if resolution else values


def _readings(noise: Noise, design: Design, targets: int, seed: int) -> FloatArray:
    spread = 1 + noise.unequal * Stream.UNEQUAL.generator(seed).uniform(-1, 1, targets)
    single = Stream.READING.generator(seed).standard_normal(len(design.position))
    return np.asarray(noise.reading * spread[design.target] * single)


def _drift(time: FloatArray, memory: float, seed: int) -> FloatArray:
    """Return a stationary process of unit variance whose correlation fades as exp(−Δt/memory)."""
    shocks = Stream.DRIFT.generator(seed).standard_normal(len(time))
    kept = np.exp(-np.diff(time) / memory)
    drift = shocks.copy()
    for later, share in enumerate(kept, 1):
        drift[later] = share * drift[later - 1] + np.sqrt(1 - share**2) * shocks[later]
    return drift


def _outliers(noise: Noise, readings: int, seed: int) -> FloatArray:
    random = Stream.OUTLIER.generator(seed)
    is_off = random.random(readings) < noise.outlier_share
    return np.asarray(np.where(is_off, random.choice([-1.0, 1.0], readings), 0.0) * noise.outlier_size)
