"""Types of arrays, read-only arrays, decimals of numbers."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: An array of doubles.
FloatArray: TypeAlias = NDArray[np.float64]
#: An array of whole numbers.
IntArray: TypeAlias = NDArray[np.int64]
#: An array of truth values.
BoolArray: TypeAlias = NDArray[np.bool_]


def read_only_floats(values: ArrayLike) -> FloatArray:
    """Return a read-only copy of the values as doubles."""
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array


def read_only_integers(values: ArrayLike) -> IntArray:
    """Return a read-only copy of the values as integers."""
    array = np.array(values, dtype=np.int64)
    array.setflags(write=False)
    return array


def count_decimals_of(values: FloatArray, most: int) -> int:
    """Return the decimals in which values were given: the fewest that hold them all, at most `most`.

    >>> count_decimals_of(np.array([0.25, np.nan, 3.0]), 3), count_decimals_of(np.array([1 / 3]), 3)
    (2, 3)
    """
    finite = values[np.isfinite(values)]
    # A thousandth of the last digit that could be printed, or a double's rounding of a large value:
    # a position read as 10000.0001 mm leaves its deviation a little off its own decimals.
    tolerance = np.maximum(1e-3 * 10.0**-most, 1e-9 * np.abs(finite))
    for decimals in range(most):
        if np.all(np.abs(np.round(finite, decimals) - finite) <= tolerance):
            return decimals
    return most
