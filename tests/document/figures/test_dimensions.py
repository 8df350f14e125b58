"""Dimension lines and their labels find places of their own."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, strategies as st

from document.figures.samples import pairs
from zlmreport.document.figures.dimensions import (
    HEAD,
    DimensionSpan,
    DrawnDimension,
    measure_margin,
    place_beside_targets,
    place_margin_columns,
    spread,
)
from zlmreport.document.figures.shapes import Box, count_points
from zlmreport.plugin.page import FontFace, TextLabel, TextRun

NOTHING = np.empty((0, 2))
REGION = Box(0.0, 0.0, 300.0, 200.0)


def _label(width: float = 12.0) -> TextLabel:
    return TextLabel((TextRun("A", FontFace.ITALIC, 8.0, 0.0, 0.0),), width, 8.0)


def _span(low: float, high: float, at: float = 150.0) -> DimensionSpan:
    return DimensionSpan(_label(), low, high, at, at)


def _columns(*spans: DimensionSpan) -> tuple[DrawnDimension, ...]:
    return place_margin_columns(spans, 400.0, 0.0, 200.0)


def test_the_shortest_bracket_stands_nearest_to_the_frame() -> None:
    placed = _columns(_span(0.0, 100.0), _span(40.0, 60.0), _span(20.0, 80.0))
    assert [one.span.length for one in placed] == [20.0, 60.0, 100.0]
    assert [one.x for one in placed] == sorted(one.x for one in placed)


def test_a_label_stands_at_the_middle_of_its_bracket() -> None:
    (one,) = _columns(_span(20.0, 80.0))
    assert one.label.y + one.span.label.rise == pytest.approx(50.0)


def test_a_label_gives_way_to_the_extension_line_of_a_bracket_further_out() -> None:
    inner, _ = _columns(_span(40.0, 60.0), _span(50.0, 150.0))
    assert not inner.label.box.bottom < 50.0 < inner.label.box.top


def test_the_columns_take_the_width_that_was_foretold() -> None:
    spans = [_span(0.0, 100.0), _span(40.0, 60.0)]
    last = _columns(*spans)[-1]
    assert last.label.x + last.span.label.width == pytest.approx(
        400.0 + measure_margin(span.label for span in spans)
    )


@given(st.lists(st.tuples(st.floats(0, 200), st.floats(0, 200)), min_size=1, max_size=4))
def test_labels_of_brackets_never_overlap(ends: list[tuple[float, float]]) -> None:
    placed = _columns(*(_span(min(pair), max(pair)) for pair in ends))
    boxes = [one.label.box for one in placed]
    assert not [pair for pair in pairs(boxes) if pair[0].is_overlapping(pair[1])]


def test_heads_between_ends_that_have_room_point_outwards() -> None:
    assert _span(0.0, 3 * HEAD).tail == 0.0


def test_heads_without_room_between_the_ends_stand_outside() -> None:
    assert _span(0.0, HEAD).tail > HEAD


def _beside(
    *spans: DimensionSpan, marks: np.ndarray = NOTHING, lines: np.ndarray = NOTHING
) -> tuple[DrawnDimension, ...]:
    return place_beside_targets(spans, REGION, marks, lines)


def test_an_arrow_stands_near_its_target_and_not_on_it() -> None:
    (one,) = _beside(_span(50.0, 100.0))
    assert 4.0 < abs(one.x - 150.0) < 12.0


def test_two_arrows_at_one_target_stand_side_by_side() -> None:
    longer, shorter = _beside(_span(50.0, 100.0), _span(20.0, 180.0))
    assert (longer.x - 150.0) * (shorter.x - 150.0) < 0


def test_arrows_one_upon_the_other_share_their_place() -> None:
    lower, upper = _beside(_span(50.0, 100.0), _span(100.0, 150.0))
    assert lower.x == upper.x


@pytest.mark.parametrize("at", [5.0, 295.0])
def test_an_arrow_at_the_edge_stays_inside(at: float) -> None:
    (one,) = _beside(_span(50.0, 100.0, at))
    assert all(REGION.has_inside(box) for box in one.boxes)


def test_a_label_leaves_marks_alone() -> None:
    marks = np.array([(x, 75.0) for x in (160.0, 165.0, 170.0, 130.0, 135.0, 140.0)])
    (one,) = _beside(_span(50.0, 100.0), marks=marks)
    assert count_points([one.label.box], marks) == [0]


def test_a_label_that_cannot_avoid_a_line_says_so() -> None:
    x, y = np.meshgrid(np.arange(0.0, 300.0, 4.0), np.arange(0.0, 200.0, 4.0))
    everywhere = np.column_stack([x.ravel(), y.ravel()])
    (one,) = _beside(_span(50.0, 100.0), lines=everywhere)
    assert one.is_among_lines


def test_a_label_on_free_ground_says_so() -> None:
    (one,) = _beside(_span(50.0, 100.0))
    assert not one.is_among_lines


@given(
    st.lists(
        st.tuples(st.floats(20, 180), st.floats(20, 180), st.sampled_from([60.0, 150.0, 155.0])),
        min_size=1,
        max_size=4,
    )
)
def test_arrows_never_overlap(spans: list[tuple[float, float, float]]) -> None:
    placed = _beside(*(_span(min(low, high), max(low, high), at) for low, high, at in spans))
    for number, one in enumerate(placed):
        for other in placed[number + 1 :]:
            assert not any(mine.is_overlapping(theirs) for mine in one.boxes for theirs in other.boxes)


def test_heights_far_apart_stay() -> None:
    assert spread([40.0, 10.0], 8.0, 0.0, 100.0) == (40.0, 10.0)


def test_heights_at_the_edge_move_inwards() -> None:
    assert spread([99.0, 100.0], 8.0, 0.0, 100.0) == (92.0, 100.0)


@given(st.lists(st.floats(0, 100), max_size=6))
def test_heights_end_up_a_distance_apart_in_their_order(heights: list[float]) -> None:
    moved = spread(heights, 8.0, -100.0, 200.0)
    in_order = [moved[index] for index in np.argsort(heights, kind="stable")]
    assert np.all(np.diff(in_order) >= 8.0 - 1e-9)
