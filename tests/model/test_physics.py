"""What is large is not impossible: it costs evidence and is asked for; what is not needed does not lead."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import EFFECTS, INSTALLED, hidden, linear_test, model_of, noise, observations
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict, diagnose
from zlmreport.model.diagnosis.report import report
from zlmreport.plugin import FloatArray, Language

_DESIGN = linear_test(11, 3)
_MODEL = model_of("offset", "scale-error")


def _diagnosed(deviation: FloatArray) -> AxisDiagnosis:
    return diagnose(_MODEL, observations(_DESIGN, deviation + noise(_DESIGN)), INSTALLED)


@pytest.fixture(scope="module")
def belt() -> AxisDiagnosis:
    """A belt: 1.2 mm of lost motion."""
    return _diagnosed(-600e-6 * _DESIGN.direction)


def test_a_belt_has_the_lost_motion_of_a_belt(belt: AxisDiagnosis) -> None:
    assert belt.verdict is DiagnosisVerdict.MISSING
    assert [each.identifier for each in belt.together] == ["backlash"]
    first = belt.candidates[0]
    assert first.is_plausible
    assert first.share == pytest.approx(1.0, abs=0.01)
    assert belt.leaves_noise


def test_what_is_large_is_asked_for(belt: AxisDiagnosis) -> None:
    first = belt.candidates[0]
    assert first.is_large
    assert first.question is not None
    said = first.question.in_language(Language.ENGLISH)
    assert "−1200" in said.replace("-", "−")
    listed = report(belt)["candidates"][0]
    assert (listed["large"], listed["plausible"], listed["question"]) == (True, True, said)


def test_a_usual_size_is_not_asked_for() -> None:
    first = _diagnosed(-3e-6 * _DESIGN.direction).candidates[0]
    assert (first.identifier, first.is_large, first.question) == ("backlash", False, None)


def test_of_two_with_the_same_column_the_one_leads_whose_sign_is_possible() -> None:
    found = diagnose(
        model_of("offset", "backlash"),
        observations(_DESIGN, noise(_DESIGN) + 12e-6 * _DESIGN.position),
        [EFFECTS["cosine-error"], EFFECTS["scale-error"]],
    )
    assert [each.identifier for each in found.together] == ["scale-error"]
    assert found.candidates[0].equals == ()


def test_an_air_that_was_corrected_twice_is_named() -> None:
    lively = 293.15 + 6.0 * np.sin(_DESIGN.time / 250.0)
    design = replace(_DESIGN, conditions={**_DESIGN.conditions, "air_temperature": lively})
    model = model_of("offset", "scale-error", "backlash")
    twice = -0.95 * EFFECTS["air-index"].columns(design, np.empty(0))[:, 0]
    found = diagnose(model, observations(design, twice + noise(design, sigma=0.3e-6)), INSTALLED)
    assert found.together[0].identifier == "air-index"
    assert found.candidates[0].is_large


def test_what_explains_all_never_stands_behind_what_explains_little() -> None:
    shape = hidden(_DESIGN, "backlash-bow", size=40.0, model=_MODEL)
    found = _diagnosed(shape)
    shares = [each.share or 0.0 for each in found.candidates]
    assert shares[0] == pytest.approx(max(shares))
    assert found.candidates[0].identifier == "backlash-bow"
