"""Adds U to all parameters, means and changes of evaluations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from zlmreport.evaluation.evaluation import Evaluation, MeanUncertainty
from zlmreport.evaluation.statistics import position_statistics
from zlmreport.evaluation.uncertainty.axis_interval import PAIRS, compute_axis_intervals
from zlmreport.evaluation.uncertainty.budget import (
    COVERAGE_FACTOR,
    Acts,
    Budget,
    NoBudget,
    compute_effect_along,
    find_full_range,
)
from zlmreport.evaluation.uncertainty.drift import (
    choose_drift_kinds,
    compute_mean_drift_variance,
    compute_reading_times,
)
from zlmreport.evaluation.uncertainty.monte_carlo import TRIALS, StandardArithmetic, propagate
from zlmreport.evaluation.uncertainty.rounding import compute_mean_rounding_variance, find_hiding_resolution
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats


def add_uncertainty(
    evaluations: Sequence[tuple[Evaluation, StandardArithmetic]],
    budget: Budget | NoBudget,
    trials: int = TRIALS,
) -> tuple[Evaluation, ...]:
    """Return evaluations of one test with U and k of their parameters and U of their mean deviations.

    Each parameter also has the interval in which another test of the same plan would find it.

    Parameters
    ----------
    evaluations
        Each with the arithmetic that takes it from statistics to parameters.
    budget
        Of the measuring set-up; without one nothing is said of U.
    trials
        Tests that are simulated; fewer, where no number is read.
    """
    if not evaluations:
        return ()
    bare = tuple(
        replace(
            evaluation,
            parameters=tuple(
                replace(each, axis_interval=of_axis.get(each.quantity.symbol))
                for each in evaluation.parameters
            ),
        )
        for (evaluation, _), of_axis in zip(
            evaluations,
            compute_axis_intervals(
                evaluations, min(PAIRS, trials), None if isinstance(budget, NoBudget) else budget
            ),
            strict=True,
        )
    )
    if isinstance(budget, NoBudget):
        return bare
    # Of the readings, which all have in common; several lines have theirs one by one.
    means = None if budget.tests else compute_mean_uncertainty(bare[0], budget)
    return tuple(
        replace(
            evaluation,
            parameters=tuple(
                replace(
                    each,
                    expanded_uncertainty=found.uncertainty,
                    coverage_factor=found.coverage_factor,
                    raised_to=found.least,
                    known_error=found.known_error,
                )
                for each in evaluation.parameters
                for found in (expanded[each.quantity.symbol],)
            ),
            mean_uncertainty=means,
            uncertainty_is_complete=budget.is_complete,
        )
        for evaluation, expanded in zip(bare, propagate(budget, evaluations, trials), strict=True)
    )


def compute_mean_uncertainty(evaluation: Evaluation, budget: Budget) -> MeanUncertainty:
    """Return U of x̄_i↑, x̄_i↓ and x̄_i, by the law of propagation (JCGM 100, 5.1).

    u²(x̄_i↑) = u_L²·((P_i − P_1)/L)² + u_0² + u_P² + u_A² + u_E² + u_R²/n, with the sums of squares u_L²
    of the contributions along the length, u_0² at the datum, u_P² at each position or round a circle,
    u_A² at each approach and u_R² at each reading, and u_E² of what a drift leaves in the mean;
    u²(x̄_i↓) has u_D² more, of what parts the directions. Both share u_L, u_0 and u_P; the mean of
    both has half of u_A², a quarter of u_D², and u_R²/n of all its readings, (1/n↑ + 1/n↓)/4. A
    resolution that hides the scatter is shared by readings, and acts as its simulated means do. What
    changes from reading to reading acts as the mean of its effects. Known errors are added to k·u
    whole (JCGM 100, F.2.4.5).
    """
    statistics, measurements = evaluation.statistics, evaluation.measurements
    effect = compute_effect_along(measurements.target_positions)
    alike = sum(
        budget.variance(each)
        for each in (Acts.AT_THE_DATUM, Acts.AT_EACH_POSITION, Acts.ROUND_THE_CIRCLE, Acts.OFF_CENTRE)
    )
    shared = budget.variance(Acts.ALONG_THE_LENGTH) * effect**2 + alike
    faces, parting = budget.variance(Acts.AT_EACH_APPROACH), budget.variance(Acts.BETWEEN_DIRECTIONS)
    of_direction = parting * np.array([each is Approach.NEGATIVE for each in Approach])[:, np.newaxis]
    hiding = find_hiding_resolution(budget, measurements.deviations())
    own = budget.variance(Acts.AT_EACH_READING) - (hiding.standard_uncertainty**2 if hiding else 0.0)
    per_reading = 1 / np.where(statistics.count > 0, statistics.count, np.nan)
    of_both = (per_reading[Approach.POSITIVE.index] + per_reading[Approach.NEGATIVE.index]) / 4
    by_approach = shared + of_direction + faces + own * per_reading
    bidirectional = shared + parting / 4 + faces / 2 + own * of_both
    if hiding is not None:
        of_approach, of_mean = compute_mean_rounding_variance(hiding, measurements.deviations())
        by_approach, bidirectional = by_approach + of_approach, bidirectional + of_mean
    drifting = budget.acting(Acts.IN_TIME)
    if drifting:
        of_approach, of_mean = compute_mean_drift_variance(
            compute_reading_times(measurements), choose_drift_kinds(measurements)
        )
        squares = sum(find_full_range(each) ** 2 for each in drifting)
        by_approach = by_approach + squares * of_approach
        bidirectional = bidirectional + squares * of_mean
    for each in budget.changing:
        acting = position_statistics(measurements.arranged(np.asarray(each.effect)))
        by_approach = by_approach + (each.standard_uncertainty * acting.mean) ** 2
        bidirectional = bidirectional + (each.standard_uncertainty * acting.mean_bidirectional) ** 2
    least = max(budget.least, budget.of_the_instrument)
    known = _compute_known_of_means(evaluation, budget)

    def expand(variance: FloatArray, known: FloatArray | float) -> FloatArray:
        return np.asarray(known + np.maximum(COVERAGE_FACTOR * np.sqrt(variance), least))

    return MeanUncertainty(
        coverage_factor=COVERAGE_FACTOR,
        by_approach=read_only_floats(expand(by_approach, known[0])),
        bidirectional=read_only_floats(expand(bidirectional, known[1])),
    )


def _compute_known_of_means(
    evaluation: Evaluation, budget: Budget
) -> tuple[FloatArray, FloatArray] | tuple[float, float]:
    """Return the amounts of the known errors of x̄_i↑ and x̄_i↓, and of x̄_i; NaN where there is no reading."""
    if budget.correction is None:
        return 0.0, 0.0
    corrections = position_statistics(evaluation.measurements.arranged(budget.correction))
    there = evaluation.statistics
    of_both = np.where(np.isnan(there.mean_bidirectional), np.nan, corrections.mean_bidirectional)
    return np.abs(corrections.mean), np.abs(of_both)
