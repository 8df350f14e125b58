"""The machine behind the control: turns and stops of its motors, and what its faults do to the tool."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from circles_on_linuxcnc import RADIUS, Faults, stops_of, turns_of


def round_trip(sense: float) -> np.ndarray:
    """A motor path: up to the circle from outside, a turn and a half, and back."""
    angle = -np.pi / 2 + sense * np.linspace(0.0, 3 * np.pi, 6000)
    on = RADIUS * np.column_stack([np.cos(angle), np.sin(angle)])
    beside = np.linspace(RADIUS + 1.5, RADIUS, 200)[:, np.newaxis]
    rest = np.repeat([[0.0, -RADIUS - 1.5]], 300, axis=0)
    way_in, way_out = beside * [[0.0, -1.0]], beside[::-1] * on[-1:] / RADIUS
    return np.concatenate([rest, way_in, on, way_out])


def test_each_turn_is_found_between_its_ways_to_and_from_the_circle() -> None:
    both = np.concatenate([round_trip(1.0), round_trip(-1.0)])
    turns = list(turns_of(both))
    assert len(turns) == 2
    travelled = [np.ptp(np.unwrap(np.arctan2(each[:, 1], each[:, 0]))) for each in turns]
    assert travelled == pytest.approx([3 * np.pi, 3 * np.pi], abs=0.02)


def test_an_axis_out_of_square_and_of_other_scales_shows_on_the_diagonal() -> None:
    motors = np.array([[0.0, 0.0], [100.0, 100.0]])
    faults = Faults(lost_motion=(0.0, 0.0), scales=(20e-6, -10e-6), square=5e-6)
    assert faults.tool(motors)[1] - motors[1] == pytest.approx([2e-3 - 0.5e-3, -1e-3])


def test_a_carriage_stays_behind_its_motor_by_half_its_play() -> None:
    there = np.linspace(0.0, 10.0, 101)
    motors = np.column_stack([np.concatenate([there, there[::-1]]), np.zeros(202)])
    tool = Faults(lost_motion=(6e-3, 0.0), scales=(0.0, 0.0), square=0.0).tool(motors)
    assert tool[50, 0] - motors[50, 0] == pytest.approx(-3e-3)
    assert tool[150, 0] - motors[150, 0] == pytest.approx(3e-3)


def test_stops_are_told_with_the_direction_they_were_come_to_from() -> None:
    places = [-5.0, 0.0, 10.0, 12.0, 10.0, 0.0]
    moves = [np.linspace(one, other, 100) for one, other in pairwise(places)]
    rests = [np.full(200, each) for each in places]
    motor = np.concatenate([each for pair in zip(rests, [*moves, []], strict=True) for each in pair])
    found = [(target, way) for target, way, _ in stops_of(motor, np.array([0.0, 10.0]))]
    assert found == [(0.0, "+"), (10.0, "+"), (10.0, "-"), (0.0, "-")]


def test_what_should_be_found_follows_from_gains_and_geometry() -> None:
    told = Faults(gains=(500.0, 400.0)).values()
    assert told["servo-mismatch T_X-T_Y"] == pytest.approx(2.0 - 2.5)
    assert told["scale-mismatch X-Y"] == pytest.approx(40.0)
    assert told["squareness C0Y"] == pytest.approx(5.0)
