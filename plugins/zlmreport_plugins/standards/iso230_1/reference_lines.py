"""Reference straight lines: least squares, through the end points, minimum zone.

Deviations are taken across the motion at each position; a line is y = y_0 + m·x. The minimum zone line is the
one from which the span of the deviations is smallest: its slope is that of an edge of the convex hull of the
points, so that it is found exactly. Every function takes one curve or a stack of curves, position last; NaN
stands for a position without a value.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Literal, TypeAlias

import numpy as np

from zlmreport.plugin import BoolArray, FloatArray
from zlmreport.plugin.standard import span_over_positions

#: How the reference line is laid.
LineName: TypeAlias = Literal["least-squares", "end-points", "minimum-zone"]
#: Positions that say how straight a line is: two always lie on one.
FEWEST_POSITIONS = 3
#: Of a value of the zone's width that went through a few operations, relative to the readings.
_ROUNDING = 1e-13


def slope(x: FloatArray, y: FloatArray, line: LineName) -> FloatArray:
    """Return the slope of the reference line, shape (...); NaN where fewer than two positions have a value.

    `x`: Positions, (position,), m, rising.
    `y`: Deviations, (..., position), m.
    """
    if np.isnan(x).any():
        return np.full(y.shape[:-1], np.nan)
    return _SLOPES[line](x, y)


def residuals(x: FloatArray, y: FloatArray, line: LineName) -> FloatArray:
    """Return the deviations from the reference line, shape (..., position).

    They are zero at both ends of a line through the end points, sum up to zero about that of least squares,
    and reach as far to one side of the minimum zone line as to the other.
    """
    tilted = y - slope(x, y, line)[..., np.newaxis] * np.where(np.isnan(x), 0.0, x)
    return tilted - _LEVELS[line](tilted)[..., np.newaxis]


def straightness(x: FloatArray, y: FloatArray, line: LineName) -> FloatArray:
    """Return the span of the deviations from the reference line, shape (...).

    NaN where fewer than three positions have a value: two points always lie on a line.
    """
    return np.where(_has_enough(y), span_over_positions(residuals(x, y, line)), np.nan)


def slope_of_several(x: FloatArray, y: FloatArray, line: LineName) -> FloatArray:
    """Return the slope of the reference line, shape (...); NaN of fewer than three positions with a value."""
    return np.where(_has_enough(y), slope(x, y, line), np.nan)


def _has_enough(y: FloatArray) -> BoolArray:
    return np.asarray(np.count_nonzero(~np.isnan(y), axis=-1) >= FEWEST_POSITIONS)


def local_straightness(x: FloatArray, y: FloatArray, line: LineName, window: float) -> FloatArray:
    """Return the largest straightness of any part as long as a window, each about its own line, shape (...).

    NaN of a curve no longer than the window, and where no part has three positions with a value.
    """
    found = np.full(y.shape[:-1], np.nan)
    if np.isnan(x).any() or not x.size or x[-1] - x[0] <= window * (1 + 1e-9):
        return found
    last = -1
    for first in range(len(x)):
        end = int(np.searchsorted(x, x[first] + window * (1 + 1e-9), side="right"))
        if end > last:  # as long as the window lets it be: no part of another one
            found = np.fmax(found, straightness(x[first:end], y[..., first:end], line))
            last = end
    return found


def _fit_least_squares(x: FloatArray, y: FloatArray) -> FloatArray:
    """Return Σ(x − x̄)(y − ȳ)/Σ(x − x̄)² over the positions with a value."""
    there = ~np.isnan(y)
    count = np.count_nonzero(there, axis=-1)[..., np.newaxis]
    with np.errstate(invalid="ignore", divide="ignore"):
        from_mean = np.where(there, x - np.sum(x * there, axis=-1, keepdims=True) / count, 0.0)
        products = np.sum(from_mean * np.where(there, y, 0.0), axis=-1)
        return np.asarray(products / np.sum(from_mean**2, axis=-1))


def _end_points(x: FloatArray, y: FloatArray) -> FloatArray:
    """Return the slope between the first and the last position with a value."""
    first, last = _find_ends(y)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray((_take_at(y, last) - _take_at(y, first)) / (x[last] - x[first]))


def _fit_minimum_zone(x: FloatArray, y: FloatArray) -> FloatArray:
    """Return the slope m for which max(y − m·x) − min(y − m·x) is smallest.

    The width is convex in m and made of straight pieces. From the pieces of a very small and a very large
    slope, the slope where the pieces on both sides of the smallest width cross is tried, and takes the place
    of one of them, until no piece lies between them: after as many steps as there are edges, at most.
    """
    curves = y.reshape(-1, y.shape[-1])
    found = _end_points(x, curves)
    first, last = _find_ends(curves)
    rise, run = _take_at(curves, last) - _take_at(curves, first), x[last] - x[first]
    pieces = np.stack([rise, -rise], axis=1), np.stack([run, -run], axis=1)  # width = rise − m·run
    open_ = np.isfinite(found)
    scale = _ROUNDING * np.nanmax(np.abs(np.where(open_[:, np.newaxis], curves, 0.0)), axis=-1, initial=0.0)
    for _ in range(2 * y.shape[-1] + 2):
        if not open_.any():
            break
        open_ = _try_crossings(x, curves, found, pieces, open_, scale)
    return found.reshape(y.shape[:-1])


def _try_crossings(  # noqa: PLR0913, PLR0917 - the state of the search
    x: FloatArray,
    curves: FloatArray,
    found: FloatArray,
    pieces: tuple[FloatArray, FloatArray],
    open_: BoolArray,
    scale: FloatArray,
) -> BoolArray:
    """Try the slopes where the pieces cross, and return the curves of which another one is to be tried."""
    which = np.flatnonzero(open_)
    rises, runs = pieces[0][which], pieces[1][which]
    trial = (rises[:, 0] - rises[:, 1]) / (runs[:, 0] - runs[:, 1])
    tilted = curves[which] - trial[:, np.newaxis] * x
    high = np.argmax(np.where(np.isnan(tilted), -np.inf, tilted), axis=-1)
    low = np.argmin(np.where(np.isnan(tilted), np.inf, tilted), axis=-1)
    width = _take_at(tilted, high) - _take_at(tilted, low)
    run = x[high] - x[low]
    found[which] = trial
    goes_on = (width > rises[:, 0] - trial * runs[:, 0] + scale[which]) & (run != 0)
    side = np.where(run > 0, 0, 1)
    pieces[0][which, side] = np.where(
        goes_on,
        _take_at(curves[which], high) - _take_at(curves[which], low),
        rises[np.arange(len(which)), side],
    )
    pieces[1][which, side] = np.where(goes_on, run, runs[np.arange(len(which)), side])
    still = np.zeros_like(open_)
    still[which[goes_on]] = True
    return still


def _find_ends(y: FloatArray) -> tuple[np.ndarray[tuple[int, ...], np.dtype[np.intp]], ...]:
    """Return the indices of the first and the last position with a value."""
    there = ~np.isnan(y)
    return np.argmax(there, axis=-1), y.shape[-1] - 1 - np.argmax(there[..., ::-1], axis=-1)


def _take_at(y: FloatArray, index: np.ndarray[tuple[int, ...], np.dtype[np.intp]]) -> FloatArray:
    return np.take_along_axis(y, index[..., np.newaxis], axis=-1)[..., 0]


def _level_by_mean(tilted: FloatArray) -> FloatArray:
    there = ~np.isnan(tilted)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.sum(np.where(there, tilted, 0.0), axis=-1) / np.count_nonzero(there, axis=-1))


def _level_by_first(tilted: FloatArray) -> FloatArray:
    return _take_at(tilted, _find_ends(tilted)[0])


def _level_by_middle(tilted: FloatArray) -> FloatArray:
    highest, lowest = np.fmax.reduce(tilted, axis=-1), np.fmin.reduce(tilted, axis=-1)
    return np.asarray((highest + lowest) / 2)


_SLOPES: Mapping[LineName, Callable[[FloatArray, FloatArray], FloatArray]] = {
    "least-squares": _fit_least_squares,
    "end-points": _end_points,
    "minimum-zone": _fit_minimum_zone,
}
#: Where a line of known slope lies.
_LEVELS: Mapping[LineName, Callable[[FloatArray], FloatArray]] = {
    "least-squares": _level_by_mean,
    "end-points": _level_by_first,
    "minimum-zone": _level_by_middle,
}
