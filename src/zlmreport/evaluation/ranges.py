"""Extremes and means over the positions, where every parameter of an axis ends.

A position at which a value is not defined (NaN) takes no part; where no position has one, the result is
NaN. Batch dimensions lead.
"""

from __future__ import annotations

import numpy as np

from zlmreport.quantities.arrays import FloatArray


def largest(values: FloatArray) -> FloatArray:
    """Return the largest value over the positions: (..., position) to (...)."""
    extreme: FloatArray = np.fmax.reduce(values, axis=-1)
    return extreme


def smallest(values: FloatArray) -> FloatArray:
    """Return the smallest value over the positions: (..., position) to (...)."""
    extreme: FloatArray = np.fmin.reduce(values, axis=-1)
    return extreme


def width(upper: FloatArray, lower: FloatArray) -> FloatArray:
    """Return the full range from the smallest lower to the largest upper value: (..., position) to (...)."""
    return largest(upper) - smallest(lower)


def span(values: FloatArray) -> FloatArray:
    """Return the full range of values over the positions: (..., position) to (...).

    NaN where fewer than two positions have one: a single value has no range, which is not to say that it
    has one of zero.
    """
    several = np.count_nonzero(~np.isnan(values), axis=-1) > 1
    return np.where(several, width(values, values), np.nan)


def average(values: FloatArray) -> FloatArray:
    """Return the mean over the positions: (..., position) to (...)."""
    present = ~np.isnan(values)
    total = np.add.reduce(values, axis=-1, where=present)
    with np.errstate(invalid="ignore"):
        mean: FloatArray = total / np.count_nonzero(present, axis=-1)
    return mean
