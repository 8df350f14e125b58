"""What rounding does to an axis that scatters less than the last digit of its readings shows.

Rounding errors are independent, and a mean of n readings has d/√(12·n) of them, where readings scatter
over several steps d. A quieter axis is rounded the same way again and again: all runs share the error of
a target, and where its mean lies between two steps a scatter is shown that the axis does not have. So
tests of axes that may be this one are simulated as they were before rounding, and rounded: how far a
parameter moves by it is the error. Such an axis has the means of this one, and a scatter from the
posterior distribution of σ: alike in all places, flat in ln σ, with readings that each lie within half a
step of what was shown, about a mean of their target and direction of which nothing else is known. Where
its means lie between the steps nobody knows, and is drawn too.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from zlmreport.evaluation.uncertainty.budget import Acts, Budget, Contribution, Distribution, find_full_range
from zlmreport.measurement.arrays import FloatArray

#: Pooled standard deviation, in steps, from which rounding errors are independent.
_LOUD = 1.5
#: σ in steps that are tried.
_SIGMAS = np.geomspace(0.01, 3.0, 18)
#: Means that are tried for a target and direction, and how far beyond what the readings allow, in σ.
_MEANS, _BEYOND = 161, 3.5
_NORMAL = np.linspace(-8.0, 8.0, 3201)
_CUMULATIVE = np.array([0.5 * math.erfc(-each / math.sqrt(2.0)) for each in _NORMAL.tolist()])
#: Draws from which the mean square of an error is taken.
_DRAWS, _SEED = 1_000, 2310


class Rounded(NamedTuple):
    """Simulated tests of one axis, (count, approach, position, run), m or rad; NaN where nothing was read."""

    before: FloatArray  #: Its readings before they were rounded.
    shown: FloatArray  #: What is shown of them.


@dataclass(frozen=True, slots=True)
class Axes:
    """Axes that may be the one that was read, and how their readings are rounded; m or rad."""

    step: float  #: d.
    sigma: FloatArray  #: (count,): The standard deviation of their readings.
    means: FloatArray  #: (count, approach, position).
    between: FloatArray  #: (count, approach, position): Where the means lie between two steps.

    def round(self, readings: FloatArray) -> FloatArray:
        """Return what is shown of readings, (count, approach, position, run)."""
        between = self.between[..., np.newaxis]
        return np.asarray(self.step * np.round((readings + between) / self.step) - between)


def find_hiding_resolution(budget: Budget, readings: FloatArray) -> Contribution | None:
    """Return the resolution of a budget if it hides the scatter of the readings, else None.

    `readings`: (approach, position, run), m or rad.
    """
    found = [
        each
        for each in budget.acting(Acts.AT_EACH_READING)
        if each.contributor == "resolution" and each.distribution is Distribution.RECTANGULAR
    ]
    there = np.isfinite(readings)
    count = there.sum(axis=-1, keepdims=True)
    freedom = int(np.maximum(count - 1, 0).sum())
    if not found or not freedom:
        return None
    mean = np.where(there, readings, 0.0).sum(axis=-1, keepdims=True) / np.maximum(count, 1)
    squares = float((np.where(there, readings - mean, 0.0) ** 2).sum())
    return found[0] if math.sqrt(squares / freedom) < _LOUD * find_full_range(found[0]) else None


def sample_rounding(
    resolution: Contribution, readings: FloatArray, count: int, generator: np.random.Generator
) -> Rounded:
    """Return simulated tests of axes that may be the one that was read, before and after rounding.

    `readings`: (approach, position, run), m or rad; NaN where there is none.
    """
    axes = sample_axes(resolution, readings, count, generator)
    own = axes.sigma[:, np.newaxis, np.newaxis, np.newaxis] * generator.standard_normal(
        (count, *readings.shape)
    )
    before = axes.means[..., np.newaxis] + own
    before[:, ~np.isfinite(readings)] = np.nan
    return Rounded(before, axes.round(before))


def sample_axes(
    resolution: Contribution, readings: FloatArray, count: int, generator: np.random.Generator
) -> Axes:
    """Return axes that may be the one that was read.

    `readings`: (approach, position, run), m or rad; NaN where there is none.
    """
    step = find_full_range(resolution)
    cells = np.ascontiguousarray(readings.reshape(-1, readings.shape[-1]) / step)
    quiet = _judge_quietness(cells.tobytes(), cells.shape)
    chosen = generator.choice(len(_SIGMAS), count, p=quiet.of_sigma)
    means = step * quiet.means[chosen].reshape(count, *readings.shape[:-1])
    between = step * generator.random(means.shape)
    return Axes(step, step * _SIGMAS[chosen], means, between)


def compute_mean_rounding_variance(
    resolution: Contribution, readings: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return E(e²) of what rounding does to x̄_i↑ and x̄_i↓, (approach, position), and to x̄_i, m² or rad²."""
    generator = np.random.Generator(np.random.PCG64(_SEED))
    before, shown = sample_rounding(resolution, readings, _DRAWS, generator)
    errors = np.nan_to_num(shown - before)
    means = errors.sum(axis=-1) / np.maximum(np.isfinite(readings).sum(axis=-1), 1)
    return np.mean(means**2, axis=0), np.mean(means.mean(axis=1) ** 2, axis=0)


@dataclass(frozen=True, slots=True)
class _Quiet:
    """What rounded readings tell of the axis, in steps."""

    of_sigma: FloatArray  #: (sigma,): The probability of each σ that is tried.
    means: FloatArray  #: (sigma, cell): The mean to be expected with it of a target in one direction.


@lru_cache(maxsize=8)
def _judge_quietness(cells: bytes, shape: tuple[int, int]) -> _Quiet:
    """Return what readings tell, (cell, run) in steps; kept, for each kind of drift asks for it again."""
    readings = np.frombuffer(cells).reshape(shape)
    there = np.isfinite(readings)
    some = there.any(axis=-1)
    highest = np.where(some, np.where(there, readings, -np.inf).max(axis=-1), 0.0)
    lowest = np.where(some, np.where(there, readings, np.inf).min(axis=-1), 0.0)
    ends = np.stack([highest - 0.5, lowest + 0.5])
    shares = np.linspace(0.0, 1.0, _MEANS)
    means = np.empty((len(_SIGMAS), len(readings)))
    evidence = np.empty(len(_SIGMAS))
    for number, sigma in enumerate(_SIGMAS.tolist()):
        low, high = ends.min(axis=0) - _BEYOND * sigma, ends.max(axis=0) + _BEYOND * sigma
        tried = low[:, np.newaxis] + (high - low)[:, np.newaxis] * shares
        away = (readings[:, np.newaxis, :] - tried[:, :, np.newaxis]) / sigma
        inside = _compute_cumulative(away + 0.5 / sigma) - _compute_cumulative(away - 0.5 / sigma)
        logarithms = np.log(np.maximum(np.where(there[:, np.newaxis, :], inside, 1.0), 1e-300)).sum(axis=-1)
        largest = logarithms.max(axis=-1, keepdims=True)
        weights = np.exp(logarithms - largest)
        means[number] = (weights * tried).sum(axis=-1) / weights.sum(axis=-1)
        evidence[number] = (largest[:, 0] + np.log(weights.mean(axis=-1) * (high - low)))[some].sum()
    of_sigma = np.exp(evidence - evidence.max())
    return _Quiet(of_sigma / of_sigma.sum(), means)


def _compute_cumulative(values: FloatArray) -> FloatArray:
    """Return Φ of the standard normal distribution; NaN of NaN."""
    return np.asarray(np.interp(values, _NORMAL, _CUMULATIVE))
