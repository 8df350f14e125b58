"""The direction of an axis, told from its motion."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from zlmreport.capture.track import Track
from zlmreport.measurement.approach import Approach

UP, DOWN = Approach.POSITIVE, Approach.NEGATIVE


def direction(*values: float) -> Approach | None:
    """Return the direction after values, of which motion counts from more than 10 on."""
    track = Track(10.0)
    for value in values:
        track.add(value)
    return track.direction


def test_the_direction_is_that_of_the_last_motion() -> None:
    assert direction(0, 0, 5, 11, 20, 20) is UP
    assert direction(0, 0, 5, 11, 20, 20, 15, 9, 8, 8) is DOWN


@given(st.lists(st.floats(-5, 5), max_size=50))
def test_noise_is_no_motion(noise: list[float]) -> None:
    assert direction(*noise) is None
    assert direction(0, 20, 40, 45, 45, *(45 + each for each in noise)) is UP


def test_slow_motion_is_motion() -> None:
    assert direction(*range(40)) is UP


@pytest.mark.parametrize("wrong", [1e9, -1e9])
def test_a_single_wrong_value_turns_nothing(wrong: float) -> None:
    assert direction(0, 20, 40, wrong, 40, 40) is UP


def test_the_position_is_a_median_of_three() -> None:
    track = Track(10.0)
    for value in (1.0, 500.0, 2.0):
        track.add(value)
    assert track.position == 2.0


def test_what_is_forgotten_has_no_direction() -> None:
    track = Track(10.0)
    for value in (0, 20, 40, 60):
        track.add(value)
    track.forget()
    assert (track.direction, track.position, track.before) == (None, None, None)
