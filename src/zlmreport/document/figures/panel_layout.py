"""Layout of a panel: where brackets, limit lines, values and the legend stand; frame and notes of a body.

All places are points from the lower left corner of the drawing, y upwards.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from zlmreport.document.figures.canvas import Label, TypeFace
from zlmreport.document.figures.dimensions import (
    GAP,
    DimensionSpan,
    DrawnDimension,
    measure_margin,
    place_beside_targets,
    place_margin_columns,
    spread,
)
from zlmreport.document.figures.figure import Arrow, Band, Bracket, Curve, Level, Panel, PlottedReadings
from zlmreport.document.figures.metrics import make_plain_label, make_symbol_label
from zlmreport.document.figures.polar import PolarGrid, find_largest_square, make_polar_grid
from zlmreport.document.figures.scale import AxisScale, find_extremes
from zlmreport.document.figures.shapes import TEXT_SIZE, TICK_TEXT_SIZE, Box, Frame, Lettering, PlacedLabel
from zlmreport.document.figures.tiles import place_tile_values
from zlmreport.language import Language, Words
from zlmreport.language.formatting import write_fixed_number
from zlmreport.measurement.arrays import FloatArray

#: Between the frame and the first column of brackets, and between the end of a level and its label.
_MARGIN_GAP = 9.0
_LEVEL_GAP = 5.0
#: Between the end of a bar and its value.
_VALUE_GAP = 2.5
#: Distance of the points that stand for a line when labels look for room.
_SAMPLING = 2.0


@dataclass(frozen=True, slots=True)
class PanelLayout:
    """A panel with the place of everything in it."""

    panel: Panel  #: What is drawn.
    frame: Frame  #: The area of its values.
    legend: LegendLayout  #: Above the frame.
    #: brackets and arrows: Dimension lines in the margin, and beside targets.
    brackets: tuple[DrawnDimension, ...]
    arrows: tuple[DrawnDimension, ...]
    #: Each level with its height at the frame, and its label.
    levels: tuple[tuple[Level, float, PlacedLabel], ...]
    bar_values: tuple[PlacedLabel, ...]  #: What is written at the end of each bar.
    grid: PolarGrid | None = None  #: Of a panel about a circle; None for the usual ones.
    notes: tuple[PlacedLabel, ...] = ()  #: Of a wire picture.
    tile_values: tuple[Lettering, ...] = ()  #: What is written on tiles.
    #: Lower left corner of a legend that stands beside a circle; None for one above the frame.
    legend_corner: tuple[float, float] | None = None


def lay_out_panel(
    panel: Panel, frame: Frame, legend: LegendLayout, level_width: float, language: Language
) -> PanelLayout:
    """Return the places of everything in a panel; labels of levels take a width beside the frame."""
    if panel.is_polar:
        grid = make_polar_grid(panel, language.decimal_sign)
        box = find_largest_square(frame.box)
        scale = grid.scale(box.width)
        round_frame = Frame(box, scale, scale)
        return PanelLayout(panel, round_frame, legend, (), (), (), (), grid)
    if panel.is_wire:
        fitted = make_wire_frame(panel, frame.box)
        notes = tuple(place_notes(panel, fitted, language))
        return PanelLayout(panel, fitted, legend, (), (), (), (), notes=notes)
    box = frame.box
    spans = [
        _make_span(bracket, frame, bracket.low_at, bracket.high_at)
        for bracket in _select_drawable_brackets(panel)
    ]
    brackets = place_margin_columns(spans, box.right + level_width + _MARGIN_GAP, box.bottom, box.top)
    drawable = [arrow for arrow in panel.arrows if np.isfinite((arrow.low, arrow.high, arrow.x)).all()]
    spans = [_make_span(arrow, frame, arrow.x, arrow.x) for arrow in drawable]
    arrows = place_beside_targets(
        spans, box, _collect_marks(panel, frame), _collect_lines(panel, frame, brackets)
    )
    levels, values = _place_levels(panel, frame), _place_bar_values(panel, frame, language)
    written = tuple(place_tile_values(panel.tiles, frame, language)) if panel.tiles else ()
    return PanelLayout(panel, frame, legend, brackets, arrows, levels, values, tile_values=written)


def _select_drawable_brackets(panel: Panel) -> list[Bracket]:
    """Return the brackets whose ends exist."""
    return [
        bracket
        for bracket in panel.brackets
        if np.isfinite((bracket.low, bracket.high, bracket.low_at, bracket.high_at)).all()
    ]


def _select_drawable_levels(panel: Panel) -> list[Level]:
    """Return the levels whose value exists."""
    return [level for level in panel.levels if np.isfinite(level.y)]


def measure_brackets(panel: Panel) -> float:
    """Return the width that a panel's brackets take beside the frame."""
    labels = [make_symbol_label(bracket.notation, TEXT_SIZE) for bracket in _select_drawable_brackets(panel)]
    return _MARGIN_GAP + measure_margin(labels) if labels else 0.0


def measure_levels(panel: Panel) -> float:
    """Return the width that the labels of a panel's levels take beside the frame."""
    named = (level.notation for level in _select_drawable_levels(panel) if level.notation)
    widths = [make_symbol_label(notation, TEXT_SIZE).width for notation in named]
    return _LEVEL_GAP + max(widths) if widths else 0.0


def _make_span(one: Arrow | Bracket, frame: Frame, low_at: float, high_at: float) -> DimensionSpan:
    ends = [
        (frame.place_y(one.low), frame.place_x(low_at)),
        (frame.place_y(one.high), frame.place_x(high_at)),
    ]
    (low, low_from), (high, high_from) = sorted(ends)
    return DimensionSpan(make_symbol_label(one.notation, TEXT_SIZE), low, high, low_from, high_from)


def _place_levels(panel: Panel, frame: Frame) -> tuple[tuple[Level, float, PlacedLabel], ...]:
    levels = _select_drawable_levels(panel)
    heights = [frame.place_y(level.y) for level in levels]
    labels = [make_symbol_label(level.notation, TEXT_SIZE) for level in levels]
    distance = max((label.height for label in labels), default=0.0)
    return tuple(
        (level, height, PlacedLabel(label, frame.box.right + _LEVEL_GAP, moved - label.rise))
        for level, label, height, moved in zip(
            levels, labels, heights, spread(heights, distance, frame.box.bottom, frame.box.top), strict=True
        )
    )


def _place_bar_values(panel: Panel, frame: Frame, language: Language) -> tuple[PlacedLabel, ...]:
    """Return the values above their bars, none of them on a line."""
    labels = [make_plain_label(bar.value.in_language(language), TICK_TEXT_SIZE) for bar in panel.bars]
    lines = sorted(frame.place_y(level.y) for level in _select_drawable_levels(panel))

    def foot(top_of_bar: float, height: float) -> float:
        at = top_of_bar + _VALUE_GAP
        for line in lines:
            if at - _VALUE_GAP < line < at + height:
                at = line + _VALUE_GAP
        return at

    return tuple(
        PlacedLabel(
            label,
            frame.place_x(number) - label.width / 2,
            foot(frame.place_y(bar.y + bar.uncertainty), label.height),
        )
        for number, (bar, label) in enumerate(zip(panel.bars, labels, strict=True))
    )


def _collect_marks(panel: Panel, frame: Frame) -> FloatArray:
    """Return where curves and readings have their marks."""
    points = [frame.place_points(curve.x, curve.y) for curve in panel.curves]
    points += [frame.place_points(readings.x, readings.y) for readings in panel.readings]
    return np.concatenate([np.empty((0, 2)), *points])


def _collect_lines(panel: Panel, frame: Frame, brackets: Sequence[DrawnDimension]) -> FloatArray:
    """Return points along all lines inside the frame, those that lead to the brackets among them."""
    lines = [frame.place_points(curve.x, curve.y) for curve in panel.curves]
    for band in panel.bands:
        lines += [frame.place_points(band.x, band.lower), frame.place_points(band.x, band.upper)]
    for height in map(frame.place_y, (0.0, *(level.y for level in _select_drawable_levels(panel)))):
        lines.append(np.array([(frame.box.left, height), (frame.box.right, height)]))
    for bracket in brackets:
        span = bracket.span
        for start, height in ((span.low_from, span.low), (span.high_from, span.high)):
            lines.append(np.array([(start + GAP, height), (frame.box.right, height)]))
    return np.concatenate([np.empty((0, 2)), *map(_sample_line, lines)])


def _sample_line(line: FloatArray) -> FloatArray:
    if len(line) < 2:
        return line
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    places = np.arange(0.0, along[-1], _SAMPLING)
    return np.column_stack([np.interp(places, along, line[:, 0]), np.interp(places, along, line[:, 1])])


#: Width of the sample of a line or a band, and of a single mark.
LINE_SAMPLE = 25.0
MARK_SAMPLE = 6.0

#: Between a legend and the frame below it.
LEGEND_GAP = 5.0

_ROW_HEIGHT = 13.0
_SAMPLE_GAP = 4.0
_ENTRY_GAP = 14.0
_HEADING_GAP = 14.0
_READINGS = Words("single readings")

#: What an entry explains; the readings of all approaches share one.
Explained: TypeAlias = Curve | Band | Level | tuple[PlottedReadings, ...]


@dataclass(frozen=True, slots=True)
class LegendEntry:
    """A sample, and the label after it."""

    explained: Explained
    label: Label

    @property
    def label_start(self) -> float:
        """Where the label begins, from the beginning of the sample."""
        marks = len(self.explained) if isinstance(self.explained, tuple) else 0
        return (marks * MARK_SAMPLE or LINE_SAMPLE) + _SAMPLE_GAP

    @property
    def width(self) -> float:
        """Of sample and label."""
        return self.label_start + self.label.width


@dataclass(frozen=True, slots=True)
class LegendLayout:
    """The heading, and each entry with the beginning of its sample and the height of its middle.

    Places are points from the legend's lower left corner, y upwards.
    """

    heading: PlacedLabel | None
    entries: tuple[tuple[LegendEntry, float, float], ...]
    height: float


def lay_out_legend(panel: Panel, language: Language, width: float) -> LegendLayout:
    """Return the legend of a panel in rows of a width; a heading begins the first row."""
    entries = _list_entries(panel, language)
    heading = None
    x, row = 0.0, 0
    if panel.heading is not None:
        heading = make_plain_label(panel.heading.in_language(language), TEXT_SIZE, TypeFace.SEMIBOLD)
        x = heading.width + _HEADING_GAP
    places = []
    for entry in entries:
        if x > 0 and x + entry.width > width:
            x, row = 0.0, row + 1
        places.append((entry, x, row))
        x += entry.width + _ENTRY_GAP
    rows = row + 1 if entries or heading else 0
    middles = [(rows - row - 0.5) * _ROW_HEIGHT for row in range(rows)]
    return LegendLayout(
        None if heading is None else PlacedLabel(heading, 0.0, middles[0] - heading.rise),
        tuple((entry, x, middles[row]) for entry, x, row in places),
        rows * _ROW_HEIGHT,
    )


def _list_entries(panel: Panel, language: Language) -> tuple[LegendEntry, ...]:
    """Return one entry for each symbol of a panel: curves, bands, readings; about a circle levels as well."""
    levels = _select_drawable_levels(panel) if panel.is_polar else ()
    explained: tuple[Curve | Band | Level, ...] = (*panel.curves, *panel.bands, *levels)
    found: dict[object, LegendEntry] = {}
    for one in explained:
        if one.notation:
            entry = LegendEntry(one, make_symbol_label(one.notation, TEXT_SIZE))
            found.setdefault((type(one), one.role, one.notation), entry)
    if panel.readings:
        arrows = (readings.approach.arrow for readings in panel.readings)
        text = " ".join((_READINGS.in_language(language), *arrows))
        found["readings"] = LegendEntry(panel.readings, make_plain_label(text, TEXT_SIZE))
    return tuple(found.values())


#: Round the body, in points: half a note has room there.
_ROOM_BESIDE, _ROOM_ABOVE = 16.0, 12.0
#: Between a place and its note.
_GAP = 2.0


def make_wire_frame(panel: Panel, box: Box) -> Frame:
    """Return the area in which a body is drawn, as large as a box lets it be and in its middle."""
    x_low, x_high = find_extremes(np.concatenate([np.empty(0), *(each.x for each in panel.curves)]))
    y_low, y_high = find_extremes(np.concatenate([np.empty(0), *(each.y for each in panel.curves)]))
    width, height = (x_high - x_low) or 1.0, (y_high - y_low) or 1.0
    factor = min((box.width - 2 * _ROOM_BESIDE) / width, (box.height - 2 * _ROOM_ABOVE) / height)
    return Frame(
        box,
        _scale((x_low + x_high) / 2, box.width / factor),
        _scale((y_low + y_high) / 2, box.height / factor),
    )


def _scale(middle: float, span: float) -> AxisScale:
    return AxisScale(middle - span / 2, middle + span / 2, (), ())


def place_notes(panel: Panel, frame: Frame, language: Language) -> Iterator[PlacedLabel]:
    """Yield the notes where they stand: above or below their places, in the middle."""
    for note in panel.notes:
        value = note.value
        if isinstance(value, Words):
            text = value.in_language(language)
        else:
            text = write_fixed_number(value, 1, language.decimal_sign)
        label = make_plain_label(text, TICK_TEXT_SIZE)
        x, y = frame.place_x(note.x), frame.place_y(note.y)
        foot = y - _GAP - label.height if note.is_below else y + _GAP
        yield PlacedLabel(label, x - label.width / 2, foot)
