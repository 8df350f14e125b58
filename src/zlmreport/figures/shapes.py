"""What a drawn figure is made of: outlines, marks and labels, each where it stands on the drawing.

A sketch is a series of them, from back to front; `zlmreport.figures.draw` puts it on a canvas. Places are
points from the lower left corner of the drawing, y upwards.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from zlmreport.figures.canvas import Colour, Fill, Label, Stroke
from zlmreport.figures.scale import Scale
from zlmreport.figures.style import Mark
from zlmreport.quantities.arrays import FloatArray


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

    def overlaps(self, other: Box) -> bool:
        """Return whether the two share more than an edge."""
        return (
            self.left < other.right
            and other.left < self.right
            and self.bottom < other.top
            and other.bottom < self.top
        )

    def contains(self, other: Box) -> bool:
        """Return whether the other lies inside."""
        return (
            self.left <= other.left
            and other.right <= self.right
            and self.bottom <= other.bottom
            and other.top <= self.top
        )


def counts(boxes: Sequence[Box], points: FloatArray) -> list[int]:
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
    x_scale: Scale
    y_scale: Scale

    @property
    def x_factor(self) -> float:
        """Points for each unit of the position."""
        return self.box.width / (self.x_scale.upper - self.x_scale.lower)

    @property
    def y_factor(self) -> float:
        """Points for each unit of the value."""
        return self.box.height / (self.y_scale.upper - self.y_scale.lower)

    def x_point(self, x: float) -> float:
        """Return where a position is drawn."""
        return self.box.left + (x - self.x_scale.lower) * self.x_factor

    def y_point(self, y: float) -> float:
        """Return where a value is drawn."""
        return self.box.bottom + (y - self.y_scale.lower) * self.y_factor

    def points(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return where values are drawn, shape (N, 2); those that are not finite are left out."""
        points = np.column_stack(
            [
                self.box.left + (x - self.x_scale.lower) * self.x_factor,
                self.box.bottom + (y - self.y_scale.lower) * self.y_factor,
            ]
        )
        return points[np.isfinite(points).all(axis=1)]

    def values(self, points: FloatArray) -> FloatArray:
        """Return the position and value that are drawn at each of some points, shape (N, 2)."""
        box, x_scale, y_scale = self.box, self.x_scale, self.y_scale
        lower, factors = (x_scale.lower, y_scale.lower), (self.x_factor, self.y_factor)
        return np.asarray((points - (box.left, box.bottom)) / factors + lower)


@dataclass(frozen=True, slots=True)
class Outline:
    """Lines, or the edges of areas: filled, stroked or both.

    Attributes
    ----------
    kind
        What is drawn, as a canvas is told.
    parts
        Each of shape (N, 2); points that are not finite leave gaps.
    stroke, fill
        How it looks.
    is_closed
        Whether each part ends where it begins, and is joined there.
    frame
        Whose values the coordinates are; None where they are places on the drawing.
    """

    kind: str
    parts: tuple[FloatArray, ...]
    stroke: Stroke | None
    fill: Fill | None = None
    is_closed: bool = False
    frame: Frame | None = None


@dataclass(frozen=True, slots=True)
class Marks:
    """A mark at each of some points, shape (N, 2); of a filled mark the stroke is the rim.

    `size` is its width in points, `frame` as in an outline.
    """

    kind: str
    points: FloatArray
    mark: Mark
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


Shape: TypeAlias = Outline | Marks | Lettering


def lines(kind: str, parts: Sequence[Sequence[tuple[float, float]]], stroke: Stroke) -> Outline:
    """Return several lines on the drawing as one outline."""
    return Outline(kind, tuple(np.array(part, dtype=np.float64) for part in parts), stroke)


def area(
    kind: str, corners: Sequence[tuple[float, float]], stroke: Stroke | None, fill: Fill | None
) -> Outline:
    """Return an area on the drawing; its last corner is its first again."""
    return Outline(kind, (np.array(corners, dtype=np.float64),), stroke, fill, is_closed=True)
