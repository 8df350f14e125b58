"""Circles through points with radial deviations: of least squares, and the two of the minimum zone.

A circle whose centre lies off by e is r(θ) = c + e_x·cos θ + e_y·sin θ (a limaçon) as long as e is small
against the radius: what that leaves out is at most e²/(2R), 0.003 µm at e = 30 µm and R = 150 mm. So both
circles are linear in their centre. Points are radial deviations, (..., n), at angles, (n,), rad, all of them
there; several may lie at one angle, as those of several paths. Batch dimensions lead.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from zlmreport.plugin import BoolArray, FloatArray, IntArray

#: Between neighbouring angles of a full turn, in the median of these distances.
_WIDEST_GAP = 3.0
#: Angles nearer than this are one, rad.
_APART = 1e-9
#: Of the width: two bounds that agree to this are one.
_EXACT = 1e-12
#: Exchanges of points; a dozen are needed.
_MOST_EXCHANGES = 60
#: Signs of the four points between which the two circles are held, the first of them outside.
_ALTERNATING = np.array([1.0, -1.0, 1.0, -1.0])


@dataclass(frozen=True, slots=True)
class Circle:
    """A circle near the nominal one."""

    centre: FloatArray  #: (..., 2): its centre, from that of the nominal circle, along the plane's axes.
    radius: FloatArray  #: (...): its radius minus the nominal one.


@dataclass(frozen=True, slots=True)
class Zone:
    """Two circles about one centre that hold all points between them."""

    centre: FloatArray  #: (..., 2)
    inner: FloatArray  #: (...): radius minus the nominal one.
    outer: FloatArray  #: (...)

    @property
    def width(self) -> FloatArray:
        """The radial distance of the two, shape (...)."""
        return self.outer - self.inner


def is_full_turn(angles: FloatArray) -> bool:
    """Return whether angles lie all round, and not on an arc of a turn."""
    gaps = _measure_gaps(angles)
    return len(gaps) > 3 and bool(gaps.max() <= _WIDEST_GAP * np.median(gaps) and gaps.max() < math.pi / 2)


def measure_covered_arc(angles: FloatArray) -> float:
    """Return how far angles reach round: 2π for a full turn, else without the widest gap."""
    return 2 * math.pi if is_full_turn(angles) else 2 * math.pi - float(_measure_gaps(angles).max())


def _measure_gaps(angles: FloatArray) -> FloatArray:
    """Return the ways from angle to angle round a turn."""
    rising = np.sort(np.mod(angles, 2 * math.pi))
    return np.diff(rising, append=rising[:1] + 2 * math.pi)


def fit_least_squares_circle(points: FloatArray, angles: FloatArray) -> Circle:
    """Return the circle of least squares; NaN where fewer than three points tell of it."""
    if len(angles) < 3:
        nothing = np.full((*points.shape[:-1], 3), np.nan)
        return Circle(nothing[..., 1:], nothing[..., 0])
    design = np.column_stack([np.ones_like(angles), np.cos(angles), np.sin(angles)])
    found = points @ np.linalg.pinv(design).T
    return Circle(found[..., 1:], found[..., 0])


def compute_about(centre: FloatArray, points: FloatArray, angles: FloatArray) -> FloatArray:
    """Return radial deviations about another centre, (..., 2), from that of the nominal circle."""
    return np.asarray(points - centre @ np.stack([np.cos(angles), np.sin(angles)]))


def find_zone_about(centre: FloatArray, points: FloatArray, angles: FloatArray) -> Zone:
    """Return the two circles about a centre that hold all points between them."""
    found = compute_about(centre, points, angles)
    return Zone(centre, found.min(axis=-1), found.max(axis=-1))


def find_minimum_zone(points: FloatArray, angles: FloatArray) -> Zone:
    """Return the two circles about one centre, as near to each other as can be, that hold all points.

    min over e of max(r − e·u) − min(r − e·u), u = (cos θ, sin θ), is a linear programme. By its dual the
    width is the largest of those of four points that lie outside, inside, outside, inside by turns round the
    circle, or of one angle at which one point lies outside and another inside: so four points are exchanged
    for those that stand out, until none does (Chebyshev's alternation; the exchange of Remez). The width that
    is returned is met by all points, and no smaller one can be: both bounds agree.
    """
    batch = points.shape[:-1]
    angles = np.mod(angles, 2 * math.pi)
    order = np.argsort(angles, kind="stable")
    begins = np.flatnonzero(np.diff(angles[order], prepend=-1.0) > _APART)
    if len(begins) < 4:
        nothing = np.full(batch, np.nan)
        return Zone(np.full((*batch, 2), np.nan), nothing, nothing)
    upper = lower = points[..., order].reshape(-1, len(order))
    if len(begins) < len(order):
        upper, lower = (each.reduceat(upper, begins, axis=-1) for each in (np.maximum, np.minimum))
    centre = _Search(upper, lower, angles[order][begins]).find_centres().reshape(*batch, 2)
    return find_zone_about(centre, points, angles)


class _Search:
    """The centre of the minimum zone of each of many tests."""

    def __init__(self, upper: FloatArray, lower: FloatArray, angles: FloatArray) -> None:
        self.upper, self.lower = upper, lower  # (test, angle): alike where one point lies at each angle
        self.direction = np.stack([np.cos(angles), np.sin(angles)])
        tests, count = upper.shape
        self.centre = np.zeros((tests, 2))
        self.width = np.full(tests, np.inf)  # that is met by the best centre so far
        self.bound = (upper - lower).max(axis=1)  # that no centre can fall below
        self.held = np.tile(np.arange(4) * count // 4, (tests, 1))
        self.begins_outside = np.ones(tests, dtype=np.bool_)

    def find_centres(self) -> FloatArray:
        """Return them, (test, 2)."""
        active = np.arange(len(self.upper))
        for _ in range(_MOST_EXCHANGES):
            if not active.size:
                break
            outermost, innermost = self._fit(active)
            is_open = self._is_open(active)
            active, outermost, innermost = active[is_open], outermost[is_open], innermost[is_open]
            changed = self._exchange(active, outermost, 1.0) | self._exchange(active, innermost, -1.0)
            active = active[changed]
        for test in np.flatnonzero(self._is_open(np.arange(len(self.upper)))):
            self.centre[test] = _find_centre_by_vertices(self.upper[test], self.lower[test], self.direction)
        return self.centre

    def _is_open(self, tests: IntArray) -> BoolArray:
        width = self.width[tests]
        is_open: BoolArray = width - self.bound[tests] > _EXACT * np.abs(width)
        return is_open

    def _fit(self, active: IntArray) -> tuple[IntArray, IntArray]:
        """Hold the circles at four points each; return the points that stand out most, on either side."""
        held, sign = self.held[active], self._find_signs(active)
        rows = active[:, np.newaxis]
        values = np.where(sign > 0, self.upper[rows, held], self.lower[rows, held])
        system = np.empty((len(active), 4, 4))
        system[..., 0], system[..., 3] = 1.0, sign
        system[..., 1], system[..., 2] = self.direction[0][held], self.direction[1][held]
        solved = np.linalg.solve(system, values[..., np.newaxis])[..., 0]
        centre = solved[:, 1:3]
        moved = centre @ self.direction
        above = self.upper[active] - moved
        below = above if self.upper is self.lower else self.lower[active] - moved
        outermost, innermost = above.argmax(axis=1), below.argmin(axis=1)
        each = np.arange(len(active))
        width = above[each, outermost] - below[each, innermost]
        better = width < self.width[active]
        self.width[active[better]], self.centre[active[better]] = width[better], centre[better]
        self.bound[active] = np.maximum(self.bound[active], 2 * solved[:, 3])
        return outermost, innermost

    def _find_signs(self, active: IntArray) -> FloatArray:
        return np.where(self.begins_outside[active][:, np.newaxis], _ALTERNATING, -_ALTERNATING)

    def _exchange(self, active: IntArray, point: IntArray, side: float) -> BoolArray:
        """Exchange the neighbour on the same side for a point; not one whose angle is held already."""
        held, sign = self.held[active], self._find_signs(active)
        free: BoolArray = ~(held == point[:, np.newaxis]).any(axis=1)
        before = (np.count_nonzero(held <= point[:, np.newaxis], axis=1) - 1) % 4
        each = np.arange(len(active))
        place = np.where(sign[each, before] == side, before, (before + 1) % 4)
        held[each[free], place[free]] = point[free]
        order = np.argsort(held, axis=1, kind="stable")
        self.held[active] = np.take_along_axis(held, order, axis=1)
        self.begins_outside[active] = np.take_along_axis(sign, order, axis=1)[:, 0] > 0
        return free


def _find_centre_by_vertices(upper: FloatArray, lower: FloatArray, direction: FloatArray) -> FloatArray:
    """Return the centre of the minimum zone where four points by turns do not hold it.

    Of few angles the best of all vertices is taken, and the angles that stand out there are added, until none
    does.
    """
    count = len(upper)
    few = {int(each) for each in np.arange(4) * count // 4} | {int((upper - lower).argmax())}
    while True:
        chosen = np.array(sorted(few))
        centre, width = _find_best_vertex(upper[chosen], lower[chosen], direction[:, chosen])
        moved = centre @ direction
        outermost, innermost = int((upper - moved).argmax()), int((lower - moved).argmin())
        met = float((upper - moved)[outermost] - (lower - moved)[innermost])
        if met - width <= _EXACT * abs(met) or {outermost, innermost} <= few:
            return centre
        few |= {outermost, innermost}


def _find_best_vertex(
    upper: FloatArray, lower: FloatArray, direction: FloatArray
) -> tuple[FloatArray, float]:
    """Return the best of all centres at which two pairs of points lie equally far out, or in."""
    first, second = np.triu_indices(len(upper), 1)
    difference = np.concatenate([(direction[:, first] - direction[:, second]).T] * 2)
    value = np.concatenate([upper[first] - upper[second], lower[first] - lower[second]])
    one, other = np.triu_indices(len(value), 1)
    determinant = difference[one, 0] * difference[other, 1] - difference[one, 1] * difference[other, 0]
    sound = np.abs(determinant) > _EXACT
    one, other, determinant = one[sound], other[sound], determinant[sound]
    centres = np.stack(
        [
            (value[one] * difference[other, 1] - value[other] * difference[one, 1]) / determinant,
            (difference[one, 0] * value[other] - difference[other, 0] * value[one]) / determinant,
        ],
        axis=1,
    )
    moved = centres @ direction
    widths = (upper - moved).max(axis=1) - (lower - moved).min(axis=1)
    best = int(widths.argmin())
    return centres[best], float(widths[best])
