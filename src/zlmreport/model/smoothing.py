"""Smoothing of logged conditions, so that the noise of a sensor does not pass for a change of the machine.

Penalized cubic splines; their stiffness is that of the least generalized cross-validation error (P. H. C.
Eilers and B. D. Marx, Statistical Science 11 (1996) 89; P. Craven and G. Wahba, Numerische Mathematik 31
(1979) 377).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.quantities.arrays import FloatArray

_DEGREE = 3
_MOST_INTERVALS = 40
_READINGS_PER_INTERVAL = 4
_STIFFNESSES = np.logspace(-6, 8, 71)


@dataclass(frozen=True, slots=True)
class Smoothed:
    """A log, smoothed.

    Attributes
    ----------
    values : (N,) array
        The smooth course at the readings, in the unit of the log.
    noise
        Standard deviation of the log about it.
    variation
        Standard deviation of the smooth course itself.
    """

    values: FloatArray
    noise: float
    variation: float


def smoothed(moments: FloatArray, log: FloatArray) -> Smoothed:
    """Return a log without its noise.

    Parameters
    ----------
    moments : (N,) array
        When it was logged; any unit, not falling.
    log : (N,) array
        The values; complete.
    """
    extent = float(np.ptp(moments))
    intervals = min(_MOST_INTERVALS, len(log) // _READINGS_PER_INTERVAL)
    if extent == 0 or intervals < 2 or np.ptp(log) == 0:
        return Smoothed(log, 0.0, float(np.std(log)))
    basis = _splines((moments - moments[0]) / extent, intervals)
    penalty = np.diff(np.eye(basis.shape[1]), 2, axis=0)
    # In the basis that makes both the fit and the penalty diagonal, all stiffnesses are tried at once.
    gram = basis.T @ basis + 1e-10 * len(log) * np.eye(basis.shape[1])
    inverse = np.linalg.inv(np.linalg.cholesky(gram))
    bending, turn = np.linalg.eigh(inverse @ (penalty.T @ penalty) @ inverse.T)
    orthonormal = basis @ inverse.T @ turn
    mean = float(np.mean(log))
    coefficients = orthonormal.T @ (log - mean)
    shrinkage = 1.0 / (1.0 + _STIFFNESSES[:, np.newaxis] * np.maximum(bending, 0.0))
    curves = mean + (shrinkage * coefficients) @ orthonormal.T
    squares = np.sum((log - curves) ** 2, axis=1)
    free = len(log) - shrinkage.sum(axis=1)
    best = int(np.argmin(squares / free**2))
    noise = float(np.sqrt(squares[best] / free[best]))
    return Smoothed(curves[best], noise, float(np.std(curves[best])))


def _splines(where: FloatArray, intervals: int) -> FloatArray:
    """Return the cubic B-splines over equal intervals of 0 to 1, shape (N, intervals + 3)."""
    step = 1.0 / intervals
    knots = (np.arange(intervals + 2 * _DEGREE + 1) - _DEGREE) * step
    inside = np.minimum(where, 1.0 - 1e-12)[:, np.newaxis]
    values = ((inside >= knots[:-1]) & (inside < knots[1:])).astype(np.float64)
    for degree in range(1, _DEGREE + 1):
        rising = (inside - knots[: -degree - 1]) / (degree * step)
        falling = (knots[degree + 1 :] - inside) / (degree * step)
        values = rising * values[:, :-1] + falling * values[:, 1:]
    return values
