"""A figure as a series of shapes, from back to front."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.figures.figure import Figure
from zlmreport.figures.layout import WIDTH, FigureLayout, figure_height
from zlmreport.figures.shapes import Lettering, Shape
from zlmreport.figures.sketch_legend import legend_shapes
from zlmreport.figures.sketch_panel import panel_shapes
from zlmreport.figures.style import INK


def figure_size(figure: Figure) -> tuple[float, float]:
    """Return the width and height that a figure takes, in points."""
    return WIDTH, figure_height(figure)


def sketch(layout: FigureLayout) -> Iterator[Shape]:
    """Yield everything that a figure is made of."""
    for panel in layout.panels:
        yield from legend_shapes(panel)
        yield from panel_shapes(panel, is_lowest=panel is layout.panels[-1])
    for title in layout.titles:
        yield Lettering("title", title, INK)
