"""Means, standard deviations and reversal values by position: where every standard begins."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.measurement.approach import Approach
from zlmreport.quantities.arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True, slots=True)
class PositionStatistics:
    """The statistics of one test, or of a stack of tests at once.

    Batch dimensions lead: ``...`` is () for one test and (100000,) for a stack of simulated ones. The
    approach axis is `Approach.index`; what cannot be had (no reading; one reading for a standard
    deviation) is NaN.

    Attributes
    ----------
    deviations : (..., approach, position, run) array
        x_ij, m or rad; NaN where missing.
    count : (..., approach, position) integer array
        n, the readings there are.
    mean : (..., approach, position) array
        x̄_i↑ and x̄_i↓.
    standard_deviation : (..., approach, position) array
        s_i↑ and s_i↓ with n − 1.
    """

    deviations: FloatArray
    count: IntArray
    mean: FloatArray
    standard_deviation: FloatArray

    @property
    def mean_positive(self) -> FloatArray:
        """x̄_i↑, shape (..., position)."""
        return self.mean[..., Approach.POSITIVE.index, :]

    @property
    def mean_negative(self) -> FloatArray:
        """x̄_i↓, shape (..., position)."""
        return self.mean[..., Approach.NEGATIVE.index, :]

    @property
    def s_positive(self) -> FloatArray:
        """s_i↑, shape (..., position)."""
        return self.standard_deviation[..., Approach.POSITIVE.index, :]

    @property
    def s_negative(self) -> FloatArray:
        """s_i↓, shape (..., position)."""
        return self.standard_deviation[..., Approach.NEGATIVE.index, :]

    @property
    def mean_bidirectional(self) -> FloatArray:
        """x̄_i = (x̄_i↑ + x̄_i↓) / 2, shape (..., position); NaN where a direction is missing."""
        return (self.mean_positive + self.mean_negative) / 2

    @property
    def reversal_value(self) -> FloatArray:
        """B_i = x̄_i↑ − x̄_i↓, signed, shape (..., position); NaN where a direction is missing."""
        return self.mean_positive - self.mean_negative

    @property
    def is_bidirectional(self) -> BoolArray:
        """Whether both directions were measured, shape (...)."""
        both: BoolArray = np.all(np.any(self.count > 0, axis=-1), axis=-1)
        return both


def position_statistics(deviations: FloatArray) -> PositionStatistics:
    """Return the statistics by position.

    Parameters
    ----------
    deviations : (..., approach, position, run) array
        x_ij, m or rad; NaN where missing. A missing reading lowers n at its position and approach only.
    """
    present = ~np.isnan(deviations)
    count = np.count_nonzero(present, axis=-1)
    filled = deviations if present.all() else np.where(present, deviations, 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = filled.sum(axis=-1) / count
        residual = filled - mean[..., np.newaxis]
        if filled is not deviations:
            residual = np.where(present, residual, 0.0)
        variance = np.einsum("...j,...j->...", residual, residual) / (count - 1)
    variance = np.where(count > 1, variance, np.nan)
    return PositionStatistics(deviations, count, mean, np.sqrt(variance))
