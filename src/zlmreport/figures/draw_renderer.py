"""matplotlib's way to a canvas: a renderer that hands on outlines and lines of text."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.backend_bases import GraphicsContextBase, RendererBase
from matplotlib.font_manager import FontProperties
from matplotlib.path import Path
from matplotlib.transforms import Affine2D, Transform

from zlmreport.figures.canvas import Canvas, Colour, Face, Fill, Run, Segment, Stroke
from zlmreport.figures.metrics import font_file
from zlmreport.quantities.arrays import FloatArray

_OPERATORS = {Path.MOVETO: "M", Path.LINETO: "L", Path.CURVE4: "C", Path.CLOSEPOLY: "Z"}
_FACES = {str(font_file(face)): face for face in Face}
_MIRROR = Affine2D().scale(1, -1)


class CanvasRenderer(RendererBase):
    """A renderer for the artists of `zlmreport.figures.draw_artists`, each of which is a group.

    Parameters
    ----------
    canvas
        What is drawn on.
    width, height
        Its size in points.
    """

    def __init__(self, canvas: Canvas, width: float, height: float) -> None:
        super().__init__()
        self._canvas = canvas
        self._size = (width, height)
        self._downwards = _MIRROR + Affine2D().translate(0, height)
        self._kind = ""
        self._runs: list[Run] = []
        self._colour: Colour = (0.0, 0.0, 0.0)
        self._angle = 0.0

    def get_canvas_width_height(self) -> tuple[float, float]:
        """Return the size of the canvas in points."""
        return self._size

    def open_group(self, s: str, gid: str | None = None) -> None:
        """Take note of what is drawn next."""
        del gid
        self._kind = s

    def close_group(self, s: str) -> None:
        """Set the runs of a label as one line of text, so that it is read as one."""
        if self._runs:
            self._canvas.text(s, self._runs, self._colour, self._angle)
            self._runs = []

    def draw_path(
        self,
        gc: GraphicsContextBase,
        path: Path,
        transform: Transform,
        rgbFace: Any = None,  # noqa: N803 - matplotlib's name
    ) -> None:
        """Draw a path; points that are not finite leave gaps."""
        self._outline(_segments(path, transform + self._downwards), gc, rgbFace)

    def draw_markers(  # noqa: PLR0913, PLR0917 - matplotlib's signature
        self,
        gc: GraphicsContextBase,
        marker_path: Path,
        marker_trans: Transform,
        path: Path,
        trans: Transform,
        rgbFace: Any = None,  # noqa: N803 - matplotlib's name
    ) -> None:
        """Draw all marks as one outline of many parts."""
        shape = _segments(marker_path, marker_trans + _MIRROR)
        places = (trans + self._downwards).transform(path.vertices)
        self._outline(_repeated(shape, places[np.isfinite(places).all(axis=1)]), gc, rgbFace)

    def draw_text(  # noqa: PLR0913, PLR0917 - matplotlib's signature
        self,
        gc: GraphicsContextBase,
        x: float,
        y: float,
        s: str,
        prop: FontProperties,
        angle: float,
        ismath: Any = False,  # noqa: FBT002 - matplotlib's signature
        mtext: Any = None,
    ) -> None:
        """Add a run to the line of text."""
        del ismath, mtext
        face = _FACES[str(prop.get_file())]
        self._runs.append(Run(s, face, prop.get_size_in_points(), x, y))
        self._colour, self._angle = _colour(gc), angle

    def _outline(self, segments: list[Segment], context: GraphicsContextBase, face: Any) -> None:
        stroke = None
        if context.get_linewidth():
            _, dashes = context.get_dashes()
            stroke = Stroke(
                _colour(context),
                context.get_linewidth(),
                () if dashes is None else tuple(np.asarray(dashes, dtype=np.float64).tolist()),
            )
        fill = None if face is None else Fill(face, context.get_alpha())
        if segments:
            self._canvas.outline(self._kind, segments, stroke, fill)


def _segments(path: Path, transform: Transform) -> list[Segment]:
    # Nothing is simplified away: every value that is given is drawn.
    return [
        (_OPERATORS[code], () if code == Path.CLOSEPOLY else tuple(np.asarray(points).tolist()))
        for points, code in path.iter_segments(transform, remove_nans=True, simplify=False)
    ]


def _repeated(shape: list[Segment], places: FloatArray) -> list[Segment]:
    """Return a shape drawn at each of some places, shape (N, 2)."""
    ends = np.cumsum([len(coordinates) for _, coordinates in shape]).tolist()
    corners = np.concatenate([coordinates for _, coordinates in shape]).reshape(-1, 2)
    rows = (places[:, np.newaxis, :] + corners).reshape(len(places), corners.size).tolist()
    return [
        (operator, tuple(row[end - len(coordinates) : end]))
        for row in rows
        for (operator, coordinates), end in zip(shape, ends, strict=True)
    ]


def _colour(context: GraphicsContextBase) -> Colour:
    red, green, blue, *_ = context.get_rgb()
    return red, green, blue
