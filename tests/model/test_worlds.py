"""Axes as owners have them: what is surely there is named, nothing else is, and numbers are true."""

from __future__ import annotations

from model.axis_tests import USUAL, known, linear_test, model_of, noise
from model.worlds import built, corrected_twice, diagnosed, in_warm_air, joints, lasting_noise, straight
from zlmreport.model.diagnosis.diagnosis import Verdict

_DESIGN = linear_test(15, 4)


def test_axis_with_a_bent_scale_and_lost_motion_is_known_from_nothing() -> None:
    found = diagnosed(model_of("offset"), _DESIGN, known(_DESIGN) + noise(_DESIGN))
    assert {each.identifier for each in found.together} == {"polynomial", "backlash"}
    assert found.leaves_noise


def test_noise_that_lasts_over_a_few_readings_is_noise() -> None:
    readings = known(_DESIGN) + lasting_noise(_DESIGN, 0.6)
    assert diagnosed(USUAL, _DESIGN, readings).verdict is Verdict.ADEQUATE


def test_second_joint_comes_in_beside_the_first() -> None:
    design = linear_test(13, 3)
    readings = straight(design) + joints(design) + noise(design)
    found = built(model_of("offset", "scale-error", "backlash"), design, readings)
    assert [each.identifier for each in found.steps] == ["scale-joint", "scale-joint-2"]
    assert found.last.verdict is Verdict.ADEQUATE


def test_air_that_was_corrected_twice_is_named_and_asked_for() -> None:
    design = in_warm_air(_DESIGN)
    found = diagnosed(USUAL, design, known(design) + corrected_twice(design) + noise(design))
    leading = found.candidates[0]
    assert leading.identifier == "air-index"
    assert leading.question is not None
    assert "corrected twice" in leading.question.en
