"""Circles through points in plain Python, by other ways than the standard's."""

from __future__ import annotations

import itertools
import math


def minimum_zone_width(points: list[tuple[float, float]]) -> float:
    """Return the width of the minimum zone of (angle, radius) by its dual: the widest that no centre avoids.

    Two points outside and two inside whose chords cross hold the circles apart; so do two at one angle.
    """
    widest = 0.0
    for (t1, r1), (t2, r2) in itertools.combinations(points, 2):
        if math.isclose(t1, t2):
            widest = max(widest, abs(r1 - r2))
    for four in itertools.combinations(sorted(points), 4):
        for out, into in ((four[::2], four[1::2]), (four[1::2], four[::2])):
            crossing = _crossing(out, into)
            if crossing:
                outer, inner = crossing
                widest = max(widest, outer - inner)
    return widest


def _crossing(out, into):
    """Return the radii at which two chords pass over each other where they cross; None for parallel ones."""
    (ax, ay), (bx, by) = [(math.cos(t), math.sin(t)) for t, _ in out]
    (cx, cy), (dx, dy) = [(math.cos(t), math.sin(t)) for t, _ in into]
    determinant = (bx - ax) * (cy - dy) - (by - ay) * (cx - dx)
    if abs(determinant) < 1e-12:
        return None
    share = ((cx - ax) * (cy - dy) - (cy - ay) * (cx - dx)) / determinant
    other = ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / determinant
    if not (0 <= share <= 1 and 0 <= other <= 1):
        return None
    outer = out[0][1] + share * (out[1][1] - out[0][1])
    return outer, into[0][1] + other * (into[1][1] - into[0][1])


def least_squares(points: list[tuple[float, float]]) -> tuple[float, float, float]:
    """Return centre and radius of least squares of (angle, radius) by the normal equations."""
    rows = [((1.0, math.cos(t), math.sin(t)), r) for t, r in points]
    matrix = [[math.fsum(a[i] * a[j] for a, _ in rows) for j in range(3)] for i in range(3)]
    right = [math.fsum(a[i] * r for a, r in rows) for i in range(3)]
    for column in range(3):
        for row in range(column + 1, 3):
            factor = matrix[row][column] / matrix[column][column]
            matrix[row] = [x - factor * y for x, y in zip(matrix[row], matrix[column], strict=True)]
            right[row] -= factor * right[column]
    solved = [0.0, 0.0, 0.0]
    for row in (2, 1, 0):
        known = math.fsum(matrix[row][k] * solved[k] for k in range(row + 1, 3))
        solved[row] = (right[row] - known) / matrix[row][row]
    return solved[1], solved[2], solved[0]
