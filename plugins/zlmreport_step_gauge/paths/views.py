"""The path of a probe over a step gauge in three views, as data: what is drawn where, in mm of each view.

The first two look at the gauge from its right side, where the path round the side goes. One is axonometric;
the other looks at right angles, so that no block hides a measuring move: from the side at a path over the
top, from above at a path round the side. The third shows where the gauge lies in the machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np

from zlmreport.plugin import MILLIMETRE, FloatArray, Words, read_only_floats, same_in_all_languages
from zlmreport_step_gauge.gauge import Side
from zlmreport_step_gauge.paths.path import PathKind, Point, Probing
from zlmreport_step_gauge.paths.plan import PlannedPath

_SAFE = Words("safe position")
#: Azimuth and elevation of the axonometric views.
_AT_GAUGE = (math.radians(14), math.radians(32))
_AT_MACHINE = (math.radians(25), math.radians(24))
#: Length of the arrows that show the machine's axes, as a part of the largest extent.
_AXIS_LENGTH = 0.12
#: A box's sides by the numbers of their corners, and the axes of its edges.
_SIDES = ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5))
_EDGES = tuple((low, low | bit) for low in range(8) for bit in (1, 2, 4) if not low & bit)
#: How far below the top of the base the numbers of faces stand in a view from the side, and how far beside
#: the blocks in a view from above, mm.
_NUMBERS_AWAY = 3.5
#: Decimals of a depth in m that tell one side from another.
_DEPTH_DIGITS = 9


@dataclass(frozen=True, slots=True)
class Touch:
    """A measuring move: to where the tip's centre is when the tip touches; (2,) arrays and radius in mm."""

    side: Side
    start: FloatArray
    end: FloatArray
    radius: float


@dataclass(frozen=True, slots=True)
class PlacedText:
    """A text at a place, (2,) mm; `side` is that of the face whose number it is, None for anything else."""

    text: Words
    at: FloatArray
    side: Side | None = None


@dataclass(frozen=True, slots=True)
class View:
    """One view of a path; coordinates are mm, to the right and upwards."""

    heading: Words  #: From where one looks.
    #: base and blocks: (s, 4, 2): The sides that are seen, from back to front; the blocks stand on the base.
    base: FloatArray
    blocks: FloatArray
    edges: FloatArray  #: (e, 2, 2): Of the working volume.
    way: FloatArray  #: (n, 2): Where the moves end.
    touches: tuple[Touch, ...]  #: The measuring moves.
    arrows: FloatArray  #: (k, 2, 2): The machine's axes.
    notes: tuple[PlacedText, ...]  #: Numbers of faces, names of axes.


@dataclass(frozen=True, slots=True)
class _Eye:
    """Where one looks from: rows to the right, upwards and away from the eye, in machine coordinates."""

    rows: FloatArray

    def see(self, points: FloatArray) -> FloatArray:
        """Return points, (..., 3) m, as they are seen, (..., 2) mm."""
        seen: FloatArray = MILLIMETRE.from_si(points @ self.rows[:2].T)
        return seen

    def measure_depth(self, points: FloatArray) -> FloatArray:
        """Return how far away points are, m."""
        depth: FloatArray = points @ self.rows[2]
        return depth


def make_path_views(planned: PlannedPath) -> tuple[View, ...]:
    """Return the views of the first cycle of a path."""
    along, across, upward = planned.frame.axes
    from_right = np.array([along, upward, -across])
    right_angled = (
        (Words("From the side"), _Eye(from_right))
        if planned.settings.kind is PathKind.VERTICAL
        else (Words("From above"), _Eye(np.array([along, -across, -upward])))
    )
    return (
        _view_at_gauge(planned, Words("Axonometric view"), _Eye(_turn_view(*_AT_GAUGE) @ from_right)),
        _view_at_gauge(planned, *right_angled),
        _view_in_machine(planned),
    )


def _turn_view(azimuth: float, elevation: float) -> FloatArray:
    """Return the rows of an axonometric view, from those of a view from the side."""
    cosine, sine = math.cos(azimuth), math.sin(azimuth)
    level = np.array([[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]])
    cosine, sine = math.cos(elevation), math.sin(elevation)
    tilted: FloatArray = np.array([[1.0, 0.0, 0.0], [0.0, cosine, sine], [0.0, -sine, cosine]]) @ level
    return tilted


def _view_at_gauge(planned: PlannedPath, heading: Words, eye: _Eye) -> View:
    moves = planned.path.first_cycle
    points = np.array([stop for move, stop in moves if move.face])
    return View(
        heading=heading,
        base=_order_sides(planned, eye, slice(-1, None)),
        blocks=_order_sides(planned, eye, slice(-1)),
        edges=np.empty((0, 2, 2)),
        way=read_only_floats(eye.see(points)),
        touches=tuple(_draw_touches(planned, eye)),
        arrows=np.empty((0, 2, 2)),
        notes=tuple(_place_numbers(planned, eye)),
    )


def _view_in_machine(planned: PlannedPath) -> View:
    eye = _Eye(_turn_view(*_AT_MACHINE) @ np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]))
    way = np.array([stop for _, stop in planned.path.first_cycle])
    volume = planned.settings.working_volume
    corners = eye.see(np.array(list(product(*volume)))) if volume else np.empty((0, 2))
    edges = [corners[list(edge)] for edge in _EDGES if volume]
    base, blocks = _order_sides(planned, eye, slice(-1, None)), _order_sides(planned, eye, slice(-1))
    drawn = np.concatenate([each.reshape(-1, 2) for each in (eye.see(way), corners, base, blocks)])
    length = _AXIS_LENGTH * float(np.ptp(drawn, axis=0).max())
    # in the corner of the volume from which its axes count, or else beside everything
    origin = corners[0] if volume else drawn.min(axis=0) - [1.8 * length, 0.0]
    tips = origin + length * eye.see(np.eye(3)) / MILLIMETRE.from_si(1.0)
    notes = [
        PlacedText(same_in_all_languages(name), origin + 1.3 * (tip - origin))
        for name, tip in zip("XYZ", tips, strict=True)
    ]
    if planned.settings.safe_position is not None:
        notes.append(PlacedText(_SAFE, eye.see(way[0])))
    return View(
        heading=Words("In the coordinates of the machine"),
        base=base,
        blocks=blocks,
        edges=read_only_floats(np.reshape(edges, (-1, 2, 2))),
        way=read_only_floats(eye.see(way)),
        touches=(),
        arrows=read_only_floats([[origin, tip] for tip in tips]),
        notes=tuple(notes),
    )


def _order_sides(planned: PlannedPath, eye: _Eye, which: slice) -> FloatArray:
    """Return the sides of some boxes that look at the eye, from back to front, equals as they come.

    Depths that differ by rounding alone are the same: in what order they were summed up changes with the
    machine, and with it would the bytes of the picture.
    """
    boxes = planned.obstacles
    found = []
    for low, high in zip(boxes.lower[which], boxes.upper[which], strict=True):
        corners = np.array([_move_into(planned, corner) for corner in product(*zip(low, high, strict=True))])
        middle = corners.mean(axis=0)
        for numbers in _SIDES:
            side = corners[list(numbers)]
            if eye.measure_depth(side.mean(axis=0)) < eye.measure_depth(middle) - 1e-9:
                found.append((round(float(eye.measure_depth(middle)), _DEPTH_DIGITS), eye.see(side)))
    found.sort(key=lambda each: -each[0])
    return read_only_floats([side for _, side in found])


def _draw_touches(planned: PlannedPath, eye: _Eye) -> Iterator[Touch]:
    path = planned.path
    for probing in _list_probings(planned):
        ends = [probing.away(path.approach + path.tip_radius), probing.away(path.tip_radius)]
        start, end = eye.see(np.array(ends))
        yield Touch(_find_side(probing), start, end, MILLIMETRE.from_si(path.tip_radius))


def _place_numbers(planned: PlannedPath, eye: _Eye) -> Iterator[PlacedText]:
    """Yield the numbers of faces: on the right side of the base, or from above beside the blocks."""
    boxes = planned.obstacles
    away = MILLIMETRE.to_si(_NUMBERS_AWAY)
    from_above = abs(float(eye.rows[1] @ planned.frame.axes[2])) < 0.1
    across, upward = boxes.upper[0, 1], boxes.lower[0, 2] - away
    if from_above:
        across, upward = boxes.lower[0, 1] - away, boxes.upper[0, 2]
    for probing in _list_probings(planned):
        along = planned.frame.to_gauge(probing.target)[0]
        at = eye.see(np.array(_move_into(planned, (along, across, upward))))
        yield PlacedText(same_in_all_languages(str(probing.face)), at, _find_side(probing))


def _list_probings(planned: PlannedPath) -> Iterator[Probing]:
    return (move for move, _ in planned.path.first_cycle if isinstance(move, Probing))


def _find_side(probing: Probing) -> Side:
    return Side.FRONT if probing.face % 2 else Side.BACK


def _move_into(planned: PlannedPath, corner: tuple[float, ...]) -> Point:
    """Return a point of the gauge in the coordinates of the machine."""
    return planned.frame.to_machine(*corner)
