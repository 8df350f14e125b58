"""Stepwise regression by the Bayesian information criterion: forward, with a look back after each step."""

from __future__ import annotations

import numpy as np

from zlmreport.measurement.arrays import FloatArray

_MOST_TERMS = 30


def stepwise(columns: FloatArray, residual: FloatArray) -> tuple[int | None, FloatArray]:
    """Return the first term and the coefficients of all; None if no term pays.

    Parameters
    ----------
    columns : (N, K) array
        The terms.
    residual : (N,) array
        What the job's model leaves.
    """
    readings = len(residual)
    price = float(np.log(readings))
    scaled = columns / np.linalg.norm(columns, axis=0)
    chosen: list[int] = []
    best = readings * float(np.log(residual @ residual / readings))
    while len(chosen) < _MOST_TERMS:
        basis = np.linalg.qr(scaled[:, chosen])[0] if chosen else np.empty((readings, 0))
        left = residual - basis @ (basis.T @ residual)
        beyond = scaled - basis @ (basis.T @ scaled)
        lengths = np.sum(beyond**2, axis=0)
        gain = np.where(lengths > 1e-6, (beyond.T @ left) ** 2 / np.maximum(lengths, 1e-6), 0.0)
        place = int(np.argmax(gain))
        squares = float(left @ left - gain[place])
        criterion = readings * float(np.log(squares / readings)) + (len(chosen) + 1) * price
        if criterion >= best:
            break
        chosen.append(place)
        best = criterion
        chosen, best = _looked_back(scaled, residual, chosen, best)
    coefficients = np.zeros(columns.shape[1])
    if not chosen:
        return None, coefficients
    coefficients[chosen] = np.linalg.lstsq(columns[:, chosen], residual, rcond=1e-9)[0]
    return chosen[0], coefficients


def _looked_back(
    scaled: FloatArray, residual: FloatArray, chosen: list[int], best: float
) -> tuple[list[int], float]:
    """Return the terms without one that no longer pays."""
    readings = len(residual)
    for place in chosen[:-1]:
        others = [each for each in chosen if each != place]
        left = residual - scaled[:, others] @ np.linalg.lstsq(scaled[:, others], residual, rcond=1e-9)[0]
        criterion = readings * np.log(left @ left / readings) + len(others) * np.log(readings)
        if criterion < best:
            return others, float(criterion)
    return chosen, best
