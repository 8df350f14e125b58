"""The budget of the readings carried to every parameter of every standard (JCGM 101:2008).

Each trial adds errors, drawn from the budget, to the readings, and evaluates the test again by the
standard's own arithmetic. So a standard needs no formula of its own for its uncertainties, whoever wrote it.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from statistics import NormalDist

import numpy as np

from zlmreport.evaluation.evaluation import Arithmetic, Evaluation, Least
from zlmreport.evaluation.statistics import PositionStatistics, position_statistics
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.quantities.arrays import FloatArray
from zlmreport.uncertainty.budget import (
    COVERAGE_FACTOR,
    COVERAGE_PROBABILITY,
    Acts,
    Budget,
    Contribution,
    Distribution,
    effect_along,
)
from zlmreport.uncertainty.drift import Drift, drawn_drifts, drift_range, reading_times
from zlmreport.values import dataclass

#: U then scatters by 1 % at most from one sequence of random numbers to another, which the second digit
#: hardly shows.
TRIALS = 10_000

#: Readings that are simulated at once: few enough for a processor's cache.
_AT_ONCE = 262_144
#: A standard uncertainty below this part of the budget's is the rounding of doubles: it is none.
_NOTHING = 1e-9
#: Digits of U and k that are kept: far more than are known, and so few that no rounding of another
#: processor shows.
_DIGITS = 6
#: Of the errors by which a parameter is asked whether it compares positions, m or rad, at the least.
_BEND = 1e-6

StandardArithmetic = Callable[[PositionStatistics], Arithmetic]


@dataclass(frozen=True, slots=True)
class Expanded:
    """Expanded uncertainty of a parameter."""

    uncertainty: float  #: U = k·u, m or rad.
    coverage_factor: float  #: k.
    least: Least | None = None  #: What U was raised to, where the simulation gave less; else None.


def propagate(
    budget: Budget,
    evaluations: Sequence[tuple[Evaluation, StandardArithmetic]],
    trials: int = TRIALS,
) -> tuple[Mapping[str, Expanded], ...]:
    """Return the expanded uncertainty of each parameter by its symbol, for each evaluation of one test.

    Parameters
    ----------
    evaluations
        Of one test, one at least, each with the arithmetic that takes it from statistics to parameters.
    trials
        Simulated tests; kinds of drift share them.

    Notes
    -----
    U is half the width of the interval y ± U, about the value that the standard gives for the readings, which
    holds 95.45 % of the simulated values; u is the root mean square of their distances from y. A range or a
    largest value grows when errors are added to the readings, so that its simulated values lie more above y
    than below: U and u both count that in. Where something drifts, U is the largest of those of the kinds of
    drift. It is never less than the budget's bounds.
    """
    measurements = evaluations[0][0].measurements
    readings = measurements.deviations()
    if not np.isfinite(readings).any():
        return tuple({} for _ in evaluations)
    generator = np.random.Generator(np.random.PCG64(seed_of(measurements, readings)))
    least = _NOTHING * budget.standard_uncertainty
    found: list[dict[str, Expanded]] = [{} for _ in evaluations]
    kinds: Sequence[Drift | None] = tuple(Drift) if budget.acting(Acts.IN_TIME) else (None,)
    for kind in kinds:
        distances = _distances(budget, evaluations, kind, trials // len(kinds), generator)
        for so_far, (evaluation, _), values in zip(found, evaluations, distances, strict=True):
            symbols = (each.quantity.symbol for each in evaluation.parameters)
            for symbol, expanded in zip(symbols, _expanded(np.abs(values), least), strict=True):
                if symbol not in so_far or expanded.uncertainty > so_far[symbol].uncertainty:
                    so_far[symbol] = expanded
    return tuple(
        {symbol: _bounded(each, budget, of_positions[symbol]) for symbol, each in so_far.items()}
        for so_far, of_positions in zip(found, _compares_positions(evaluations, readings), strict=True)
    )


def _distances(
    budget: Budget,
    evaluations: Sequence[tuple[Evaluation, StandardArithmetic]],
    kind: Drift | None,
    trials: int,
    generator: np.random.Generator,
) -> list[FloatArray]:
    """Return y* − y in simulated tests with one kind of drift, for each evaluation: (parameter, trial)."""
    distances = [np.empty((len(evaluation.parameters), trials)) for evaluation, _ in evaluations]
    done = 0
    for simulated in _simulated(budget, evaluations[0][0].measurements, kind, trials, generator):
        statistics = position_statistics(simulated)
        chunk = slice(done, done + len(simulated))
        done = chunk.stop
        for (evaluation, arithmetic), found in zip(evaluations, distances, strict=True):
            parameters = arithmetic(statistics).parameters
            for each, of_one in zip(evaluation.parameters, found, strict=True):
                of_one[chunk] = parameters[each.quantity.symbol] - each.value
    return distances


def _simulated(
    budget: Budget,
    measurements: MeasurementSet,
    kind: Drift | None,
    trials: int,
    generator: np.random.Generator,
) -> Iterator[FloatArray]:
    """Yield simulated tests, so many at a time: shape (trial, approach, position, run), m or rad."""
    readings = measurements.deviations()
    along = stratified_draws(budget.acting(Acts.ALONG_THE_LENGTH), trials, generator)
    parting = stratified_draws(budget.acting(Acts.BETWEEN_DIRECTIONS), trials, generator)
    alike = stratified_draws(budget.acting(Acts.AT_THE_DATUM), trials, generator)
    drifting = budget.acting(Acts.IN_TIME)
    times = reading_times(measurements)
    effect = effect_along(measurements.target_positions)
    parted = np.array([float(approach is Approach.NEGATIVE) for approach in Approach])
    at_once = max(1, _AT_ONCE // readings.size)
    for first in range(0, trials, at_once):
        count = min(at_once, trials - first)
        errors = along[first : first + count, np.newaxis] * effect
        errors += single_draws(budget.acting(Acts.AT_EACH_POSITION), errors.shape, generator)
        own = single_draws(budget.acting(Acts.AT_EACH_READING), (count, *readings.shape), generator)
        if kind:
            for each in drifting:
                drifts = drawn_drifts(kind, times, count, generator)
                drifts *= drift_range(each)
                own += drifts
        trial = slice(first, first + count)
        common = alike[trial, np.newaxis] + np.multiply.outer(parting[trial], parted)
        shared = errors[:, np.newaxis, :] + common[..., np.newaxis]
        shared += single_draws(budget.acting(Acts.AT_EACH_APPROACH), shared.shape, generator)
        tests = readings + shared[..., np.newaxis]
        tests += own
        yield tests


def _compares_positions(
    evaluations: Sequence[tuple[Evaluation, StandardArithmetic]], readings: FloatArray
) -> list[dict[str, bool]]:
    """Return which parameters an error of position can enter: asked of the standard by large errors."""
    bend = float(np.nanmax(readings) - np.nanmin(readings) + _BEND) * np.arange(readings.shape[1]) ** 2
    bent = np.stack([readings + side * bend[:, np.newaxis] for side in (-1.0, 1.0)])
    statistics = position_statistics(bent)
    return [
        {
            each.quantity.symbol: bool(
                np.any(np.abs(parameters[each.quantity.symbol] - each.value) > _NOTHING * bend[-1])
            )
            for each in evaluation.parameters
        }
        for evaluation, arithmetic in evaluations
        for parameters in (arithmetic(statistics).parameters,)
    ]


def seed_of(measurements: MeasurementSet, readings: FloatArray) -> int:
    """Return a seed that is the readings' own: the same test gives the same uncertainties."""
    digest = hashlib.sha256()
    for values in (measurements.target_positions, np.where(np.isnan(readings), np.inf, readings)):
        digest.update(np.ascontiguousarray(values, dtype="<f8").tobytes())
    return int.from_bytes(digest.digest())


def _expanded(distances: FloatArray, least: float) -> list[Expanded]:
    """Return the expanded uncertainty of each parameter by its distances, shape (parameter, trial)."""
    standard = np.sqrt(np.mean(distances**2, axis=-1))
    rank = math.ceil(COVERAGE_PROBABILITY * distances.shape[-1]) - 1
    half_width = np.partition(distances, rank, axis=-1)[:, rank]
    return [
        Expanded(shortened(half), shortened(half / one)) if one > least else Expanded(0.0, COVERAGE_FACTOR)
        for half, one in zip(half_width.tolist(), standard.tolist(), strict=True)
    ]


def _bounded(expanded: Expanded, budget: Budget, compares_positions: bool) -> Expanded:  # noqa: FBT001 - private
    """Raise U to what it must at least be; the bounds are stated with k = 2."""
    for bound, least in (
        (budget.of_the_instrument if compares_positions else 0.0, Least.INSTRUMENT),
        (budget.least, Least.LABORATORY),
    ):
        if expanded.uncertainty < bound:
            expanded = Expanded(shortened(bound), COVERAGE_FACTOR, least)
    return expanded


def shortened(value: float) -> float:
    """Return a value with the digits that are kept."""
    return float(f"{value:.{_DIGITS}g}")


def stratified_draws(
    contributions: Sequence[Contribution], count: int, generator: np.random.Generator
) -> FloatArray:
    """Return sums of one error of each contribution, spread evenly over the distributions, shape (count,).

    Each contribution takes the middles of `count` equally probable parts of its distribution once each, in
    an order of its own (Latin hypercube): the tails are as full as they should be, and not as chance has it.
    """
    middles = (np.arange(count) + 0.5) / count
    total = np.zeros(count)
    for distribution, standard_uncertainty in _combined(contributions):
        total += standard_uncertainty * generator.permutation(_quantiles(distribution, middles))
    return total


def single_draws(
    contributions: Sequence[Contribution], shape: tuple[int, ...], generator: np.random.Generator
) -> FloatArray:
    """Return sums of one error of each contribution, each element drawn for itself, m or rad."""
    total = np.zeros(shape)
    for distribution, standard_uncertainty in _combined(contributions):
        if distribution is Distribution.NORMAL:
            errors = generator.standard_normal(shape)
        else:
            errors = _quantiles(distribution, generator.random(shape))
        errors *= standard_uncertainty
        total += errors
    return total


def _combined(contributions: Sequence[Contribution]) -> Iterator[tuple[Distribution, float]]:
    """Yield distributions with their signed standard uncertainties; the sum of normal ones is normal."""
    normal = [each for each in contributions if each.distribution is Distribution.NORMAL]
    if normal:
        yield Distribution.NORMAL, math.sqrt(math.fsum(each.standard_uncertainty**2 for each in normal))
    for each in contributions:
        if each.distribution is not Distribution.NORMAL:
            yield each.distribution, each.sign * each.standard_uncertainty


def _quantiles(distribution: Distribution, probability: FloatArray) -> FloatArray:
    """Return the quantiles of a distribution whose root mean square is 1."""
    full_range = distribution.range_over_standard_uncertainty
    if distribution is Distribution.NORMAL:
        return np.array(list(map(NormalDist().inv_cdf, probability.tolist())))
    if distribution is Distribution.KNOWN:
        return np.ones_like(probability)
    if distribution is Distribution.ONE_SIDED:
        return probability * full_range
    if distribution is Distribution.RECTANGULAR:
        return (probability - 0.5) * full_range
    tail = np.sqrt(np.minimum(probability, 1 - probability) / 2)
    return np.asarray(np.where(probability < 0.5, tail - 0.5, 0.5 - tail) * full_range)
