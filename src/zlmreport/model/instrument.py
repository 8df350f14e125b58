"""The error of the measuring instrument: one and the same in all readings, however many are taken.

M. Halaj, E. Kureková, R. Palenčár and T. Loebl, The positional deviation in two axes, equations (7) to (9):
U(x) = diag(u²(P_i)) + u²(δ)·i·iᵀ. The second term changes no estimate and no residual of a model with a
constant, so it can hide no misfit; it is an uncertainty of every prediction.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.quantities.arrays import FloatArray


@dataclass(frozen=True, slots=True)
class InstrumentError:
    """Standard uncertainty of the instrument, fully correlated between readings.

    Attributes
    ----------
    common
        u(δ), the same at all positions, m or rad.
    proportional
        Per position, m/m or rad/rad: the paper has none, but a laser's wavelength does.
    """

    common: float = 0.0
    proportional: float = 0.0

    def factor(self, position: FloatArray) -> FloatArray:
        """Return F with F·Fᵀ the covariance of readings at these positions, shape (N, 2)."""
        return np.column_stack([np.full(len(position), self.common), self.proportional * position])
