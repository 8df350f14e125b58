"""In how many decimals values were given."""

from __future__ import annotations

import numpy as np

from zlmreport.quantities.arrays import FloatArray


def decimals_of(values: FloatArray, most: int) -> int:
    """Return the decimals in which values were given: the fewest that hold them all, at most `most`.

    >>> decimals_of(np.array([0.25, np.nan, 3.0]), 3), decimals_of(np.array([1 / 3]), 3)
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
