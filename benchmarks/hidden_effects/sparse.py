"""Sparse regression: sequentially thresholded ridge regression.

S. L. Brunton, J. L. Proctor and J. N. Kutz, Proceedings of the National Academy of Sciences 113 (2016) 3932.
The threshold is chosen by the Bayesian information criterion.
"""

from __future__ import annotations

import numpy as np

from zlmreport.measurement.arrays import BoolArray, FloatArray

_RIDGE = 1e-3
_THRESHOLDS = np.geomspace(0.02, 0.9, 25)
_ROUNDS = 20


def sparse(columns: FloatArray, residual: FloatArray) -> tuple[int | None, FloatArray]:
    """Return the term of the largest coefficient and the coefficients of all; None if no term is left.

    Parameters
    ----------
    columns : (N, K) array
        The terms.
    residual : (N,) array
        What the job's model leaves.
    """
    readings = len(residual)
    sizes = np.sqrt(np.mean(columns**2, axis=0))
    scaled = columns / sizes
    goal = residual / np.sqrt(np.mean(residual**2))
    start = _ridge(scaled, goal)
    best, kept = 0.0, np.zeros(columns.shape[1], dtype=np.bool_)
    for threshold in _THRESHOLDS:
        active = _thresholded(scaled, goal, start, float(threshold) * float(np.abs(start).max()))
        if 0 < active.sum() < readings / 3:
            left = goal - scaled[:, active] @ np.linalg.lstsq(scaled[:, active], goal, rcond=1e-9)[0]
            criterion = float(readings * np.log(np.mean(left**2)) + active.sum() * np.log(readings))
            if criterion < best:
                best, kept = criterion, active
    coefficients = np.zeros(columns.shape[1])
    if not kept.any():
        return None, coefficients
    coefficients[kept] = np.linalg.lstsq(scaled[:, kept], residual, rcond=1e-9)[0]
    leading = int(np.argmax(np.abs(coefficients)))
    return leading, coefficients / sizes


def _thresholded(scaled: FloatArray, goal: FloatArray, start: FloatArray, threshold: float) -> BoolArray:
    active = np.abs(start) > threshold
    for _ in range(_ROUNDS):
        if not active.any():
            break
        coefficients = np.zeros(len(active))
        coefficients[active] = _ridge(scaled[:, active], goal)
        still = np.abs(coefficients) > threshold
        if np.array_equal(still, active):
            break
        active = still
    return active


def _ridge(scaled: FloatArray, goal: FloatArray) -> FloatArray:
    gram = scaled.T @ scaled + _RIDGE * len(goal) * np.eye(scaled.shape[1])
    return np.asarray(np.linalg.solve(gram, scaled.T @ goal))
