"""Effects that come in several forms, and the grids of those that are searched."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from pydantic import ValidationError

from plugins.effects.installed import EFFECTS, design_for

NO_THETA = np.empty(0)


def test_order_of_the_polynomial_is_a_key() -> None:
    fifth = EFFECTS["polynomial"].with_settings(EFFECTS["polynomial"].options(order=5))
    assert [parameter.name for parameter in fifth.linear] == ["c0", "c1", "c2", "c3", "c4", "c5"]
    assert fifth.columns(design_for("polynomial"), NO_THETA).shape[1] == 6


def test_polynomial_is_a_cubic_unless_a_job_says_otherwise() -> None:
    assert len(EFFECTS["polynomial"].linear) == 4


@pytest.mark.parametrize("identifier", ["screw-pitch", "encoder-interpolation"])
def test_harmonics_are_a_key(identifier: str) -> None:
    effect = EFFECTS[identifier].with_settings(EFFECTS[identifier].options(harmonics=(1, 4)))
    assert [parameter.name for parameter in effect.linear] == ["sine", "cosine", "sine_4", "cosine_4"]


@pytest.mark.parametrize("identifier", ["screw-pitch", "encoder-interpolation"])
def test_a_contest_tries_one_harmonic_the_other_and_both(identifier: str) -> None:
    forms = [len(form.linear) for form in EFFECTS[identifier].forms()]
    assert [forms[0], forms[1], 4 in forms] == [2, 2, True]


@pytest.mark.parametrize("harmonics", [(), (0,), (5,), (1, 1)])
def test_harmonics_that_are_none_are_refused(harmonics: tuple[int, ...]) -> None:
    with pytest.raises(ValidationError):
        EFFECTS["screw-pitch"].options(harmonics=harmonics)


def test_bearing_at_the_other_end_turns_the_fan_round() -> None:
    design = design_for("screw-expansion")
    effect = EFFECTS["screw-expansion"]
    last = effect.with_settings(effect.options(fixed_bearing="last"))
    at_bearing = replace(design, position=np.full_like(design.position, 1.0))
    assert np.all(last.columns(at_bearing, NO_THETA) == 0.0)


def test_shift_is_tried_to_both_sides() -> None:
    design = design_for("compensation-shift")
    one, other = (form.columns(design, NO_THETA) for form in EFFECTS["compensation-shift"].forms())
    table = design.axis.compensation_table
    np.testing.assert_allclose(
        one[:, 0] - other[:, 0], table.at(design.position - 0.1) - table.at(design.position + 0.1), atol=1e-18
    )


@pytest.mark.parametrize(("identifier", "known"), [("screw-pitch", 10e-3), ("encoder-interpolation", 20e-6)])
def test_period_that_the_job_states_is_not_searched(identifier: str, known: float) -> None:
    np.testing.assert_array_equal(EFFECTS[identifier].grid(design_for(identifier)), [[known]])


def test_unknown_period_is_searched_evenly_in_its_inverse_up_to_half_the_targets() -> None:
    design = design_for("periodic")
    within = design.length / EFFECTS["periodic"].grid(design)[:, 0]
    assert (within[0], within[-1]) == (pytest.approx(1.3), pytest.approx(10.3))
    np.testing.assert_allclose(np.diff(within), 0.25, rtol=1e-9)


def test_joint_is_searched_in_every_gap_but_the_outer_ones() -> None:
    design = design_for("scale-joint")
    targets, places = design.target_positions, EFFECTS["scale-joint"].grid(design)[:, 0]
    assert len(places) == len(targets) - 3
    np.testing.assert_array_equal(np.searchsorted(targets, places), np.arange(2, len(targets) - 1))


def test_jump_is_searched_between_readings() -> None:
    design = design_for("datum-step")
    moments = EFFECTS["datum-step"].grid(design)[:, 0]
    assert len(moments) == 200
    assert not np.any(np.isin(moments, design.time))
    assert design.time[1] < moments[0] < moments[-1] < design.time[-2]


def test_teeth_are_whole_numbers_that_the_targets_can_tell() -> None:
    design = design_for("gear-mesh")
    bare = replace(design, axis=replace(design.axis, screw_pitch=None))
    teeth = EFFECTS["gear-mesh"].grid(bare)[:, 0]
    assert set(range(3, 11)) < set(teeth)


def test_teeth_that_no_job_states_are_those_of_usual_wheels_too() -> None:
    design = design_for("gear-mesh")
    bare = replace(design, axis=replace(design.axis, screw_pitch=None))
    assert {60, 90, 120, 180, 360} < set(EFFECTS["gear-mesh"].grid(bare)[:, 0])


def test_a_pitch_of_the_gear_tells_the_teeth() -> None:
    np.testing.assert_array_equal(EFFECTS["gear-mesh"].grid(design_for("gear-mesh")), [[120.0]])


def test_whole_pitches_hide_the_pitch_and_random_fractions_show_it() -> None:
    design = design_for("screw-pitch")
    effect = EFFECTS["screw-pitch"]
    even = replace(design, position=np.round(design.position, 2))
    hidden, seen = (np.std(effect.columns(each, np.array([10e-3])), axis=0).max() for each in (even, design))
    assert hidden < 1e-9
    assert seen > 0.5
