"""What the pages of the effects say, together."""

from __future__ import annotations

import pytest

import zlmreport_plugins.effects
from plugins.effects.installed import EFFECTS
from zlmreport.plugin import Language, measurands_of
from zlmreport.plugin.effect import measurements_of_catalogue
from zlmreport.testing import full_designs

# The identifiers are promises to users.
PROMISED = """
offset scale-error polynomial backlash backlash-gradient backlash-bow reversal-relaxation screw-pitch
directional-pitch encoder-interpolation periodic scale-joint scale-kink compensation-sign compensation-shift
abbe scale-expansion screw-expansion thermal-growth thermal-drift datum-temperature datum-step first-run
time-periodic air-index dead-path cosine-error probe-radius gauge-misalignment
eccentricity ellipticity gear-mesh
worn-zone control-increment scale-elements lost-motion-step lost-motion-wave lost-motion-turn one-way-kink
one-way-step drive-period pole-pitch growth-from-bearing growth-after-pause material-expansion passing-warmth
first-run-slope run-displaced
"""


def test_the_effects_that_users_are_promised_are_there() -> None:
    assert set(EFFECTS) == set(PROMISED.split())


@pytest.mark.parametrize("identifier", EFFECTS)
def test_confusion_is_mutual_and_one_measurement_tells_both_apart(identifier: str) -> None:
    for confusion in EFFECTS[identifier].confusions:
        back = {each.effect: each.told_apart_by for each in EFFECTS[confusion.effect].confusions}
        assert back[identifier] == confusion.told_apart_by


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


ON_ROTARY = """
offset scale-error polynomial scale-joint scale-kink compensation-sign compensation-shift worn-zone backlash
backlash-gradient backlash-bow reversal-relaxation directional-pitch lost-motion-step lost-motion-wave
lost-motion-turn one-way-kink one-way-step encoder-interpolation periodic eccentricity ellipticity gear-mesh
drive-period thermal-drift datum-temperature passing-warmth time-periodic datum-step first-run first-run-slope
run-displaced
"""


def test_rotary_table_is_tried_for_all_that_physics_allows_there() -> None:
    design = full_designs()["a complete rotary test"]
    tried = {name for name, effect in EFFECTS.items() if effect.untestable(design) is None}
    assert tried - {"probe-radius", "gauge-misalignment"} == set(ON_ROTARY.split())


@pytest.mark.parametrize("identifier", EFFECTS)
def test_effect_says_on_what_it_acts(identifier: str) -> None:
    acts_on = {each.identifier for each in measurands_of(EFFECTS[identifier])}
    assert "positioning" in acts_on
    assert acts_on <= {"positioning", "straightness"}


@pytest.mark.parametrize("identifier", sorted(set(PROMISED.split()) - {"probe-radius", "gauge-misalignment"}))
def test_effect_says_what_happens_and_how_that_is_known(identifier: str) -> None:
    effect = EFFECTS[identifier]
    assert effect.physics is not None
    assert effect.source is not None


def test_every_measurement_tells_some_effects_apart() -> None:
    named = {each.told_apart_by.en for effect in EFFECTS.values() for each in effect.confusions}
    listed = measurements_of_catalogue(zlmreport_plugins.effects.__file__, "measurements.yaml")
    assert {words.en for words in listed.values()} - named == set()


@pytest.mark.parametrize("identifier", EFFECTS)
def test_german_is_no_english(identifier: str) -> None:
    effect = EFFECTS[identifier]
    said = [effect.title, effect.look, effect.remedy, effect.physics]
    for words in (each for each in said if each is not None):
        assert words.in_language(Language.GERMAN) != words.in_language(Language.ENGLISH)
