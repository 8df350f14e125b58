"""Targets that lie at few phases of a known period do not see what repeats with it."""

from __future__ import annotations

import numpy as np
import pytest

from foresight.planned import WHOLE_PITCHES, foreseen
from zlmreport.foresight.phases import periods_at_phases, phases
from zlmreport.language import Language
from zlmreport.measurement.axis import Axis

HALF_PITCHES = "plan: {targets: {positions: [0, 55, 110, 165, 220, 275, 330, 385, 440, 495, 550]}}"


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
    assert phases(np.array(targets), 10.0) == number


def test_position_before_whole_turn_is_at_the_phase_of_its_beginning() -> None:
    assert phases(np.array([0.0, 9.99, 20.01]), 10.0) == 1


def test_each_known_period_is_named() -> None:
    axis = Axis("X", screw_pitch=0.01, signal_period=0.004)
    (only,) = periods_at_phases(axis, np.array([0.0, 0.02, 0.04]), 1)[:1]
    assert only.in_language(Language.ENGLISH) == "the pitch of 10 mm"
    assert len(periods_at_phases(axis, np.array([0.0, 0.02, 0.04]), 1)) == 2


def test_plan_at_half_pitches_is_known_to_see_a_part_only() -> None:
    (period,) = foreseen(("plan: {}", HALF_PITCHES)).half_seen
    assert period.in_language(Language.GERMAN) == "der Steigung von 10 mm"


def test_plan_with_random_fractions_sees_periods_whole() -> None:
    assert foreseen().half_seen == ()


def test_plan_at_whole_pitches_has_its_own_reason() -> None:
    assert foreseen(("plan: {}", WHOLE_PITCHES)).half_seen == ()
