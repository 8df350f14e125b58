"""What ``plan`` tells of a probing path: sentences, JSON, the table of moves, and the drawing.

Its views are drawn below each other, in the style of the graphs.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from zlmreport.plugin import (
    MILLIMETRE,
    FloatArray,
    InputError,
    Language,
    Words,
    counted,
    fixed_number,
    general_number,
)
from zlmreport.plugin.extension import ExtensionPlan, Job
from zlmreport.plugin.page import (
    GRAPH_TEXT_SIZE,
    GRAPH_WIDTH,
    INK_COLOUR,
    ROLE_STYLES,
    Canvas,
    Fill,
    FontFace,
    Segment,
    Stroke,
    SvgCanvas,
    TextLabel,
    TextRun,
    plain_label,
    round_ticks,
)
from zlmreport.plugin.standard import Role
from zlmreport_step_gauge.gauge import Side
from zlmreport_step_gauge.keys import StepGaugeKeys
from zlmreport_step_gauge.paths.path import Move, PathKind, Point, Probing, ProbingPath
from zlmreport_step_gauge.paths.plan import PlannedPath, plan_path_of_job
from zlmreport_step_gauge.paths.room import find_least_gap
from zlmreport_step_gauge.paths.views import PlacedText, Touch, View, make_path_views

SCHEMA = "zlmreport/probing-path/1"
_MINUTE = 60.0
_KINDS = {
    PathKind.VERTICAL: "over the top of the blocks",
    PathKind.HORIZONTAL: "round the right side of the blocks, seen along the gauge",
}


def foretell(job: Job, keys: StepGaugeKeys) -> ExtensionPlan:
    """Return the plan of the path over the step gauge of a job; its points need not exist."""
    if "plan" in job.tree.entries:
        raise InputError.at(
            job.place_of("plan"),
            "plan is about a test of target positions, and this job has a step gauge, whose path is "
            "step_gauge.path; take one of them out",
        )
    planned = plan_path_of_job(job, keys)
    path = planned.path
    faces = {probing.face for probing in path.probings}
    sizes = ((len(faces), "face"), (planned.settings.cycles, "cycle"), (len(path.probings), "point"))
    size = ", ".join(counted(number, thing) for number, thing in sizes)
    return ExtensionPlan(
        heading=(path.number, f"{path.gauge}: {size}"),
        parts=(
            ("gauge", f"faces {min(faces)} to {max(faces)}, mm", tuple(_say_of_gauge(planned))),
            (
                "path",
                f"{planned.settings.kind.value}, {_KINDS[planned.settings.kind]}",
                tuple(_say_of_path(planned)),
            ),
        ),
        values=_collect_values(planned),
        subject=lambda place: replace(path, place=place),
        files=lambda: _make_files(planned, job.keys.certificate.language),
        files_in_words="a picture of the path",
        next_step="look at the picture, probe the gauge",
    )


def _make_files(planned: PlannedPath, language: Language) -> dict[str, str]:
    """Return the picture of the path, and its moves as a table."""
    return {
        "path.svg": draw_path(planned, language),
        "path.csv": "".join(f"{line}\n" for line in _make_rows(planned.path)),
    }


def _make_rows(path: ProbingPath) -> Iterator[str]:
    yield "# moves of the tip's centre, and the points of the surface that measuring moves lead to, mm"
    yield "move,kind,face,cycle,x,y,z,i,j,k"
    for number, move in enumerate(path.moves, start=1):
        kind, point, normal = _split_move(move)
        which = [str(each or "") for each in (move.face, move.cycle)]
        along = [f"{each:.7f}" for each in normal] if normal else ["", "", ""]
        yield ",".join([str(number), kind, *which, *(f"{_write_mm(at):.5f}" for at in point), *along])


def _split_move(move: Move) -> tuple[str, Point, Point | None]:
    """Return what a move is called, where it leads to, and the normal of the surface that it measures."""
    return ("measure", move.target, move.normal) if isinstance(move, Probing) else ("move", move.to, None)


def _say_of_gauge(planned: PlannedPath) -> Iterator[str]:
    path = planned.path
    last = max(probing.face for probing in path.probings)
    ends = [_write_point(probing.target) for probing in (path.probings[0], _find_probing_of_face(path, last))]
    yield f"from {ends[0]} to {ends[1]}"
    yield f"direction ({', '.join(fixed_number(each, 6) for each in planned.frame.axes[0].tolist())})"


def _say_of_path(planned: PlannedPath) -> Iterator[str]:
    path = planned.path
    yield "each cycle takes front faces on the way forward and back faces on the way back"
    yield ", ".join(
        f"{name} {general_number(_write_mm(value))} mm"
        for name, value in (
            ("tip radius", path.tip_radius),
            ("clearance", planned.settings.clearance),
            ("approach", path.approach),
            ("retract", path.retract),
        )
    )
    gap, name = find_least_gap(path, planned.room)
    yield f"free of collisions: the tip stays {fixed_number(_write_mm(gap), 2)} mm from {name}"
    speed, measuring = (general_number(_write_mm(each)) for each in (path.speed, path.measuring_speed))
    minutes = max(1, round(path.duration / _MINUTE))
    yield (
        f"{len(path.moves)} moves, {fixed_number(path.length, 2)} m at {speed} mm/s, "
        f"measuring {measuring} mm/s: about {minutes} min"
    )


def _find_probing_of_face(path: ProbingPath, face: int) -> Probing:
    return next(probing for probing in path.probings if probing.face == face)


def _write_point(point: Point) -> str:
    return f"({', '.join(fixed_number(_write_mm(at), 3) for at in point)})"


def _write_mm(length: float) -> float:
    return MILLIMETRE.from_si(length)


def _collect_values(planned: PlannedPath) -> dict[str, Any]:
    """Return a path as plain values for JSON, mm and s."""
    path = planned.path
    gap, name = find_least_gap(path, planned.room)
    return {
        "schema": SCHEMA,
        "certificate": {"number": path.number},
        "gauge": path.gauge,
        "units": {"position": "mm", "time": "s"},
        "kind": planned.settings.kind.value,
        "cycles": planned.settings.cycles,
        "faces": sorted({probing.face for probing in path.probings}),
        "direction": planned.frame.axes[0].tolist(),
        "travelled": _write_mm(path.length),
        "duration": path.duration,
        "least_gap": {"value": _write_mm(gap), "beside": name},
        "moves": [
            {
                "kind": kind,
                "face": move.face or None,
                "cycle": move.cycle or None,
                "to": [_write_mm(at) for at in point],
                "normal": normal and list(normal),
            }
            for move in path.moves
            for kind, point, normal in [_split_move(move)]
        ],
    }


_ALTERNATIVE = Words(
    "Path of the probe over {faces} faces of {gauge}, {kind}: {points} points in {moves} moves, {length} m."
)
_DRAWN_KINDS = {
    PathKind.VERTICAL: Words("over the top of the blocks"),
    PathKind.HORIZONTAL: Words("round the side of the blocks"),
}
_WAY = Words("path of the tip's centre, first cycle")
_TOUCHES = {
    Side.FRONT: Words("measuring move, front face"),
    Side.BACK: Words("measuring move, back face"),
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


def draw_path(planned: PlannedPath, language: Language) -> str:
    """Return the picture of a path as an SVG image."""
    views = make_path_views(planned)
    boxes = [_find_extent(view) for view in views]
    scales = [min((GRAPH_WIDTH - 2 * _EDGE) / wide, _TALLEST / high) for _, (wide, high) in boxes]
    heights = [scale * high for scale, (_, (_, high)) in zip(scales, boxes, strict=True)]
    total = _LEGEND + sum(heights) + len(views) * (_HEADING + _VIEW_GAP)
    canvas = SvgCanvas(GRAPH_WIDTH, total, _describe_in_words(planned).in_language(language))
    _draw_legend(canvas, language)
    top = _LEGEND
    for view, (lowest, (wide, _)), scale, height in zip(views, boxes, scales, heights, strict=True):
        top += _HEADING
        _draw_heading(canvas, view, top, scale, language)
        placed = _Placed(view, scale, (GRAPH_WIDTH - scale * wide) / 2, top + height, lowest)
        _draw_view(canvas, placed, language)
        top += height + _VIEW_GAP
    return canvas.image()


def _find_extent(view: View) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the lower left corner of a view, and its width and height, mm."""
    notes = np.reshape([note.at for note in view.notes], (-1, 2))
    parts = [view.base, view.blocks, view.edges, view.way, view.arrows, notes]
    points = np.concatenate([part.reshape(-1, 2) for part in parts])
    low, high = points.min(axis=0), points.max(axis=0)
    wide, tall = np.maximum(high - low, 1.0).tolist()
    return (float(low[0]), float(low[1])), (wide, tall)


def _draw_view(canvas: Canvas, placed: _Placed, language: Language) -> None:
    view = placed.view
    for kind, sides, style in (("base", view.base, _BASE), ("block", view.blocks, _BLOCK)):
        for side in sides:
            canvas.outline(kind, [*_draw_polyline(placed(side)), ("Z", ())], *style)
    for edge in view.edges:
        canvas.outline("working volume", _draw_polyline(placed(edge)), _EXTENSION, None)
    canvas.outline("path", _draw_polyline(placed(view.way)), _PATH, None)
    for touch in view.touches:
        _draw_touch(canvas, placed, touch)
    for arrow in view.arrows:
        start, end = placed(arrow)
        _draw_arrow(canvas, "axis", start, end, _DIMENSION)
    for note in view.notes:
        _draw_note(canvas, placed, note, language)


def _draw_touch(canvas: Canvas, placed: _Placed, touch: Touch) -> None:
    colour = _COLOURS[touch.side]
    start, end = placed(touch.start), placed(touch.end)
    stroke = Stroke(colour, 0.35)
    canvas.outline("tip", list(_draw_circle(end, placed.scale * touch.radius)), stroke, Fill(colour, 0.12))
    _draw_arrow(canvas, f"touch {touch.side.name.lower()}", start, end, Stroke(colour, 0.9))


def _draw_arrow(canvas: Canvas, kind: str, start: FloatArray, end: FloatArray, stroke: Stroke) -> None:
    way = end - start
    length = float(np.hypot(*way))
    if not length:
        return
    along = way / length
    head = min(_LONGEST_HEAD, 0.7 * length)
    base, aside = end - head * along, 0.35 * head * np.array([-along[1], along[0]])
    canvas.outline(kind, _draw_polyline(np.array([start, base])), stroke, None)
    corners = np.array([end, base + aside, base - aside])
    canvas.outline(kind, [*_draw_polyline(corners), ("Z", ())], None, Fill(stroke.colour))


def _draw_note(canvas: Canvas, placed: _Placed, note: PlacedText, language: Language) -> None:
    size = GRAPH_TEXT_SIZE if note.side is None else _NUMBER_SIZE
    label = plain_label(note.text.in_language(language), size)
    x, y = placed(note.at).tolist()
    left = min(max(x - label.width / 2, _EDGE), GRAPH_WIDTH - _EDGE - label.width)
    if note.side is None:
        corners = np.array([[left, y + 2], [left + label.width, y + 2]])
        box = np.concatenate([corners, corners[::-1] - [0.0, label.height]])
        canvas.outline("ground", [*_draw_polyline(box), ("Z", ())], None, _GROUND)
    baseline = y if note.side is None else y + label.rise
    _place_text(canvas, "note", label, left=left, baseline=baseline, side=note.side)


def _place_text(  # noqa: PLR0913 - what, in which colour, and where
    canvas: Canvas, kind: str, label: TextLabel, *, left: float, baseline: float, side: Side | None = None
) -> None:
    runs = [TextRun(run.text, run.face, run.size, left + run.x, baseline + run.y) for run in label.runs]
    canvas.text(kind, runs, INK_COLOUR if side is None else _COLOURS[side], 0.0)


def _draw_heading(canvas: Canvas, view: View, top: float, scale: float, language: Language) -> None:
    """Write from where one looks, and draw how long a round length is."""
    label = plain_label(view.heading.in_language(language), GRAPH_TEXT_SIZE, FontFace.SEMIBOLD)
    baseline = top - _HEADING / 2
    _place_text(canvas, "heading", label, left=_EDGE, baseline=baseline)
    ticks, decimals = round_ticks(0.0, GRAPH_WIDTH / scale, _BAR_PART)
    length = ticks[1] - ticks[0]
    right, left = GRAPH_WIDTH - _EDGE, GRAPH_WIDTH - _EDGE - scale * length
    ends = [[left, baseline - 2], [left, baseline + 2], [left, baseline], [right, baseline]]
    ends += [[right, baseline - 2], [right, baseline + 2]]
    canvas.outline("scale", _draw_polyline(np.array(ends)), _FRAME, None)
    value = fixed_number(length, decimals, language.decimal_sign)
    text = plain_label(f"{value} {MILLIMETRE.symbol}", GRAPH_TEXT_SIZE)
    _place_text(canvas, "scale", text, left=left - 4.0 - text.width, baseline=baseline + text.rise)


def _draw_legend(canvas: Canvas, language: Language) -> None:
    left, height = _EDGE, _LEGEND / 2
    ends = np.array([[0.0, height], [18.0, height]])
    entries = [("path", _WAY, None), *(("touch", words, side) for side, words in _TOUCHES.items())]
    for kind, words, side in entries:
        start, end = ends + np.array([left, 0.0])
        if side is None:
            canvas.outline(kind, _draw_polyline(np.array([start, end])), _PATH, None)
        else:
            _draw_arrow(canvas, kind, start, end, Stroke(_COLOURS[side], 0.9))
        label = plain_label(words.in_language(language), GRAPH_TEXT_SIZE)
        _place_text(canvas, "legend", label, left=left + 22.0, baseline=height + label.rise)
        left += 22.0 + label.width + 16.0


def _draw_polyline(points: FloatArray) -> list[Segment]:
    return [("L" if number else "M", (x, y)) for number, (x, y) in enumerate(points.tolist())]


def _draw_circle(centre: FloatArray, radius: float) -> Iterator[Segment]:
    """Yield a circle as four cubic curves."""
    reach = 0.5523 * radius
    x, y = centre.tolist()
    yield "M", (x + radius, y)
    for cosine, sine in ((1, 0), (0, 1), (-1, 0), (0, -1)):
        first = (x + radius * cosine - reach * sine, y + radius * sine + reach * cosine)
        second = (x - radius * sine + reach * cosine, y + radius * cosine + reach * sine)
        yield "C", (*first, *second, x - radius * sine, y + radius * cosine)
    yield "Z", ()


def _describe_in_words(planned: PlannedPath) -> Words:
    path = planned.path
    return _ALTERNATIVE.given(
        faces=len({probing.face for probing in path.probings}),
        gauge=path.gauge,
        kind=_DRAWN_KINDS[planned.settings.kind],
        points=len(path.probings),
        moves=len(path.moves),
        length=round(path.length, 2),
    )
