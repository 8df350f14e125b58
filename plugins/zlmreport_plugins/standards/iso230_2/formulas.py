"""The formulas of ISO 230-2, in the order of the standard.

k stands for the edition's coverage factor: 3 in 1988, 2 since 1997. All parameters are full ranges. Every
function takes the statistics of one test or of a stack of tests; NaN stands for what is not defined.

Sources: 1988 as in the ZLM Position manual, G 1.3; 1997, 2006 and 2014 as published, and confirmed by the
published results in ``tests/data/published``.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from zlmreport.plugin import FloatArray
from zlmreport.plugin.standard import (
    PositionStatistics,
    largest_over_positions,
    mean_over_positions,
    range_over_positions,
    smallest_over_positions,
    span_over_positions,
)


def unidirectional_repeatability(statistics: PositionStatistics, k: int) -> FloatArray:
    """R_i↑ = 2k·s_i↑ and R_i↓ = 2k·s_i↓, shape (..., approach, position)."""
    return 2 * k * statistics.standard_deviation


def bidirectional_repeatability(statistics: PositionStatistics, k: int) -> FloatArray:
    """R_i = max(k·s_i↑ + k·s_i↓ + abs(B_i); 2k·s_i↑; 2k·s_i↓), shape (..., position).

    NaN where a direction has fewer than two readings.
    """
    positive, negative = k * statistics.s_positive, k * statistics.s_negative
    mixed = positive + negative + np.abs(statistics.reversal_value)
    widest: FloatArray = np.maximum(mixed, 2 * np.maximum(positive, negative))
    return widest


def upper_limit(statistics: PositionStatistics, k: int) -> FloatArray:
    """x̄_i↑ + k·s_i↑ and x̄_i↓ + k·s_i↓, shape (..., approach, position)."""
    return statistics.mean + k * statistics.standard_deviation


def lower_limit(statistics: PositionStatistics, k: int) -> FloatArray:
    """x̄_i↑ − k·s_i↑ and x̄_i↓ − k·s_i↓, shape (..., approach, position)."""
    return statistics.mean - k * statistics.standard_deviation


def bidirectional_width(upper: FloatArray, lower: FloatArray) -> FloatArray:
    """Return the range over both directions: max(upper↑; upper↓) − min(lower↑; lower↓).

    Shape (..., approach, position) to (...); NaN where a direction was not measured at all.
    """
    highest: FloatArray = np.maximum.reduce(largest_over_positions(upper), axis=-1)
    lowest: FloatArray = np.minimum.reduce(smallest_over_positions(lower), axis=-1)
    return highest - lowest


def positions(statistics: PositionStatistics, k: int) -> dict[str, FloatArray]:
    """Return the columns by position by symbol, each of shape (..., position)."""
    unidirectional = unidirectional_repeatability(statistics, k)
    return {
        "R_fwd": unidirectional[..., 0, :],
        "R_bwd": unidirectional[..., 1, :],
        "R": bidirectional_repeatability(statistics, k),
    }


def parameters(
    statistics: PositionStatistics, k: int, repeatability: Mapping[str, FloatArray]
) -> dict[str, FloatArray]:
    """Return the parameters of the axis by symbol, each of shape (...).

    `repeatability`: The columns by position, as from `positions`.
    """
    upper, lower = upper_limit(statistics, k), lower_limit(statistics, k)
    mean, mean_bidirectional = statistics.mean, statistics.mean_bidirectional
    accuracy, systematic = range_over_positions(upper, lower), span_over_positions(mean)
    reversal = statistics.reversal_value
    return {
        "A": bidirectional_width(upper, lower),
        "A_fwd": accuracy[..., 0],
        "A_bwd": accuracy[..., 1],
        "E": bidirectional_width(mean, mean),
        "E_fwd": systematic[..., 0],
        "E_bwd": systematic[..., 1],
        "M": span_over_positions(mean_bidirectional),
        "R": largest_over_positions(repeatability["R"]),
        "R_fwd": largest_over_positions(repeatability["R_fwd"]),
        "R_bwd": largest_over_positions(repeatability["R_bwd"]),
        "B": largest_over_positions(np.abs(reversal)),
        "B_mean": mean_over_positions(reversal),
    }
