"""Draws a figure: grid, axes, curves, bands, readings, bars, arrows, legend, from back to front."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from zlmreport.document.figures.canvas import Canvas, Fill, Run, Segment, Stroke, SvgCanvas
from zlmreport.document.figures.dimensions import GAP, HEAD, HEAD_HALF_WIDTH, OVERSHOOT, DrawnDimension
from zlmreport.document.figures.figure import Band, Bar, Curve, Figure, PlottedReadings, Role
from zlmreport.document.figures.layout import (
    TICK_GAP,
    TICK_LENGTH,
    TICK_LINE,
    FigureLayout,
    lay_out,
    measure_figure,
)
from zlmreport.document.figures.metrics import make_plain_label, make_symbol_label
from zlmreport.document.figures.panel_layout import (
    LEGEND_GAP,
    LINE_SAMPLE,
    MARK_SAMPLE,
    LegendEntry,
    PanelLayout,
)
from zlmreport.document.figures.polar import (
    PolarGrid,
    draw_direction_marks,
    draw_polar_grid,
    draw_senses,
    place_grid_labels,
    place_on_circle,
)
from zlmreport.document.figures.shapes import (
    BAR,
    DIMENSION,
    EXTENSION,
    FRAME,
    GRID,
    GROUND,
    INK,
    MARK_SIZES,
    READING_SIZE,
    READINGS,
    RIM,
    ROLES,
    TICK,
    TICK_TEXT_SIZE,
    TRIANGLE_HALF_WIDTH,
    ZERO,
    Box,
    Frame,
    Lettering,
    Outline,
    PlacedLabel,
    PointMarks,
    PointShape,
    RoleStyle,
    Shape,
    join_lines,
    outline_area,
)
from zlmreport.document.figures.tiles import draw_tiles
from zlmreport.language import Language
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.arrays import BoolArray, FloatArray

#: Least distance between two marks of a curve that has very many targets.
_MARK_DISTANCE = 11.0
#: Half the length of the dash that stands for a value between two gaps.
_LONE_DASH = 3.5
#: Half the width of a bar, of its whisker's ends, and of the mark across it, in distances of bars.
_HALF_BAR = 0.32
_HALF_WHISKER = 0.07
_HALF_ACCEPTED = 0.4
#: Distance of bars from which on they grow no wider, in points: few bars are no wall.
_WIDEST_DISTANCE = 90.0


_HALF_SWATCH = 3.25

#: Of a quarter circle of radius 1, the distance of a control point from its end.
_QUARTER = 4 / 3 * (math.sqrt(2) - 1)


def draw_figure_shapes(layout: FigureLayout) -> Iterator[Shape]:
    """Yield everything that a figure is made of."""
    for panel in layout.panels:
        yield from draw_legend(panel)
        is_lowest = panel.frame.box.bottom == layout.panels[-1].frame.box.bottom
        yield from draw_panel(panel, is_lowest=is_lowest)
    for title in layout.titles:
        yield Lettering("title", title, INK)


def draw_panel(layout: PanelLayout, *, is_lowest: bool) -> Iterator[Shape]:
    """Return the shapes of a panel; only below the lowest panel the positions are written."""
    if layout.grid is not None:
        return _draw_about_a_circle(layout, layout.grid)
    return _draw_body(layout) if layout.panel.is_wire else _draw_over_positions(layout, is_lowest=is_lowest)


def _draw_over_positions(layout: PanelLayout, *, is_lowest: bool) -> Iterator[Shape]:
    """Return the shapes of a panel with axes."""
    frame, panel = layout.frame, layout.panel

    yield from _draw_grid(frame)
    if panel.tiles:
        yield from draw_tiles(panel.tiles, frame)
        yield from layout.tile_values
    yield from _draw_bars(layout)
    for band in panel.bands:
        yield from _draw_band(band, frame)
    for readings in panel.readings:
        points = np.column_stack([readings.x, readings.y])
        yield _place_reading_marks("reading", readings, points, frame)
    for level, height, _ in layout.levels:
        line = [(frame.box.left, height), (frame.box.right, height)]
        yield join_lines("level", [line], ROLES[level.role].stroke)
    yield from _draw_extensions(layout)
    for curve in panel.curves:
        yield from _draw_curve(curve, frame)
    yield from _draw_axes(layout, is_lowest=is_lowest)
    for value in layout.bar_values:
        yield _draw_ground(value)
        yield Lettering("bar", value, INK)
    for kind, dimensions in (("arrow", layout.arrows), ("bracket", layout.brackets)):
        for dimension in dimensions:
            yield from _draw_dimension(kind, dimension)
    for label in (each for level, _, each in layout.levels if level.notation):
        yield _draw_ground(label)
        yield Lettering("level", label, INK)


def _draw_about_a_circle(layout: PanelLayout, grid: PolarGrid) -> Iterator[Shape]:
    frame, panel = layout.frame, place_on_circle(layout.panel, grid)
    yield from draw_polar_grid(layout.panel, grid, frame)
    for readings in panel.readings:
        points = np.column_stack([readings.x, readings.y])
        yield _place_reading_marks("reading", readings, points, frame)
    for curve in panel.curves:
        points = np.column_stack([curve.x, curve.y])
        yield Outline(f"curve {curve.role.name.lower()}", (points,), ROLES[curve.role].stroke, frame=frame)
    yield from draw_direction_marks(panel, grid, frame)
    yield from draw_senses(panel, frame)
    for letters in place_grid_labels(panel, grid, frame):
        yield _draw_ground(letters.placed)
        yield letters


def _draw_body(layout: PanelLayout) -> Iterator[Shape]:
    for curve in layout.panel.curves:
        points = np.column_stack([curve.x, curve.y])
        stroke = ROLES[curve.role].stroke
        yield Outline(f"curve {curve.role.name.lower()}", (points,), stroke, frame=layout.frame)
    for note in layout.notes:
        yield _draw_ground(note)
        yield Lettering("note", note, INK)


def _place_curve_marks(
    kind: str, style: RoleStyle, points: FloatArray, frame: Frame | None = None
) -> Iterator[PointMarks]:
    """Return the marks of a curve, where its role has marks."""
    if style.mark is not None:
        size, fill = MARK_SIZES[style.mark], Fill(style.stroke.colour)
        yield PointMarks(kind, points, style.mark, size, RIM, fill, frame)


def _place_reading_marks(
    kind: str, readings: PlottedReadings, points: FloatArray, frame: Frame | None = None
) -> PointMarks:
    mark, stroke = READINGS[readings.approach]
    return PointMarks(kind, points, mark, READING_SIZE, stroke, frame=frame)


def _draw_grid(frame: Frame) -> Iterator[Shape]:
    box = frame.box
    across = [[(box.left, y), (box.right, y)] for y in map(frame.place_y, frame.y_scale.ticks)]
    along = [[(x, box.bottom), (x, box.top)] for x in map(frame.place_x, frame.x_scale.ticks)]
    yield join_lines("grid", across + along, GRID)
    if frame.y_scale.lower <= 0 <= frame.y_scale.upper:
        zero = frame.place_y(0.0)
        yield join_lines("zero", [[(box.left, zero), (box.right, zero)]], ZERO)


def _draw_axes(layout: PanelLayout, *, is_lowest: bool) -> Iterator[Shape]:
    frame, box = layout.frame, layout.frame.box
    notations = [bar.label.in_language(Language.ENGLISH) for bar in layout.panel.bars if bar.is_symbol]
    symbols = {write_plain(each): each for each in notations}
    yield join_lines("frame", [[(box.left, box.top), (box.left, box.bottom), (box.right, box.bottom)]], FRAME)
    ticks = [[(box.left - TICK_LENGTH, y), (box.left, y)] for y in map(frame.place_y, frame.y_scale.ticks)]
    for positions, length in ((frame.x_scale.ticks, TICK_LENGTH), (frame.x_scale.marks, TICK_LENGTH / 2)):
        ticks += [[(x, box.bottom - length), (x, box.bottom)] for x in map(frame.place_x, positions)]
    yield join_lines("tick", ticks, TICK)
    right = box.left - TICK_LENGTH - TICK_GAP
    for value, text in zip(frame.y_scale.ticks, frame.y_scale.labels, strict=True):
        label = make_plain_label(text, TICK_TEXT_SIZE)
        place = PlacedLabel(label, right - label.width, frame.place_y(value) - label.rise)
        yield Lettering("tick y", place, INK)
    if is_lowest:
        top = box.bottom - TICK_LENGTH - TICK_GAP
        for value, text in zip(frame.x_scale.ticks, frame.x_scale.labels, strict=True):
            for line, part in enumerate(text.split("\n")):
                setting = make_symbol_label if part in symbols else make_plain_label
                label = setting(symbols.get(part, part), TICK_TEXT_SIZE)
                middle = frame.place_x(value)
                place = PlacedLabel(label, middle - label.width / 2, top - 2 * label.rise - line * TICK_LINE)
                yield Lettering("tick x", place, INK)


def _draw_bars(layout: PanelLayout) -> Iterator[Shape]:
    """Return the bars, which grow from zero."""
    frame = layout.frame
    for number, bar in enumerate(layout.panel.bars):
        left, right = _find_ends(frame, number, _HALF_BAR)
        bottom, top = sorted((frame.place_y(0.0), frame.place_y(bar.y)))
        yield outline_area("bar", Box(left, bottom, right, top).corners, *BAR)
        if bar.accepted is not None:
            height = frame.place_y(bar.accepted)
            ends = [(end, height) for end in _find_ends(frame, number, _HALF_ACCEPTED)]
            yield join_lines("accepted", [ends], ROLES[Role.BAND_LIMIT].stroke)
        if bar.uncertainty:
            yield _draw_whisker(frame, number, bar)


def _find_ends(frame: Frame, number: int, half: float) -> tuple[float, float]:
    """Return where something begins and ends that is centred on a bar, `half` in distances of bars."""
    middle, reach = frame.place_x(number), half * min(frame.x_factor, _WIDEST_DISTANCE)
    return middle - reach, middle + reach


def _draw_whisker(frame: Frame, number: int, bar: Bar) -> Outline:
    low, high = (frame.place_y(bar.y + side * bar.uncertainty) for side in (-1, 1))
    middle = frame.place_x(number)
    left, right = _find_ends(frame, number, _HALF_WHISKER)
    across = [[(left, height), (right, height)] for height in (low, high)]
    return join_lines("whisker", [[(middle, low), (middle, high)], *across], DIMENSION)


def _draw_curve(curve: Curve, frame: Frame) -> Iterator[Shape]:
    style = ROLES[curve.role]
    role = curve.role.name.lower()
    points = np.column_stack([curve.x, curve.y])
    yield Outline(f"curve {role}", (points,), style.stroke, frame=frame)
    shown = _select_spaced(points, _MARK_DISTANCE / frame.x_factor)
    yield from _place_curve_marks(f"mark {role}", style, points[shown], frame)
    if style.mark is None:
        yield from _draw_lone_values(f"curve {role}", curve.x, curve.y, frame, style.stroke)


def _select_spaced(points: FloatArray, distance: float) -> BoolArray:
    """Return which points of a curve get a mark: all that are far enough from the marked one before."""
    shown = np.zeros(len(points), dtype=np.bool_)
    last = -np.inf
    for index in np.flatnonzero(np.isfinite(points).all(axis=1)):
        if abs(points[index, 0] - last) >= distance:
            shown[index] = True
            last = points[index, 0]
    return shown


def _draw_lone_values(
    kind: str, x: FloatArray, y: FloatArray, frame: Frame, stroke: Stroke
) -> Iterator[Shape]:
    """Return short dashes for values between gaps, to which no line leads."""
    finite = np.concatenate([[False], np.isfinite(x) & np.isfinite(y), [False]])
    lone = finite[1:-1] & ~finite[:-2] & ~finite[2:]
    if lone.any():
        places = frame.place_points(x[lone], y[lone]).tolist()
        dashes = [[(left - _LONE_DASH, height), (left + _LONE_DASH, height)] for left, height in places]
        yield join_lines(kind, dashes, Stroke(stroke.colour, stroke.width))


def _draw_band(band: Band, frame: Frame) -> Iterator[Shape]:
    style = ROLES[band.role]
    role = band.role.name.lower()
    exists = np.isfinite(band.x) & np.isfinite(band.lower) & np.isfinite(band.upper)
    for part in np.split(np.arange(len(exists)), np.flatnonzero(np.diff(exists)) + 1):
        if len(part) > 1 and exists[part[0]]:
            x = np.concatenate([band.x[part], band.x[part][::-1]])
            y = np.concatenate([band.upper[part], band.lower[part][::-1]])
            yield Outline(f"band {role}", (np.column_stack([x, y]),), None, style.tint, frame=frame)
    for limit in (band.lower, band.upper):
        yield Outline(f"limit {role}", (np.column_stack([band.x, limit]),), style.stroke, frame=frame)
        yield from _draw_lone_values(f"limit {role}", band.x, limit, frame, style.stroke)


def _draw_extensions(layout: PanelLayout) -> Iterator[Shape]:
    parts = []
    for dimension in (*layout.arrows, *layout.brackets):
        span = dimension.span
        for start, height in ((span.low_from, span.low), (span.high_from, span.high)):
            side = 1.0 if dimension.x > start else -1.0
            parts.append([(start + side * GAP, height), (dimension.x + side * OVERSHOOT, height)])
    if parts:
        yield join_lines("extension", parts, EXTENSION)


def _draw_dimension(kind: str, dimension: DrawnDimension) -> Iterator[Shape]:
    span, x = dimension.span, dimension.x
    if span.length > 0:
        yield join_lines(kind, [[(x, span.low - span.tail), (x, span.high + span.tail)]], DIMENSION)
        outwards = -1.0 if span.tail else 1.0
        heads = (_draw_head(x, span.low, -outwards), _draw_head(x, span.high, outwards))
        yield Outline(f"{kind} head", heads, None, Fill(INK), is_closed=True)
    else:
        half = 2 * HEAD_HALF_WIDTH
        yield join_lines(kind, [[(x - half, span.low), (x + half, span.low)]], DIMENSION)
    if dimension.is_among_lines:
        yield _draw_ground(dimension.label)
    yield Lettering(kind, dimension.label, INK)


def _draw_head(x: float, tip: float, direction: float) -> FloatArray:
    base = tip - direction * HEAD
    return np.array([(x, tip), (x - HEAD_HALF_WIDTH, base), (x + HEAD_HALF_WIDTH, base), (x, tip)])


def _draw_ground(label: PlacedLabel) -> Outline:
    """Return what lets lines fade behind a label."""
    return outline_area("ground", label.box.corners, None, GROUND)


def draw_legend(layout: PanelLayout) -> Iterator[Shape]:
    """Return the shapes of the heading and the legend above a panel, or beside its circle."""
    left, base = layout.legend_corner or (layout.frame.box.left, layout.frame.box.top + LEGEND_GAP)
    heading = layout.legend.heading
    if heading is not None:
        yield Lettering("heading", PlacedLabel(heading.label, left + heading.x, base + heading.y), INK)
    for entry, x, y in layout.legend.entries:
        yield from _sample(entry, left + x, base + y, with_mark=not layout.panel.is_polar)
        label = PlacedLabel(entry.label, left + x + entry.label_start, base + y - entry.label.rise)
        yield Lettering("legend", label, INK)


def _sample(entry: LegendEntry, x: float, y: float, *, with_mark: bool) -> Iterator[Shape]:
    """Yield what stands before an entry; curves about a circle have no marks."""
    explained = entry.explained
    if isinstance(explained, tuple):
        for number, readings in enumerate(explained):
            place = np.array([(x + (number + 0.5) * MARK_SAMPLE, y)])
            yield _place_reading_marks("legend", readings, place)
        return
    style = ROLES[explained.role]
    if isinstance(explained, Band):
        box = Box(x, y - _HALF_SWATCH, x + LINE_SAMPLE, y + _HALF_SWATCH)
        lower_left, lower_right, upper_right, upper_left, _ = box.corners
        yield outline_area("legend", box.corners, None, style.tint)
        yield join_lines("legend", [[lower_left, lower_right], [upper_left, upper_right]], style.stroke)
    else:
        yield join_lines("legend", [[(x, y), (x + LINE_SAMPLE, y)]], style.stroke)
        if with_mark:
            yield from _place_curve_marks("legend", style, np.array([(x + LINE_SAMPLE / 2, y)]))


def draw(figure: Figure, language: Language, canvas: Canvas) -> None:
    """Draw a figure on a canvas of its size."""
    layout = lay_out(figure, language)
    pen = _Pen(canvas, layout.height)
    for shape in draw_figure_shapes(layout):
        match shape:
            case Outline():
                pen.draw_outline(shape)
            case PointMarks():
                pen.draw_marks(shape)
            case Lettering():
                pen.set_lettering(shape)


def to_svg(figure: Figure, language: Language) -> str:
    """Return a figure as an SVG image, its text as text in the bundled typeface.

    The image names the typeface and does not carry it: set it into a page that has it.
    """
    canvas = SvgCanvas(*measure_figure(figure), figure.alternative.in_language(language))
    draw(figure, language, canvas)
    return canvas.image()


class _Pen:
    """Hands shapes on to a canvas of a height, on which y points downwards."""

    def __init__(self, canvas: Canvas, height: float) -> None:
        self._canvas = canvas
        self._height = height

    def draw_outline(self, outline: Outline) -> None:
        """Draw an outline."""
        places = self._place(np.concatenate(outline.parts), outline.frame).tolist()
        segments: list[Segment] = []
        begin = 0
        for part in outline.parts:
            end = begin + len(part)
            if outline.is_closed:
                segments += _draw_line(places[begin : end - 1])
                segments.append(("Z", ()))
            else:
                segments += _draw_line(places[begin:end])
            begin = end
        if segments:
            self._canvas.outline(outline.kind, segments, outline.stroke, outline.fill)

    def draw_marks(self, marks: PointMarks) -> None:
        """Draw all marks as one outline of many parts."""
        places = self._place(marks.points, marks.frame)
        places = places[np.isfinite(places).all(axis=1)]
        segments: list[tuple[Segment, ...]] = []
        for operator, points in _SHAPES[marks.mark]:
            corners = marks.size * np.reshape(points, (-1, 2)) * (1.0, -1.0)
            rows = (places[:, np.newaxis, :] + corners).reshape(len(places), len(points)).tolist()
            segments.append(tuple((operator, tuple(row)) for row in rows))
        if len(places):
            drawn = [segment for mark in zip(*segments, strict=True) for segment in mark]
            self._canvas.outline(marks.kind, drawn, marks.stroke, marks.fill)

    def set_lettering(self, lettering: Lettering) -> None:
        """Set a label."""
        placed = lettering.placed
        cosine, sine = math.cos(math.radians(placed.angle)), math.sin(math.radians(placed.angle))
        runs = [
            Run(
                run.text,
                run.face,
                run.size,
                placed.x + run.x * cosine + run.y * sine,
                self._height - (placed.y + run.x * sine - run.y * cosine),
            )
            for run in placed.label.runs
        ]
        self._canvas.text(lettering.kind, runs, lettering.colour, placed.angle)

    def _place(self, points: FloatArray, frame: Frame | None) -> FloatArray:
        """Return where points lie on the canvas, shape (N, 2)."""
        if frame is not None:
            points = (points - (frame.x_scale.lower, frame.y_scale.lower)) * (
                frame.x_factor,
                frame.y_factor,
            ) + (frame.box.left, frame.box.bottom)
        return points * (1.0, -1.0) + (0.0, self._height)


def _draw_line(places: Sequence[Sequence[float]]) -> Iterator[Segment]:
    """Yield a line from place to place; it is broken where a place does not exist."""
    operator = "M"
    for x, y in places:
        if math.isfinite(x) and math.isfinite(y):
            yield operator, (x, y)
            operator = "L"
        else:
            operator = "M"


def _draw_triangle(direction: float) -> list[Segment]:
    half = TRIANGLE_HALF_WIDTH
    base, tip = -0.5 * direction, 0.5 * direction
    return [("M", (-half, base)), ("L", (half, base)), ("L", (0.0, tip)), ("Z", ())]


def _draw_circle() -> list[Segment]:
    """Return a circle of diameter 1 as four curves, anticlockwise from its right."""
    turn, quarter = np.array([(0.0, 1.0), (-1.0, 0.0)]), [(1.0, _QUARTER), (_QUARTER, 1.0), (0.0, 1.0)]
    curves: list[Segment] = []
    points = 0.5 * np.array(quarter)
    for _ in range(4):
        curves.append(("C", tuple(points.ravel().tolist())))
        points = points @ turn
    return [("M", (0.5, 0.0)), *curves, ("Z", ())]


_SHAPES = {
    PointShape.UP: _draw_triangle(1.0),
    PointShape.DOWN: _draw_triangle(-1.0),
    PointShape.DISC: _draw_circle(),
}
