"""The motion that part programs are written from."""

from __future__ import annotations

import pytest

from refusals import refusal
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.model.planning.programs import plan_motion_of, write_program_number
from zlmreport.plugin import Approach, Axis, InputError, Place, read_only_floats
from zlmreport.testing import sample_motion

PLACE = Place("job.yaml", 3, 4)


def _slow(**rates: float) -> AxisPlan:
    return AxisPlan(read_only_floats([0.0, 0.1]), **rates)


def test_readings_are_numbered_in_their_order() -> None:
    readings = [stop.reading for stop in sample_motion(Method.PENDULUM).stops if stop.reading]
    assert [reading.number for reading in readings] == list(range(1, 17))
    first, second = readings[:2]
    assert (first.target, first.approach, first.run) == (1, Approach.POSITIVE, 1)
    assert (second.target, second.approach, second.run) == (1, Approach.NEGATIVE, 1)


def test_positions_are_the_decimal_numbers_that_were_meant() -> None:
    positions = [stop.position for stop in sample_motion().stops]
    assert positions[:6] == [-25.5, -20.5, 3.125, 30.002, 58.25, 63.25]


def test_turning_points_are_rounded() -> None:
    rounded = sample_motion(overrun=1.23456).in_decimals(3)
    assert [stop.position for stop in rounded.stops][:2] == [-21.735, -20.5]


def test_rounded_zero_has_no_sign() -> None:
    turned = sample_motion(targets=(0.0, 10.0), overrun=0.0004, method=Method.LINEAR)
    with pytest.raises(InputError, match="leaves no approach"):
        turned.in_decimals(3)
    first = sample_motion(targets=(5.0, 10.0), overrun=5.0001).in_decimals(3).stops[0]
    assert f"{first.position:+.3f}" == "+0.000"


def test_stop_that_the_axis_has_reached_already_is_left_out() -> None:
    # From target 1, approached from above, the second target's turning point is target 1 itself.
    motion = sample_motion(Method.PENDULUM, targets=(0.0, 5.0), runs=1, overrun=5.0)
    assert [stop.position for stop in motion.stops] == [-5.0, 0.0, 5.0, 0.0, 0.0, 5.0, 10.0, 5.0, -5.0]
    assert [stop.position for stop in motion.in_decimals(3).stops] == [
        -5.0,
        0.0,
        5.0,
        0.0,
        5.0,
        10.0,
        5.0,
        -5.0,
    ]


def test_overrun_that_rounds_to_nothing_is_refused() -> None:
    told = refusal(sample_motion(Method.PENDULUM, overrun=0.0004).in_decimals, 3)
    assert "with 3 digits after the point, an overrun of 0.0004 mm leaves no approach" in told


@pytest.mark.parametrize(("rates", "key"), [({"feed": 1e-9}, "feed"), ({"dwell": 1e-4}, "dwell")])
def test_rate_that_no_control_takes_is_refused(rates: dict[str, float], key: str) -> None:
    with pytest.raises(
        InputError, match=f"job.yaml:3:4: measurement.{key}: .* is less than can be programmed"
    ):
        plan_motion_of("N", Axis("X"), _slow(**rates), PLACE)


@pytest.mark.parametrize(
    ("value", "text"), [(2000.0, "2000"), (4.5, "4.5"), (1e6, "1000000"), (0.001, "0.001"), (100.0, "100")]
)
def test_numbers_are_written_without_exponent(value: float, text: str) -> None:
    assert write_program_number(value) == text
