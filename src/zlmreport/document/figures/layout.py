"""Layout of a figure: its width and heights, margins, titles of axes, distance of panels.

All places are points from the lower left corner of the drawing, y upwards.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.document.figures.figure import Figure, Panel
from zlmreport.document.figures.metrics import make_plain_label
from zlmreport.document.figures.panel_layout import (
    LEGEND_GAP,
    LegendLayout,
    PanelLayout,
    lay_out_legend,
    lay_out_panel,
    measure_brackets,
    measure_levels,
)
from zlmreport.document.figures.polar import BESIDE_CIRCLE
from zlmreport.document.figures.scale import (
    AxisScale,
    make_category_scale,
    make_position_scale,
    make_value_scales,
)
from zlmreport.document.figures.shapes import TEXT_SIZE, TICK_TEXT_SIZE, Box, Frame, PlacedLabel
from zlmreport.language import Language, Words
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.units import ARCSECOND, DEGREE

_MILLIMETRE = 72 / 25.4
#: The text width of an A4 page.
WIDTH = 170 * _MILLIMETRE
_HEIGHT_OF_PANEL = 52 * _MILLIMETRE
_HEIGHT_OF_CIRCLE = 96 * _MILLIMETRE
_HEIGHT_OF_BODY = 62 * _MILLIMETRE
_HEIGHT_OF_BARS = 34 * _MILLIMETRE
_HEIGHT_BESIDES = 38 * _MILLIMETRE

TICK_LENGTH = 3.0
TICK_GAP = 2.5
_TITLE_GAP = 4.0
_PANEL_GAP = 10.0
_LEAST_FRAME = 72.0
_EDGE = 2.0
#: Beside the frame at least: half the label of a tick at its end.
_LEAST_MARGIN = 6.0
#: Between the outermost values and the frame: an arrow head that points from outside has room there.
_VALUE_ROOM = 11.0
_POSITION_ROOM = 12.0
_LEAST_TICK_DISTANCE = 18.0
#: Positions over so many degrees are told by parts of a turn.
_HALF_A_TURN = 180.0
#: Up to so high a figure leaves room for words in the corners beside a circle, points.
_ROOM_IN_CORNERS = 110 * _MILLIMETRE
#: From line to line of a label below the frame.
TICK_LINE = 1.2 * TICK_TEXT_SIZE
#: What a legend of one row takes from a panel's height, with the gaps above and below.
_ABOUT_LEGEND = 28.0


@dataclass(frozen=True, slots=True)
class FigureLayout:
    """A figure with the place of everything in it, in points."""

    width: float
    height: float
    panels: tuple[PanelLayout, ...]
    titles: tuple[PlacedLabel, ...]


_NAMED_SIGNS = {each.symbol: f"{each.symbol} ({each.ascii})" for each in (DEGREE, ARCSECOND)}


def measure_figure(figure: Figure) -> tuple[float, float]:
    """Return width and height of a figure in points; they depend on nothing but its panels and bars."""
    if figure.height is not None:
        return WIDTH, figure.height * _MILLIMETRE
    if figure.is_wide and any(panel.is_polar for panel in figure.panels):
        return WIDTH, WIDTH / len(figure.panels) + _HEIGHT_BESIDES / 2
    return WIDTH, _HEIGHT_BESIDES + sum(map(_measure_height, figure.panels))


def _measure_height(panel: Panel) -> float:
    if panel.is_polar:
        return _HEIGHT_OF_CIRCLE
    if panel.is_wire:
        return _HEIGHT_OF_BODY
    return _HEIGHT_OF_BARS if panel.bars else _HEIGHT_OF_PANEL


def lay_out(figure: Figure, language: Language) -> FigureLayout:
    """Return the places of everything in a figure."""
    _, height = measure_figure(figure)
    is_round = bool(figure.panels) and all(panel.is_polar for panel in figure.panels)
    is_alone = is_round and len(figure.panels) == 1 and height <= _ROOM_IN_CORNERS
    bottom = _EDGE + (0.0 if is_alone else 1.35 * TEXT_SIZE)
    if not is_round:  # its angles stand inside of the frame, and it has no ticks
        bottom += _TITLE_GAP + TICK_TEXT_SIZE + TICK_GAP + TICK_LENGTH
    columns = len(figure.panels) if figure.is_wide else 1
    rows = max(1, len(figure.panels) // max(1, columns))
    # The width of the values' labels is the left margin, and the legend's rows follow from it; so the
    # values come first, for the height that a legend of one row leaves.
    y_scales = _make_y_scales(figure, language, (height - bottom) / rows - _ABOUT_LEGEND)
    widest = max((_measure_ticks(text) for scale in y_scales for text in scale.labels), default=0.0)
    left = _EDGE + BESIDE_CIRCLE
    if not is_round:
        left = _EDGE + TEXT_SIZE + _TITLE_GAP + widest + TICK_GAP + TICK_LENGTH
    levels = max(map(measure_levels, figure.panels), default=0.0)
    brackets = max(map(measure_brackets, figure.panels), default=0.0)
    room = (WIDTH + _PANEL_GAP) / max(1, columns) - _PANEL_GAP
    right = room - (left if is_round else _EDGE + max(levels + brackets, _LEAST_MARGIN))
    x_scale = _make_x_scale(figure, language, right - left)
    bottom += TICK_LINE if any("\n" in label for label in x_scale.labels) else 0.0
    legend_room = _EDGE if is_alone else room - _EDGE - left  # in a corner, each entry has its line
    legends = [lay_out_legend(panel, language, legend_room) for panel in figure.panels]
    if is_alone:
        boxes = [Box(left, bottom, right, height - _EDGE)]
    elif figure.is_wide:
        boxes = _place_boxes_in_a_row(Box(left, bottom, right, height), room + _PANEL_GAP, legends)
    else:
        boxes = _place_boxes(left, bottom, right, height, legends)
    panels = tuple(
        lay_out_panel(panel, Frame(box, x_scale, y_scale), legend, levels, language)
        for panel, box, y_scale, legend in zip(figure.panels, boxes, y_scales, legends, strict=True)
    )
    right = boxes[-1].right if boxes else right
    is_bare = bool(figure.panels) and all(panel.is_wire for panel in figure.panels)
    if is_round:
        text = _say_magnification(figure, panels, language)
    else:
        text = write_axis_title(figure.x_title, "" if is_bare else figure.x_unit, language)
    told = make_plain_label(text, TEXT_SIZE)
    middle = (left + right - told.width) / 2
    below = PlacedLabel(told, _EDGE if is_alone else middle, _EDGE + 0.35 * TEXT_SIZE)
    if is_alone:
        panels = (replace(panels[0], legend_corner=(_EDGE, height - _EDGE - legends[0].height)),)
    if is_round or is_bare:
        return FigureLayout(WIDTH, height, panels, (below,))
    upright = _place_value_titles(figure, boxes, language, Box(left, bottom, right, height))
    return FigureLayout(WIDTH, height, panels, (below, *upright))


def _place_value_titles(
    figure: Figure, boxes: Sequence[Box], language: Language, room: Box
) -> Iterator[PlacedLabel]:
    """Yield what stands at the upright axes: once for all panels, or at each where their quantities differ.

    `room`: Of all panels together, up to the upper edge of the figure.
    """
    if figure.has_several_quantities:
        axes = [(figure.value_axis(panel), box) for panel, box in zip(figure.panels, boxes, strict=True)]
    else:
        top = boxes[0].top if boxes else room.top
        axes = [((figure.y_title, figure.y_unit), Box(room.left, room.bottom, room.right, top))]
    for (quantity, unit), box in axes:
        label = make_plain_label(write_axis_title(quantity, unit, language), TEXT_SIZE)
        middle = (box.bottom + box.top - label.width) / 2
        foot = max(_EDGE, min(middle, room.top - _EDGE - label.width))
        yield PlacedLabel(label, box.left - room.left + _EDGE + 0.8 * TEXT_SIZE, foot, 90.0)


def _say_magnification(figure: Figure, panels: Sequence[PanelLayout], language: Language) -> str:
    """Return what stands below circles: what their distances are, and of how much."""
    divisions = {each.grid.division for each in panels if each.grid}
    title, unit = figure.y_title, figure.y_unit
    if len(divisions) != 1:
        return write_axis_title(title, unit, language)
    words = Words("{title}: from circle to circle {division} {unit}").given(
        title=title, division=float(divisions.pop()), unit=unit
    )
    return words.in_language(language)


def lay_out_alone(
    figure: Figure, number: int, language: Language, width: float, height: float
) -> PanelLayout:
    """Return the places in one of a figure's panels that stands alone, in a room of points from (0, 0).

    The frame begins in the room's corner: ticks and titles have their places outside.
    """
    panel = figure.panels[number]
    legend = lay_out_legend(panel, language, width)
    levels = measure_levels(panel)
    right = max(width - levels - measure_brackets(panel), _LEAST_FRAME)
    top = max(height - legend.height - LEGEND_GAP, _LEAST_FRAME)
    frame = Frame(
        Box(0.0, 0.0, right, top),
        _make_x_scale(figure, language, right),
        _make_y_scales(figure, language, top)[number],
    )
    return lay_out_panel(panel, frame, legend, levels, language)


_IN_UNIT = Words("{quantity} in {unit}")


def write_axis_title(quantity: Words, unit: str, language: Language) -> str:
    """Return what stands at an axis; a unit that is but a small sign has its name, too."""
    named = _NAMED_SIGNS.get(unit, unit)
    title = _IN_UNIT.given(quantity=quantity, unit=named) if named else quantity
    return title.in_language(language)


def _place_boxes(
    left: float, bottom: float, right: float, top: float, legends: list[LegendLayout]
) -> list[Box]:
    """Return the frames' places: alike in height, each below its legend."""
    taken = sum(legend.height + LEGEND_GAP + _PANEL_GAP for legend in legends) - _PANEL_GAP
    height = (top - bottom - taken) / max(1, len(legends))
    boxes = []
    for legend in legends:
        top -= legend.height + LEGEND_GAP
        boxes.append(Box(left, top - height, right, top))
        top -= height + _PANEL_GAP
    return boxes


def _measure_ticks(text: str) -> float:
    return make_plain_label(text, TICK_TEXT_SIZE).width


def _place_boxes_in_a_row(first: Box, distance: float, legends: list[LegendLayout]) -> list[Box]:
    """Return the frames' places beside each other, alike in size, below the highest of the legends."""
    top = first.top - max((legend.height for legend in legends), default=0.0) - LEGEND_GAP
    shifts = (number * distance for number in range(len(legends)))
    return [Box(first.left + shift, first.bottom, first.right + shift, top) for shift in shifts]


def _make_x_scale(figure: Figure, language: Language, width: float) -> AxisScale:
    """Return the scale along the lower edge: of categories where there are bars, else of positions."""
    bars = [bar for panel in figure.panels for bar in panel.bars]
    labels = [bar.label.in_language(language) for bar in bars]
    names = [write_plain(text) if bar.is_symbol else text for bar, text in zip(bars, labels, strict=True)]
    if names:
        return make_category_scale(names, width, _measure_ticks)
    positions = _collect_positions(figure.panels)
    shown = positions[np.isfinite(positions)]
    of_a_turn = figure.x_unit == DEGREE.symbol and shown.size > 0 and np.ptp(shown) >= _HALF_A_TURN
    return make_position_scale(
        positions, width, _POSITION_ROOM, language.decimal_sign, _measure_ticks, of_a_turn=bool(of_a_turn)
    )


def _make_y_scales(figure: Figure, language: Language, height: float) -> tuple[AxisScale, ...]:
    room = _VALUE_ROOM / (height - 2 * _VALUE_ROOM)
    most = int(height / _LEAST_TICK_DISTANCE)
    values = [_collect_values(panel) for panel in figure.panels]
    return make_value_scales(values, room, most, language.decimal_sign, alike=figure.spans_are_alike)


def _collect_positions(panels: Iterable[Panel]) -> FloatArray:
    found: list[FloatArray] = []
    for panel in panels:
        found += [curve.x for curve in panel.curves]
        found += [band.x for band in panel.bands]
        found += [readings.x for readings in panel.readings]
        found.append(np.array([arrow.x for arrow in panel.arrows]))
        found.append(np.array([(bracket.low_at, bracket.high_at) for bracket in panel.brackets]))
        found += [panel.tiles.edges[0]] if panel.tiles else []
    return _join_arrays(found)


def _collect_values(panel: Panel) -> FloatArray:
    found = [curve.y for curve in panel.curves]
    found += [panel.tiles.edges[1]] if panel.tiles else []
    found += [limit for band in panel.bands for limit in (band.lower, band.upper)]
    found += [readings.y for readings in panel.readings]
    found.append(np.array([(arrow.low, arrow.high) for arrow in panel.arrows]))
    found.append(np.array([(bracket.low, bracket.high) for bracket in panel.brackets]))
    found.append(np.array([level.y for level in panel.levels]))
    found.append(np.array([(0.0, bar.y + bar.uncertainty, bar.accepted or 0.0) for bar in panel.bars]))
    return _join_arrays(found)


def _join_arrays(arrays: list[FloatArray]) -> FloatArray:
    return np.concatenate([np.empty(0), *map(np.ravel, arrays)])
