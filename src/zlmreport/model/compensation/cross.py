"""Tables across axes: while one moves, another is moved aside, and straightness and squareness go."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.measurement.arrays import FloatArray


@dataclass(frozen=True, slots=True)
class CrossTable:
    """What an axis is off, over the position of another.

    Attributes
    ----------
    input, output
        The axis that moves, and the one that is off and is moved aside.
    positions : (g,) array
        Of the input axis, equally far apart, rising, m.
    values : (g,) array
        The deviation e = actual − nominal of the output axis there, m: zero at the first row.
    slope
        What of it is squareness: e grows so much along the input axis, rad.
    """

    input: str
    output: str
    positions: FloatArray
    values: FloatArray
    slope: float

    def at(self, positions: FloatArray) -> FloatArray:
        """Return what is taken away at some positions, m: linear between rows, the end value outside."""
        return np.asarray(np.interp(positions, self.positions, self.values), dtype=np.float64)
