"""Where everything in and beside a panel stands, once its frame is known.

All places are points from the lower left corner of the drawing, y upwards.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.figures.dimensions import (
    GAP,
    Dimension,
    Span,
    beside_targets,
    margin_columns,
    margin_width,
    spread,
)
from zlmreport.figures.figure import Arrow, Bracket, Level, Panel
from zlmreport.figures.frame import Frame, PlacedLabel
from zlmreport.figures.legend import LegendLayout
from zlmreport.figures.lettering import plain_label, symbol_label
from zlmreport.figures.style import TEXT_SIZE, TICK_TEXT_SIZE
from zlmreport.language import Language
from zlmreport.quantities.arrays import FloatArray

#: Between the frame and the first column of brackets, and between the end of a level and its label.
_MARGIN_GAP = 9.0
_LEVEL_GAP = 5.0
#: Between the end of a bar and its value.
_VALUE_GAP = 2.5
#: Distance of the points that stand for a line when labels look for room.
_SAMPLING = 2.0


@dataclass(frozen=True, slots=True)
class PanelLayout:
    """A panel with the place of everything in it.

    Attributes
    ----------
    panel
        What is drawn.
    frame
        The area of its values.
    legend
        Above the frame.
    brackets, arrows
        Dimension lines in the margin, and beside targets.
    levels
        Each level with its height at the frame, and its label.
    bar_values
        What is written at the end of each bar.
    """

    panel: Panel
    frame: Frame
    legend: LegendLayout
    brackets: tuple[Dimension, ...]
    arrows: tuple[Dimension, ...]
    levels: tuple[tuple[Level, float, PlacedLabel], ...]
    bar_values: tuple[PlacedLabel, ...]


def lay_out_panel(
    panel: Panel, frame: Frame, legend: LegendLayout, level_width: float, language: Language
) -> PanelLayout:
    """Return the places of everything in a panel; labels of levels take a width beside the frame."""
    box = frame.box
    spans = [_span(bracket, frame, bracket.low_at, bracket.high_at) for bracket in drawable_brackets(panel)]
    brackets = margin_columns(spans, box.right + level_width + _MARGIN_GAP, box.bottom, box.top)
    drawable = [arrow for arrow in panel.arrows if np.isfinite((arrow.low, arrow.high, arrow.x)).all()]
    spans = [_span(arrow, frame, arrow.x, arrow.x) for arrow in drawable]
    arrows = beside_targets(spans, box, _marks(panel, frame), _lines(panel, frame, brackets))
    levels, values = _levels(panel, frame), _bar_values(panel, frame, language)
    return PanelLayout(panel, frame, legend, brackets, arrows, levels, values)


def drawable_brackets(panel: Panel) -> list[Bracket]:
    """Return the brackets whose ends exist."""
    return [
        bracket
        for bracket in panel.brackets
        if np.isfinite((bracket.low, bracket.high, bracket.low_at, bracket.high_at)).all()
    ]


def drawable_levels(panel: Panel) -> list[Level]:
    """Return the levels whose value exists."""
    return [level for level in panel.levels if np.isfinite(level.y)]


def bracket_width(panel: Panel) -> float:
    """Return the width that a panel's brackets take beside the frame."""
    labels = [symbol_label(bracket.notation, TEXT_SIZE) for bracket in drawable_brackets(panel)]
    return _MARGIN_GAP + margin_width(labels) if labels else 0.0


def level_width(panel: Panel) -> float:
    """Return the width that the labels of a panel's levels take beside the frame."""
    widths = [symbol_label(level.notation, TEXT_SIZE).width for level in drawable_levels(panel)]
    return _LEVEL_GAP + max(widths) if widths else 0.0


def _span(one: Arrow | Bracket, frame: Frame, low_at: float, high_at: float) -> Span:
    ends = [
        (frame.y_point(one.low), frame.x_point(low_at)),
        (frame.y_point(one.high), frame.x_point(high_at)),
    ]
    (low, low_from), (high, high_from) = sorted(ends)
    return Span(symbol_label(one.notation, TEXT_SIZE), low, high, low_from, high_from)


def _levels(panel: Panel, frame: Frame) -> tuple[tuple[Level, float, PlacedLabel], ...]:
    levels = drawable_levels(panel)
    heights = [frame.y_point(level.y) for level in levels]
    labels = [symbol_label(level.notation, TEXT_SIZE) for level in levels]
    distance = max((label.height for label in labels), default=0.0)
    return tuple(
        (level, height, PlacedLabel(label, frame.box.right + _LEVEL_GAP, moved - label.rise))
        for level, label, height, moved in zip(
            levels, labels, heights, spread(heights, distance, frame.box.bottom, frame.box.top), strict=True
        )
    )


def _bar_values(panel: Panel, frame: Frame, language: Language) -> tuple[PlacedLabel, ...]:
    labels = [plain_label(bar.value.in_language(language), TICK_TEXT_SIZE) for bar in panel.bars]
    return tuple(
        PlacedLabel(
            label,
            frame.x_point(number) - label.width / 2,
            frame.y_point(bar.y + bar.uncertainty) + _VALUE_GAP,
        )
        for number, (bar, label) in enumerate(zip(panel.bars, labels, strict=True))
    )


def _marks(panel: Panel, frame: Frame) -> FloatArray:
    """Return where curves and readings have their marks."""
    points = [frame.points(curve.x, curve.y) for curve in panel.curves]
    points += [frame.points(readings.x, readings.y) for readings in panel.readings]
    return np.concatenate([np.empty((0, 2)), *points])


def _lines(panel: Panel, frame: Frame, brackets: Sequence[Dimension]) -> FloatArray:
    """Return points along all lines inside the frame, those that lead to the brackets among them."""
    lines = [frame.points(curve.x, curve.y) for curve in panel.curves]
    for band in panel.bands:
        lines += [frame.points(band.x, band.lower), frame.points(band.x, band.upper)]
    for height in map(frame.y_point, (0.0, *(level.y for level in drawable_levels(panel)))):
        lines.append(np.array([(frame.box.left, height), (frame.box.right, height)]))
    for bracket in brackets:
        span = bracket.span
        for start, height in ((span.low_from, span.low), (span.high_from, span.high)):
            lines.append(np.array([(start + GAP, height), (frame.box.right, height)]))
    return np.concatenate([np.empty((0, 2)), *map(_sampled, lines)])


def _sampled(line: FloatArray) -> FloatArray:
    if len(line) < 2:
        return line
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    places = np.arange(0.0, along[-1], _SAMPLING)
    return np.column_stack([np.interp(places, along, line[:, 0]), np.interp(places, along, line[:, 1])])
