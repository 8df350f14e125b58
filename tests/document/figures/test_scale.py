"""Axes: round values, zero where it is near, labels at the targets where they fit."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, strategies as st

from zlmreport.document.figures.scale import (
    find_extremes,
    include_zero,
    make_category_scale,
    make_position_scale,
    make_value_scales,
    widen,
)
from zlmreport.plugin import DecimalSign
from zlmreport.plugin.page import round_ticks

POINT = DecimalSign.POINT


def _width(text: str) -> float:
    return 4.5 * len(text)


def test_extremes_leave_out_what_does_not_exist() -> None:
    assert find_extremes(np.array([np.nan, 2.0, -1.0, np.inf])) == (-1.0, 2.0)


def test_no_value_has_extremes_of_zero() -> None:
    assert find_extremes(np.array([np.nan])) == (0.0, 0.0)


def test_limits_move_outwards_by_a_part_of_their_span() -> None:
    assert widen(2.0, 4.0, 0.5) == (1.0, 5.0)


@pytest.mark.parametrize("value", [0.0, 0.001, -5000.0])
def test_a_single_value_gets_an_axis_about_it(value: float) -> None:
    lower, upper = widen(value, value, 0.1)
    assert lower < value < upper


@pytest.mark.parametrize(
    ("limits", "with_its_zero"),
    [
        ((1.0, 4.0), (0.0, 4.0)),
        ((-4.0, -1.0), (-4.0, 0.0)),
        ((-1.0, 4.0), (-1.0, 4.0)),
        ((100.0, 104.0), (100.0, 104.0)),
    ],
)
def test_zero_is_taken_in_where_it_is_near(
    limits: tuple[float, float], with_its_zero: tuple[float, float]
) -> None:
    assert include_zero(*limits) == with_its_zero


def test_ticks_are_doubles_nearest_to_round_decimals() -> None:
    ticks, decimals = round_ticks(0.05, 0.45, 4)
    assert (ticks, decimals) == ((0.1, 0.2, 0.3, 0.4), 1)


@given(st.floats(-1e6, 1e6), st.floats(1e-6, 1e6), st.integers(2, 12))
def test_ticks_lie_between_the_limits_in_steps_of_1_2_or_5(start: float, span: float, most: int) -> None:
    ticks, _ = round_ticks(start, start + span, most)
    slack = 1e-6 * span
    assert all(start - slack <= tick <= start + span + slack for tick in ticks)
    steps = np.diff(ticks)
    if len(steps):
        power = 10 ** np.floor(np.log10(steps[0]))
        rounding = 2 * np.spacing(np.abs(ticks).max()) / power + 1e-9
        assert min(abs(steps[0] / power - one) for one in (1, 2, 5, 10)) < rounding
        assert len(steps) <= most


def test_a_flat_graph_has_a_scale_too() -> None:
    (scale,) = make_value_scales([np.array([-61.0, 65.0])], 0.2, 3, POINT)
    assert scale.labels == ("−50", "0", "50")


def test_all_panels_have_one_span() -> None:
    one, other = make_value_scales([np.array([0.0, 10.0]), np.array([100.0, 104.0])], 0.1, 5, POINT)
    assert one.upper - one.lower == pytest.approx(other.upper - other.lower)


def test_a_panel_stands_about_its_own_values() -> None:
    _, other = make_value_scales([np.array([0.0, 10.0]), np.array([100.0, 104.0])], 0.1, 5, POINT)
    assert (other.lower + other.upper) / 2 == pytest.approx(102.0)


def test_labels_have_the_decimals_of_the_step() -> None:
    (scale,) = make_value_scales([np.array([-0.2, 0.2])], 0.0, 4, DecimalSign.COMMA)
    assert scale.labels == ("−0,2", "−0,1", "0,0", "0,1", "0,2")


@pytest.mark.parametrize(
    ("positions", "decimals"), [([0.0, 250.0], 0), ([25.2, 35.4], 1), ([3.137, 50.0], 3), ([0.3333], 4)]
)
def test_positions_are_written_with_the_decimals_that_they_have(
    positions: list[float], decimals: int
) -> None:
    scale = make_position_scale(np.array(positions), 400.0, 12.0, POINT, _width)
    assert {len(label.partition(".")[2]) for label in scale.labels} == {decimals}


def test_labels_stand_at_targets_that_have_room() -> None:
    scale = make_position_scale(np.array([15.0, 25.2, 35.4, 45.6, 55.8]), 400.0, 12.0, POINT, _width)
    assert scale.labels == ("15.0", "25.2", "35.4", "45.6", "55.8")


def test_targets_without_room_have_small_ticks_between_round_positions() -> None:
    targets = np.array([0.0, 10.0, 11.0, 500.0, 1000.0])
    scale = make_position_scale(targets, 400.0, 12.0, POINT, _width)
    assert scale.labels == ("0", "100", "200", "300", "400", "500", "600", "700", "800", "900", "1000")
    assert scale.marks == tuple(targets)


def test_a_narrow_panel_has_two_labels_for_they_show_the_length() -> None:
    scale = make_position_scale(np.linspace(0.0, 707.0, 15), 78.0, 12.0, POINT, _width)
    assert scale.labels == ("0", "500")


def test_labels_of_round_positions_keep_apart() -> None:
    targets = 1e6 + np.linspace(0.0, 1.0, 40)
    scale = make_position_scale(targets, 400.0, 12.0, POINT, _width)
    places = [(tick - scale.lower) / (scale.upper - scale.lower) * 400.0 for tick in scale.ticks]
    assert np.diff(places).min() >= max(map(_width, scale.labels))


@pytest.mark.parametrize(
    ("width", "expected"),
    [(400.0, [0, 45, 90, 135, 180, 225, 270, 315, 360]), (200.0, [0, 90, 180, 270, 360])],
)
def test_degrees_of_a_turn_are_told_by_its_parts(width: float, expected: list[float]) -> None:
    scale = make_position_scale(np.arange(0.0, 360.0, 0.7), width, 12.0, POINT, _width, of_a_turn=True)
    assert list(scale.ticks) == expected
    assert list(scale.labels) == list(map(str, expected))


def test_a_single_target_has_its_label() -> None:
    scale = make_position_scale(np.array([5.0]), 400.0, 12.0, POINT, _width)
    assert (scale.ticks, scale.labels) == ((5.0,), ("5",))


def test_panels_may_have_spans_of_their_own() -> None:
    one, other = make_value_scales([np.array([0.0, 10.0]), np.array([0.0, 1.0])], 0.1, 5, POINT, alike=False)
    assert (one.upper - one.lower) / (other.upper - other.lower) == pytest.approx(10.0)


def test_things_side_by_side_stand_at_whole_numbers() -> None:
    scale = make_category_scale(("a", "b", "c"), 300.0, _width)
    assert (scale.lower, scale.upper, scale.ticks, scale.labels) == (
        -0.5,
        2.5,
        (0.0, 1.0, 2.0),
        ("a", "b", "c"),
    )


def test_names_that_do_not_fit_are_parted_at_the_hyphen_nearest_to_their_middle() -> None:
    scale = make_category_scale(("offset", "a-long-wave-name"), 130.0, _width)
    assert scale.labels == ("offset", "a-long-\nwave-name")


def test_where_a_name_does_not_fit_at_all_numbers_stand_for_all() -> None:
    scale = make_category_scale(("offset", "x" * 40), 130.0, _width)
    assert scale.labels == ("0", "1")


@given(st.lists(st.text("ab- ", min_size=1, max_size=30), min_size=1, max_size=20))
def test_names_side_by_side_never_overlap(names: list[str]) -> None:
    scale = make_category_scale(names, 400.0, _width)
    widest = max(_width(line) for label in scale.labels for line in label.split("\n"))
    assert widest < 400.0 / len(names) or scale.labels == tuple(map(str, range(len(names))))


def test_a_flat_graph_has_two_numbers_where_more_would_touch():
    """Three multiples of 50 do not lie between −45 and 85, and seven of 20 have no room."""
    (scale,) = make_value_scales([np.array([-45.0, 85.0])], 0.0, 1, DecimalSign.POINT)
    assert scale.ticks == (0.0, 50.0)
    (scale,) = make_value_scales([np.array([-45.0, 85.0])], 0.0, 4, DecimalSign.POINT)
    assert scale.ticks == (-40.0, -20.0, 0.0, 20.0, 40.0, 60.0, 80.0)
