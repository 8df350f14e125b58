"""Circular graphs: values over the angle, magnified on a nominal circle, with circles and rays for a grid.

A deviation is drawn outwards from the nominal circle, magnified: the circles of the grid tell how far.
Angles are in degrees, from the right, anticlockwise. So whatever can draw lines can draw such a panel.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.document.figures.canvas import Fill
from zlmreport.document.figures.figure import Curve, Panel
from zlmreport.document.figures.metrics import make_plain_label
from zlmreport.document.figures.scale import AxisScale, find_extremes, include_zero, round_ticks, widen
from zlmreport.document.figures.shapes import (
    EXTENSION,
    GRID,
    INK,
    MARK_SIZES,
    RIM,
    ROLES,
    TICK_TEXT_SIZE,
    ZERO,
    Box,
    Frame,
    Lettering,
    Outline,
    PlacedLabel,
    PointMarks,
    PointShape,
    Shape,
    join_lines,
)
from zlmreport.language.formatting import DecimalSign, write_fixed_number
from zlmreport.measurement.arrays import FloatArray

#: The innermost circle of the grid, in parts of the outermost.
_INNERMOST = 0.35
#: How far beyond the outermost circle the frame reaches, so that the angles have room, and how far to either
#: side of the frame they reach, points.
_ROOM = 11.0
BESIDE_CIRCLE = 24.0
#: Between the outermost circle and an angle at its side.
_ANGLE_GAP = 4.0
_MOST_CIRCLES = 6
_DIRECTIONS = tuple(range(0, 360, 45))
_AROUND = np.linspace(0.0, 2 * math.pi, 181)
#: The ray along which the circles are told, in degrees: between two rays of the grid.
_TOLD_AT = 67.5
#: Where on a curve an arrow tells its sense, in parts of its points, and the arrow's size in points.
_SENSE_AT = 0.06
_HEAD = 7.0
_START = 2.4


@dataclass(frozen=True, slots=True)
class PolarGrid:
    """The circles of a polar panel, and how a value becomes a distance from the middle."""

    ticks: tuple[float, ...]  #: Values of the circles, rising.
    labels: tuple[str, ...]  #: What is written at them.
    base: float  #: The value at the middle.

    @property
    def division(self) -> float:
        """From circle to circle."""
        return self.ticks[1] - self.ticks[0] if len(self.ticks) > 1 else 0.0

    def compute_radius(self, value: FloatArray | float) -> FloatArray:
        """Return the distance from the middle, in the unit of the values."""
        return np.asarray(value) - self.base

    def place_around(self, angle: FloatArray, value: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return where values over angles, °, are drawn."""
        radians = np.radians(angle)
        radius = self.compute_radius(value)
        return radius * np.cos(radians), radius * np.sin(radians)

    def scale(self, side: float) -> AxisScale:
        """Return either axis of the square of a side, in points, in which the panel is drawn."""
        reach = (self.ticks[-1] - self.base) * side / max(side - 2 * _ROOM, side / 2)
        return AxisScale(-reach, reach, (), ())


def make_polar_grid(panel: Panel, sign: DecimalSign) -> PolarGrid:
    """Return the grid of a panel: round values about all that it shows, the nominal circle among them."""
    values = [curve.y for curve in panel.curves] + [readings.y for readings in panel.readings]
    values += [limit for band in panel.bands for limit in (band.lower, band.upper)]
    values.append(np.array([level.y for level in panel.levels] + [0.0]))
    lower, upper = include_zero(*widen(*find_extremes(np.concatenate(values)), 0.05))
    inner, decimals = round_ticks(lower, upper, _MOST_CIRCLES)
    step = inner[1] - inner[0] if len(inner) > 1 else upper - lower
    ticks = list(inner)
    if ticks[0] > lower:
        ticks.insert(0, ticks[0] - step)
    if ticks[-1] < upper:
        ticks.append(ticks[-1] + step)
    base = ticks[0] - _INNERMOST / (1 - _INNERMOST) * (ticks[-1] - ticks[0])
    labels = tuple(write_fixed_number(value, decimals, sign) for value in ticks)
    return PolarGrid(tuple(ticks), labels, base)


def place_on_circle(panel: Panel, grid: PolarGrid) -> Panel:
    """Return the panel with everything where it is drawn; what has no place on a circle is left out."""

    def placed(curve: Curve) -> Curve:
        x, y = grid.place_around(curve.x, curve.y)
        return replace(curve, x=x, y=y)

    curves = [placed(curve) for curve in panel.curves]
    for band in panel.bands:
        for limit in (band.lower, band.upper):
            x, y = grid.place_around(band.x, limit)
            curves.append(Curve(band.notation, band.role, x, y))
    readings = []
    for each in panel.readings:
        x, y = grid.place_around(each.x, each.y)
        readings.append(replace(each, x=x, y=y))
    return replace(
        panel, curves=tuple(curves), readings=tuple(readings), bands=(), arrows=(), brackets=(), levels=()
    )


def find_largest_square(box: Box) -> Box:
    """Return the largest square in a box, in its middle."""
    side = min(box.width, box.height)
    left, bottom = (box.left + box.right - side) / 2, (box.bottom + box.top - side) / 2
    return Box(left, bottom, left + side, bottom + side)


def draw_polar_grid(panel: Panel, grid: PolarGrid, frame: Frame) -> Iterator[Shape]:
    """Yield the circles and rays behind the curves; the nominal circle is drawn as zero is elsewhere."""
    outermost = float(grid.compute_radius(grid.ticks[-1]))
    for value in grid.ticks:
        yield _draw_circle("zero" if value == 0 else "grid", grid, value, frame)
    rays = []
    for direction in map(math.radians, _DIRECTIONS):
        inner = float(grid.compute_radius(grid.ticks[0]))
        ends = np.outer([inner, outermost], [math.cos(direction), math.sin(direction)])
        rays.append([tuple(point) for point in frame.place_points(ends[:, 0], ends[:, 1]).tolist()])
    yield join_lines("grid", rays, GRID)
    for level in panel.levels:
        if math.isfinite(level.y):
            outline = _draw_circle("level", grid, level.y, frame)
            yield replace(outline, stroke=ROLES[level.role].stroke)


def draw_direction_marks(panel: Panel, grid: PolarGrid, frame: Frame) -> Iterator[Shape]:
    """Yield a point on the nominal circle at each direction that has a name."""
    if panel.directions:
        angles = np.array([angle for angle, _ in panel.directions])
        points = np.column_stack(grid.place_around(angles, np.zeros_like(angles)))
        yield PointMarks(
            "direction", points, PointShape.DISC, MARK_SIZES[PointShape.DISC], RIM, Fill(INK), frame
        )


def _draw_circle(kind: str, grid: PolarGrid, value: float, frame: Frame) -> Outline:
    radius = float(grid.compute_radius(value))
    points = frame.place_points(radius * np.cos(_AROUND), radius * np.sin(_AROUND))
    return Outline(kind, (points,), ZERO if kind == "zero" else GRID)


def place_grid_labels(panel: Panel, grid: PolarGrid, frame: Frame) -> Iterator[Lettering]:
    """Yield what is written at the circles and at the ends of the rays."""
    names = dict(panel.directions)
    told_at = math.radians(_TOLD_AT)
    for value, text in zip(grid.ticks, grid.labels, strict=True):
        radius = float(grid.compute_radius(value))
        x, y = frame.place_x(radius * math.cos(told_at)), frame.place_y(radius * math.sin(told_at))
        label = make_plain_label(text, TICK_TEXT_SIZE)
        yield Lettering("circle", PlacedLabel(label, x - label.width / 2, y - label.rise), INK)
    outermost = float(grid.compute_radius(grid.ticks[-1]))
    for degrees in _DIRECTIONS:
        across, up = (round(part(math.radians(degrees)), 9) for part in (math.cos, math.sin))
        label = make_plain_label(f"{names.get(degrees, '')} {degrees}°".lstrip(), TICK_TEXT_SIZE)
        x = frame.place_x(outermost * across) + _ANGLE_GAP * across
        y = frame.place_y(outermost * up) + _ROOM / 2 * up
        # Right of the circle it begins there, left of it it ends; above and below it has its middle there.
        shift = 0.0 if across > 0 else label.width * (1.0 if across < 0 else 0.5)
        yield Lettering("ray", PlacedLabel(label, x - shift, y - label.rise), INK)


def draw_senses(panel: Panel, frame: Frame) -> Iterator[Shape]:
    """Yield where each curve begins, and an arrow behind that in which it goes on.

    `panel`: As it is drawn (`place_on_circle`).
    """
    for curve in panel.curves:
        style = ROLES[curve.role]
        points = frame.place_points(curve.x, curve.y)
        if len(points) < 3 or not curve.notation:
            continue
        at = max(1, int(_SENSE_AT * len(points)))
        start, before, tip = points[0], points[at - 1], points[at]
        length = float(np.hypot(*(tip - before)))
        if length == 0:
            continue
        along = (tip - before) / length
        across = np.array([-along[1], along[0]])
        base = tip - _HEAD * along
        corners = [tip, base + 0.45 * _HEAD * across, base - 0.45 * _HEAD * across, tip]
        fill = Fill(style.stroke.colour)
        yield Outline("sense", (np.array(corners),), None, fill, is_closed=True)
        radial = start - np.array([frame.place_x(0.0), frame.place_y(0.0)])
        radial = radial / (float(np.hypot(*radial)) or 1.0)
        ends = [tuple(start - 2 * _START * radial), tuple(start + 2 * _START * radial)]
        yield join_lines("start", [ends], EXTENSION)
