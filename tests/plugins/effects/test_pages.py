"""What the pages of the effects say, together."""

from __future__ import annotations

import pytest

from plugins.effects.installed import EFFECTS, design_for
from zlmreport.testing import full_designs

# The identifiers are promises to users.
PROMISED = """
offset scale-error polynomial backlash backlash-gradient backlash-bow reversal-relaxation screw-pitch
directional-pitch encoder-interpolation periodic scale-joint scale-kink compensation-sign compensation-shift
abbe scale-expansion screw-expansion thermal-growth thermal-drift datum-temperature datum-step first-run
time-periodic air-index dead-path cosine-error probe-radius gauge-misalignment
eccentricity ellipticity gear-mesh
"""


def test_the_effects_that_users_are_promised_are_there() -> None:
    assert set(EFFECTS) == set(PROMISED.split())


@pytest.mark.parametrize("identifier", EFFECTS)
def test_confusion_is_mutual_and_one_measurement_tells_both_apart(identifier: str) -> None:
    for confusion in EFFECTS[identifier].confusions:
        back = {each.effect: each.told_apart_by for each in EFFECTS[confusion.effect].confusions}
        assert back[identifier] == confusion.told_apart_by


@pytest.mark.parametrize("identifier", EFFECTS)
def test_effect_can_be_tested_where_everything_is_known(identifier: str) -> None:
    assert EFFECTS[identifier].untestable(design_for(identifier)) is None


@pytest.mark.parametrize(
    ("identifier", "expected"),
    [
        ("screw-pitch", {"period": 0.01}),
        ("directional-pitch", {"period": 0.01}),
        ("encoder-interpolation", {"period": 20e-6}),
        ("abbe", {"abbe_offset": 0.2}),
        ("compensation-shift", {"factor": 1.0}),
        ("air-index", {"factor": 1.0}),
        ("backlash", {}),
    ],
)
def test_values_that_follow_from_the_job(identifier: str, expected: dict[str, float]) -> None:
    assert EFFECTS[identifier].expected(full_designs()["a complete linear test"].axis) == expected


def test_teeth_follow_from_the_pitch_of_the_gear() -> None:
    axis = full_designs()["a complete rotary test"].axis
    assert EFFECTS["gear-mesh"].expected(axis) == {"teeth": 120.0}


def test_polynomial_contains_what_its_first_powers_are() -> None:
    assert EFFECTS["polynomial"].contains == ("offset", "scale-error")
