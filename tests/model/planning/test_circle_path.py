"""The path of a planned circular test: each turn begins where the one before it ended."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from hypothesis import given, strategies as st

from zlmreport.plugin import Approach, InputError
from zlmreport.testing import sample_circle_path

angles = st.floats(-360, 360, allow_nan=False)


@given(angles, st.floats(1, 360), st.floats(0, 360), st.integers(1, 4))
def test_a_path_is_closed_and_continuous(first: float, extent: float, arc: float, runs: int) -> None:
    path = sample_circle_path(first=first, extent=extent, arc=arc, runs=runs)
    blocks = path.blocks(6)
    assert all(one.end == other.start for one, other in pairwise(blocks))
    assert math.dist(blocks[0].end, blocks[-1].end) < 1e-5 or len(path.turns) % 2


@given(angles, st.floats(1, 360), st.floats(0, 360))
def test_both_senses_are_evaluated_over_the_same_arc(first: float, extent: float, arc: float) -> None:
    ccw, cw = sample_circle_path(first=first, extent=extent, arc=arc, runs=1).turns
    assert (ccw.first, ccw.last) == (cw.last, cw.first) == (first, first + extent)
    assert (ccw.begins, ccw.ends) == pytest.approx((cw.ends, cw.begins))


def test_the_tool_stops_beside_the_circle_and_never_on_it() -> None:
    blocks = sample_circle_path().blocks(3)
    assert [block.stops for block in blocks if block.sense is None] == [True] * 9
    assert not any(block.stops for block in blocks if block.sense is not None)


def test_right_angles_are_exact() -> None:
    ends = {block.end for block in sample_circle_path(first=270, extent=90, arc=90).blocks(9)}
    assert {(0.0, -100.0), (100.0, 0.0), (0.0, 100.0), (-102.0, 0.0)} <= ends


def test_points_that_rounding_puts_off_the_circle_are_refused() -> None:
    with pytest.raises(InputError, match=r"at 210° a point of 3 digits after the point lies on a radius of"):
        sample_circle_path(first=30).blocks(3)
    assert sample_circle_path(first=30).blocks(4)


def test_a_run_of_its_own_has_a_turn_in_each_sense() -> None:
    path = sample_circle_path(runs=3)
    assert [turn.sense for turn in path.of_run(3).turns] == [Approach.POSITIVE, Approach.NEGATIVE]
    with pytest.raises(InputError, match="there is no run 4: state 1 to 3"):
        path.of_run(4)


def test_a_test_takes_as_long_as_its_way_at_its_feed_and_its_rests() -> None:
    # 720° at 100 mm and 2 · 2 mm at 25 mm/s, and 4 s, four times.
    assert sample_circle_path().duration == pytest.approx(4 * ((4 * math.pi * 100 + 4) / 25 + 4))


def test_acceleration_is_that_of_uniform_motion_on_a_circle() -> None:
    assert sample_circle_path().acceleration == pytest.approx(0.025**2 / 0.1)
