"""The formulas of the NMTBA recommendation, in the order of its chart.

All readings at a position form one sample, whatever their direction: the reversal is inside the spread,
and there is no parameter for it. A test in one direction has the readings of this direction for its
sample. Every function takes the statistics of one test or of a stack of tests; NaN stands for what is not
defined: in a test of both directions, a position that lacks one of them. Positions are counted by j,
cycles by i.

Source: the ZLM Position manual, G 1.3; the bar over X that its formulas of the parameters lack is set.
"""

from __future__ import annotations

import numpy as np

from zlmreport.plugin import (
    BoolArray,
    FloatArray,
    PositionStatistics,
    largest_over_positions,
    mean_over_positions,
    range_over_positions,
    smallest_over_positions,
    span_over_positions,
)


def mean_deviation(statistics: PositionStatistics) -> FloatArray:
    """X̄_j, the mean of all readings at a position, shape (..., position).

    X̄_j = 1/(2z) · Σ(x_ij↑ + x_ij↓); with readings missing, their sum by their number.
    """
    count = statistics.count
    total = np.where(count > 0, count * statistics.mean, 0.0).sum(axis=-2)
    with np.errstate(invalid="ignore"):
        mean = total / count.sum(axis=-2)
    return np.where(_lacks_a_direction(statistics), np.nan, mean)


def position_spread(statistics: PositionStatistics, mean: FloatArray) -> FloatArray:
    """P_sj = 6·√(Σ_i[(x_ij↑ − X̄_j)² + (x_ij↓ − X̄_j)²] / (2z − 1)), shape (..., position).

    The sum of squares about X̄_j is taken as that about the mean of each direction and that of these means
    about X̄_j: two sums of squares, in which nothing cancels.

    Parameters
    ----------
    statistics
        By position.
    mean : (..., position) array
        X̄_j.
    """
    count = statistics.count
    degrees_of_freedom = count.sum(axis=-2) - 1
    within = np.where(count > 1, (count - 1) * statistics.standard_deviation**2, 0.0)
    between = np.where(count > 0, count * (statistics.mean - mean[..., np.newaxis, :]) ** 2, 0.0)
    squares = (within + between).sum(axis=-2)
    spread: FloatArray = 6 * np.sqrt(squares / np.where(degrees_of_freedom > 0, degrees_of_freedom, np.nan))
    return spread


def parameters(mean: FloatArray, spread: FloatArray) -> dict[str, FloatArray]:
    """Return the parameters of the axis by symbol, each of shape (...).

    Parameters
    ----------
    mean, spread : (..., position) arrays
        X̄_j and P_sj.
    """
    upper, lower = mean + spread / 2, mean - spread / 2
    return {
        "P": range_over_positions(upper, lower),
        "Pa": span_over_positions(mean),
        "Ps_max": largest_over_positions(spread),
        "Ps_mean": mean_over_positions(spread),
        "O": offset(upper, lower),
    }


def offset(upper: FloatArray, lower: FloatArray) -> FloatArray:
    """O = −½·(max[X̄_j + P_sj/2] + min[X̄_j − P_sj/2]): what centres the band on zero. Shape (...)."""
    return -(largest_over_positions(upper) + smallest_over_positions(lower)) / 2


def _lacks_a_direction(statistics: PositionStatistics) -> BoolArray:
    """Tell where a test of both directions has readings of only one, shape (..., position)."""
    lacks: BoolArray = np.any(statistics.count == 0, axis=-2)
    return lacks & statistics.is_bidirectional[..., np.newaxis]
