"""A path that would touch what it does not measure, or leave the machine, is refused with its moves."""

from __future__ import annotations

import re

import numpy as np
import pytest

from step_gauge.paths import PLACE, planned, step_gauge
from zlmreport.plugin import InputError
from zlmreport_step_gauge.paths.path import PathKind
from zlmreport_step_gauge.paths.room import find_least_gap, make_obstacles


def refused(**changes: object) -> str:
    """Return the message on a path; all of it stands at the path's key."""
    with pytest.raises(InputError) as caught:
        planned(**changes)
    assert {problem.place for problem in caught.value.problems} == {PLACE}
    return str(caught.value)


def test_a_tip_that_is_too_large_for_the_gap_is_refused_with_the_face_and_the_block() -> None:
    # Face 1 has no neighbour; before face 3 a tip of 7.2 mm and its approach leave 0.3 mm of a gap of 10 mm.
    first, *_ = refused(tip_radius=3.6e-3, blocks=2).splitlines()
    assert re.search(
        r"move \d+ at face 3, to \(.*\) mm: only 0.3 mm are left beside block 1, and 0.5 mm must", first
    )


def test_a_tip_that_leaves_just_the_allowance_goes_through() -> None:
    assert planned(tip_radius=3.5e-3).path.probings


def test_a_tip_that_does_not_fit_runs_into_the_block_behind_it() -> None:
    assert "the tip runs into block 1" in refused(tip_radius=3.9e-3, blocks=2)


def test_a_measuring_move_may_touch_its_own_block() -> None:
    # So what is left least is the approach; over the top are 3 mm, and 3.5 mm to the block behind.
    assert find_least_gap(planned().path, planned().room)[0] == pytest.approx(2.5e-3)


def test_blocks_outside_the_section_stand_in_the_way_too() -> None:
    at_the_beginning = planned(blocks=5, section=(1, 2), tip_radius=2e-3, approach=5.4e-3, stylus_allowance=0)
    assert at_the_beginning.path.probings
    message = refused(blocks=5, section=(3, 4), approach=7e-3, stylus_allowance=0)
    assert "at face 5" in message
    assert "block 2" in message


def test_a_face_that_is_probed_too_deep_is_refused_by_the_base() -> None:
    assert "the base of the gauge" in refused(depth=8.5e-3)


def test_the_way_from_a_safe_position_inside_the_gauge_is_refused() -> None:
    message = refused(safe_position=(0.3, 0.22, 0.2))
    assert "move 2 at face 1, to" in message
    assert "the tip runs into block 2" in message


def test_a_path_that_leaves_the_working_volume_is_refused_by_its_axis() -> None:
    volume = ((0.0, 0.5), (0.0, 0.25), (0.0, 0.5))
    assert re.search(
        r"at face 7, .*: y leaves the working volume, 0 to 250 mm", refused(working_volume=volume)
    )


def test_a_message_names_five_moves_and_counts_the_rest() -> None:
    lines = refused(tip_radius=3.9e-3, blocks=4, cycles=3).splitlines()
    assert len(lines) == 6
    assert re.search(r"\d+ more moves of the path cannot be made", lines[-1])


@pytest.mark.parametrize("kind", list(PathKind))
@pytest.mark.parametrize("orientation", ["x", "y", "z", "against y", "diagonal"])
def test_turning_the_gauge_changes_no_distance(kind: PathKind, orientation: str) -> None:
    usual, turned = planned(kind=kind), planned(kind=kind, orientation=orientation)
    assert find_least_gap(turned.path, turned.room)[0] == pytest.approx(
        find_least_gap(usual.path, usual.room)[0]
    )


class TestDistances:
    """Of a straight move from a box, held against many points of the move."""

    def test_by_hand(self) -> None:
        boxes = make_obstacles(step_gauge(1), 1, 0.01, 0.01)
        starts = np.array([[-0.02, 0.0, 0.0], [-0.02, 0.008, 0.02], [-0.02, 0.0, 0.02]])
        ends = np.array([[-0.01, 0.0, 0.0], [0.02, 0.008, 0.02], [0.02, 0.0, -0.02]])
        # before the front face; along an edge, 3 mm aside and 15 mm above it; through the block
        expected = [5e-3, np.hypot(3e-3, 15e-3), 0.0]
        assert boxes.measure_distances(starts, ends)[:, 0] == pytest.approx(expected, abs=1e-9)

    def test_by_points_of_the_move(self) -> None:
        random = np.random.default_rng(4)
        boxes = make_obstacles(step_gauge(3), 2, 0.01, 0.01)
        starts, ends = random.uniform(-0.05, 0.05, (2, 40, 3))
        shares = np.linspace(0.0, 1.0, 2001)[:, None, None]
        points = (starts + shares * (ends - starts))[:, :, None, :]
        outside = np.maximum(np.maximum(boxes.lower - points, points - boxes.upper), 0.0)
        sampled = np.linalg.norm(outside, axis=-1).min(axis=0)
        found = boxes.measure_distances(starts, ends)
        assert (found <= sampled + 1e-9).all()
        # between two points lie at most 0.18 m / 2000 = 0.09 mm
        assert found == pytest.approx(sampled, abs=9e-5)
