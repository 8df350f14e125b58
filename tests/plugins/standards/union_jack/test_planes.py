"""Planes through heights: the minimum zone against every plane that may be it."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, strategies as st

from zlmreport_plugins.standards.union_jack.planes import compute_least_squares_span, find_minimum_zone

GRID = np.array([(x, y) for x in np.linspace(0, 1.6, 4) for y in np.linspace(0, 1, 3)])


def by_trying(places: np.ndarray, heights: np.ndarray) -> float:
    """Return the least width of all zones that two edges, or an edge and a corner, of the cloud define."""
    points = np.column_stack([places, heights])
    least = np.inf
    for a, b, c in combinations(points, 3):  # a face, and the point opposite to it
        least = min(least, _width(points, b - a, c - a))
    pairs = list(combinations(range(len(points)), 2))
    for (a, b), (c, d) in combinations(pairs, 2):  # two edges opposite to each other
        least = min(least, _width(points, points[b] - points[a], points[d] - points[c]))
    return least


def _width(points: np.ndarray, first: np.ndarray, second: np.ndarray) -> float:
    normal = np.cross(first, second)
    if abs(normal[2]) < 1e-12:
        return np.inf
    return float(np.ptp(points @ (normal / normal[2])))


@given(st.integers(0, 2**32 - 1))
def test_the_minimum_zone_is_the_least_of_all(seed: int) -> None:
    heights = np.random.default_rng(seed).normal(0, 1e-6, 9)
    places = GRID[[0, 2, 3, 5, 6, 7, 9, 10, 11]]
    assert find_minimum_zone(places, heights) == pytest.approx(by_trying(places, heights), rel=1e-9)


@given(st.integers(0, 2**32 - 1), st.floats(-1e-5, 1e-5), st.floats(-1e-5, 1e-5))
def test_tilting_and_lifting_change_nothing(seed: int, a: float, b: float) -> None:
    heights = np.random.default_rng(seed).normal(0, 1e-6, (3, len(GRID)))
    tilted = heights + a * GRID[:, 0] + b * GRID[:, 1] + a
    for span in (compute_least_squares_span, find_minimum_zone):
        assert span(GRID, tilted) == pytest.approx(span(GRID, heights), rel=1e-6)


def test_no_zone_is_wider_than_that_about_least_squares() -> None:
    heights = np.random.default_rng(3).normal(0, 1e-6, (200, len(GRID)))
    assert np.all(find_minimum_zone(GRID, heights) <= compute_least_squares_span(GRID, heights) * (1 + 1e-12))


def test_a_saddle_touches_its_zone_in_all_four_corners() -> None:
    corners = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    assert find_minimum_zone(corners, np.array([1.0, -1.0, 1.0, -1.0])) == pytest.approx(2)


def test_a_gap_leaves_no_zone() -> None:
    heights = np.zeros((2, len(GRID)))
    heights[1, 3] = np.nan
    assert find_minimum_zone(GRID, heights) == pytest.approx([0, np.nan], nan_ok=True)
