"""Graphs as the template takes them: all outlines as one SVG image, and over it the labels as text.

Typst sets the labels as it sets every other text, so a symbol such as x̄ is one letter to whoever searches
or copies it. In an SVG image its bar would be a shape without a meaning.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

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
    hexadecimal_colour,
)
from zlmreport_plugins.renderers.pdf_typst.words import parted

_FACES = {FontFace.REGULAR: "regular", FontFace.ITALIC: "italic", FontFace.SEMIBOLD: "semibold"}
# A hundredth of a point is 4 µm of paper.
_OPERATORS = {"M": "M%.2f %.2f", "L": "L%.2f %.2f", "C": "C%.2f %.2f %.2f %.2f %.2f %.2f", "Z": "Z"}


def graph_data(figure: Figure, language: Language) -> dict[str, Any]:
    """Return a figure's drawing: its size in points, an image, and labels."""
    width, height = figure_size(figure)
    canvas = GraphCanvas()
    draw_figure(figure, language, canvas)
    return {
        "width": width,
        "height": height,
        "drawing": canvas.image(width, height),
        "labels": canvas.labels,
    }


class GraphCanvas:
    """A canvas that keeps outlines and text apart.

    Attributes
    ----------
    labels
        Each line of text in the order in which it was set: x and y of its beginning, angle, colour, and its
        runs, each with face, size, how far it lies below the first, and a stretch of text.
    """

    def __init__(self) -> None:
        self._paths: list[str] = []
        self.labels: list[list[Any]] = []

    def outline(
        self, kind: str, segments: Sequence[Segment], stroke: Stroke | None, fill: Fill | None
    ) -> None:
        """Add a path."""
        del kind
        data = "".join([_OPERATORS[operator] % points for operator, points in segments])
        self._paths.append(f'<path d="{data}"{_look(stroke, fill)}/>')

    def text(self, kind: str, runs: Sequence[TextRun], colour: Colour, angle: float) -> None:
        """Keep a line of text."""
        del kind
        first = runs[0]
        spans = [
            [_FACES[run.face], run.size, run.y - first.y, *stretch]
            for run in runs
            for stretch in parted(run.text, run.face)
        ]
        self.labels.append([first.x, first.y, angle, hexadecimal_colour(colour), spans])

    def image(self, width: float, height: float) -> str:
        """Return the outlines as an SVG image of a size in points."""
        size = f'width="{width}pt" height="{height}pt" viewBox="0 0 {width} {height}"'
        return "".join((f'<svg xmlns="http://www.w3.org/2000/svg" {size}>', *self._paths, "</svg>"))


@cache
def _look(stroke: Stroke | None, fill: Fill | None) -> str:
    """Return the attributes of a path: a drawing has a few looks, and they come again and again."""
    inside = (
        f' fill="{hexadecimal_colour(fill.colour)}" fill-opacity="{fill.opacity}"' if fill else ' fill="none"'
    )
    if stroke is None:
        return inside
    dashes = f' stroke-dasharray="{" ".join(map(str, stroke.dashes))}"' if stroke.dashes else ""
    return f'{inside} stroke="{hexadecimal_colour(stroke.colour)}" stroke-width="{stroke.width}"{dashes}'
