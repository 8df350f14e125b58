"""Target positions, and the phases of periods they see."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from model.planning.planned import WHOLE_PITCHES, plan_of_test
from zlmreport.measurement.axis import find_usual_overrun
from zlmreport.model.planning.targets import (
    compute_target_positions,
    count_phases,
    find_periods_at_phases,
    makes_whole_turns,
    sample_targets,
)
from zlmreport.plugin import Axis, AxisKind, Language

LINEAR = Axis("X", travel=(-0.1, 0.5), screw_pitch=0.01)
FULL_TURN = Axis("C", AxisKind.ROTARY, (0.0, 2 * math.pi), screw_pitch=math.radians(4))
OVERRUN = 0.005
HALF_PITCHES = "plan: {targets: {positions: [0, 55, 110, 165, 220, 275, 330, 385, 440, 495, 550]}}"


def _random(seed: int = 1) -> np.random.Generator:
    return np.random.default_rng(seed)


@given(seed=st.integers(0, 2**32), count=st.integers(2, 60), share=st.floats(0.0, 0.999))
def test_targets_rise_within_the_travel(seed: int, count: int, share: float) -> None:
    period = share * 1.2 / count  # a period of 1.2 m / count just fits
    targets = compute_target_positions((-0.2, 1.0), count, period, _random(seed))
    assert np.all(np.diff(targets) > 0)
    assert targets[0] >= -0.2
    assert targets[-1] <= 1.0 + 1e-12


def test_each_target_is_its_multiple_of_the_interval_and_a_fraction_of_the_period() -> None:
    targets = compute_target_positions((0.0, 1.0), 11, 0.01, _random())
    fraction = targets - 0.099 * np.arange(11)
    assert np.all((fraction >= 0) & (fraction < 0.01))
    assert len(set(fraction.round(12))) == 11


def test_without_a_period_targets_are_even() -> None:
    np.testing.assert_array_equal(compute_target_positions((0.0, 4.0), 5, 0.0, _random()), [0, 1, 2, 3, 4])


def test_the_same_seed_gives_the_same_targets() -> None:
    one, other = (compute_target_positions((0.0, 1.0), 11, 0.01, _random(5)) for _ in range(2))
    np.testing.assert_array_equal(one, other)


def test_too_many_targets_are_refused_with_how_many_would_fit() -> None:
    with pytest.raises(ValueError, match=r"101 targets .* do not fit into the travel; up to 100 do"):
        compute_target_positions((0.0, 1.0), 101, 0.01, _random())


def _phases(targets: np.ndarray, period: float) -> np.ndarray:
    return np.unique(np.round(targets / period % 1, 6))


def test_targets_leave_room_to_turn_round_at_both_ends() -> None:
    targets = sample_targets(LINEAR, 11, OVERRUN, None, 1)
    assert targets[0] >= -0.1 + OVERRUN
    assert targets[-1] <= 0.5 - OVERRUN


def test_fractions_reach_over_one_pitch() -> None:
    targets = sample_targets(LINEAR, 11, OVERRUN, None, 1)
    interval = (0.6 - 2 * OVERRUN - 0.01) / 10
    fractions = targets - (-0.1 + OVERRUN) - interval * np.arange(11)
    assert np.all((fractions > -1e-6) & (fractions < 0.01 + 1e-6))
    assert np.ptp(fractions) > 0.005


def test_targets_have_as_many_digits_as_controls_take() -> None:
    millimetres = 1e3 * sample_targets(LINEAR, 11, OVERRUN, None, 1)
    np.testing.assert_allclose(millimetres, np.round(millimetres, 3), atol=1e-12)


@pytest.mark.parametrize("signal_period", [20e-6, 4e-6, 0.5e-6])
def test_digits_do_not_hide_the_signal_period(signal_period: float) -> None:
    axis = Axis("X", travel=(0.0, 1.0), signal_period=signal_period, screw_pitch=0.01)
    assert len(_phases(sample_targets(axis, 41, OVERRUN, None, 1), signal_period)) > 10


def test_without_a_known_period_fractions_reach_over_a_quarter_of_the_interval() -> None:
    targets = sample_targets(Axis("X", travel=(0.0, 1.0)), 11, 0.0, None, 1)
    intervals = np.diff(targets)
    assert np.ptp(intervals) > 0.005
    assert np.all(np.abs(intervals - 0.1) <= 0.025 + 0.0025 + 1e-6)


def test_fractions_of_a_long_period_are_shortened_where_many_targets_are_to_fit() -> None:
    axis = Axis("X", travel=(0.0, 0.1), screw_pitch=0.02)
    targets = sample_targets(axis, 21, 0.001, None, 1)
    assert np.all(np.diff(targets) > 0)


def test_targets_of_a_tiny_travel_are_told_apart() -> None:
    targets = sample_targets(Axis("Z", travel=(0.0, 5e-6)), 11, 1e-7, None, 1)
    assert np.all(np.diff(targets) > 0)


def test_stated_fractions_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ValueError, match=r"21 targets .* do not fit"):
        sample_targets(LINEAR, 21, OVERRUN, 0.1, 1)


def test_travel_shorter_than_both_overruns_is_refused() -> None:
    with pytest.raises(ValueError, match="shorter than the overrun"):
        sample_targets(LINEAR, 5, 0.31, None, 1)


def test_fractions_of_zero_give_even_targets() -> None:
    targets = sample_targets(LINEAR, 11, OVERRUN, 0.0, 1)
    np.testing.assert_allclose(np.diff(targets), 0.059, atol=1e-9)


def test_other_seed_gives_other_targets() -> None:
    one, other = (sample_targets(LINEAR, 11, OVERRUN, None, seed) for seed in (1, 2))
    assert not np.any(one == other)


def test_full_turn_is_covered_from_end_to_end_with_its_quarters_among_the_targets() -> None:
    degrees = np.degrees(sample_targets(FULL_TURN, 13, math.radians(5), None, 1))
    for quarter in (0, 90, 180, 270, 360):
        assert np.min(np.abs(degrees - quarter)) < 1e-9
    assert len(degrees) == 13
    assert np.all(np.diff(degrees) > 0)


def test_part_of_a_turn_has_the_quarters_that_it_can_reach_from_both_sides() -> None:
    axis = Axis("A", AxisKind.ROTARY, (math.radians(-110), math.radians(90)))
    degrees = np.degrees(sample_targets(axis, 11, math.radians(4), None, 1))
    assert np.min(np.abs(degrees + 90)) < 1e-9
    assert np.min(np.abs(degrees)) < 1e-9
    assert degrees[-1] <= 86 + 1e-9


@pytest.mark.parametrize(
    ("axis", "expected"),
    [(LINEAR, 0.005), (Axis("Z", travel=(0.0, 0.02)), 0.0004), (Axis("Y"), 0.005)],
    ids=["usual", "short travel", "no travel"],
)
def test_usual_overrun_is_5_mm_or_a_fiftieth_of_a_short_travel(axis: Axis, expected: float) -> None:
    assert find_usual_overrun(axis) == pytest.approx(expected)


def test_only_a_full_turn_has_no_ends() -> None:
    assert makes_whole_turns(FULL_TURN)
    assert not makes_whole_turns(Axis("A", AxisKind.ROTARY, (0.0, 3.0)))
    assert not makes_whole_turns(LINEAR)


@pytest.mark.parametrize(
    ("targets", "number"),
    [
        ([0, 10, 30, 70], 1),
        ([3.3, 13.3, 33.3], 1),
        ([0, 5, 10, 25], 2),
        ([0, 51, 110, 161], 2),
        ([1, 12, 23], 3),
        ([0, 3.3, 6.7], 3),
    ],
)
def test_phases_of_a_period_are_counted(targets: list[float], number: int) -> None:
    assert count_phases(np.array(targets), 10.0) == number


def test_position_before_whole_turn_is_at_the_phase_of_its_beginning() -> None:
    assert count_phases(np.array([0.0, 9.99, 20.01]), 10.0) == 1


def test_each_known_period_is_named() -> None:
    axis = Axis("X", screw_pitch=0.01, signal_period=0.004)
    (only,) = find_periods_at_phases(axis, np.array([0.0, 0.02, 0.04]), 1)[:1]
    assert only.in_language(Language.ENGLISH) == "the pitch of 10 mm"
    assert len(find_periods_at_phases(axis, np.array([0.0, 0.02, 0.04]), 1)) == 2


def test_plan_at_half_pitches_is_known_to_see_a_part_only() -> None:
    (period,) = plan_of_test(("plan: {}", HALF_PITCHES)).half_seen
    assert period.in_language(Language.GERMAN) == "der Steigung von 10 mm"


def test_plan_with_random_fractions_sees_periods_whole() -> None:
    assert plan_of_test().half_seen == ()


def test_plan_at_whole_pitches_has_its_own_reason() -> None:
    assert plan_of_test(("plan: {}", WHOLE_PITCHES)).half_seen == ()
