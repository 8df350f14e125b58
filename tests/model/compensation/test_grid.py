"""Where a table has its rows: as fine as the targets support, as coarse as the U of a mean allows."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport.model.compensation.basis import ReadingScatter, TableBasis
from zlmreport.model.compensation.curve import ErrorCurve
from zlmreport.model.compensation.making import Grid, GridReason, GridRules, make_grid_of
from zlmreport.plugin import Approach, FloatArray, Place

PLACE = Place("test")
UNEVEN = np.array([0.0, 0.04, 0.07, 0.13, 0.16, 0.22, 0.25, 0.3])
#: Of a bow that is 8 µm high over the 0.3 m of the test: its lines miss c·h²/8 between rows h apart.
BEND = 8 * 8e-6 / 0.3**2


def bow(at: FloatArray) -> FloatArray:
    return np.stack([BEND / 2 * at * (0.3 - at)] * 2)


def known_by(single: float, **of_waves: object) -> TableBasis:
    """Return a basis whose smooth part is the bow, from five readings a mean that scatter by so much, m."""
    forward, reverse = bow(UNEVEN)
    curve = ErrorCurve(UNEVEN, forward, reverse, np.full((2, 8), single), 5, tuple(Approach))
    scatter = ReadingScatter(single, 0.0, 60) if single else None
    return TableBasis(curve, bow, bow(UNEVEN), (), scatter, lambda _: bow, **of_waves)


def chosen(basis: TableBasis, **control: object) -> Grid:
    step = control.pop("step", None)
    return make_grid_of(basis, PLACE, step=step, rules=GridRules(**control))


def test_rows_stand_at_the_targets_where_lines_between_them_are_within_u() -> None:
    grid = chosen(known_by(1e-6))
    assert grid.reason is GridReason.TARGETS
    assert grid.rows.tolist() == UNEVEN.tolist()
    assert grid.allowed == pytest.approx(2e-6 / np.sqrt(5))
    assert grid.added == pytest.approx(BEND * 0.06**2 / 8, rel=0.1)  # between the targets farthest apart


def test_a_model_known_better_gets_the_fewest_rows_that_keep_within_u() -> None:
    grid = chosen(known_by(0.15e-6))
    intervals = len(grid.rows) - 1
    assert grid.reason is GridReason.UNCERTAINTY
    assert BEND * (0.3 / intervals) ** 2 / 8 <= grid.allowed < BEND * (0.3 / (intervals - 1)) ** 2 / 8


def test_no_grid_is_finer_than_four_rows_in_the_shortest_wave_that_the_targets_show() -> None:
    grid = chosen(known_by(0.01e-6))
    assert (len(grid.rows), grid.reason) == (15, GridReason.SUPPORT)
    assert grid.added > grid.allowed


def test_a_control_that_takes_fewer_rows_gets_what_it_takes_and_the_rest_is_stated() -> None:
    grid = chosen(known_by(0.01e-6), most_rows=6)
    assert (len(grid.rows), grid.reason) == (6, GridReason.CONTROL)
    assert grid.added == pytest.approx(BEND * 0.06**2 / 8, rel=0.1)


def test_a_control_with_equal_steps_gets_no_targets_that_are_unequally_far_apart() -> None:
    grid = chosen(known_by(1e-6), is_equidistant=True)
    assert np.ptp(np.diff(grid.rows)) < 1e-12
    assert grid.added <= grid.allowed


def test_a_wave_that_a_finer_grid_can_carry_is_carried() -> None:
    wave = {"screw-pitch": 0.09}
    assert chosen(known_by(1e-6)).reason is GridReason.TARGETS
    basis = known_by(1e-6, waves=wave)
    assert basis.list_left_out(chosen(basis).rows) == {}


def test_a_stated_step_is_kept() -> None:
    grid = chosen(known_by(1e-6), step=0.1)
    assert grid.reason is GridReason.STATED
    assert grid.rows == pytest.approx([0.0, 0.1, 0.2, 0.3])
