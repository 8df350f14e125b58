"""What a test of few targets tells: irregular geometry has no name, nor has what is too little to see."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import (
    EFFECTS,
    INSTALLED,
    SIGMA,
    linear_test,
    model_of,
    noise,
    observations,
)
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict, diagnose
from zlmreport.model.diagnosis.effect_set import make_member
from zlmreport.model.diagnosis.fixed_numbers import FixedNumbers
from zlmreport.model.diagnosis.random_curves import Course
from zlmreport.model.diagnosis.remainder import Remainder
from zlmreport.model.diagnosis.report import write_verdict_statement
from zlmreport.model.diagnosis.set_costs import FORBIDDEN, SetCosts
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.fitting.fit import fit
from zlmreport.plugin import Axis, AxisKind, FloatArray, Language
from zlmreport.plugin.effect import Design

_MODEL = model_of("offset", "scale-error", "backlash")


def _draw_geometry(design: Design, seed: int, size: float) -> FloatArray:
    """Return an error that is another at each target, m, and the same whenever the axis comes there."""
    targets = design.target_positions
    errors = size * np.random.default_rng([seed, len(targets)]).standard_normal(len(targets))
    return np.asarray(errors[np.searchsorted(targets, design.position)])


def _diagnose(design: Design, deviation: FloatArray, model: AxisModel = _MODEL) -> AxisDiagnosis:
    return diagnose(model, observations(design, deviation), INSTALLED)


def _leave(design: Design, deviation: FloatArray, model: AxisModel = _MODEL) -> Remainder:
    """Return what a diagnosis leaves without a name."""
    found = _diagnose(design, deviation, model).remainder
    assert found is not None
    return found


@pytest.mark.parametrize(("targets", "seed"), [(6, 1), (6, 4), (7, 2), (9, 4), (11, 0), (11, 11)])
def test_geometry_that_is_irregular_from_target_to_target_is_given_no_name(targets: int, seed: int) -> None:
    design = linear_test(targets, 5, seed=seed)
    deviation = _draw_geometry(design, seed, 10 * SIGMA) + noise(design, seed=seed + 50)
    found = _diagnose(design, deviation)
    assert found.verdict is DiagnosisVerdict.UNEXPLAINED
    assert found.remainder is not None
    assert found.remainder.shape.en.startswith("irregular from position to position")


@pytest.mark.parametrize(("targets", "seed"), [(7, 1), (7, 5), (9, 4), (11, 1), (11, 3)])
def test_no_formula_is_proposed_for_what_no_form_follows(targets: int, seed: int) -> None:
    design = linear_test(targets, 5, seed=seed)
    left = _leave(design, _draw_geometry(design, seed, 10 * SIGMA) + noise(design, seed=seed + 50))
    assert (left.course, left.formula) == (Course.IRREGULAR, None)


@pytest.mark.parametrize("kind", AxisKind)
def test_what_is_irregular_along_the_axis_has_no_formula_in_time(kind: AxisKind) -> None:
    # Of a slow slope in three runs over five targets a wave in time explains much, by chance.
    design = linear_test(5, 3, seed=4)
    if kind is AxisKind.ROTARY:
        axis, turn = Axis("C", kind, travel=(0.0, 2 * np.pi)), (0.0, 2 * np.pi)
        design = replace(design, axis=axis, position=2 * np.pi * design.position, span=turn)
    deviation = _draw_geometry(design, 4, 5e-6) + noise(design, 54, 3.5 * SIGMA)
    left = _leave(design, deviation, model_of("offset", "backlash"))
    assert (left.course, left.formula) == (Course.IRREGULAR, None)


def test_a_wave_that_follows_the_most_of_what_is_irregular_is_not_that() -> None:
    design = linear_test(6, 3, seed=3)
    deviation = _draw_geometry(design, 3, 5e-6) + noise(design, 53, 3.5 * SIGMA)
    left = _leave(design, deviation, model_of("offset", "backlash"))
    assert (left.course, left.formula) == (Course.IRREGULAR, None)


@pytest.mark.parametrize(("targets", "seed"), [(6, 0), (6, 3), (7, 2), (7, 3), (7, 5), (9, 0), (9, 3)])
def test_beside_lost_motion_such_geometry_is_given_no_name_either(targets: int, seed: int) -> None:
    design = linear_test(targets, 5, seed=seed)
    geometry = _draw_geometry(design, seed, 3 * SIGMA)
    deviation = geometry + 2 * SIGMA * design.direction + noise(design, seed=seed + 50)
    found = _diagnose(design, deviation, model_of("offset", "scale-error"))
    assert [each.identifier for each in found.together] == ["backlash"]
    assert found.remainder is not None
    assert found.remainder.shape.en.startswith("irregular from position to position")


@pytest.mark.parametrize("seed", [2, 4, 5, 7])
def test_what_would_not_lower_the_error_beside_a_large_remainder_is_not_named(seed: int) -> None:
    design = linear_test(6, 6)
    wave = 1e-6 * np.sin(2 * np.pi * design.time / (0.37 * np.ptp(design.time)) + 1)
    deviation = _draw_geometry(design, seed, 25 * SIGMA) + wave + noise(design, seed=seed + 50)
    found = _diagnose(design, deviation)
    assert found.verdict is DiagnosisVerdict.UNEXPLAINED
    assert not found.together
    # It is there, and told as what may be.
    assert found.candidates[0].identifier == "time-periodic"
    assert found.candidates[0].error.rms >= found.error.rms
    said = write_verdict_statement(found).in_language(Language.ENGLISH)
    is_told = "Likely beside it, but not to be fitted without it: time-periodic" in said
    assert is_told is (found.candidates[0].probability >= 0.8)


@pytest.mark.parametrize(("targets", "is_refused"), [(9, True), (10, False)])
def test_a_set_with_more_numbers_than_there_are_targets_is_refused(targets: int, is_refused: bool) -> None:
    # Offset and slope are two, first and second harmonic of a known pitch and of a signal period four each.
    design = linear_test(targets, 5)
    base = fit(_MODEL, design, noise(design, seed=3)).compute_base()
    effects = [EFFECTS[each] for each in ("screw-pitch", "encoder-interpolation")]
    contest = Contest.of(
        design, base, [each.with_settings(each.options(harmonics=[1, 2])) for each in effects]
    )
    members = [make_member(each, 0, 0.0) for each in contest.families]
    costs = SetCosts(contest).compute(members, contest.quiet)
    assert (costs >= FORBIDDEN) is is_refused


def test_of_a_model_that_describes_any_readings_it_is_said_so() -> None:
    design = linear_test(6, 5, seed=2)
    deviation = _draw_geometry(design, 2, 10 * SIGMA) + noise(design, seed=52)
    polynomial = EFFECTS["polynomial"]
    model = model_of("backlash", polynomial.with_settings(polynomial.options(order=4)), "scale-kink")
    said = write_verdict_statement(_diagnose(design, deviation, model)).en
    assert "it describes any readings" in said


@pytest.mark.parametrize(
    ("names", "targets", "is_too_rich"),
    [
        (("offset",), 2, False),
        (("offset", "scale-error"), 2, False),  # nobody asks more of two targets
        (("offset", "scale-error"), 3, False),
        (("offset", "scale-error", "thermal-drift"), 3, False),
        (("offset", "scale-error", "screw-pitch"), 6, True),
        (("offset", "scale-error", "screw-pitch"), 7, False),
        (("offset", "backlash", "directional-pitch", "backlash-gradient"), 4, True),
        (("offset", "backlash", "backlash-gradient", "lost-motion-step"), 5, False),
    ],
)
def test_numbers_count_in_the_mean_of_both_directions_and_in_their_difference(
    names: tuple[str, ...], targets: int, is_too_rich: bool
) -> None:
    design = linear_test(targets, 5)
    fitted = fit(model_of(*names), design, noise(design, seed=3))
    assert FixedNumbers(design, fitted.compute_base()).is_model_too_rich() is is_too_rich
