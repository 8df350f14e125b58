"""Types of arrays, read-only arrays, decimals and scatter of numbers, what columns leave of them."""

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

#: Standard deviation of a normal variable over its median absolute deviation.
_NORMAL_OVER_MEDIAN = 1.4826


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


def estimate_robust_deviation(values: FloatArray) -> float:
    """Return the standard deviation of values about zero by the median of their amounts, in their unit.

    Of normal values; up to half of them may stand off as far as they like.

    >>> estimate_robust_deviation(np.array([-1.0, 1.0, 1.0, 500.0]))
    1.4826
    """
    return _NORMAL_OVER_MEDIAN * float(np.median(np.abs(values)))


def compute_left_beside(columns: FloatArray, values: FloatArray) -> FloatArray:
    """Return what columns in their best combination (least squares) leave of values, shape (N,).

    The columns, (N, q), are brought to one length first: a time in seconds would else outweigh a length in
    metres, and what is small beside it would count as nothing.
    """
    scaled = _scale_to_one_length(columns)
    return np.asarray(values - scaled @ np.linalg.lstsq(scaled, values, rcond=None)[0], dtype=np.float64)


def make_orthonormal_basis(columns: FloatArray, dependent: float) -> FloatArray:
    """Return orthonormal columns of the same span, (N, r), of columns of any lengths, (N, q).

    `dependent`: Singular value over the largest, up to which a combination of columns is no further one.
    """
    vectors, singular, _ = np.linalg.svd(_scale_to_one_length(columns), full_matrices=False)
    return np.asarray(vectors[:, singular > dependent * singular.max(initial=0.0)], dtype=np.float64)


def _scale_to_one_length(columns: FloatArray) -> FloatArray:
    lengths = np.linalg.norm(columns, axis=0)
    return np.asarray(columns / np.where(lengths > 0, lengths, 1.0), dtype=np.float64)
