"""Drawing a figure on a canvas: shapes become outlines and lines of text at places of the canvas."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from zlmreport.figures.canvas import Canvas, Run, Segment, SvgCanvas
from zlmreport.figures.figure import Figure
from zlmreport.figures.layout import figure_size, lay_out
from zlmreport.figures.shapes import TRIANGLE_HALF_WIDTH, Frame, Lettering, Mark, Marks, Outline
from zlmreport.figures.sketch import sketch
from zlmreport.language import Language
from zlmreport.quantities.arrays import FloatArray

#: Of a quarter circle of radius 1, the distance of a control point from its end.
_QUARTER = 4 / 3 * (math.sqrt(2) - 1)


def draw(figure: Figure, language: Language, canvas: Canvas) -> None:
    """Draw a figure on a canvas of its size."""
    layout = lay_out(figure, language)
    pen = _Pen(canvas, layout.height)
    for shape in sketch(layout):
        match shape:
            case Outline():
                pen.outline(shape)
            case Marks():
                pen.marks(shape)
            case Lettering():
                pen.lettering(shape)


def to_svg(figure: Figure, language: Language) -> str:
    """Return a figure as an SVG image, its text as text in the bundled typeface.

    The image names the typeface and does not carry it: set it into a page that has it.
    """
    canvas = SvgCanvas(*figure_size(figure), figure.alternative.in_language(language))
    draw(figure, language, canvas)
    return canvas.image()


class _Pen:
    """Hands shapes on to a canvas of a height, on which y points downwards."""

    def __init__(self, canvas: Canvas, height: float) -> None:
        self._canvas = canvas
        self._height = height

    def outline(self, outline: Outline) -> None:
        """Draw an outline."""
        places = self._places(np.concatenate(outline.parts), outline.frame).tolist()
        segments: list[Segment] = []
        begin = 0
        for part in outline.parts:
            end = begin + len(part)
            if outline.is_closed:
                segments += _line(places[begin : end - 1])
                segments.append(("Z", ()))
            else:
                segments += _line(places[begin:end])
            begin = end
        if segments:
            self._canvas.outline(outline.kind, segments, outline.stroke, outline.fill)

    def marks(self, marks: Marks) -> None:
        """Draw all marks as one outline of many parts."""
        places = self._places(marks.points, marks.frame)
        places = places[np.isfinite(places).all(axis=1)]
        segments: list[tuple[Segment, ...]] = []
        for operator, points in _SHAPES[marks.mark]:
            corners = marks.size * np.reshape(points, (-1, 2)) * (1.0, -1.0)
            rows = (places[:, np.newaxis, :] + corners).reshape(len(places), len(points)).tolist()
            segments.append(tuple((operator, tuple(row)) for row in rows))
        if len(places):
            drawn = [segment for mark in zip(*segments, strict=True) for segment in mark]
            self._canvas.outline(marks.kind, drawn, marks.stroke, marks.fill)

    def lettering(self, lettering: Lettering) -> None:
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

    def _places(self, points: FloatArray, frame: Frame | None) -> FloatArray:
        """Return where points lie on the canvas, shape (N, 2)."""
        if frame is not None:
            points = (points - (frame.x_scale.lower, frame.y_scale.lower)) * (
                frame.x_factor,
                frame.y_factor,
            ) + (frame.box.left, frame.box.bottom)
        return points * (1.0, -1.0) + (0.0, self._height)


def _line(places: Sequence[Sequence[float]]) -> Iterator[Segment]:
    """Yield a line from place to place; it is broken where a place does not exist."""
    operator = "M"
    for x, y in places:
        if math.isfinite(x) and math.isfinite(y):
            yield operator, (x, y)
            operator = "L"
        else:
            operator = "M"


def _triangle(direction: float) -> list[Segment]:
    half = TRIANGLE_HALF_WIDTH
    base, tip = -0.5 * direction, 0.5 * direction
    return [("M", (-half, base)), ("L", (half, base)), ("L", (0.0, tip)), ("Z", ())]


def _circle() -> list[Segment]:
    """Return a circle of diameter 1 as four curves, anticlockwise from its right."""
    turn, quarter = np.array([(0.0, 1.0), (-1.0, 0.0)]), [(1.0, _QUARTER), (_QUARTER, 1.0), (0.0, 1.0)]
    curves: list[Segment] = []
    points = 0.5 * np.array(quarter)
    for _ in range(4):
        curves.append(("C", tuple(points.ravel().tolist())))
        points = points @ turn
    return [("M", (0.5, 0.0)), *curves, ("Z", ())]


_SHAPES = {Mark.UP: _triangle(1.0), Mark.DOWN: _triangle(-1.0), Mark.DISC: _circle()}
