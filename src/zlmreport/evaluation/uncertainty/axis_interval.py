"""The interval of a parameter in another test of the same axis by the same plan (its scatter included).

This is about the axis and its scatter, and not about the measuring set-up: five readings know a standard
deviation to a third, so the next test's R differs from this one's by far more than U. Pairs of tests are
simulated of axes that may be this one, by the posterior distribution of its scatter, and the differences
of a parameter between the two tests of a pair are put about the value of this test.

The scatter has two parts. What all positions of a run share in one direction (the machine warms up, someone
opens the door) varies from run to run; what is left belongs to a position and direction, whose variances
inform each other (`zlmreport.evaluation.uncertainty.pooled_variances`). That some readings lie far out may
also come from long tails: `zlmreport.evaluation.uncertainty.long_tails` tells which is more probable, and the
pairs are drawn of that.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.evaluation.statistics import PositionStatistics, join_statistics, position_statistics
from zlmreport.evaluation.uncertainty.budget import Budget
from zlmreport.evaluation.uncertainty.long_tails import Tails, find_long_tails
from zlmreport.evaluation.uncertainty.monte_carlo import StandardArithmetic, make_seed_of, shorten
from zlmreport.evaluation.uncertainty.pooled_variances import pool_variances
from zlmreport.evaluation.uncertainty.rounding import Axes, find_hiding_resolution, sample_axes
from zlmreport.measurement.arrays import BoolArray, FloatArray
from zlmreport.measurement.measurement_set import MeasurementSet

#: Pairs of simulated tests.
PAIRS = 2_000
#: Probability that the next test's value lies in the interval.
PROBABILITY = 0.95
#: Part of an interval by which its ends lie beyond the values that they hold.
_INSIDE = 1e-5


@dataclass(frozen=True, slots=True)
class Scatter:
    """What one test tells of its axis's scatter; cells are positions in one direction."""

    mean: FloatArray  #: (approach, position): Mean deviations, m or rad; NaN where there is no reading.
    #: variance and freedom: (approach, position): Of the posterior: scaled inverse χ².
    variance: FloatArray
    freedom: FloatArray
    #: run_variance and run_freedom: (approach,): Of the means of runs.
    run_variance: FloatArray
    run_freedom: FloatArray
    correlation: float  #: Of what the two directions of a run share.
    tails: Tails | None = None  #: Of the readings of a cell, where they may be long.


def compute_axis_intervals(
    evaluations: Sequence[tuple[Evaluation, StandardArithmetic]],
    pairs: int = PAIRS,
    budget: Budget | None = None,
) -> tuple[Mapping[str, tuple[float, float]], ...]:
    """Return for each evaluation of one test the interval of each parameter, m or rad.

    Empty where the test has a single run, which tells nothing of the scatter, and where an axis does not stop
    at targets: readings that follow each other on a path or in time do not scatter independently.

    `evaluations`: Of one test, one at least, each with the arithmetic that takes it from statistics to
        parameters.
    `budget`: Of its set-up: a resolution that hides the scatter hides it in the next test, too.
    """
    measurements = evaluations[0][0].measurements
    generator = np.random.Generator(np.random.PCG64(make_seed_of(measurements)))
    stops = not measurements.axis.measurand.is_continuous
    simulated = _simulate_pairs(measurements, pairs, generator, budget) if stops else None
    if simulated is None:
        return tuple({} for _ in evaluations)
    first, second = simulated
    lines = zip(measurements.lines, budget.lines, strict=False) if budget else ()
    rounded = any(find_hiding_resolution(of_line, line.deviations()) for line, of_line in lines)
    found = []
    for evaluation, arithmetic in evaluations:
        one, other = arithmetic(first).parameters, arithmetic(second).parameters
        found.append(
            {
                symbol: _make_interval(each.value, one[symbol], other[symbol], rounded=rounded)
                for each in evaluation.parameters
                for symbol in (each.quantity.symbol,)
            }
        )
    return tuple(found)


def _simulate_pairs(
    measurements: MeasurementSet, pairs: int, generator: np.random.Generator, budget: Budget | None
) -> tuple[PositionStatistics, PositionStatistics] | None:
    """Return two stacks of tests, of each axis one in each; None where a line tells nothing of scatter."""
    if measurements.tests:
        budgets = budget.tests if budget else {}
        lines = {
            name: _simulate_pairs(each, pairs, generator, budgets.get(name))
            for name, each in measurements.tests.items()
        }
        known = {name: each for name, each in lines.items() if each}
        if len(known) < len(lines):
            return None
        one, other = ({name: each[stack] for name, each in known.items()} for stack in (0, 1))
        return join_statistics(one), join_statistics(other)
    readings = measurements.deviations()
    scatter = estimate_scatter(readings, measurements.target_positions)
    if scatter is None:
        return None
    hiding = find_hiding_resolution(budget, readings) if budget else None
    axes = sample_axes(hiding, readings, pairs, generator) if hiding else None
    first, second = (
        position_statistics(each, measurements.target_positions)
        for each in _sample_pairs(scatter, np.isfinite(readings), pairs, generator, axes)
    )
    return first, second


def _make_interval(
    value: float, one: FloatArray, other: FloatArray, *, rounded: bool = False
) -> tuple[float, float]:
    """Return the value with the quantiles of the differences within pairs on either side.

    `rounded`: Whether a parameter has few values: the ends are then some that occurred, and are inside.
    """
    tail = (1.0 - PROBABILITY) / 2
    differences = np.concatenate((other - one, one - other))
    if rounded:
        low = np.quantile(differences, tail, method="lower")
        high = np.quantile(differences, 1.0 - tail, method="higher")
        low, high = (each + side * _INSIDE * (high - low) for each, side in ((low, -1), (high, 1)))
    else:
        low, high = np.quantile(differences, (tail, 1.0 - tail))
    never_negative = value >= 0 and float(min(one.min(), other.min())) >= 0
    lowest = value + float(low)
    return shorten(max(lowest, 0.0) if never_negative else lowest), shorten(value + float(high))


def estimate_scatter(readings: FloatArray, target_positions: FloatArray) -> Scatter | None:
    """Return what readings (approach, position, run) tell of the scatter; None where they tell nothing."""
    there = np.isfinite(readings)
    count = there.sum(axis=-1)
    runs = there.any(axis=1)
    if not np.any(count > 1) or not np.any(runs.sum(axis=-1) > 1):
        return None
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.where(there, readings, 0.0).sum(axis=-1) / np.where(count > 0, count, np.nan)
        residuals = np.where(there, readings - mean[..., np.newaxis], 0.0)
        of_run = residuals.sum(axis=1) / np.maximum(there.sum(axis=1), 1)
    positions = np.maximum((count > 1).sum(axis=1), 1)
    inner = np.where(there, residuals - of_run[:, np.newaxis, :], 0.0)
    freedom = np.maximum(count - 1, 0).astype(float)
    # A run's mean takes its share out of each residual: 1 of the m positions is used up.
    left = np.where(positions > 1, positions / np.maximum(positions - 1, 1), 1.0)[:, np.newaxis]
    variance = np.where(freedom > 0, (inner**2).sum(axis=-1) * left / np.maximum(freedom, 1), np.nan)
    run_freedom = np.maximum(runs.sum(axis=-1) - 1, 0).astype(float)
    run_variance = (of_run**2).sum(axis=-1) / np.maximum(run_freedom, 1)
    product = math.sqrt(float(np.prod((of_run**2).sum(axis=-1))))
    correlation = float((of_run[0] * of_run[1]).sum()) / product if product else 0.0
    pooled, pooled_freedom = pool_variances(variance, freedom, target_positions)
    own = np.where(there, inner * np.sqrt(left)[..., np.newaxis], np.nan)
    return Scatter(
        mean,
        pooled,
        pooled_freedom,
        run_variance,
        run_freedom,
        max(-1.0, min(1.0, correlation)),
        find_long_tails(own.reshape(-1, own.shape[-1])),
    )


def _sample_pairs(
    scatter: Scatter, there: BoolArray, count: int, generator: np.random.Generator, axes: Axes | None
) -> tuple[FloatArray, FloatArray]:
    """Return two stacks of tests, (count, approach, position, run): of each axis one in each stack.

    `axes`: That are drawn where the last digit hides the scatter; both tests are then rounded.
    """
    shape = (count, *there.shape[:2])
    tails = None if axes else scatter.tails
    if axes is None:
        freedom = scatter.freedom / 2
        variance = scatter.variance * freedom / generator.standard_gamma(freedom, shape)
        means = scatter.mean
    else:
        variance = np.broadcast_to(axes.sigma[:, np.newaxis, np.newaxis] ** 2, shape)
        means = axes.means
    tail_freedom = np.empty(0)
    if tails:
        tail_freedom, scale = (each[:, np.newaxis, np.newaxis] for each in tails.draw(count, generator))
        variance = np.broadcast_to(scale**2, shape)
    freedom = np.maximum(scatter.run_freedom, 1.0)
    of_means = scatter.run_variance * freedom / (2 * generator.standard_gamma(freedom / 2, shape[:2]))
    positions = np.maximum(there.any(axis=-1).sum(axis=1), 1)
    of_cells = variance * (tail_freedom / (tail_freedom - 2)) if tails else variance
    shared = np.maximum(of_means - np.nanmean(of_cells, axis=-1) / positions, 0.0)
    tests = []
    for _ in range(2):
        run = generator.standard_normal((count, 2, there.shape[-1]))
        run[:, 1] = scatter.correlation * run[:, 0] + math.sqrt(1 - scatter.correlation**2) * run[:, 1]
        test = generator.standard_normal((count, *there.shape))
        if tails:  # Student's t: normal, of a variance that each reading draws for itself
            half = tail_freedom[..., np.newaxis] / 2
            test *= np.sqrt(half / generator.standard_gamma(half, test.shape))
        test *= np.sqrt(variance)[..., np.newaxis]
        test += (np.sqrt(shared)[..., np.newaxis] * run)[:, :, np.newaxis, :]
        test += means[..., np.newaxis]
        test[:, ~there] = np.nan
        tests.append(axes.round(test) if axes else test)
    return tests[0], tests[1]
