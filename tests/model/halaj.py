"""The paper's own way, written down as it is printed: an independent computation to compare with.

M. Halaj, E. Kureková, R. Palenčár and T. Loebl, The positional deviation in two axes: equations (2) and (13)
over means, with the covariance (9) of means whose variances (10) are taken as known.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from zlmreport.plugin import FloatArray

#: Equations (11) and (12), "zprava" (from the right) and "zlava" (from the left): Δ and P in mm. The paper
#: prints no readings; it names ten positions, ten runs, and an axis of 2143 mm.
PRINTED = {
    "-": (0.0072729, 2.17e-5, -4.2836e-8, 4.5325e-11),
    "+": (0.0081716, 2.49e-5, -4.7664e-8, 4.6966e-11),
}


def columns(along: FloatArray, across: FloatArray | None = None) -> FloatArray:
    """Return the powers of equation (2), or of (13) with a second axis."""
    found = [np.ones_like(along), along, along**2, along**3]
    if across is not None:
        found += [across, across**2, across**3]
    return np.stack(found, axis=1)


def means(
    points: Sequence[FloatArray], deviation: FloatArray
) -> tuple[list[FloatArray], FloatArray, FloatArray]:
    """Return the points, the mean of the readings at each, and its standard uncertainty after (10)."""
    places, index, count = np.unique(np.stack(points), axis=1, return_inverse=True, return_counts=True)
    index = index.reshape(-1)
    mean = np.bincount(index, deviation) / count
    squares = np.bincount(index, (deviation - mean[index]) ** 2)
    return list(places), mean, np.sqrt(squares / (count * (count - 1)))


def solve(
    columns_: FloatArray, mean: FloatArray, u: FloatArray | float, u_instrument: float
) -> tuple[FloatArray, FloatArray]:
    """Return the coefficients and their covariance by generalized least squares with (9)."""
    covariance = np.diag(np.broadcast_to(np.square(u), mean.shape)) + u_instrument**2
    weights = np.linalg.inv(covariance)
    found = np.linalg.inv(columns_.T @ weights @ columns_)
    return found @ columns_.T @ weights @ mean, found
