"""Drawing a figure by matplotlib: the one way in for pages that hold its drawings.

matplotlib stays behind this module; it is imported with it, so whoever draws imports it in the function
that draws. `zlmreport.figures.pen` draws the same without it.
"""

from __future__ import annotations

from matplotlib.figure import Figure as Sheet

from zlmreport.figures.canvas import Canvas
from zlmreport.figures.draw_artists import artist
from zlmreport.figures.draw_renderer import CanvasRenderer
from zlmreport.figures.figure import Figure
from zlmreport.figures.layout import lay_out
from zlmreport.figures.sketch import figure_size, sketch
from zlmreport.figures.svg import SvgCanvas
from zlmreport.language import Language


def draw(figure: Figure, language: Language, canvas: Canvas) -> None:
    """Draw a figure on a canvas of its size."""
    layout = lay_out(figure, language)
    sheet = Sheet(figsize=(layout.width / 72, layout.height / 72), dpi=72, frameon=False)
    for shape in sketch(layout):
        sheet.add_artist(artist(shape))
    sheet.draw(CanvasRenderer(canvas, layout.width, layout.height))


def to_svg(figure: Figure, language: Language) -> str:
    """Return a figure as an SVG image, its text as text in the bundled typeface.

    The image names the typeface and does not carry it: set it into a page that has it.
    """
    canvas = SvgCanvas(*figure_size(figure), figure.alternative.in_language(language))
    draw(figure, language, canvas)
    return canvas.image()
