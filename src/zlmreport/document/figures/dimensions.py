"""Where dimension lines (brackets and arrows) and their labels stand, in the margin and at a target.

All places are points from the lower left corner of the drawing, y upwards.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from zlmreport.document.figures.canvas import Label
from zlmreport.document.figures.shapes import Box, PlacedLabel, count_points
from zlmreport.measurement.arrays import FloatArray

#: Length of an arrow head, and half its width.
HEAD = 4.5
HEAD_HALF_WIDTH = 1.15
#: How far a dimension line goes on beyond its ends, where the heads point inwards from outside.
TAIL = 9.0
#: Between an extension line and the point where it begins.
GAP = 3.0
#: How far an extension line goes beyond the dimension line.
OVERSHOOT = 1.6

_LABEL_GAP = 2.6
_COLUMN_GAP = 7.0
#: Between a label and an extension line that passes it.
_PASSING_GAP = 0.8
#: Distances from its target at which an arrow is tried.
_OFFSETS = (8.0, 13.0, 18.0, 24.0, 31.0, 40.0, 52.0, 66.0)

# What is given up, and how gladly: points of distance from the target weigh least; a label on another
# label is never chosen while there is any other place.
_COST_OF_DISTANCE = 0.25
_COST_OFF_MIDDLE = 2.0
_COST_OF_LINE = 1.5
_COST_OF_MARK = 6.0
_COST_OF_LEAVING = 300.0
_COST_OF_OVERLAP = 1000.0


@dataclass(frozen=True, slots=True)
class DimensionSpan:
    """What a dimension measures, in points."""

    label: Label  #: Its symbol.
    #: low and high: Its ends.
    low: float
    high: float
    #: low_from and high_from: Where, along the axis, the values of its ends arise.
    low_from: float
    high_from: float

    @property
    def length(self) -> float:
        """From end to end."""
        return self.high - self.low

    @property
    def middle(self) -> float:
        """Between the ends."""
        return (self.low + self.high) / 2

    @property
    def tail(self) -> float:
        """How far the dimension line goes on beyond its ends.

        Where two heads have no room between the ends, they point at them from outside.
        """
        return TAIL if self.length < 2.2 * HEAD else 0.0


@dataclass(frozen=True, slots=True)
class DrawnDimension:
    """A span, where its dimension line stands, and its label.

    `is_among_lines` tells whether the label stands on lines, which must then fade behind it.
    """

    span: DimensionSpan
    x: float
    label: PlacedLabel
    is_among_lines: bool = False

    @property
    def boxes(self) -> tuple[Box, Box]:
        """The room of the dimension line with its heads, and that of the label."""
        half, tail = 2 * HEAD_HALF_WIDTH, self.span.tail
        line = Box(self.x - half, self.span.low - tail, self.x + half, self.span.high + tail)
        return line, self.label.box


def _place_dimension(span: DimensionSpan, x: float, side: float, height: float) -> DrawnDimension:
    """Return the dimension with its label on a side of it (−1: left), its middle at a height."""
    label_x = x + _LABEL_GAP if side > 0 else x - _LABEL_GAP - span.label.width
    return DrawnDimension(span, x, PlacedLabel(span.label, label_x, height - span.label.rise))


def measure_margin(labels: Iterable[Label]) -> float:
    """Return the width of the columns of `place_margin_columns`."""
    widths = [label.width for label in labels]
    return sum(widths) + len(widths) * _LABEL_GAP + max(0, len(widths) - 1) * _COLUMN_GAP


def place_margin_columns(
    spans: Sequence[DimensionSpan], start: float, floor: float, ceiling: float
) -> tuple[DrawnDimension, ...]:
    """Return the dimensions in successive columns to the right of `start`, the shortest first.

    So no dimension line is crossed by the extension line of a shorter one inside it; labels give way to
    the extension lines that pass on to the columns further out.
    """
    ordered = sorted(spans, key=lambda span: span.length)
    placed: list[DrawnDimension] = []
    x = start
    for number, span in enumerate(ordered):
        passing = [end for other in ordered[number + 1 :] for end in (other.low, other.high)]
        placed.append(_place_dimension(span, x, 1.0, _find_free_height(span, passing, floor, ceiling)))
        x += _LABEL_GAP + span.label.width + _COLUMN_GAP
    return tuple(placed)


def _find_free_height(span: DimensionSpan, passing: Sequence[float], floor: float, ceiling: float) -> float:
    """Return the height nearest to the middle of the span at which nothing passes its label."""
    half = span.label.height / 2 + _PASSING_GAP
    beside = [end + side * half for end in passing for side in (-1.0, 1.0)]
    free = [
        height
        for height in (span.middle, *beside)
        if floor <= height - half
        and height + half <= ceiling
        and all(abs(height - end) >= half - 1e-6 for end in passing)
    ]
    return min(free, key=lambda height: abs(height - span.middle), default=span.middle)


def place_beside_targets(
    spans: Sequence[DimensionSpan], region: Box, marks: FloatArray, lines: FloatArray
) -> tuple[DrawnDimension, ...]:
    """Return the dimensions beside their targets, where they cover least and never one another.

    `marks`, `lines`, (N, 2): Points that a dimension should not cover, and points along lines that its label
        should not.
    """
    placed: list[DrawnDimension] = []
    for span in sorted(spans, key=lambda span: -span.length):
        taken = [box for other in placed for box in other.boxes]
        best = _choose_cheapest(_list_candidates(span), region, taken, marks, lines)
        covered = count_points([best.label.box], marks) + count_points([best.label.box], lines)
        placed.append(replace(best, is_among_lines=any(covered)))
    return tuple(placed)


def _list_candidates(span: DimensionSpan) -> list[DrawnDimension]:
    half = span.label.height / 2
    heights = (
        span.middle,
        span.high - half,
        span.low + half,
        span.high + half + span.tail,
        span.low - half - span.tail,
    )
    return [
        _place_dimension(span, span.low_from + side * offset, side, height)
        for offset, side, height in itertools.product(_OFFSETS, (1.0, -1.0), heights)
    ]


def _choose_cheapest(
    candidates: Sequence[DrawnDimension],
    region: Box,
    taken: Sequence[Box],
    marks: FloatArray,
    lines: FloatArray,
) -> DrawnDimension:
    boxes = [one.boxes for one in candidates]
    line_boxes, label_boxes = zip(*boxes, strict=True)
    covered = zip(
        count_points(label_boxes, lines),
        count_points(label_boxes, marks),
        count_points(line_boxes, marks),
        strict=True,
    )
    costs = [
        _weigh_cost(one, region, taken, on_lines, label_on_marks + line_on_marks)
        for one, (on_lines, label_on_marks, line_on_marks) in zip(candidates, covered, strict=True)
    ]
    return candidates[costs.index(min(costs))]


def _weigh_cost(
    dimension: DrawnDimension, region: Box, taken: Sequence[Box], on_lines: int, on_marks: int
) -> float:
    line, label = dimension.boxes
    is_off_middle = label.bottom + label.top != 2 * dimension.span.middle
    return (
        _COST_OF_DISTANCE * abs(dimension.x - dimension.span.low_from)
        + _COST_OFF_MIDDLE * is_off_middle
        + _COST_OF_LINE * on_lines
        + _COST_OF_MARK * on_marks
        + _COST_OF_LEAVING * sum(not region.has_inside(box) for box in (line, label))
        + _COST_OF_OVERLAP * sum(box.is_overlapping(other) for box in (line, label) for other in taken)
    )


def spread(heights: Sequence[float], distance: float, floor: float, ceiling: float) -> tuple[float, ...]:
    """Return the heights moved apart to at least a distance, each as little as possible, in their order.

    >>> spread([10.0, 12.0, 40.0], 8.0, 0.0, 100.0)
    (7.0, 15.0, 40.0)
    """
    order = sorted(range(len(heights)), key=lambda index: heights[index])
    # Neighbours that are too close become one group about their common mean, until none are.
    groups: list[tuple[float, int]] = []
    for index in order:
        middle, size = heights[index], 1
        while groups and middle - groups[-1][0] < distance * (size + groups[-1][1]) / 2:
            other, count = groups.pop()
            middle, size = (middle * size + other * count) / (size + count), size + count
        groups.append((middle, size))
    moved = [0.0] * len(heights)
    places = iter(order)
    for middle, size in groups:
        half = distance * (size - 1) / 2
        lowest = min(max(middle, floor + half), ceiling - half) - half
        for number in range(size):
            moved[next(places)] = lowest + number * distance
    return tuple(moved)
