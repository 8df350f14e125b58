"""The budget of the readings carried to every parameter of every standard (JCGM 101:2008).

Each trial adds errors, drawn from the budget, to the readings, and evaluates the test again by the
standard's own arithmetic. So a standard needs no formula of its own for its uncertainties, whoever wrote it.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.evaluation.evaluation import Arithmetic, Evaluation
from zlmreport.evaluation.statistics import PositionStatistics, position_statistics
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.quantities.arrays import FloatArray
from zlmreport.uncertainty.budget import COVERAGE_FACTOR, COVERAGE_PROBABILITY, Budget, effect_along
from zlmreport.uncertainty.contribution import Acts
from zlmreport.uncertainty.draws import single_draws, stratified_draws

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

StandardArithmetic = Callable[[PositionStatistics], Arithmetic]


@dataclass(frozen=True, slots=True)
class Expanded:
    """Expanded uncertainty U = k·u of a parameter, m or rad, and its coverage factor k."""

    uncertainty: float
    coverage_factor: float


def propagate(
    budget: Budget,
    evaluations: Sequence[tuple[Evaluation, StandardArithmetic]],
    trials: int = TRIALS,
) -> tuple[Mapping[str, Expanded], ...]:
    """Return the expanded uncertainty of each parameter by its symbol, for each evaluation of one test.

    Parameters
    ----------
    budget
        Of the set-up.
    evaluations
        Of one test, one at least, each with the arithmetic that takes it from statistics to parameters.
    trials
        Simulated tests.

    Notes
    -----
    U is half the width of the interval y ± U, about the value that the standard gives for the readings, which
    holds 95.45 % of the simulated values; u is the root mean square of their distances from y. A range or a
    largest value grows when errors are added to the readings, so that its simulated values lie more above y
    than below: U and u both count that in.
    """
    symbols = [[each.quantity.symbol for each in evaluation.parameters] for evaluation, _ in evaluations]
    distances = [{symbol: np.empty(trials) for symbol in of_one} for of_one in symbols]
    measurements = evaluations[0][0].measurements
    done = 0
    for simulated in _simulated(budget, measurements, trials):
        statistics = position_statistics(simulated)
        chunk = slice(done, done + len(simulated))
        done = chunk.stop
        for (evaluation, arithmetic), found in zip(evaluations, distances, strict=True):
            parameters = arithmetic(statistics).parameters
            for each in evaluation.parameters:
                found[each.quantity.symbol][chunk] = parameters[each.quantity.symbol] - each.value
    least = _NOTHING * budget.standard_uncertainty
    return tuple(
        {symbol: _expanded(np.abs(values), least) for symbol, values in of_one.items()}
        for of_one in distances
    )


def _simulated(budget: Budget, measurements: MeasurementSet, trials: int) -> Iterator[FloatArray]:
    """Yield simulated tests, so many at a time: shape (trial, approach, position, run), m or rad."""
    readings = measurements.deviations()
    generator = np.random.Generator(np.random.PCG64(_seed(measurements, readings)))
    along = stratified_draws(budget.acting(Acts.ALONG_THE_LENGTH), trials, generator)
    parting = stratified_draws(budget.acting(Acts.BETWEEN_DIRECTIONS), trials, generator)
    alike = stratified_draws(budget.acting(Acts.AT_THE_DATUM), trials, generator)
    effect = effect_along(measurements.target_positions)
    parted = np.array([float(approach is Approach.NEGATIVE) for approach in Approach])
    at_once = max(1, _AT_ONCE // readings.size)
    for first in range(0, trials, at_once):
        count = min(at_once, trials - first)
        errors = along[first : first + count, np.newaxis] * effect
        errors += single_draws(budget.acting(Acts.AT_EACH_POSITION), errors.shape, generator)
        own = single_draws(budget.acting(Acts.AT_EACH_READING), (count, *readings.shape), generator)
        trial = slice(first, first + count)
        common = alike[trial, np.newaxis] + np.multiply.outer(parting[trial], parted)
        shared = errors[:, np.newaxis, :] + common[..., np.newaxis]
        shared += single_draws(budget.acting(Acts.AT_EACH_APPROACH), shared.shape, generator)
        yield readings + shared[..., np.newaxis] + own


def _seed(measurements: MeasurementSet, readings: FloatArray) -> int:
    """Return a seed that is the readings' own: the same test gives the same uncertainties."""
    digest = hashlib.sha256()
    for values in (measurements.target_positions, np.where(np.isnan(readings), np.inf, readings)):
        digest.update(np.ascontiguousarray(values, dtype="<f8").tobytes())
    return int.from_bytes(digest.digest())


def _expanded(distances: FloatArray, least: float) -> Expanded:
    standard = math.sqrt(float(np.mean(distances**2)))
    if standard <= least:
        return Expanded(0.0, COVERAGE_FACTOR)
    rank = math.ceil(COVERAGE_PROBABILITY * len(distances)) - 1
    half_width = float(np.partition(distances, rank)[rank])
    return Expanded(_shortened(half_width), _shortened(half_width / standard))


def _shortened(value: float) -> float:
    return float(f"{value:.{_DIGITS}g}")
