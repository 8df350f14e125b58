"""Colours, line widths, dashes, marks and sizes of type of graphs; and the shapes that a figure consists of.

A sketch is a series of them, from back to front; `zlmreport.document.figures.draw` puts it on a canvas.
Places are points from the lower left corner of the drawing, y upwards.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import TypeAlias

import numpy as np

from zlmreport.document.figures.canvas import Colour, Fill, Label, Stroke
from zlmreport.document.figures.figure import Role
from zlmreport.document.figures.scale import AxisScale
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray

_BLACK = (0.0, 0.0, 0.0)
_BLUE = (0.0, 0.39, 0.65)
_VERMILION = (0.8, 0.33, 0.0)
_GREEN = (0.0, 0.45, 0.335)
_VIOLET = (0.45, 0.22, 0.62)
_GREY = (0.4, 0.4, 0.4)

#: Colour of axes and letters.
INK: Colour = (0.1, 0.1, 0.1)
WHITE: Colour = (1.0, 1.0, 1.0)
#: Of a triangle of height 1 with three equal sides.
TRIANGLE_HALF_WIDTH = 0.5 / math.cos(math.pi / 6)
#: Parts a mark from the line that it sits on.
RIM = Stroke(WHITE, 0.5)

#: A bar: its outline and its inside.
BAR = (Stroke(_BLUE, 0.8), Fill(_BLUE, 0.2))

FRAME = Stroke(INK, 0.6)
TICK = Stroke(INK, 0.5)
GRID = Stroke((0.9, 0.9, 0.9), 0.4)
ZERO = Stroke((0.45, 0.45, 0.45), 0.6)
EXTENSION = Stroke((0.35, 0.35, 0.35), 0.35)
DIMENSION = Stroke(INK, 0.55)

#: Size of the letters of a graph, points.
TEXT_SIZE = 8.0
TICK_TEXT_SIZE = 7.5
READING_SIZE = 3.0
#: Behind labels among lines.
GROUND = Fill(WHITE, 0.8)


class PointShape(Enum):
    """The shape of a point."""

    UP = "triangle, up"
    DOWN = "triangle, down"
    DISC = "disc"


@dataclass(frozen=True, slots=True)
class RoleStyle:
    """The look of a curve or a band."""

    stroke: Stroke  #: Of the curve, or of both limits of a band.
    mark: PointShape | None  #: At each target; None for a bare line.
    tint: Fill  #: Of a band's inside.


def _style(
    colour: Colour, width: float, dashes: tuple[float, ...], mark: PointShape | None, tint: float
) -> RoleStyle:
    return RoleStyle(Stroke(colour, width, dashes), mark, Fill(colour, tint))


#: How a curve of each role is drawn.
ROLES = {
    Role.MEAN_POSITIVE: _style(_BLUE, 1.1, (), PointShape.UP, 0.11),
    Role.MEAN_NEGATIVE: _style(_VERMILION, 1.1, (5.0, 1.6), PointShape.DOWN, 0.11),
    Role.MEAN_BIDIRECTIONAL: _style(_BLACK, 1.1, (8.0, 1.6, 1.6, 1.6), PointShape.DISC, 0.11),
    Role.LIMIT_POSITIVE: _style(_BLUE, 0.7, (2.6, 1.4), None, 0.12),
    Role.LIMIT_NEGATIVE: _style(_VERMILION, 0.7, (0.9, 1.3), None, 0.12),
    Role.SPREAD: _style(_GREEN, 0.7, (), None, 0.12),
    Role.REVERSAL: _style(_VIOLET, 0.7, (4.0, 1.3, 0.9, 1.3), None, 0.14),
    Role.BAND_LIMIT: _style(_BLACK, 0.8, (9.0, 2.4), None, 0.06),
    Role.TOLERANCE: _style(_BLACK, 0.9, (9.0, 1.6, 1.4, 1.6, 1.4, 1.6), None, 0.06),
    Role.MODEL_POSITIVE: _style(_BLUE, 1.1, (14.0, 1.2), None, 0.11),
    Role.MODEL_NEGATIVE: _style(_VERMILION, 1.1, (4.4, 1.5), None, 0.11),
    Role.UNCERTAINTY_POSITIVE: _style(_BLUE, 0.6, (1.8, 1.0), None, 0.14),
    Role.UNCERTAINTY_NEGATIVE: _style(_VERMILION, 0.6, (0.7, 0.9), None, 0.14),
    Role.NOISE: _style(_BLACK, 0.7, (3.2, 1.8), None, 0.07),
    Role.PATH: _style(_GREY, 0.5, (24.0, 0.8), None, 0.06),
    Role.CHANNEL_1: _style(_BLUE, 1.0, (40.0, 0.6), None, 0.06),
    Role.CHANNEL_2: _style(_VERMILION, 1.0, (6.0, 1.8), None, 0.06),
    Role.CHANNEL_3: _style(_BLACK, 1.0, (1.2, 1.2), None, 0.06),
    Role.CHANNEL_4: _style(_GREEN, 1.0, (10.0, 1.6, 1.2, 1.6), None, 0.06),
    Role.CHANNEL_5: _style(_VIOLET, 1.0, (3.0, 1.2), None, 0.06),
    Role.CHANNEL_6: _style(_GREY, 1.0, (12.0, 1.6, 1.2, 1.4, 1.2, 1.6), None, 0.06),
}
MARK_SIZES = {PointShape.UP: 4.6, PointShape.DOWN: 4.6, PointShape.DISC: 3.8}

READINGS = {
    Approach.POSITIVE: (PointShape.UP, Stroke((0.35, 0.6, 0.76), 0.45)),
    Approach.NEGATIVE: (PointShape.DOWN, Stroke((0.88, 0.56, 0.34), 0.45)),
}


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle."""

    left: float
    bottom: float
    right: float
    top: float

    @property
    def width(self) -> float:
        """From left to right."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """From bottom to top."""
        return self.top - self.bottom

    @property
    def corners(self) -> tuple[tuple[float, float], ...]:
        """All four, and the first again."""
        left, bottom, right, top = self.left, self.bottom, self.right, self.top
        return (left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)

    def is_overlapping(self, other: Box) -> bool:
        """Return whether the two share more than an edge."""
        return (
            self.left < other.right
            and other.left < self.right
            and self.bottom < other.top
            and other.bottom < self.top
        )

    def has_inside(self, other: Box) -> bool:
        """Return whether the other lies inside."""
        return (
            self.left <= other.left
            and other.right <= self.right
            and self.bottom <= other.bottom
            and other.top <= self.top
        )


def count_points(boxes: Sequence[Box], points: FloatArray) -> list[int]:
    """Return how many points, shape (N, 2), lie inside each of some boxes."""
    edges = np.array([(box.left, box.bottom, box.right, box.top) for box in boxes])
    left, bottom, right, top = edges.T[:, :, np.newaxis]
    x, y = points.T
    inside = (x > left) & (x < right) & (y > bottom) & (y < top)
    numbers: list[int] = np.count_nonzero(inside, axis=1).tolist()
    return numbers


@dataclass(frozen=True, slots=True)
class PlacedLabel:
    """A label, where its baseline begins, and its direction: degrees, anticlockwise."""

    label: Label
    x: float
    y: float
    angle: float = 0.0

    @property
    def box(self) -> Box:
        """The room of a label that is not turned, with the distance that others keep from it."""
        middle, half = self.y + self.label.rise, self.label.height / 2
        return Box(self.x - _CLEARANCE, middle - half, self.x + self.label.width + _CLEARANCE, middle + half)


_CLEARANCE = 2.0


@dataclass(frozen=True, slots=True)
class Frame:
    """The area of a panel in which values are drawn, and the two scales along its edges."""

    box: Box
    x_scale: AxisScale
    y_scale: AxisScale

    @property
    def x_factor(self) -> float:
        """Points for each unit of the position."""
        return self.box.width / (self.x_scale.upper - self.x_scale.lower)

    @property
    def y_factor(self) -> float:
        """Points for each unit of the value."""
        return self.box.height / (self.y_scale.upper - self.y_scale.lower)

    def place_x(self, x: float) -> float:
        """Return where a position is drawn."""
        return self.box.left + (x - self.x_scale.lower) * self.x_factor

    def place_y(self, y: float) -> float:
        """Return where a value is drawn."""
        return self.box.bottom + (y - self.y_scale.lower) * self.y_factor

    def place_points(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return where values are drawn, shape (N, 2); those that are not finite are left out."""
        points = np.column_stack(
            [
                self.box.left + (x - self.x_scale.lower) * self.x_factor,
                self.box.bottom + (y - self.y_scale.lower) * self.y_factor,
            ]
        )
        return points[np.isfinite(points).all(axis=1)]

    def find_values(self, points: FloatArray) -> FloatArray:
        """Return the position and value that are drawn at each of some points, shape (N, 2)."""
        box, x_scale, y_scale = self.box, self.x_scale, self.y_scale
        lower, factors = (x_scale.lower, y_scale.lower), (self.x_factor, self.y_factor)
        return np.asarray((points - (box.left, box.bottom)) / factors + lower)


@dataclass(frozen=True, slots=True)
class Outline:
    """Lines, or the edges of areas: filled, stroked or both."""

    kind: str  #: What is drawn, as a canvas is told.
    parts: tuple[FloatArray, ...]  #: Each of shape (N, 2); points that are not finite leave gaps.
    #: stroke and fill: How it looks.
    stroke: Stroke | None
    fill: Fill | None = None
    is_closed: bool = False  #: Whether each part ends where it begins, and is joined there.
    #: Whose values the coordinates are; None where they are places on the drawing.
    frame: Frame | None = None


@dataclass(frozen=True, slots=True)
class PointMarks:
    """A mark at each of some points, shape (N, 2); of a filled mark the stroke is the rim.

    `size` is its width in points, `frame` as in an outline.
    """

    kind: str
    points: FloatArray
    mark: PointShape
    size: float
    stroke: Stroke | None
    fill: Fill | None = None
    frame: Frame | None = None


@dataclass(frozen=True, slots=True)
class Lettering:
    """A label at its place."""

    kind: str
    placed: PlacedLabel
    colour: Colour


Shape: TypeAlias = Outline | PointMarks | Lettering


def join_lines(kind: str, parts: Sequence[Sequence[tuple[float, float]]], stroke: Stroke) -> Outline:
    """Return several lines on the drawing as one outline."""
    return Outline(kind, tuple(np.array(part, dtype=np.float64) for part in parts), stroke)


def outline_area(
    kind: str, corners: Sequence[tuple[float, float]], stroke: Stroke | None, fill: Fill | None
) -> Outline:
    """Return an area on the drawing; its last corner is its first again."""
    return Outline(kind, (np.array(corners, dtype=np.float64),), stroke, fill, is_closed=True)
