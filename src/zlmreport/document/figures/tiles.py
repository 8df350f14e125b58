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
#: How far letters keep from the edge of the tiles and from one another at least, points.
_INSIDE = 0.6


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
    """Yield what is written on every other tile along both axes, or on fewer where tiles are narrow."""
    digits = 1 if tiles.darkest < _WITHOUT_DECIMALS else 0
    widest = make_plain_label(
        write_fixed_number(tiles.darkest, digits, language.decimal_sign), _LETTERS
    ).width
    every, middles = _place_across(tiles, frame, widest)
    for middle, values in zip(middles, tiles.values[::every], strict=True):
        for y, value in zip(tiles.y[::2].tolist(), values[::2].tolist(), strict=True):
            label = make_plain_label(write_fixed_number(value, digits, language.decimal_sign), _LETTERS)
            place = PlacedLabel(label, middle - label.width / 2, frame.place_y(y) - label.rise)
            yield Lettering("tile", place, WHITE if value / tiles.darkest > _DARK else INK)


def _place_across(tiles: Tiles, frame: Frame, widest: float) -> tuple[int, list[float]]:
    """Return on each how manieth tile along X a value is written, and where its middle is drawn.

    White letters are not seen beside the tiles: values move together until the outermost stand within them.
    """
    first, *_, last = (frame.place_x(edge) for edge in tiles.edges[0].tolist())
    room = widest / 2 + _INSIDE
    for every in range(2, max(3, len(tiles.x))):
        places = [frame.place_x(x) for x in tiles.x[::every].tolist()]
        ends = max(places[0], first + room), min(places[-1], last - room)
        if ends[1] - ends[0] >= (len(places) - 1) * 2 * room:
            break
    return every, np.interp(places, (places[0], places[-1]), ends).tolist()


def _choose_colour(share: float) -> Colour:
    """Return the colour of a share of the darkest."""
    steps = np.linspace(0.0, 1.0, len(_COLOURS))
    red, green, blue = (float(np.interp(share, steps, each)) for each in _COLOURS.T)
    return red, green, blue
