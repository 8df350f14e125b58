"""Uncertainty of the mean deviations at each target, by the law of propagation (JCGM 100, 5.1)."""

from __future__ import annotations

import numpy as np

from zlmreport.evaluation.evaluation import Evaluation, MeanUncertainty
from zlmreport.measurement.approach import Approach
from zlmreport.quantities.arrays import read_only_floats
from zlmreport.uncertainty.budget import COVERAGE_FACTOR, Budget, effect_along
from zlmreport.uncertainty.contribution import Acts


def mean_uncertainty(evaluation: Evaluation, budget: Budget) -> MeanUncertainty:
    """Return U of x̄_i↑, x̄_i↓ and x̄_i.

    Notes
    -----
    u²(x̄_i↑) = u_L²·((P_i − P_1)/L)² + u_0² + u_P² + u_A² + u_R²/n, with the sums of squares u_L² of the
    contributions along the length, u_0² at the datum, u_P² at each position, u_A² at each approach and u_R²
    at each reading; u²(x̄_i↓) has u_D² more, of what parts the directions. Both share u_L, u_0 and u_P; the
    mean of both has half of u_A², a quarter of u_D², and u_R²/n of all its readings, (1/n↑ + 1/n↓)/4.
    """
    statistics = evaluation.statistics
    effect = effect_along(evaluation.measurements.target_positions)
    alike = budget.variance(Acts.AT_THE_DATUM) + budget.variance(Acts.AT_EACH_POSITION)
    shared = budget.variance(Acts.ALONG_THE_LENGTH) * effect**2 + alike
    faces, parting = budget.variance(Acts.AT_EACH_APPROACH), budget.variance(Acts.BETWEEN_DIRECTIONS)
    of_direction = parting * np.array([each is Approach.NEGATIVE for each in Approach])[:, np.newaxis]
    own = budget.variance(Acts.AT_EACH_READING)
    per_reading = 1 / np.where(statistics.count > 0, statistics.count, np.nan)
    of_both = (per_reading[Approach.POSITIVE.index] + per_reading[Approach.NEGATIVE.index]) / 4
    return MeanUncertainty(
        coverage_factor=COVERAGE_FACTOR,
        by_approach=read_only_floats(
            COVERAGE_FACTOR * np.sqrt(shared + of_direction + faces + own * per_reading)
        ),
        bidirectional=read_only_floats(
            COVERAGE_FACTOR * np.sqrt(shared + parting / 4 + faces / 2 + own * of_both)
        ),
    )
