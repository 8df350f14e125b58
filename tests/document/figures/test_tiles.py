"""A map of values over two axes: what is drawn, and that it is read by everybody."""

import re
from itertools import pairwise

import numpy as np
import pytest

from zlmreport.document.figures.figure import Tiles
from zlmreport.document.figures.scale import AxisScale
from zlmreport.document.figures.shapes import Box, Frame
from zlmreport.document.figures.tiles import place_tile_values
from zlmreport.plugin import Figure, Language, same_in_all_languages
from zlmreport.plugin.page import figure_to_svg
from zlmreport.plugin.standard import Panel

PLACES = np.linspace(0.0, 100.0, 5)


def drawn(values, language=Language.ENGLISH):
    tiles = Tiles(PLACES, PLACES, values, float(values.max()))
    figure = Figure(
        "map",
        same_in_all_languages("Map"),
        same_in_all_languages("Map"),
        same_in_all_languages("X"),
        same_in_all_languages("Y"),
        "mm",
        "mm",
        (Panel(tiles=tiles),),
    )
    return figure_to_svg(figure, language)


def luminance(colour):
    red, green, blue = (int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5))
    return 0.2126 * red**2.2 + 0.7152 * green**2.2 + 0.0722 * blue**2.2


def colours(svg):
    return re.findall(r'<path class="tile"[^>]*fill="(#[0-9a-f]{6})"', svg)


@pytest.fixture
def rising():
    """Values that grow along X, alike for every Y."""
    return np.repeat(np.linspace(0.0, 8.0, 5)[:, np.newaxis], 5, axis=1)


def test_each_place_has_a_tile_about_it(rising):
    assert len(colours(drawn(rising))) == 25
    across, upwards = Tiles(PLACES, PLACES, rising, 8.0).edges
    assert across.tolist() == upwards.tolist() == [-12.5, 12.5, 37.5, 62.5, 87.5, 112.5]


def test_tiles_grow_darker_with_their_values_in_grey_too(rising):
    found = [luminance(each) for each in colours(drawn(rising))[::5]]
    assert all(one > 1.3 * other for one, other in pairwise(found))


def test_letters_stand_out_of_their_tiles(rising):
    """Contrast as for large text at least: 3 to 1."""
    svg = drawn(rising)
    letters = re.findall(r'<text class="tile" fill="(#[0-9a-f]{6})"', svg)
    grounds = colours(svg)[::10]  # every other place along X, the first along Y
    for ground, letter in zip(grounds, letters[::3], strict=True):
        dark, light = sorted((luminance(ground), luminance(letter)))
        assert (light + 0.05) / (dark + 0.05) > 3.0


def test_every_other_value_is_written_in_the_language_of_the_document(rising):
    letters = re.findall(r'<text class="tile".*?</text>', drawn(rising, Language.GERMAN))
    assert len(letters) == 9
    assert "8,0" in letters[-1]


def test_white_letters_stay_on_narrow_tiles():
    """Beside the tiles a white digit is not seen: 18.7 would be read as 8.7."""
    narrow = np.linspace(0.0, 40.0, 11)
    values = np.full((11, 5), 18.7)
    tiles = Tiles(narrow, PLACES, values, 18.7)
    frame = Frame(Box(0.0, 0.0, 60.0, 100.0), AxisScale(-2.0, 42.0, (), ()), AxisScale(-10.0, 110.0, (), ()))
    first, *_, last = (frame.place_x(each) for each in tiles.edges[0].tolist())
    placed = [each.placed for each in place_tile_values(tiles, frame, Language.ENGLISH)]
    assert all(first < each.x < last - each.label.width for each in placed)
    in_a_row = sorted((each.x, each.x + each.label.width) for each in placed[::3])
    assert all(end < begin for (_, end), (begin, _) in pairwise(in_a_row))
    assert len(in_a_row) > 2
