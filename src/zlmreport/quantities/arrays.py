"""Array types, and arrays that nobody can alter behind a frozen value."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: An array of doubles.
FloatArray: TypeAlias = NDArray[np.float64]
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
