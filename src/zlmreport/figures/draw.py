"""Drawing a figure: the one way in for everything that puts graphs on a page.

matplotlib stays behind this module; it is imported with it, so whoever draws imports it in the function
that draws.
"""

from __future__ import annotations

from matplotlib.figure import Figure as Sheet

from zlmreport.figures.canvas import Canvas
from zlmreport.figures.draw_artists import Lettering
from zlmreport.figures.draw_legend import legend_artists
from zlmreport.figures.draw_panel import panel_artists
from zlmreport.figures.draw_renderer import CanvasRenderer
from zlmreport.figures.figure import Figure
from zlmreport.figures.layout import WIDTH, figure_height, lay_out
from zlmreport.figures.style import INK
from zlmreport.figures.svg import SvgCanvas
from zlmreport.language import Language


def figure_size(figure: Figure) -> tuple[float, float]:
    """Return the width and height that a figure takes, in points."""
    return WIDTH, figure_height(figure)


def draw(figure: Figure, language: Language, canvas: Canvas) -> None:
    """Draw a figure on a canvas of its size."""
    layout = lay_out(figure, language)
    sheet = Sheet(figsize=(layout.width / 72, layout.height / 72), dpi=72, frameon=False)
    for panel in layout.panels:
        for artist in (*legend_artists(panel), *panel_artists(panel, is_lowest=panel is layout.panels[-1])):
            sheet.add_artist(artist)
    for title in layout.titles:
        sheet.add_artist(Lettering("title", title, INK))
    sheet.draw(CanvasRenderer(canvas, layout.width, layout.height))


def to_svg(figure: Figure, language: Language) -> str:
    """Return a figure as an SVG image, its text as text in the bundled typeface.

    The image names the typeface and does not carry it: set it into a page that has it.
    """
    canvas = SvgCanvas(*figure_size(figure), figure.alternative.in_language(language))
    draw(figure, language, canvas)
    return canvas.image()
