"""Shapes as matplotlib artists.

matplotlib's own lines and texts take their defaults from a configuration that all threads of a process
share and that any user may have changed. These three take nothing from it: the same figure gives the
same drawing everywhere.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from matplotlib.artist import Artist
from matplotlib.backend_bases import GraphicsContextBase, RendererBase
from matplotlib.font_manager import FontProperties
from matplotlib.path import Path
from matplotlib.transforms import Affine2D, IdentityTransform, Transform

from zlmreport.figures.canvas import Colour, Face, Fill, Stroke
from zlmreport.figures.frame import Frame
from zlmreport.figures.metrics import font_file
from zlmreport.figures.shapes import Lettering, Marks, Outline, Shape
from zlmreport.figures.style import TRIANGLE_HALF_WIDTH, Mark


def artist(shape: Shape) -> Artist:
    """Return the artist that draws a shape."""
    match shape:
        case Outline():
            return _OutlineArtist(shape)
        case Marks():
            return _MarksArtist(shape)
        case Lettering():
            return _LetteringArtist(shape)


class _OutlineArtist(Artist):
    """Draws an outline as one path."""

    def __init__(self, outline: Outline) -> None:
        super().__init__()
        self._outline = outline
        self.set_transform(_transform(outline.frame))

    def draw(self, renderer: RendererBase) -> None:
        """Draw the path."""
        outline = self._outline
        context = _context(renderer, outline.stroke, outline.fill)
        renderer.open_group(outline.kind)
        renderer.draw_path(context, _path(outline), self.get_transform(), _face(outline.fill))
        renderer.close_group(outline.kind)
        context.restore()


class _MarksArtist(Artist):
    """Draws all marks at once."""

    def __init__(self, marks: Marks) -> None:
        super().__init__()
        self._marks = marks
        self.set_transform(_transform(marks.frame))

    def draw(self, renderer: RendererBase) -> None:
        """Draw the marks."""
        marks = self._marks
        context = _context(renderer, marks.stroke, marks.fill)
        renderer.open_group(marks.kind)
        renderer.draw_markers(
            context,
            _SHAPES[marks.mark],
            Affine2D().scale(marks.size),
            Path(marks.points),
            self.get_transform(),
            _face(marks.fill),
        )
        renderer.close_group(marks.kind)
        context.restore()


class _LetteringArtist(Artist):
    """Sets a label."""

    def __init__(self, lettering: Lettering) -> None:
        super().__init__()
        self._lettering = lettering

    def draw(self, renderer: RendererBase) -> None:
        """Set the runs of the label, one after the other within one group."""
        placed = self._lettering.placed
        context = renderer.new_gc()
        context.set_foreground(self._lettering.colour)
        cosine, sine = math.cos(math.radians(placed.angle)), math.sin(math.radians(placed.angle))
        _, height = renderer.get_canvas_width_height()
        renderer.open_group(self._lettering.kind)
        for run in placed.label.runs:
            x = placed.x + run.x * cosine + run.y * sine
            y = placed.y + run.x * sine - run.y * cosine
            y = height - y if renderer.flipy() else y
            renderer.draw_text(context, x, y, run.text, _font(run.face, run.size), placed.angle)
        renderer.close_group(self._lettering.kind)
        context.restore()


def _transform(frame: Frame | None) -> Transform:
    """Return the way from an outline's coordinates to places on the drawing."""
    if frame is None:
        return IdentityTransform()
    to_page = Affine2D().translate(-frame.x_scale.lower, -frame.y_scale.lower)
    return to_page.scale(frame.x_factor, frame.y_factor).translate(frame.box.left, frame.box.bottom)


def _path(outline: Outline) -> Path:
    if outline.is_closed:
        return Path.make_compound_path(*(Path(part, closed=True) for part in outline.parts))
    if len(outline.parts) == 1:
        return Path(outline.parts[0])  # without codes: with them, what follows a gap begins wrongly
    codes = [code for part in outline.parts for code in (Path.MOVETO, *[Path.LINETO] * (len(part) - 1))]
    return Path(np.concatenate(outline.parts), codes)


@cache
def _font(face: Face, size: float) -> FontProperties:
    return FontProperties(fname=str(font_file(face)), size=size)


def _context(renderer: RendererBase, stroke: Stroke | None, fill: Fill | None) -> GraphicsContextBase:
    context = renderer.new_gc()
    context.set_capstyle("butt")
    context.set_joinstyle("miter")
    context.set_linewidth(0.0)
    if stroke is not None:
        context.set_linewidth(stroke.width)
        context.set_foreground(stroke.colour)
        context.set_dashes(0.0, list(stroke.dashes) or None)
    if fill is not None:
        context.set_alpha(fill.opacity)
    return context


def _face(fill: Fill | None) -> Colour | None:
    return None if fill is None else fill.colour


def _triangle(direction: float) -> Path:
    half = TRIANGLE_HALF_WIDTH
    base, tip = -0.5 * direction, 0.5 * direction
    return Path([(-half, base), (half, base), (0.0, tip), (-half, base)], closed=True)


_SHAPES = {
    Mark.UP: _triangle(1.0),
    Mark.DOWN: _triangle(-1.0),
    Mark.DISC: Path.circle(radius=0.5),
}
