"""What must not change a diagnosis: what the model describes, and the order in which things are told."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from environments import ROOT
from model.axis_tests import INSTALLED, hidden, known, linear_test, model_of, noise, observations
from model.hidden_effect import study
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict, diagnose
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.plugin import FloatArray
from zlmreport.plugin.effect import Effect

DESIGN = linear_test(13, 4)
MODEL = model_of("polynomial", "backlash")
READINGS = known(DESIGN) + noise(DESIGN) + hidden(DESIGN, "screw-pitch", [0.01], size=1.5)


def _diagnosis(
    added: FloatArray | float = 0.0, model: AxisModel = MODEL, effects: tuple[Effect, ...] = INSTALLED
) -> AxisDiagnosis:
    return diagnose(model, observations(DESIGN, READINGS + added), effects)


@cache
def _usual() -> AxisDiagnosis:
    return _diagnosis()


def _outcome(diagnosis: AxisDiagnosis) -> tuple[object, ...]:
    """Return what a reader takes from a diagnosis."""
    return (
        diagnosis.verdict,
        [each.identifier for each in diagnosis.candidates],
        [each.equals for each in diagnosis.candidates],
        [(each.test, each.where) for each in diagnosis.failures],
    )


def _compute_odds(probability: float) -> float:
    """Return 2·ln of the odds of what is so probable."""
    return 2 * math.log(probability / (1 - probability))


def _is_like(diagnosis: AxisDiagnosis, usual: AxisDiagnosis) -> None:
    assert _outcome(diagnosis) == _outcome(usual)
    for one, other in zip(diagnosis.candidates, usual.candidates, strict=True):
        # What the model explains counts by a noise of known size, 0.2 % of it, beside the scatter: that is an
        # eighth of what is worth a mention, 2.
        assert _compute_odds(one.probability) == pytest.approx(_compute_odds(other.probability), abs=0.25)
        assert one.error.rms == pytest.approx(other.error.rms, rel=1e-6)


def test_the_example_has_something_to_lose() -> None:
    assert _usual().verdict is DiagnosisVerdict.MISSING
    assert _usual().candidates[0].identifier == "screw-pitch"


@pytest.mark.parametrize(
    "added",
    [40e-6 + 1e-4 * DESIGN.position, 5e-6 * DESIGN.direction + 30e-6 * (2 * DESIGN.position - 1) ** 3],
    ids=["offset and slope", "backlash and cubic"],
)
def test_what_the_model_describes_changes_nothing(added: FloatArray) -> None:
    _is_like(_diagnosis(added), _usual())


def test_readings_of_the_other_sign_give_the_same_names() -> None:
    mirrored = diagnose(MODEL, observations(DESIGN, -READINGS), INSTALLED)
    assert [each.identifier for each in mirrored.candidates] == [
        each.identifier for each in _usual().candidates
    ]
    assert mirrored.fit.rms == pytest.approx(_usual().fit.rms, rel=1e-9)


def test_the_order_of_the_model_changes_nothing() -> None:
    _is_like(_diagnosis(model=model_of("backlash", "polynomial")), _usual())


def test_the_order_in_which_effects_are_installed_changes_nothing() -> None:
    _is_like(_diagnosis(effects=INSTALLED[::-1]), _usual())


@pytest.mark.long
def test_the_rounding_of_readings_decides_nothing_on_five_targets(tmp_path: Path) -> None:
    # On so few targets many a set of effects describes the same: which leads is a matter of order alone.
    job = tmp_path / "c.yaml"
    job.write_text(
        f"schema: zlmreport/job/1\nextends: {ROOT / 'configs' / 'rotary-axis' / 'report.yaml'}\n"
        "certificate: {number: C, kind: report}\nmodel: {effects: [offset, scale-error, backlash]}\n",
        encoding="utf-8",
    )
    model, read = study(job).model, study(job).observed
    rounding = 1e-13 * np.random.default_rng(0).standard_normal(len(read.deviation))
    rounded = replace(read, deviation=read.deviation * (1.0 + rounding))
    found, other = (diagnose(model, each, INSTALLED) for each in (read, rounded))
    assert _outcome(other) == _outcome(found)
    assert found.remainder is not None
    assert other.remainder is not None
    assert other.remainder.shape == found.remainder.shape
