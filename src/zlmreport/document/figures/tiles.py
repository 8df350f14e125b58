"""Maps of values over two axes: tiles with their colours, and values written on them.

The colours grow darker evenly from yellow to blue: they tell the same in grey, and to those who do not tell
red from green.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.document.figures.canvas import Colour, Fill
from zlmreport.document.figures.figure import Tiles
from zlmreport.document.figures.metrics import make_plain_label
from zlmreport.document.figures.shapes import (
    INK,
    WHITE,
    Box,
    Frame,
    Lettering,
    PlacedLabel,
    Shape,
    outline_area,
)
from zlmreport.language import Language
from zlmreport.language.formatting import write_fixed_number

#: From nothing to the darkest.
_COLOURS = np.array(
    [
        (1.0, 1.0, 0.86),
        (0.78, 0.91, 0.71),
        (0.42, 0.77, 0.74),
        (0.15, 0.55, 0.72),
        (0.1, 0.3, 0.58),
        (0.04, 0.14, 0.4),
    ]
)
#: Letters on tiles darker than this share of the darkest are white.
_DARK = 0.55
#: Size of the letters, points; values have no decimals where the darkest is as large as this.
_LETTERS, _WITHOUT_DECIMALS = 6.0, 100.0
#: Tiles overlap by so much, points: else a viewer shows hairs between them.
_OVERLAP = 0.3


def draw_tiles(tiles: Tiles, frame: Frame) -> Iterator[Shape]:
    """Yield the tiles."""
    across, upwards = (
        [point(each) for each in edges.tolist()]
        for point, edges in zip((frame.place_x, frame.place_y), tiles.edges, strict=True)
    )
    for left, right, values in zip(across, across[1:], tiles.values, strict=False):
        for bottom, top, value in zip(upwards, upwards[1:], values.tolist(), strict=False):
            box = Box(left, bottom, right + _OVERLAP, top + _OVERLAP)
            yield outline_area("tile", box.corners, None, Fill(_choose_colour(value / tiles.darkest)))


def place_tile_values(tiles: Tiles, frame: Frame, language: Language) -> Iterator[Lettering]:
    """Yield what is written on every other tile along both axes."""
    digits = 1 if tiles.darkest < _WITHOUT_DECIMALS else 0
    for x, values in zip(tiles.x[::2].tolist(), tiles.values[::2], strict=True):
        for y, value in zip(tiles.y[::2].tolist(), values[::2].tolist(), strict=True):
            label = make_plain_label(write_fixed_number(value, digits, language.decimal_sign), _LETTERS)
            place = PlacedLabel(label, frame.place_x(x) - label.width / 2, frame.place_y(y) - label.rise)
            yield Lettering("tile", place, WHITE if value / tiles.darkest > _DARK else INK)


def _choose_colour(share: float) -> Colour:
    """Return the colour of a share of the darkest."""
    steps = np.linspace(0.0, 1.0, len(_COLOURS))
    red, green, blue = (float(np.interp(share, steps, each)) for each in _COLOURS.T)
    return red, green, blue
