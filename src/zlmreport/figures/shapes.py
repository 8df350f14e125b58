"""What a drawn figure is made of: outlines, marks and labels, each where it stands on the drawing.

A sketch is a series of them, from back to front; `zlmreport.figures.draw` and `zlmreport.figures.pen` put it
on a canvas. Places are points from the lower left corner of the drawing, y upwards.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from zlmreport.figures.canvas import Colour, Fill, Stroke
from zlmreport.figures.frame import Frame, PlacedLabel
from zlmreport.figures.style import Mark
from zlmreport.quantities.arrays import FloatArray


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
