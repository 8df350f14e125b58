"""The door of formats that lay out pages: graphs drawn on a canvas, style sheets, fonts."""

from __future__ import annotations

from zlmreport.document.figures.canvas import (
    Canvas,
    Colour,
    Fill,
    Label as TextLabel,
    Run as TextRun,
    Segment,
    Stroke,
    SvgCanvas,
    TypeFace as FontFace,
    write_hexadecimal as hexadecimal_colour,
)
from zlmreport.document.figures.draw import (
    draw as draw_figure,
    to_svg as figure_to_svg,
)
from zlmreport.document.figures.layout import (
    WIDTH as GRAPH_WIDTH,
    measure_figure as figure_size,
)
from zlmreport.document.figures.metrics import (
    has_letter,
    make_plain_label as plain_label,
    mark_offset,
    measure_advance as text_advance,
)
from zlmreport.document.figures.scale import (
    round_ticks,
)
from zlmreport.document.figures.shapes import (
    INK as INK_COLOUR,
    ROLES as ROLE_STYLES,
    TEXT_SIZE as GRAPH_TEXT_SIZE,
)
from zlmreport.document.typesetting.resources import (
    FACES as FONT_FACES,
    digest_script as script_fingerprint,
    read_font as font_file,
    read_linked_script as linked_script,
    read_linked_style as linked_style,
    style_sheet,
    write_font_faces as font_face_rules,
    write_own_style as own_style,
)

__all__ = [
    "FONT_FACES",
    "GRAPH_TEXT_SIZE",
    "GRAPH_WIDTH",
    "INK_COLOUR",
    "ROLE_STYLES",
    "Canvas",
    "Colour",
    "Fill",
    "FontFace",
    "Segment",
    "Stroke",
    "SvgCanvas",
    "TextLabel",
    "TextRun",
    "draw_figure",
    "figure_size",
    "figure_to_svg",
    "font_face_rules",
    "font_file",
    "has_letter",
    "hexadecimal_colour",
    "linked_script",
    "linked_style",
    "mark_offset",
    "own_style",
    "plain_label",
    "round_ticks",
    "script_fingerprint",
    "style_sheet",
    "text_advance",
]
