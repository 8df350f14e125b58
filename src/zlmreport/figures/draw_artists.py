"""What a drawn figure is made of: outlines, marks and labels as matplotlib artists.

matplotlib's own lines and texts take their defaults from a configuration that all threads of a process
share and that any user may have changed. These three take nothing from it: the same figure gives the
same drawing everywhere.
"""

from __future__ import annotations

import math
from functools import cache

from matplotlib.artist import Artist
from matplotlib.backend_bases import GraphicsContextBase, RendererBase
from matplotlib.font_manager import FontProperties
from matplotlib.path import Path
from matplotlib.transforms import Affine2D, Transform

from zlmreport.figures.canvas import Colour, Face, Fill, Stroke
from zlmreport.figures.draw_lettering import font_file
from zlmreport.figures.frame import PlacedLabel
from zlmreport.figures.style import Mark


class Outline(Artist):
    """A path, filled, stroked or both; `kind` says what it is."""

    def __init__(
        self, kind: str, path: Path, transform: Transform, stroke: Stroke | None, fill: Fill | None = None
    ) -> None:
        super().__init__()
        self.kind = kind
        self.path = path
        self.stroke = stroke
        self.fill = fill
        self.set_transform(transform)

    def draw(self, renderer: RendererBase) -> None:
        """Draw the path."""
        context = _context(renderer, self.stroke, self.fill)
        renderer.open_group(self.kind)
        renderer.draw_path(context, self.path, self.get_transform(), _face(self.fill))
        renderer.close_group(self.kind)
        context.restore()


class Marks(Artist):
    """A mark at each point of a path; of a filled mark the stroke is the rim."""

    def __init__(  # noqa: PLR0913, PLR0917 - a mark has a shape, a size, a rim and an inside
        self,
        kind: str,
        points: Path,
        transform: Transform,
        mark: Mark,
        size: float,
        stroke: Stroke | None,
        fill: Fill | None = None,
    ) -> None:
        super().__init__()
        self.kind = kind
        self.points = points
        self.shape = _SHAPES[mark]
        self.size = Affine2D().scale(size)
        self.stroke = stroke
        self.fill = fill
        self.set_transform(transform)

    def draw(self, renderer: RendererBase) -> None:
        """Draw the marks."""
        context = _context(renderer, self.stroke, self.fill)
        renderer.open_group(self.kind)
        renderer.draw_markers(
            context, self.shape, self.size, self.points, self.get_transform(), _face(self.fill)
        )
        renderer.close_group(self.kind)
        context.restore()


class Lettering(Artist):
    """A label at its place."""

    def __init__(self, kind: str, placed: PlacedLabel, colour: Colour) -> None:
        super().__init__()
        self.kind = kind
        self.placed = placed
        self.colour = colour

    def draw(self, renderer: RendererBase) -> None:
        """Set the runs of the label, one after the other within one group."""
        placed = self.placed
        context = renderer.new_gc()
        context.set_foreground(self.colour)
        cosine, sine = math.cos(math.radians(placed.angle)), math.sin(math.radians(placed.angle))
        _, height = renderer.get_canvas_width_height()
        renderer.open_group(self.kind)
        for run in placed.label.runs:
            x = placed.x + run.x * cosine + run.y * sine
            y = placed.y + run.x * sine - run.y * cosine
            y = height - y if renderer.flipy() else y
            renderer.draw_text(context, x, y, run.text, _font(run.face, run.size), placed.angle)
        renderer.close_group(self.kind)
        context.restore()


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
    half = 0.5 / math.cos(math.pi / 6)
    base, tip = -0.5 * direction, 0.5 * direction
    return Path([(-half, base), (half, base), (0.0, tip), (-half, base)], closed=True)


_SHAPES = {
    Mark.UP: _triangle(1.0),
    Mark.DOWN: _triangle(-1.0),
    Mark.DISC: Path.circle(radius=0.5),
}
