"""A legend's layout as shapes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.figures.figure import Band
from zlmreport.figures.frame import Box, PlacedLabel
from zlmreport.figures.legend import LEGEND_GAP, LINE_SAMPLE, MARK_SAMPLE, Entry
from zlmreport.figures.panel_layout import PanelLayout
from zlmreport.figures.shapes import Lettering, Shape, area, lines
from zlmreport.figures.sketch_panel import curve_marks, reading_marks
from zlmreport.figures.style import INK, ROLES

_HALF_SWATCH = 3.25


def legend_shapes(layout: PanelLayout) -> Iterator[Shape]:
    """Return the shapes of the heading and the legend above a panel."""
    left, base = layout.frame.box.left, layout.frame.box.top + LEGEND_GAP
    heading = layout.legend.heading
    if heading is not None:
        yield Lettering("heading", PlacedLabel(heading.label, left + heading.x, base + heading.y), INK)
    for entry, x, y in layout.legend.entries:
        yield from _sample(entry, left + x, base + y)
        label = PlacedLabel(entry.label, left + x + entry.label_start, base + y - entry.label.rise)
        yield Lettering("legend", label, INK)


def _sample(entry: Entry, x: float, y: float) -> Iterator[Shape]:
    explained = entry.explained
    if isinstance(explained, tuple):
        for number, readings in enumerate(explained):
            place = np.array([(x + (number + 0.5) * MARK_SAMPLE, y)])
            yield reading_marks("legend", readings, place)
        return
    style = ROLES[explained.role]
    if isinstance(explained, Band):
        box = Box(x, y - _HALF_SWATCH, x + LINE_SAMPLE, y + _HALF_SWATCH)
        lower_left, lower_right, upper_right, upper_left, _ = box.corners
        yield area("legend", box.corners, None, style.tint)
        yield lines("legend", [[lower_left, lower_right], [upper_left, upper_right]], style.stroke)
    else:
        yield lines("legend", [[(x, y), (x + LINE_SAMPLE, y)]], style.stroke)
        yield from curve_marks("legend", style, np.array([(x + LINE_SAMPLE / 2, y)]))
