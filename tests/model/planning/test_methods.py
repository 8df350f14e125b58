"""Each positioning method leads the axis as its description says, and effects see it so."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, strategies as st

from zlmreport.model.planning.methods import (
    Method,
    Stop,
    compute_times,
    list_visits,
    make_planned_design,
    plan_path,
)
from zlmreport.plugin import Approach, Axis

TARGETS = (10.0, 20.0, 40.0)
OVERRUN = 5.0
BOTH = [Method.LINEAR, Method.PENDULUM, Method.QUASI_PILGRIM]


def _read(method: Method, runs: int = 2) -> str:
    """Return the readings in their order, as target (from 1), direction, run."""
    signs = {Approach.POSITIVE: "+", Approach.NEGATIVE: "-"}
    listed = list_visits(plan_path(method, TARGETS, runs, OVERRUN))
    return " ".join(f"{visit.target + 1}{signs[visit.approach]}{visit.run}" for visit in listed)


def _since_reversal(method: Method) -> list[float]:
    return [visit.since_reversal for visit in list_visits(plan_path(method, TARGETS, 2, OVERRUN))]


def test_linear_method_goes_up_and_down_in_each_run() -> None:
    assert _read(Method.LINEAR) == "1+1 2+1 3+1 3-1 2-1 1-1 1+2 2+2 3+2 3-2 2-2 1-2"


def test_unidirectional_method_goes_up_only() -> None:
    assert _read(Method.UNIDIRECTIONAL) == "1+1 2+1 3+1 1+2 2+2 3+2"


def test_pendulum_method_ends_with_a_target_before_the_next() -> None:
    assert _read(Method.PENDULUM) == "1+1 1-1 1+2 1-2 2+1 2-1 2+2 2-2 3+1 3-1 3+2 3-2"


def test_quasi_pilgrim_method_goes_to_and_fro_between_neighbours() -> None:
    assert _read(Method.QUASI_PILGRIM) == "1+1 1+2 2+1 1-1 2+2 1-2 3+1 2-1 3+2 2-2 3-1 3-2"


@pytest.mark.parametrize("method", Method)
def test_every_method_reads_each_target_as_often_in_each_direction(method: Method) -> None:
    readings = _read(method, runs=3).split()
    directions = "+" if method is Method.UNIDIRECTIONAL else "+-"
    wanted = {f"{target}{sign}{run}" for target in (1, 2, 3) for sign in directions for run in (1, 2, 3)}
    assert len(readings) == len(wanted)
    assert set(readings) == wanted


def test_linear_method_turns_beyond_its_ends() -> None:
    assert _since_reversal(Method.LINEAR) == [5, 15, 35, 5, 25, 35] * 2


def test_unidirectional_method_turns_before_its_start() -> None:
    assert _since_reversal(Method.UNIDIRECTIONAL) == [5, 15, 35] * 2


def test_pendulum_method_comes_from_the_overrun_or_straight_from_the_target_before() -> None:
    assert _since_reversal(Method.PENDULUM) == [5, 5, 5, 5, 10, 5, 5, 5, 20, 5, 5, 5]


def test_quasi_pilgrim_method_comes_from_the_neighbour() -> None:
    assert _since_reversal(Method.QUASI_PILGRIM) == [5, 5, 15, 10, 10, 10, 30, 20, 20, 20, 5, 5]


def test_the_way_between_readings_holds_the_loops() -> None:
    listed = list_visits(plan_path(Method.LINEAR, TARGETS, 2, OVERRUN))
    assert [visit.travelled for visit in listed] == [5, 10, 20, 10, 20, 10, 10, 10, 20, 10, 20, 10]


def test_pendulum_has_the_shortest_way_for_targets_far_apart() -> None:
    ways = {
        method: sum(
            visit.travelled
            for visit in list_visits(plan_path(method, (0.0, 100.0, 200.0, 300.0), 5, OVERRUN))
        )
        for method in BOTH
    }
    assert min(ways, key=ways.__getitem__) is Method.PENDULUM


@given(
    method=st.sampled_from(Method),
    intervals=st.lists(st.integers(1, 5000), min_size=1, max_size=12),
    overrun=st.integers(1, 5000),
    runs=st.integers(1, 6),
)
def test_every_reading_comes_from_its_side_whatever_the_targets(
    method: Method, intervals: list[int], overrun: int, runs: int
) -> None:
    targets = [float(position) for position in itertools.accumulate(intervals)]
    listed = list_visits(plan_path(method, targets, runs, float(overrun)))
    approaches = [Approach.POSITIVE] if method is Method.UNIDIRECTIONAL else list(Approach)
    wanted = set(itertools.product(range(len(targets)), approaches, range(1, runs + 1)))
    assert {(visit.target, visit.approach, visit.run) for visit in listed} == wanted
    assert len(listed) == len(wanted)
    assert all(visit.since_reversal >= min(overrun, *intervals) for visit in listed)


@pytest.mark.parametrize("method", Method)
def test_a_single_target_is_approached_from_its_overrun(method: Method) -> None:
    listed = list_visits(plan_path(method, (10.0,), 2, OVERRUN))
    assert {visit.since_reversal for visit in listed} == {OVERRUN}


@pytest.mark.parametrize("overrun", [0.0, -1.0, 1e-16])
@pytest.mark.parametrize("method", Method)
def test_overrun_that_leaves_no_approach_is_refused(method: Method, overrun: float) -> None:
    with pytest.raises(ValueError, match="leaves no approach"):
        plan_path(method, TARGETS, 2, overrun)


@pytest.mark.parametrize("targets", [(10.0, 10.0), (20.0, 10.0)])
def test_targets_that_do_not_rise_are_refused(targets: tuple[float, ...]) -> None:
    with pytest.raises(ValueError, match="must rise"):
        plan_path(Method.LINEAR, targets, 1, OVERRUN)


def test_a_reading_where_nothing_has_moved_has_no_direction() -> None:
    with pytest.raises(ValueError, match="no direction of approach"):
        list_visits([Stop(1.0, 0, 1)])


TWO_TARGETS = np.array([0.1, 0.3])
VISITS_OF_TWO = list_visits(plan_path(Method.LINEAR, TWO_TARGETS.tolist(), 1, 0.05))


def test_time_is_way_by_feed_and_dwell() -> None:
    # ways: 0.05 (start), 0.2, 0.1, 0.2 m at 0.1 m/s; 2 s at rest before each reading
    np.testing.assert_allclose(compute_times(VISITS_OF_TWO, 0.1, 2.0), [0.0, 4.0, 7.0, 11.0], rtol=1e-14)


def test_design_has_the_readings_in_their_order() -> None:
    design = make_planned_design(Axis("X"), TWO_TARGETS, VISITS_OF_TWO, 0.1, 2.0)
    np.testing.assert_array_equal(design.position, [0.1, 0.3, 0.3, 0.1])
    np.testing.assert_array_equal(design.direction, [1.0, 1.0, -1.0, -1.0])
    np.testing.assert_array_equal(design.target, [0, 1, 1, 0])
    np.testing.assert_array_equal(design.run, [1, 1, 1, 1])
    np.testing.assert_allclose(design.since_reversal, [0.05, 0.25, 0.05, 0.25], rtol=1e-14)
    assert not design.time_is_counted
    assert design.is_bidirectional


def test_design_ends_where_the_targets_do() -> None:
    design = make_planned_design(Axis("X"), TWO_TARGETS, VISITS_OF_TWO, 0.1, 2.0)
    assert (design.length, design.middle, design.duration) == (0.3 - 0.1, 0.2, 11.0)
