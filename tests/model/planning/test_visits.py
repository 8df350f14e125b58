"""A planned test as effects see it."""

from __future__ import annotations

import numpy as np

from zlmreport.model.planning.methods import (
    Method,
    compute_times,
    list_visits,
    make_planned_design,
    plan_path,
)
from zlmreport.plugin import Axis

TARGETS = np.array([0.1, 0.3])
LISTED = list_visits(plan_path(Method.LINEAR, TARGETS.tolist(), 1, 0.05))


def test_time_is_way_by_feed_and_dwell() -> None:
    # ways: 0.05 (start), 0.2, 0.1, 0.2 m at 0.1 m/s; 2 s at rest before each reading
    np.testing.assert_allclose(compute_times(LISTED, 0.1, 2.0), [0.0, 4.0, 7.0, 11.0], rtol=1e-14)


def test_design_has_the_readings_in_their_order() -> None:
    design = make_planned_design(Axis("X"), TARGETS, LISTED, 0.1, 2.0)
    np.testing.assert_array_equal(design.position, [0.1, 0.3, 0.3, 0.1])
    np.testing.assert_array_equal(design.direction, [1.0, 1.0, -1.0, -1.0])
    np.testing.assert_array_equal(design.target, [0, 1, 1, 0])
    np.testing.assert_array_equal(design.run, [1, 1, 1, 1])
    np.testing.assert_allclose(design.since_reversal, [0.05, 0.25, 0.05, 0.25], rtol=1e-14)
    assert not design.time_is_counted
    assert design.is_bidirectional


def test_design_ends_where_the_targets_do() -> None:
    design = make_planned_design(Axis("X"), TARGETS, LISTED, 0.1, 2.0)
    assert (design.length, design.middle, design.duration) == (0.3 - 0.1, 0.2, 11.0)
