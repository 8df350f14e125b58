import numpy as np
import pytest

from machines.simulated import MICRO, circle, nothing, out_of_square
from machines.test_diagnosis import CATALOGUE, diagnosed
from zlmreport.machines.planning import plan_next_run, plan_values


def test_the_other_sense_decides_between_squareness_and_servo_mismatch():
    found = plan_values(
        plan_next_run(diagnosed(circle(out_of_square(20 * MICRO), seed=2, senses=(1,))), CATALOGUE)
    )
    assert set(found["decides_between"]) == {"squareness", "servo-mismatch"}
    other = next(each for each in found["proposals"] if each["run"]["senses"] == ["cw"])
    assert other["decides"] > 0.95
    assert other["minutes"] < 5
    elsewhere = [each["decides"] for each in found["proposals"] if each["run"]["plane"] != "XY"]
    assert max(elsewhere) < 0.5
    assert "other sense" in other["statement"]


def test_the_smallest_visible_sizes_are_seen_half_of_the_time():
    """σ and 360 readings alone: LR = 20 at the size that the noise makes of a column."""
    found = plan_values(plan_next_run(diagnosed(circle(nothing, seed=5)), CATALOGUE))
    sizes = {(each["effect"], each["name"]): each["value"] for each in found["smallest_visible"]}
    square = sizes["squareness", "C0Y"] * np.pi / 180 / 3600 * 0.15 / 2 / np.sqrt(2) / 0.5e-6
    assert square == pytest.approx(0.51, abs=0.3)  # ρ for LR = 20, machine.md section 5
    assert found["decides_between"] == []
