"""Draws the views of a probing path below each other, in the style of the graphs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from zlmreport.plugin import (
    GRAPH_TEXT_SIZE,
    GRAPH_WIDTH,
    INK_COLOUR,
    MILLIMETRE,
    ROLE_STYLES,
    Canvas,
    Fill,
    FloatArray,
    FontFace,
    Language,
    Role,
    Segment,
    Stroke,
    SvgCanvas,
    TextLabel,
    TextRun,
    Words,
    fixed_number,
    plain_label,
    round_ticks,
)
from zlmreport_step_gauge.gauge import Side
from zlmreport_step_gauge.paths.path import PathKind
from zlmreport_step_gauge.paths.plan import PlannedPath
from zlmreport_step_gauge.paths.views import Note, Touch, View, path_views

_ALTERNATIVE = Words(
    en="Path of the probe over {faces} faces of {gauge}, {kind}: {points} points in {moves} moves, "
    "{length} m.",
    de="Weg des Tasters über {faces} Flächen von {gauge}, {kind}: {points} Punkte in {moves} Bewegungen, "
    "{length} m.",
)
_KINDS = {
    PathKind.VERTICAL: Words(en="over the top of the blocks", de="über die Blöcke hinweg"),
    PathKind.HORIZONTAL: Words(en="round the side of the blocks", de="seitlich um die Blöcke herum"),
}
_WAY = Words(en="path of the tip's centre, first cycle", de="Weg der Tastkugelmitte, erster Zyklus")
_TOUCHES = {
    Side.FRONT: Words(en="measuring move, front face", de="Antastung, Vorderfläche"),
    Side.BACK: Words(en="measuring move, back face", de="Antastung, Rückfläche"),
}
_COLOURS = {
    Side.FRONT: ROLE_STYLES[Role.MEAN_POSITIVE].stroke.colour,
    Side.BACK: ROLE_STYLES[Role.MEAN_NEGATIVE].stroke.colour,
}
_DIMENSION = Stroke(INK_COLOUR, 0.55)
_EXTENSION = Stroke((0.35, 0.35, 0.35), 0.35)
_FRAME = Stroke(INK_COLOUR, 0.6)
_GROUND = Fill((1.0, 1.0, 1.0), 0.8)
_PATH = Stroke((0.3, 0.3, 0.3), 0.55)
_BLOCK = (Stroke((0.45, 0.45, 0.45), 0.4), Fill((0.88, 0.9, 0.92)))
_BASE = (Stroke((0.6, 0.6, 0.6), 0.4), Fill((0.97, 0.97, 0.97)))

_EDGE = 8.0
_HEADING = 18.0
_VIEW_GAP = 10.0
_LEGEND = 16.0
_TALLEST = 230.0
_NUMBER_SIZE = 6.0
_LONGEST_HEAD = 4.0
#: Of a scale bar, as a part of the width.
_BAR_PART = 6


@dataclass(frozen=True, slots=True)
class _Placed:
    """A view on the page: points from its upper left corner, y downwards."""

    view: View
    scale: float
    left: float
    top: float
    lowest: tuple[float, float]

    def __call__(self, points: FloatArray) -> FloatArray:
        """Return where points of the view, (..., 2) mm, are drawn."""
        x = self.left + self.scale * (points[..., 0] - self.lowest[0])
        y = self.top - self.scale * (points[..., 1] - self.lowest[1])
        return np.stack([x, y], axis=-1)


def path_svg(planned: PlannedPath, language: Language) -> str:
    """Return the picture of a path as an SVG image."""
    views = path_views(planned)
    boxes = [_extent(view) for view in views]
    scales = [min((GRAPH_WIDTH - 2 * _EDGE) / wide, _TALLEST / high) for _, (wide, high) in boxes]
    heights = [scale * high for scale, (_, (_, high)) in zip(scales, boxes, strict=True)]
    total = _LEGEND + sum(heights) + len(views) * (_HEADING + _VIEW_GAP)
    canvas = SvgCanvas(GRAPH_WIDTH, total, _alternative(planned).in_language(language))
    _legend(canvas, language)
    top = _LEGEND
    for view, (lowest, (wide, _)), scale, height in zip(views, boxes, scales, heights, strict=True):
        top += _HEADING
        _heading(canvas, view, top, scale, language)
        placed = _Placed(view, scale, (GRAPH_WIDTH - scale * wide) / 2, top + height, lowest)
        _draw(canvas, placed, language)
        top += height + _VIEW_GAP
    return canvas.image()


def _extent(view: View) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the lower left corner of a view, and its width and height, mm."""
    notes = np.reshape([note.at for note in view.notes], (-1, 2))
    parts = [view.base, view.blocks, view.edges, view.way, view.arrows, notes]
    points = np.concatenate([part.reshape(-1, 2) for part in parts])
    low, high = points.min(axis=0), points.max(axis=0)
    wide, tall = np.maximum(high - low, 1.0).tolist()
    return (float(low[0]), float(low[1])), (wide, tall)


def _draw(canvas: Canvas, placed: _Placed, language: Language) -> None:
    view = placed.view
    for kind, sides, style in (("base", view.base, _BASE), ("block", view.blocks, _BLOCK)):
        for side in sides:
            canvas.outline(kind, [*_polyline(placed(side)), ("Z", ())], *style)
    for edge in view.edges:
        canvas.outline("working volume", _polyline(placed(edge)), _EXTENSION, None)
    canvas.outline("path", _polyline(placed(view.way)), _PATH, None)
    for touch in view.touches:
        _touch(canvas, placed, touch)
    for arrow in view.arrows:
        start, end = placed(arrow)
        _arrow(canvas, "axis", start, end, _DIMENSION)
    for note in view.notes:
        _note(canvas, placed, note, language)


def _touch(canvas: Canvas, placed: _Placed, touch: Touch) -> None:
    colour = _COLOURS[touch.side]
    start, end = placed(touch.start), placed(touch.end)
    stroke = Stroke(colour, 0.35)
    canvas.outline("tip", list(_circle(end, placed.scale * touch.radius)), stroke, Fill(colour, 0.12))
    _arrow(canvas, f"touch {touch.side.name.lower()}", start, end, Stroke(colour, 0.9))


def _arrow(canvas: Canvas, kind: str, start: FloatArray, end: FloatArray, stroke: Stroke) -> None:
    way = end - start
    length = float(np.hypot(*way))
    if not length:
        return
    along = way / length
    head = min(_LONGEST_HEAD, 0.7 * length)
    base, aside = end - head * along, 0.35 * head * np.array([-along[1], along[0]])
    canvas.outline(kind, _polyline(np.array([start, base])), stroke, None)
    corners = np.array([end, base + aside, base - aside])
    canvas.outline(kind, [*_polyline(corners), ("Z", ())], None, Fill(stroke.colour))


def _note(canvas: Canvas, placed: _Placed, note: Note, language: Language) -> None:
    size = GRAPH_TEXT_SIZE if note.side is None else _NUMBER_SIZE
    label = plain_label(note.text.in_language(language), size)
    x, y = placed(note.at).tolist()
    left = min(max(x - label.width / 2, _EDGE), GRAPH_WIDTH - _EDGE - label.width)
    if note.side is None:
        corners = np.array([[left, y + 2], [left + label.width, y + 2]])
        box = np.concatenate([corners, corners[::-1] - [0.0, label.height]])
        canvas.outline("ground", [*_polyline(box), ("Z", ())], None, _GROUND)
    baseline = y if note.side is None else y + label.rise
    _text(canvas, "note", label, left=left, baseline=baseline, side=note.side)


def _text(  # noqa: PLR0913 - what, in which colour, and where
    canvas: Canvas, kind: str, label: TextLabel, *, left: float, baseline: float, side: Side | None = None
) -> None:
    runs = [TextRun(run.text, run.face, run.size, left + run.x, baseline + run.y) for run in label.runs]
    canvas.text(kind, runs, INK_COLOUR if side is None else _COLOURS[side], 0.0)


def _heading(canvas: Canvas, view: View, top: float, scale: float, language: Language) -> None:
    """Write from where one looks, and draw how long a round length is."""
    label = plain_label(view.heading.in_language(language), GRAPH_TEXT_SIZE, FontFace.SEMIBOLD)
    baseline = top - _HEADING / 2
    _text(canvas, "heading", label, left=_EDGE, baseline=baseline)
    ticks, decimals = round_ticks(0.0, GRAPH_WIDTH / scale, _BAR_PART)
    length = ticks[1] - ticks[0]
    right, left = GRAPH_WIDTH - _EDGE, GRAPH_WIDTH - _EDGE - scale * length
    ends = [[left, baseline - 2], [left, baseline + 2], [left, baseline], [right, baseline]]
    ends += [[right, baseline - 2], [right, baseline + 2]]
    canvas.outline("scale", _polyline(np.array(ends)), _FRAME, None)
    value = fixed_number(length, decimals, language.decimal_sign)
    text = plain_label(f"{value} {MILLIMETRE.symbol}", GRAPH_TEXT_SIZE)
    _text(canvas, "scale", text, left=left - 4.0 - text.width, baseline=baseline + text.rise)


def _legend(canvas: Canvas, language: Language) -> None:
    left, height = _EDGE, _LEGEND / 2
    ends = np.array([[0.0, height], [18.0, height]])
    entries = [("path", _WAY, None), *(("touch", words, side) for side, words in _TOUCHES.items())]
    for kind, words, side in entries:
        start, end = ends + np.array([left, 0.0])
        if side is None:
            canvas.outline(kind, _polyline(np.array([start, end])), _PATH, None)
        else:
            _arrow(canvas, kind, start, end, Stroke(_COLOURS[side], 0.9))
        label = plain_label(words.in_language(language), GRAPH_TEXT_SIZE)
        _text(canvas, "legend", label, left=left + 22.0, baseline=height + label.rise)
        left += 22.0 + label.width + 16.0


def _polyline(points: FloatArray) -> list[Segment]:
    return [("L" if number else "M", (x, y)) for number, (x, y) in enumerate(points.tolist())]


def _circle(centre: FloatArray, radius: float) -> Iterator[Segment]:
    """Yield a circle as four cubic curves."""
    reach = 0.5523 * radius
    x, y = centre.tolist()
    yield "M", (x + radius, y)
    for cosine, sine in ((1, 0), (0, 1), (-1, 0), (0, -1)):
        first = (x + radius * cosine - reach * sine, y + radius * sine + reach * cosine)
        second = (x - radius * sine + reach * cosine, y + radius * cosine + reach * sine)
        yield "C", (*first, *second, x - radius * sine, y + radius * cosine)
    yield "Z", ()


def _alternative(planned: PlannedPath) -> Words:
    path = planned.path
    return _ALTERNATIVE.given(
        faces=len({probing.face for probing in path.probings}),
        gauge=path.gauge,
        kind=_KINDS[planned.settings.kind],
        points=len(path.probings),
        moves=len(path.moves),
        length=Words(f"{path.length:.2f}", f"{path.length:.2f}".replace(".", ",")),
    )
