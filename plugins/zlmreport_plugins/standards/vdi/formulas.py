"""The formulas of VDI/DGQ 3441 and VDI/VDE 2617, in the order of their charts.

k stands for the guideline's factor: 3 in VDI/DGQ 3441, 2 in VDI/VDE 2617. Every function takes the
statistics of one test or of a stack of tests; NaN stands for what is not defined. Positions are counted
by j, cycles by i.

In a test in one direction, for which the guidelines do not provide, x̄_j and s̄_j are those of this
direction, and there is no reversal span.

Source: the ZLM Position manual, G 1.3; of its limits x̄_j↑ + P_sj/2 and x̄_j↓ − P_sj/2, which hold only
where x̄_j↑ lies above x̄_j↓, the general form x̄_j ± ½(U_j + P_sj) is taken, as in its formula for P.
"""

from __future__ import annotations

import numpy as np

from zlmreport.plugin import (
    FloatArray,
    PositionStatistics,
    largest_over_positions,
    mean_over_positions,
    range_over_positions,
    span_over_positions,
)


def mean_deviation(statistics: PositionStatistics) -> FloatArray:
    """x̄_j = (x̄_j↑ + x̄_j↓)/2, shape (..., position)."""
    return statistics.of_both_or_single(statistics.mean_bidirectional, statistics.mean)


def position_spread(statistics: PositionStatistics, k: int) -> FloatArray:
    """P_sj = k·(s_j↑ + s_j↓) = 2k·s̄_j, shape (..., position)."""
    both = k * (statistics.s_positive + statistics.s_negative)
    return statistics.of_both_or_single(both, 2 * k * statistics.standard_deviation)


def reversal_span(statistics: PositionStatistics) -> FloatArray:
    """U_j = abs(x̄_j↑ − x̄_j↓), shape (..., position); NaN where a direction is missing."""
    return np.abs(statistics.reversal_value)


def half_width(reversal: FloatArray, spread: FloatArray, statistics: PositionStatistics) -> FloatArray:
    """½(U_j + P_sj), half the width of the band about x̄_j; ½P_sj in one direction. Shape (..., position)."""
    bidirectional = statistics.is_bidirectional[..., np.newaxis]
    return np.where(bidirectional, reversal + spread, spread) / 2


def parameters(statistics: PositionStatistics, k: int) -> dict[str, FloatArray]:
    """Return the parameters of the axis by symbol, each of shape (...)."""
    mean = mean_deviation(statistics)
    spread = position_spread(statistics, k)
    reversal = reversal_span(statistics)
    half = half_width(reversal, spread, statistics)
    return {
        "P": range_over_positions(mean + half, mean - half),
        "Pa": span_over_positions(mean),
        "Ps_max": largest_over_positions(spread),
        "Ps_mean": mean_over_positions(spread),
        "U_max": largest_over_positions(reversal),
        "U_mean": mean_over_positions(reversal),
    }


def positions(statistics: PositionStatistics, k: int) -> dict[str, FloatArray]:
    """Return the columns by position, each of shape (..., position)."""
    return {"U": reversal_span(statistics), "Ps": position_spread(statistics, k)}
