"""Graphs drawn straight into a page of WeasyPrint.

An image of a document is anything with `get_intrinsic_size` and `draw` in the ``cache`` mapping of
``write_pdf``, under the address that the document names: ``<img src="graph:0" alt="…">``. So a graph needs
no SVG in between, its text is text of the document's own fonts, and the image's alternative text tags it.

This leans on parts of WeasyPrint 70 that are no public interface: the page's stream, and text laid out
by Pango. Tests hold them; `zlmreport.figures.draw.to_svg` is the other way.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import pydyf
from weasyprint.css.properties import INITIAL_VALUES
from weasyprint.draw.text import draw_first_line
from weasyprint.matrix import Matrix
from weasyprint.text.line_break import create_layout

from zlmreport.plugin import (
    Colour,
    Figure,
    Fill,
    FontFace,
    Language,
    Segment,
    Stroke,
    TextRun,
    draw_figure,
    figure_size,
)

#: The family under which the document's style sheet brings the bundled faces in.
FAMILY = "IBM Plex Sans"

_PIXELS_PER_POINT = 96 / 72
_FACES = {
    FontFace.REGULAR: ("normal", 400),
    FontFace.ITALIC: ("italic", 400),
    FontFace.SEMIBOLD: ("normal", 600),
}
# A hundredth of a point is 4 µm of paper.
_OPERATORS = {"M": "%.2f %.2f m", "L": "%.2f %.2f l", "C": "%.2f %.2f %.2f %.2f %.2f %.2f c", "Z": "h"}
_PAINTING = {(True, False): "S", (False, True): "f", (True, True): "B"}


class PageGraph:
    """A figure as an image of a document."""

    def __init__(self, figure: Figure, language: Language) -> None:
        self._figure = figure
        self._language = language

    def get_intrinsic_size(self, image_resolution: float, font_size: float) -> tuple[float, float, float]:
        """Return width and height in CSS pixels, and their ratio."""
        del image_resolution, font_size
        width, height = figure_size(self._figure)
        return width * _PIXELS_PER_POINT, height * _PIXELS_PER_POINT, width / height

    def draw(self, stream: Any, concrete_width: float, concrete_height: float, style: Any) -> None:
        """Draw the figure into the page, in the size that the document gives it."""
        width, height = figure_size(self._figure)
        stream.transform(a=concrete_width / width, d=concrete_height / height)
        draw_figure(self._figure, self._language, StreamCanvas(stream, style.font_config))


class StreamCanvas:
    """A canvas on a page's stream, whose unit is the point and whose y axis points downwards.

    Parameters
    ----------
    stream
        WeasyPrint's stream; its state belongs to this canvas alone.
    font_config
        The document's fonts.
    """

    def __init__(self, stream: Any, font_config: Any) -> None:
        self._stream = stream
        self._style = _TextStyle(INITIAL_VALUES, font_family=[FAMILY])
        self._style.font_config = font_config
        self._stroke: Stroke | None = None
        self._fill: Fill | None = None

    def outline(
        self, kind: str, segments: Sequence[Segment], stroke: Stroke | None, fill: Fill | None
    ) -> None:
        """Draw an outline."""
        del kind
        if stroke is not None:
            self._take_stroke(stroke)
        if fill is not None:
            self._take_fill(fill)
        path = [_OPERATORS[operator] % points for operator, points in segments]
        self._stream.stream.append("\n".join((*path, _PAINTING[stroke is not None, fill is not None])))

    def text(self, kind: str, runs: Sequence[TextRun], colour: Colour, angle: float) -> None:
        """Set a line of text, each run laid out by Pango as the document's own text is."""
        del kind
        self._take_fill(Fill(colour))
        cosine, sine = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        self._stream.begin_marked_content("Span", _meant(runs))
        self._stream.begin_text()
        for run in runs:
            self._style["font_style"], self._style["font_weight"] = _FACES[run.face]
            self._style["font_size"] = run.size
            layout = create_layout(run.text, self._style, None, None, 0)
            matrix = Matrix(cosine, -sine, -sine, -cosine, run.x, run.y)
            draw_first_line(self._stream, _TextBox(layout, self._style), "none", "none", matrix)
        self._stream.end_text()
        self._stream.end_marked_content()

    def _take_stroke(self, stroke: Stroke) -> None:
        if stroke != self._stroke:
            self._stream.set_color_rgb(*stroke.colour, stroke=True)
            self._stream.set_line_width(stroke.width)
            self._stream.set_dash(stroke.dashes, 0)
            self._stroke = stroke

    def _take_fill(self, fill: Fill) -> None:
        if fill != self._fill:
            self._stream.set_color_rgb(*fill.colour)
            self._stream.set_alpha(fill.opacity)
            self._fill = fill


def _meant(runs: Sequence[TextRun]) -> Any:
    """Return what a symbol reads as: some readers see a space where a bar ends or an index begins."""
    return pydyf.Dictionary({"ActualText": pydyf.String("".join(run.text for run in runs))})


class _TextStyle(dict[str, Any]):
    """Computed style of a text: WeasyPrint wants a mapping with the fonts as an attribute."""

    font_config: Any


class _TextBox:
    """What WeasyPrint wants to know of a line of text."""

    def __init__(self, layout: Any, style: _TextStyle) -> None:
        self.pango_layout = layout
        self.style = style
        self.text = layout.text
