"""The tip goes to every face along the line of the centres, and between the faces where it is free."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from step_gauge.paths import ORIENTATIONS, planned
from zlmreport_step_gauge.gauge import Side
from zlmreport_step_gauge.paths.path import PathKind, Probing, ProbingPath, Travel
from zlmreport_step_gauge.paths.plan import find_remaining

KINDS = list(PathKind)
MICROMETRE = 1e-6


def turning_points(path: ProbingPath) -> list[tuple[str, list[float]]]:
    """Return the moves, in mm."""
    return [
        ("MS", [1e3 * at for at in move.target])
        if isinstance(move, Probing)
        else ("MV", [1e3 * at for at in move.to])
        for move in path.moves
    ]


@pytest.mark.parametrize("kind", KINDS)
def test_each_cycle_takes_the_fronts_forward_and_the_backs_backward(kind: PathKind) -> None:
    path = planned(blocks=3, kind=kind, cycles=2).path
    assert [(each.face, each.cycle) for each in path.probings] == [
        *((face, 1) for face in (1, 3, 5, 6, 4, 2)),
        *((face, 2) for face in (1, 3, 5, 6, 4, 2)),
    ]


def test_a_section_is_probed_by_the_numbers_of_the_gauge() -> None:
    path = planned(blocks=6, section=(3, 4)).path
    assert [each.face for each in path.probings] == [5, 7, 8, 6]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("orientation", ORIENTATIONS)
def test_faces_lie_at_their_nominal_distances_along_the_gauge(orientation: str, kind: PathKind) -> None:
    direction = np.array(ORIENTATIONS[orientation][0])
    path = planned(orientation=orientation, kind=kind).path
    first = np.array((0.3, 0.2, 0.2)) - 0.005 * direction
    for probing in path.probings:
        expected = first + 0.01 * (probing.face - 1) * direction
        assert probing.target == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("orientation", ORIENTATIONS)
def test_measuring_moves_go_along_the_gauge_against_the_outward_normal(
    orientation: str, kind: PathKind
) -> None:
    direction = np.array(ORIENTATIONS[orientation][0])
    path = planned(orientation=orientation, kind=kind).path
    for before, move in pairwise(path.moves):
        if not isinstance(move, Probing):
            continue
        side = Side.FRONT if move.face % 2 else Side.BACK
        assert move.normal == pytest.approx(side * direction, abs=1e-12)
        assert isinstance(before, Travel)
        start = np.array(before.to) - np.array(move.target)
        assert start == pytest.approx((2.5e-3 + 2e-3) * np.array(move.normal), abs=1e-12)


@pytest.mark.parametrize("orientation", ORIENTATIONS)
def test_a_vertical_path_passes_over_the_top_by_its_clearance(orientation: str) -> None:
    _, upward = ORIENTATIONS[orientation]
    path = planned(orientation=orientation, kind=PathKind.VERTICAL, clearance=7e-3).path
    heights = [float(np.dot(np.array(stop) - (0.3, 0.2, 0.2), upward)) for stop in path.stops]
    assert max(heights) == pytest.approx(5e-3 + 2e-3 + 7e-3)
    assert min(heights) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("orientation", ORIENTATIONS)
def test_a_horizontal_path_goes_round_the_right_side_by_its_clearance(orientation: str) -> None:
    direction, upward = ORIENTATIONS[orientation]
    right = np.cross(direction, upward)
    path = planned(orientation=orientation, kind=PathKind.HORIZONTAL, clearance=7e-3).path
    beside = [float(np.dot(np.array(stop) - (0.3, 0.2, 0.2), right)) for stop in path.stops]
    assert max(beside) == pytest.approx(5e-3 + 2e-3 + 7e-3)
    assert min(beside) == pytest.approx(0.0, abs=1e-12)


def test_depth_says_how_far_below_the_top_faces_are_touched() -> None:
    path = planned(orientation="y", depth=3e-3).path
    assert {round(1e3 * each.target[2], 9) for each in path.probings} == {200 + 5 - 3}


def test_the_path_begins_and_ends_in_the_safe_position() -> None:
    path = planned(safe_position=(0.0, 0.0, 0.4)).path
    assert path.moves[0] == path.moves[-1] == Travel((0.0, 0.0, 0.4))


@pytest.mark.parametrize("kind", KINDS)
def test_without_a_safe_position_it_begins_and_ends_over_the_gauge(kind: PathKind) -> None:
    path = planned(kind=kind).path
    assert {round(1e3 * stop[2], 9) for stop in (path.stops[0], path.stops[-1])} == {200 + 5 + 3 + 2}


def test_a_safe_position_behind_the_gauge_is_reached_over_its_top() -> None:
    path = planned(kind=PathKind.HORIZONTAL, safe_position=(0.1, 0.23, 0.2)).path
    kinds = turning_points(path)
    assert kinds[0] == ("MV", pytest.approx([100, 230, 200]))
    assert kinds[1][1][2] == pytest.approx(210)
    assert kinds[-2][1][2] == pytest.approx(210)


def test_the_length_is_the_way_of_the_tips_centre_by_hand() -> None:
    path = planned(blocks=2, kind=PathKind.VERTICAL, safe_position=None).path
    # At each of four faces 10 mm in, 2.5 mm to the touch, the same back and out. Over the blocks 20 mm from
    # front to front, 4.5 + 10 + 4.5 mm from the last front to the last back, 20 mm from back to back.
    assert path.length == pytest.approx(4 * 25e-3 + 20e-3 + 19e-3 + 20e-3)


def test_the_duration_is_that_of_both_speeds() -> None:
    path = planned(blocks=2).path
    measuring = 4 * 2.5e-3
    assert path.duration == pytest.approx(measuring / 3e-3 + (path.length - measuring) / 30e-3)


def test_the_first_cycle_holds_the_beginning_and_the_end_of_the_path() -> None:
    path = planned(blocks=2, cycles=3, safe_position=(0.0, 0.0, 0.4)).path
    moves = [move for move, _ in path.first_cycle]
    assert moves[0] == moves[-1] == Travel((0.0, 0.0, 0.4))
    assert sum(isinstance(move, Probing) for move in moves) == 4


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_left_of_a_path_begins_and_ends_as_a_path_does(kind: PathKind) -> None:
    whole = planned(blocks=3, cycles=2, kind=kind, safe_position=(0.0, 0.0, 0.4))
    done = {(each.face, each.cycle) for each in whole.path.probings} - {(4, 1), (3, 2)}
    path = find_remaining(whole, done)
    assert [(each.face, each.cycle) for each in path.probings] == [(4, 1), (3, 2)]
    assert path.moves[0] == path.moves[-1] == Travel((0.0, 0.0, 0.4))
    assert {move.face for move in path.moves} == {0, 3, 4}


def test_of_a_path_that_is_done_nothing_is_left() -> None:
    whole = planned(blocks=2)
    assert find_remaining(whole, {(each.face, 1) for each in whole.path.probings}).moves == ()


def test_a_point_away_from_a_face_lies_in_front_of_it() -> None:
    probing = Probing(1, 1, (1.0, 2.0, 3.0), (0.0, -1.0, 0.0))
    assert probing.away(0.5) == (1.0, 1.5, 3.0)
    assert math.dist(probing.away(0.5), probing.target) == 0.5
