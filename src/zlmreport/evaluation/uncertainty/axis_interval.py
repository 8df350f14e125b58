"""The interval of a parameter in another test of the same axis by the same plan (its scatter included).

This is about the axis and its scatter, and not about the measuring set-up: five readings know a standard
deviation to a third, so the next test's R differs from this one's by far more than U. Pairs of tests are
simulated of axes that may be this one, by the posterior distribution of its scatter, and the differences
of a parameter between the two tests of a pair are put about the value of this test.

The scatter has two parts. What all positions of a run share in one direction (the machine warms up, someone
opens the door) varies from run to run; what is left belongs to a position and direction. The variances of
the second part are taken as drawn from one scaled inverse χ² distribution, whose two parameters are estimated
from all of them by the moments of ln s² (G. K. Smyth, Stat. Appl. Genet. Mol. Biol. 3, 2004, article 3): so
positions that scatter alike inform each other, and those that do not keep their own. A position whose scatter
stands out from all others is judged by itself, by both directions together where they scatter alike. That
some readings lie far out may also come from long tails: `zlmreport.evaluation.uncertainty.long_tails` tells
which is more probable, and the pairs are drawn of that.
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
from zlmreport.evaluation.uncertainty.rounding import Axes, find_hiding_resolution, sample_axes
from zlmreport.measurement.arrays import BoolArray, FloatArray
from zlmreport.measurement.measurement_set import MeasurementSet

#: Pairs of simulated tests.
PAIRS = 2_000
#: Probability that the next test's value lies in the interval.
PROBABILITY = 0.95
#: Standard deviations of ln s² by which a position stands out from the others.
_STANDS_OUT = 2.2
#: Share of the positions that may stand out: were it more, they would be the rule.
_MOST_STANDING_OUT = 0.3
#: Variances of fewer positions tell nothing of how these vary.
_FEWEST = 4
#: Standard errors of a slope of ln s² along the axis from which the scatter counts as growing.
_GROWS = 3.0
#: Standard errors by which variances are taken to differ more than they seem to.
_CAUTION = 1.0
_STEP = 1e-3
#: Part of an interval by which its ends lie beyond the values that they hold.
_INSIDE = 1e-5


@dataclass(frozen=True, slots=True)
class _Scatter:
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
    scatter = _scatter_of(readings, measurements.target_positions)
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


def _scatter_of(readings: FloatArray, target_positions: FloatArray) -> _Scatter | None:
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
    pooled, pooled_freedom = _pool(variance, freedom, target_positions)
    own = np.where(there, inner * np.sqrt(left)[..., np.newaxis], np.nan)
    return _Scatter(
        mean,
        pooled,
        pooled_freedom,
        run_variance,
        run_freedom,
        max(-1.0, min(1.0, correlation)),
        find_long_tails(own.reshape(-1, own.shape[-1])),
    )


def _pool(variance: FloatArray, freedom: FloatArray, positions: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the posterior variances and degrees of freedom of cells, each informed by all others."""
    known = (freedom > 0) & (variance > 0)
    if np.count_nonzero(known) < _FEWEST:
        total = float(freedom.sum())
        common = float(np.nansum(variance * freedom)) / total
        return np.full_like(freedom, common), np.full_like(freedom, total)
    own = float(np.median(freedom[known]))
    chance = _trigamma(own / 2)
    logarithms = np.log(np.where(known, variance, 1.0)) - _digamma(own / 2) + math.log(own / 2)
    trend, spent = _fit_trend(logarithms, known, np.broadcast_to(positions, known.shape), chance)
    logarithms -= trend
    level = np.where(known, variance, 0.0) / np.exp(trend)
    alike = _select_alike(logarithms, known, chance)
    cells = np.count_nonzero(alike)
    observed = float(logarithms[alike].var(ddof=1))
    beyond_chance = observed * (1 + _CAUTION * math.sqrt(2 / (cells - 1))) - chance
    if beyond_chance <= _STEP:  # no more different than equal variances look
        total = float(freedom[alike].sum())
        common = float((level[alike] * freedom[alike]).sum()) / total
        pooled, pooled_freedom = np.full_like(freedom, common), np.full_like(freedom, total)
    else:
        prior = 2 * _inverse_trigamma(beyond_chance)
        scale = math.exp(float(logarithms[alike].mean()) + _digamma(prior / 2) - math.log(prior / 2))
        pooled_freedom = freedom + prior
        pooled = (level * freedom + prior * scale) / pooled_freedom
    pooled = pooled * np.exp(trend)
    pooled_freedom = _blur_freedom(pooled_freedom, spent)
    stands_out = known & ~alike
    joined, joined_freedom = _join_directions(variance, freedom, stands_out, chance)
    return np.where(stands_out, joined, pooled), np.where(stands_out, joined_freedom, pooled_freedom)


def _join_directions(
    variance: FloatArray, freedom: FloatArray, stands_out: BoolArray, chance: float
) -> tuple[FloatArray, FloatArray]:
    """Return variances and freedom of cells, joined at positions that stand out alike in both directions."""
    if len(variance) == 1:
        return variance, freedom
    with np.errstate(invalid="ignore", divide="ignore"):
        apart = np.abs(np.log(variance[0] / variance[1]))
    alike = stands_out.all(axis=0) & (apart <= _STANDS_OUT * math.sqrt(2 * chance))
    total = freedom.sum(axis=0)
    with np.errstate(invalid="ignore"):
        common = (variance * freedom).sum(axis=0) / np.maximum(total, 1)
    return np.where(alike, common, variance), np.where(alike, total, freedom)


def _fit_trend(
    logarithms: FloatArray, known: BoolArray, positions: FloatArray, chance: float
) -> tuple[FloatArray, FloatArray]:
    """Return how ln σ² grows along the axis, about its mean, and the variance of that; 0 if by chance."""
    x = positions - positions[known].mean()
    squares = float((x[known] ** 2).sum())
    nothing = np.zeros_like(logarithms)
    if not squares or np.count_nonzero(known) <= _FEWEST:
        return nothing, nothing
    slope = float((x * logarithms)[known].sum()) / squares
    left = (logarithms - slope * x)[known]
    variance = max(float(left.var(ddof=2)), chance) / squares
    if abs(slope) <= _GROWS * math.sqrt(variance):
        return nothing, nothing
    return slope * x, variance * x**2


def _blur_freedom(freedom: FloatArray, variance: FloatArray) -> FloatArray:
    """Return degrees of freedom of variances whose logarithms are known worse by a `variance`."""
    return np.array(
        [
            2 * _inverse_trigamma(_trigamma(each / 2) + more) if more else each
            for each, more in zip(freedom.ravel().tolist(), variance.ravel().tolist(), strict=True)
        ]
    ).reshape(freedom.shape)


def _select_alike(logarithms: FloatArray, known: BoolArray, chance: float) -> BoolArray:
    """Return the cells without those whose ln s² stands out from the others.

    A position is asked as a whole first: what shakes it shakes both directions, and their mean tells by two
    tests what the s of one, which may have come out small, does not.
    """
    whole = np.asarray(known.all(axis=0, keepdims=True))
    means = np.where(whole, logarithms.mean(axis=0, keepdims=True), 0.0)
    stand_out = whole & ~_drop_outstanding(means, whole, whole, chance / len(known))
    return _drop_outstanding(logarithms, known & ~stand_out, known, chance)


def _drop_outstanding(logarithms: FloatArray, alike: BoolArray, known: BoolArray, chance: float) -> BoolArray:
    """Return those of `alike` that do not stand out from the others, the largest dropped first.

    `known`: All, of which only so many may stand out. `chance`: The variance that alike ones show.
    """
    fewest = max(_FEWEST, (1 - _MOST_STANDING_OUT) * np.count_nonzero(known))
    while np.count_nonzero(alike) > fewest:
        largest = np.unravel_index(np.argmax(np.where(alike, logarithms, -np.inf)), alike.shape)
        others = alike.copy()
        others[largest] = False
        spread = math.sqrt(max(float(logarithms[others].var(ddof=1)), chance))
        if logarithms[largest] - logarithms[others].mean() <= _STANDS_OUT * spread:
            break
        alike = others
    return alike


def _sample_pairs(
    scatter: _Scatter, there: BoolArray, count: int, generator: np.random.Generator, axes: Axes | None = None
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


def _digamma(x: float) -> float:
    """Return ψ(x), by a difference quotient of ln Γ: to 1e-7, where variances are known to a third."""
    return (math.lgamma(x + _STEP) - math.lgamma(x - _STEP)) / (2 * _STEP)


def _trigamma(x: float) -> float:
    """Return ψ′(x) for x ≥ 1/2, by its recurrence and its asymptotic series."""
    total = 0.0
    while x < 6:  # where the series is good to 1e-7
        total += 1 / x**2
        x += 1
    return total + 1 / x + 1 / (2 * x**2) + 1 / (6 * x**3) - 1 / (30 * x**5)


def _inverse_trigamma(value: float) -> float:
    """Return x with ψ′(x) = value, by bisection over all that matters."""
    low, high = 1e-2, 1e6
    for _ in range(60):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if _trigamma(middle) > value else (low, middle)
    return low
