"""The contribution of environmental drift: simulated in time from the range of a test at rest.

Nobody knows whether the next test sees a ramp, slow waves, a random walk or plain noise of that range. These
are the kinds that are simulated, and U of a parameter is that of the kind which disturbs it most: so y ± U
holds whichever of them it was. What that costs where it was another is measured
(docs/explanation/uncertainty.md).
"""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum

import numpy as np

from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.measurement_set import MeasurementSet


class Drift(Enum):
    """A kind of drift over the time of a test."""

    NOISE = "noise"
    RAMP = "ramp"
    ONE_PERIOD = "one period"
    THREE_PERIODS = "three periods"
    RANDOM_WALK = "random walk"


#: Simulated drifts of each kind for the mean deviations: their root mean square is then known to 2 %.
_DRIFTS = 1_000
_SEED = 2309
_PERIODS = {Drift.ONE_PERIOD: 1.0, Drift.THREE_PERIODS: 3.0}


def choose_drift_kinds(measurements: MeasurementSet) -> tuple[Drift, ...]:
    """Return the kinds of drift that a test may see.

    Plain noise is none of them where the machine was read while it moved, many times a second: no environment
    varies so fast, and what does shows in the readings.
    """
    is_continuous = measurements.axis.measurand.is_continuous
    return tuple(kind for kind in Drift if not (is_continuous and kind is Drift.NOISE))


def compute_reading_times(measurements: MeasurementSet) -> FloatArray:
    """Return when each reading was taken, from 0 to 1 over the test, shape (approach, position, run).

    From the readings' own times where all have one, else from their order, evenly. NaN where there is none.
    """
    taken = np.arange(len(measurements.deviation), dtype=float)
    if measurements.time is not None and np.isfinite(measurements.time).all():
        taken = _spread_ties(measurements.time)
    first, last = float(taken.min()), float(taken.max())
    return measurements.arranged((taken - first) / (last - first) if last > first else np.zeros_like(taken))


def _spread_ties(times: FloatArray) -> FloatArray:
    """Return times of which those that are alike lie evenly up to the next one.

    A clock that stood, or that tells one time for a whole run, would have it that nothing drifted meanwhile.
    The last ones go on at the mean pace of those before; where all are alike, only their order is left.
    """
    count = np.arange(len(times), dtype=float)
    begins = np.flatnonzero(np.append(True, np.diff(times) != 0))
    if len(begins) == 1:
        return count
    pace = (times[begins[-1]] - times[0]) / begins[-1]
    end = times[-1] + pace * (len(times) - begins[-1])
    return np.asarray(np.interp(count, np.append(begins, len(times)), np.append(times[begins], end)))


def sample_drifts(kind: Drift, times: FloatArray, count: int, generator: np.random.Generator) -> FloatArray:
    """Return simulated drifts of full range 1, shape (count, approach, position, run).

    Noise has the range of its distribution, a wave that of its period, the others have it over the test.
    """
    each = (count, *(1,) * times.ndim)
    if kind is Drift.NOISE:
        return generator.random((count, *times.shape)) - 0.5
    if kind is Drift.RAMP:
        return np.asarray(np.where(generator.random(each) < 0.5, -1.0, 1.0) * (times - 0.5))
    if kind is Drift.RANDOM_WALK:
        return _sample_random_walks(times, count, generator)
    return np.asarray(0.5 * np.sin(2 * np.pi * (_PERIODS[kind] * times + generator.random(each))))


def compute_mean_drift_variance(
    times: FloatArray, kinds: Iterable[Drift] = tuple(Drift)
) -> tuple[FloatArray, FloatArray]:
    """Return E(d²) of what a drift of full range 1 adds to x̄_i↑ or x̄_i↓, and to x̄_i, of the worst kind.

    Both have the shape (position,); the first is of the direction that it disturbs more.

    `times`: Of the readings, (approach, position, run), NaN where there is none.
    `kinds`: That may occur.
    """
    generator = np.random.Generator(np.random.PCG64(_SEED))
    there = np.isfinite(times)
    by_approach, both = np.zeros(times.shape[1]), np.zeros(times.shape[1])
    for kind in kinds:
        drifts = sample_drifts(kind, times, _DRIFTS, generator)
        drifts[:, ~there] = 0.0
        means = drifts.sum(axis=-1) / np.maximum(there.sum(axis=-1), 1)
        by_approach = np.maximum(by_approach, np.mean(means**2, axis=0).max(axis=0))
        both = np.maximum(both, np.mean(means.mean(axis=1) ** 2, axis=0))
    return by_approach, both


def _sample_random_walks(times: FloatArray, count: int, generator: np.random.Generator) -> FloatArray:
    flat = times.ravel()
    order = np.argsort(flat)  # readings that are missing come last, and stay NaN
    there = order[: np.count_nonzero(np.isfinite(flat))]
    steps = np.sqrt(np.diff(flat[there], prepend=flat[there[0]]))
    walks = np.cumsum(steps * generator.standard_normal((count, len(there))), axis=1)
    full_range = np.ptp(walks, axis=1, keepdims=True)
    drifts = np.full((count, flat.size), np.nan)
    drifts[:, there] = walks / np.where(full_range > 0, full_range, 1.0)
    return drifts.reshape(count, *times.shape)
