"""A figure on given axes of matplotlib: for notebooks, and for pages of one's own.

This is the one place that knows matplotlib, and it is imported by nothing that makes a certificate. Layout,
brackets and labels are those of the page; they become artists at the values that they stand for, so axes
can be zoomed, and drawn upon further. Ticks and titles are the axes' own.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import rc_context
from matplotlib.artist import Artist
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.text import Annotation

from zlmreport.document.figures.canvas import TypeFace
from zlmreport.document.figures.draw import draw_legend, draw_panel
from zlmreport.document.figures.figure import Figure
from zlmreport.document.figures.layout import lay_out_alone, measure_figure, write_axis_title
from zlmreport.document.figures.metrics import find_font_file
from zlmreport.document.figures.shapes import (
    TEXT_SIZE,
    TICK_TEXT_SIZE,
    Frame,
    Lettering,
    Outline,
    PointMarks,
    PointShape,
    Shape,
)
from zlmreport.language import Language

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: What the axes draw themselves.
_OF_AXES = frozenset({"frame", "tick", "tick x", "tick y"})
_MARKERS = {PointShape.UP: "^", PointShape.DOWN: "v", PointShape.DISC: "o"}
_POINTS_PER_INCH = 72


def make_axes(figure: Figure) -> list[Axes]:
    """Return axes for a figure, one for each of its panels, in its size on a page."""
    from matplotlib import pyplot as plt  # noqa: PLC0415 - it keeps what it makes

    width, height = measure_figure(figure)
    _, axes = plt.subplots(
        len(figure.panels),
        1,
        squeeze=False,
        figsize=(width / _POINTS_PER_INCH, height / _POINTS_PER_INCH),
    )
    return list(axes[:, 0])


def put(figure: Figure, axes: Axes | Sequence[Axes], language: Language = Language.ENGLISH) -> None:
    """Draw a figure on axes: on one for each of its panels, from top to bottom.

    `axes`: Empty ones, in the size that they will have; legend and brackets stand inside.

    Raises `ValueError` if there are not as many axes as panels.
    """
    all_axes = list(axes) if isinstance(axes, Sequence | np.ndarray) else [axes]
    if len(all_axes) != len(figure.panels):
        raise ValueError(f"a figure of {len(figure.panels)} panels needs as many axes, not {len(all_axes)}")
    for number, each in enumerate(all_axes):
        with rc_context({"lines.scale_dashes": False}):  # dashes are told in points
            _put_panel(figure, number, each, language)


def _put_panel(figure: Figure, number: int, axes: Axes, language: Language) -> None:
    to_points = _POINTS_PER_INCH / axes.figure.dpi
    size = axes.bbox.width * to_points, axes.bbox.height * to_points
    layout = lay_out_alone(figure, number, language, *size)
    is_lowest = number == len(figure.panels) - 1
    _set_scales(layout.frame, axes, size, is_lowest=is_lowest, is_bare=layout.panel.projection != "straight")
    font = _make_font(TypeFace.REGULAR, TEXT_SIZE)
    axes.set_ylabel(
        write_axis_title(*figure.value_axis(figure.panels[number]), language), fontproperties=font
    )
    if is_lowest:
        axes.set_xlabel(write_axis_title(figure.x_title, figure.x_unit, language), fontproperties=font)
    shapes = chain(draw_panel(layout, is_lowest=is_lowest), draw_legend(layout))
    own = (shape for shape in shapes if shape.kind not in _OF_AXES)
    for place, artist in enumerate(artist for shape in own for artist in _make_artists(shape, layout.frame)):
        artist.set_zorder(1 + place / 1000)  # from back to front, as they come
        axes.add_artist(artist)


def _set_scales(
    frame: Frame, axes: Axes, size: tuple[float, float], *, is_lowest: bool, is_bare: bool
) -> None:
    """Set limits and ticks: the frame is a part of the axes, and the rest holds legend and brackets."""
    (left, bottom), (right, top) = frame.find_values(np.array([(0.0, 0.0), size])).tolist()
    axes.set(xlim=(left, right), ylim=(bottom, top))
    if is_bare:
        axes.set_aspect("equal")
        axes.set_axis_off()
        return
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.spines["bottom"].set_bounds(frame.x_scale.lower, frame.x_scale.upper)
    axes.spines["left"].set_bounds(frame.y_scale.lower, frame.y_scale.upper)
    font = _make_font(TypeFace.REGULAR, TICK_TEXT_SIZE)
    axes.set_xticks(frame.x_scale.ticks, frame.x_scale.labels, fontproperties=font)
    axes.set_xticks(frame.x_scale.marks, minor=True)
    axes.set_yticks(frame.y_scale.ticks, frame.y_scale.labels, fontproperties=font)
    axes.tick_params(labelbottom=is_lowest)


def _make_artists(shape: Shape, frame: Frame) -> Sequence[Artist]:
    """Return what draws a shape, at values of the frame."""
    match shape:
        case Outline():
            parts = shape.parts if shape.frame else [frame.find_values(part) for part in shape.parts]
            paths = (Path(part, closed=shape.is_closed) for part in parts)
            return [
                PathPatch(Path.make_compound_path(*paths), **_look(shape), capstyle="butt", joinstyle="miter")
            ]
        case PointMarks():
            points = shape.points if shape.frame else frame.find_values(shape.points)
            rim = {"mew": shape.stroke.width, "mec": shape.stroke.colour} if shape.stroke else {"mew": 0.0}
            inside = shape.fill.colour if shape.fill else "none"
            return [
                Line2D(*points.T, ls="none", marker=_MARKERS[shape.mark], ms=shape.size, mfc=inside, **rim)
            ]
        case Lettering():
            placed = shape.placed
            ((x, y),) = frame.find_values(np.array([(placed.x, placed.y)])).tolist()
            return [
                Annotation(
                    run.text,
                    (x, y),
                    (run.x, -run.y),
                    textcoords="offset points",
                    fontproperties=_make_font(run.face, run.size),
                    color=shape.colour,
                    parse_math=False,
                )
                for run in placed.label.runs
            ]


def _look(outline: Outline) -> dict[str, object]:
    stroke, fill = outline.stroke, outline.fill
    inside = (*fill.colour, fill.opacity) if fill else "none"
    if stroke is None:
        return {"facecolor": inside, "edgecolor": "none", "linewidth": 0.0}
    dashes = (0.0, stroke.dashes) if stroke.dashes else "solid"
    return {"facecolor": inside, "edgecolor": stroke.colour, "linewidth": stroke.width, "linestyle": dashes}


def _make_font(face: TypeFace, size: float) -> FontProperties:
    return FontProperties(fname=str(find_font_file(face)), size=size)
