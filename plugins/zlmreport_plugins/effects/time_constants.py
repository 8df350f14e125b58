"""Where the search for a time constant begins."""

from __future__ import annotations

import numpy as np

from zlmreport.plugin import Design, FloatArray

#: Of the duration: a shorter one ends with the first readings, a longer one is a straight line.
_SHORTEST, _LONGEST = 0.05, 1.5
_CONSTANTS = 12


def time_constants(design: Design) -> FloatArray:
    """Return time constants in a geometric row, shape (12, 1)."""
    return design.duration * np.geomspace(_SHORTEST, _LONGEST, _CONSTANTS)[:, np.newaxis]


def warmed_up(design: Design, time_constant: float) -> FloatArray:
    """Return how much of the way to the final state is done at each reading, from 0 to 1."""
    return -np.expm1(-design.time / time_constant)
