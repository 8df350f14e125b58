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
    u²(x̄_i↑) = u_L²·((P_i − P_1)/L)² + u_P² + u_R²/n, with the sums of squares u_L² of the contributions along
    the length, u_P² at each position and u_R² at each reading. Both directions share the first two, so that
    the mean of both has u_R²/n of all its readings: (1/n↑ + 1/n↓)/4.
    """
    statistics = evaluation.statistics
    effect = effect_along(evaluation.measurements.target_positions)
    shared = budget.variance(Acts.ALONG_THE_LENGTH) * effect**2 + budget.variance(Acts.AT_EACH_POSITION)
    own = budget.variance(Acts.AT_EACH_READING)
    per_reading = 1 / np.where(statistics.count > 0, statistics.count, np.nan)
    of_both = (per_reading[Approach.POSITIVE.index] + per_reading[Approach.NEGATIVE.index]) / 4
    return MeanUncertainty(
        coverage_factor=COVERAGE_FACTOR,
        by_approach=read_only_floats(COVERAGE_FACTOR * np.sqrt(shared + own * per_reading)),
        bidirectional=read_only_floats(COVERAGE_FACTOR * np.sqrt(shared + own * of_both)),
    )
