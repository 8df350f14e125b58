"""How far heights lie from a plane: of least squares, and of the smallest zone.

The two parallel planes that are nearest to each other and hold all points between them are the solution of
a linear programme: least half width e with −e ≤ z − (c + a·x + b·y) ≤ e. It is solved exactly, by exchanging
one point at a time: four points always decide it, and the one that lies farthest outside takes the place of
one of them (E. Stiefel, 1959; the simplex method on the dual problem). All tests of a stack are solved side
by side.
"""

from __future__ import annotations

import numpy as np

from zlmreport.plugin import FloatArray, IntArray

#: Far more exchanges than so few unknowns take.
_MOST_EXCHANGES = 200
#: Of the largest height: a point that lies outside by less does not.
_ROUNDING = 1e-12
#: By so much the weights of the four points are never 0, so that each exchange is one.
_APART = 1e-7 * np.array([1.0, 0.83, 0.61, 0.37])
_NO_STEP = 1e-12


def compute_least_squares_span(places: FloatArray, heights: FloatArray) -> FloatArray:
    """Return the span of the heights about their plane of least squares, m, (...).

    `places`: (N, 2), m. `heights`: (..., N), m; a span is NaN where one of them is.
    """
    base = _make_base(places)
    left = heights - heights @ np.linalg.pinv(base).T @ base.T
    return np.asarray(np.ptp(left, axis=-1))


def find_minimum_zone(places: FloatArray, heights: FloatArray) -> FloatArray:
    """Return the least distance of two parallel planes that hold all points, m, (...).

    Along the vertical, which slopes of a plate do not tell from the normal. `places`: (N, 2), m, with one in
    each corner. `heights`: (..., N), m; a distance is NaN where one of them is.
    """
    tests = heights.reshape(-1, heights.shape[-1])
    widths = np.full(len(tests), np.nan)
    sound = np.flatnonzero(np.isfinite(tests).all(axis=-1))
    sizes = np.abs(tests[sound]).max(axis=-1)
    sizes[sizes == 0] = 1.0
    widths[sound] = sizes * _measure_widths(_make_base(places), tests[sound] / sizes[:, np.newaxis])
    return widths.reshape(heights.shape[:-1])


def _make_base(places: FloatArray) -> FloatArray:
    """Return 1, x and y of each place, (N, 3), on a scale of their own."""
    middle, reach = places.mean(axis=0), np.ptp(places, axis=0)
    return np.column_stack([np.ones(len(places)), (places - middle) / np.where(reach > 0, reach, 1.0)])


def _measure_widths(base: FloatArray, heights: FloatArray) -> FloatArray:
    """Return the widths of the zones of tests, (test,); `heights` are about 1."""
    points, signs, weights = _choose_corners(base)
    number = len(heights)
    points, signs = np.tile(points, (number, 1)), np.tile(signs, (number, 1))
    wanted = _make_columns(base, points[:1], signs[:1])[0] @ (weights + _APART) if number else weights
    widths, open_tests = np.full(number, np.nan), np.arange(number)
    for _ in range(_MOST_EXCHANGES):
        if not open_tests.size:
            break
        held, way = points[open_tests], signs[open_tests]
        of_held = way * np.take_along_axis(heights[open_tests], held, axis=-1)
        columns = _make_columns(base, held, way)
        plane = np.linalg.solve(np.swapaxes(columns, -1, -2), of_held[..., np.newaxis])[..., 0]
        left = heights[open_tests] - plane[:, :3] @ base.T
        widths[open_tests] = np.ptp(left, axis=-1)
        worst = np.abs(left).argmax(axis=-1)
        farthest = np.take_along_axis(left, worst[:, np.newaxis], axis=-1)[:, 0]
        outside = np.abs(farthest) > plane[:, 3] + _ROUNDING
        if not outside.any():
            break
        open_tests, columns = open_tests[outside], columns[outside]
        entering, side = worst[outside], np.sign(farthest[outside])
        leaving = _find_leaving(
            columns, _make_columns(base, entering[:, np.newaxis], side[:, np.newaxis]), wanted
        )
        points[open_tests, leaving], signs[open_tests, leaving] = entering, side
    return widths


def _choose_corners(base: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
    """Return the four points to begin with, on which side of the plane each lies, and its weight."""
    rises, falls = base[:, 1] + base[:, 2], base[:, 1] - base[:, 2]
    points = np.array([rises.argmin(), falls.argmax(), rises.argmax(), falls.argmin()])
    weights = np.linalg.svd(base[points].T)[2][-1]
    signs = np.where(weights < 0, -1.0, 1.0)
    return points, signs, np.abs(weights) / np.abs(weights).sum()


def _make_columns(base: FloatArray, points: IntArray, signs: FloatArray) -> FloatArray:
    """Return what a point adds to the four equations of the weights, (test, 4, point)."""
    own = signs[..., np.newaxis] * base[points]
    return np.swapaxes(np.concatenate([own, np.ones((*points.shape, 1))], axis=-1), -1, -2)


def _find_leaving(columns: FloatArray, entering: FloatArray, wanted: FloatArray) -> IntArray:
    """Return which of the four points leaves as one enters: the first whose weight falls to 0, (test,)."""
    right = np.concatenate([np.broadcast_to(wanted[:, np.newaxis], entering.shape), entering], axis=-1)
    solved = np.linalg.solve(columns, right)
    weights, falling = solved[..., 0], solved[..., 1]
    steps = np.where(falling > _NO_STEP, weights / np.where(falling > _NO_STEP, falling, 1.0), np.inf)
    return np.asarray(steps.argmin(axis=-1))
