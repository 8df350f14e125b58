"""A panel about a circle: where values stand, and what is drawn with them."""

from dataclasses import replace

import numpy as np
import pytest

from document.figures.samples import drawn
from zlmreport.document.figures.draw import draw_figure_shapes, draw_legend
from zlmreport.document.figures.layout import lay_out
from zlmreport.document.figures.polar import find_largest_square, make_polar_grid, place_on_circle
from zlmreport.document.figures.shapes import Box, PointMarks
from zlmreport.plugin import DecimalSign, Figure, Language, same_in_all_languages
from zlmreport.plugin.page import figure_size, figure_to_svg
from zlmreport.plugin.standard import Curve, Level, Panel, Role

ANGLES = np.linspace(0.0, 360.0, 361)


def figure(values, **of_panel):
    of_panel = {"projection": "polar", **of_panel}
    panel = Panel(curves=(Curve("G", Role.MEAN_POSITIVE, ANGLES, values),), **of_panel)
    return Figure(
        "circle",
        same_in_all_languages("Circle"),
        same_in_all_languages("A circle."),
        same_in_all_languages("Angle"),
        same_in_all_languages("Radial"),
        "°",
        "µm",
        (panel,),
    )


def shapes(shown, kind):
    """Return the shapes of a kind that are drawn of a figure."""
    return [each for each in draw_figure_shapes(lay_out(shown, Language.ENGLISH)) if each.kind == kind]


def test_values_stand_so_far_outside_the_nominal_circle_as_they_are_large():
    panel = figure(3.0 * np.cos(np.radians(ANGLES))).panels[0]
    grid = make_polar_grid(panel, DecimalSign.POINT)
    curve = place_on_circle(panel, grid).curves[0]
    radius = np.hypot(curve.x, curve.y)
    assert radius[0] - radius[180] == pytest.approx(6.0)
    assert np.degrees(np.arctan2(curve.y[90], curve.x[90])) == pytest.approx(90.0)
    assert 0.0 in grid.ticks
    assert grid.ticks[0] <= -3.0
    assert grid.ticks[-1] >= 3.0
    assert float(grid.compute_radius(grid.ticks[0])) > 0


@pytest.mark.parametrize("size", [1e-3, 1.0, 3e4])
def test_a_circle_is_drawn_round_and_inside_whatever_its_size(size):
    shown = figure(size * np.sin(2 * np.radians(ANGLES)))
    layout = lay_out(shown, Language.ENGLISH)
    (panel,) = layout.panels
    assert panel.frame.box.width == pytest.approx(panel.frame.box.height)
    assert panel.frame.x_factor == pytest.approx(panel.frame.y_factor)
    width, height = figure_size(shown)
    box = panel.frame.box
    assert 0 <= box.left < box.right <= width
    assert 0 <= box.bottom < box.top <= height
    (curve,) = shapes(shown, "curve mean_positive")
    assert np.abs(curve.parts[0]).max() <= panel.frame.x_scale.upper


@pytest.mark.parametrize(("height", "least"), [(99.5, 90.0), (None, 115.0)])
def test_a_circle_uses_the_height_of_its_figure(height, least):
    # Above and below it are angles; in a high figure a line of the legend, too, and what its distances are.
    shown = replace(figure(3.0 * np.cos(np.radians(ANGLES))), height=height)
    outermost = max(np.ptp(each.parts[0][:, 1]) for each in shapes(shown, "grid"))
    assert outermost / 72 * 25.4 >= least


def test_the_angles_stand_outside_of_the_circle_and_inside_of_the_figure():
    shown = figure(3.0 * np.cos(np.radians(ANGLES)), directions=((0, "+X"), (180, "−X")))
    width, _ = figure_size(shown)
    rim = max((each.parts[0] for each in shapes(shown, "grid")), key=np.ptp)
    labels = {each.placed.label.runs[0].text: each.placed for each in shapes(shown, "ray") if each.placed}
    right, left = labels["+X 0°"], labels["−X 180°"]
    assert 0 <= left.x < left.x + left.label.width < rim[:, 0].min()
    assert rim[:, 0].max() < right.x < right.x + right.label.width <= width


def test_a_curve_shows_its_sense_by_an_arrow_along_it():
    forwards = figure(0 * ANGLES)
    turned = Curve("G", Role.MEAN_POSITIVE, ANGLES[::-1], 0 * ANGLES)
    backwards = replace(forwards, panels=(replace(forwards.panels[0], curves=(turned,)),))
    for shown, sense in ((forwards, 1.0), (backwards, -1.0)):
        (head,) = shapes(shown, "sense")
        tip, *corners = head.parts[0][:3]
        base = sum(corners) / 2
        frame = lay_out(shown, Language.ENGLISH).panels[0].frame
        middle = np.array([frame.place_x(0.0), frame.place_y(0.0)])
        arm, way = base - middle, tip - base
        assert np.sign(arm[0] * way[1] - arm[1] * way[0]) == sense


def test_the_distance_of_circles_is_told_in_words_of_the_language():
    image = figure_to_svg(figure(3.0 * np.cos(np.radians(ANGLES))), Language.GERMAN)
    assert "von Kreis zu Kreis" in image
    assert "°" in image


def test_a_level_is_a_circle_and_a_gap_stays_a_gap():
    shown = figure(np.where(ANGLES < 180, 1.0, np.nan), levels=(Level("F", Role.TOLERANCE, 4.0),))
    (level,) = shapes(shown, "level")
    middle = level.parts[0][:-1].mean(axis=0)
    assert np.ptp(np.hypot(*(level.parts[0][:-1] - middle).T)) < 1e-6
    (curve,) = drawn(shown).of("curve mean_positive")
    width, height = np.ptp(curve.points, axis=0)
    assert height == pytest.approx(width / 2, rel=0.03)


def test_a_circle_stands_in_the_middle_of_its_room():
    assert find_largest_square(Box(0, 0, 4, 2)) == Box(1, 0, 3, 2)


def test_an_entry_of_its_legend_has_no_mark():
    about, over = figure(0 * ANGLES), figure(0 * ANGLES, projection="straight")
    marks = [
        [
            each
            for each in draw_legend(lay_out(shown, Language.ENGLISH).panels[0])
            if isinstance(each, PointMarks)
        ]
        for shown in (about, over)
    ]
    assert list(map(len, marks)) == [0, 1]
