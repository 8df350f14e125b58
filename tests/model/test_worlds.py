"""Axes as owners have them: what is surely there is named, nothing else is, and numbers are true."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from model.axis_tests import (
    AXIS,
    EFFECTS,
    INSTALLED,
    SIGMA,
    USUAL,
    known,
    linear_test,
    model_of,
    noise,
    pendulum_test,
)
from model.hidden_effect import study, written
from model.worlds import (
    built,
    corrected_twice,
    diagnosed,
    in_warm_air,
    joints,
    lasting_noise,
    straight,
    with_night,
)
from zlmreport.model.diagnosis.candidate import list_questions
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict
from zlmreport.model.diagnosis.report import write_verdict_statement
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.fitting.fit import fit
from zlmreport.plugin import Language

_DESIGN = linear_test(15, 4)


def _said(diagnosis: AxisDiagnosis) -> str:
    return write_verdict_statement(diagnosis).in_language(Language.ENGLISH)


def test_axis_with_a_bent_scale_and_lost_motion_is_known_from_nothing() -> None:
    found = diagnosed(model_of("offset"), _DESIGN, known(_DESIGN) + noise(_DESIGN))
    assert {each.identifier for each in found.together} == {"polynomial", "backlash"}
    assert found.leaves_noise


def test_each_step_to_a_model_lowers_the_error() -> None:
    design = replace(linear_test(21, 3), conditions={})
    warming = 7e-6 * (1.0 - np.exp(-design.time / (0.3 * design.duration)))
    readings = 8e-6 * design.position - 1.5e-6 * design.direction + warming + noise(design, 1, 0.7e-6)
    found = built(model_of("offset"), design, readings)
    assert {each.identifier for each in found.steps} == {"scale-error", "backlash", "thermal-drift"}
    assert all(each.after.rms < each.before.rms for each in found.steps)


def test_slope_is_seen_beside_lost_motion_that_is_a_hundred_times_as_large() -> None:
    design = linear_test(13, 3)
    readings = 1e-5 * design.position - 4e-4 * design.direction + noise(design)
    found = diagnosed(model_of("offset"), design, readings)
    assert [each.identifier for each in found.together] == ["backlash", "scale-error"]
    assert found.leaves_noise


def test_screw_worn_on_one_flank_is_told_with_its_lost_motion_and_its_slope() -> None:
    design = replace(linear_test(21, 3), conditions={})
    first, last = design.span
    worn = (design.direction < 0) * (3e-6 + 5e-6 * (design.position > 0.55 * last + 0.45 * first))
    readings = 8e-6 * design.position + worn + noise(design, 1, 0.7e-6)
    found = built(model_of("offset"), design, readings)
    assert {each.identifier for each in found.steps} == {"one-way-step", "backlash", "scale-error"}
    assert found.last.verdict is DiagnosisVerdict.ADEQUATE


@pytest.mark.long
def test_lost_motion_is_told_beside_a_kink_in_one_direction() -> None:
    design = replace(linear_test(21, 3), conditions={})
    first, last = design.span
    kink = (design.direction > 0) * 12e-6 * np.maximum(0.0, design.position - 0.4 * last - 0.6 * first)
    readings = 5e-6 * design.position - 1.5e-6 * design.direction + kink + noise(design, 1, 0.7e-6)
    found = built(model_of("offset"), design, readings)
    assert {each.identifier for each in found.steps} == {"one-way-kink", "backlash", "scale-error"}


def test_noise_that_lasts_over_a_few_readings_is_noise() -> None:
    readings = known(_DESIGN) + lasting_noise(_DESIGN, 0.6)
    assert diagnosed(USUAL, _DESIGN, readings).verdict is DiagnosisVerdict.ADEQUATE


@pytest.mark.long
def test_second_joint_comes_in_beside_the_first() -> None:
    design = linear_test(13, 3)
    readings = straight(design) + joints(design) + noise(design)
    found = built(model_of("offset", "scale-error", "backlash"), design, readings)
    assert [each.identifier for each in found.steps] == ["scale-joint", "scale-joint-2"]
    assert found.last.verdict is DiagnosisVerdict.ADEQUATE


def test_air_that_was_corrected_twice_is_named_and_asked_for() -> None:
    design = in_warm_air(_DESIGN)
    found = diagnosed(USUAL, design, known(design) + corrected_twice(design) + noise(design))
    leading = found.candidates[0]
    assert leading.identifier == "air-index"
    assert leading.question is not None
    assert "corrected twice" in leading.question.in_language(Language.ENGLISH)


def test_zero_that_moved_in_a_night_is_a_step_of_the_zero() -> None:
    design = with_night(_DESIGN, run=2)
    found = diagnosed(USUAL, design, known(design) + noise(design) + 3e-6 * (design.run > 2))
    assert found.together[0].identifier == "datum-step"
    assert any("22 h" in each.in_language(Language.ENGLISH) for each in found.remarks)


def test_pitch_that_the_readings_contradict_is_said_beside_that_of_the_job() -> None:
    wave = 3e-6 * np.sin(2 * np.pi * _DESIGN.position / 0.012)
    said = _said(diagnosed(USUAL, _DESIGN, known(_DESIGN) + wave + noise(_DESIGN)))
    assert "screw-pitch" in said
    assert "12.0 mm fits, the job says 10.0 mm" in said


def test_pitch_that_the_job_does_not_state_is_found() -> None:
    """Who knows least states none: a wrong one led to the cause, and none to nothing."""
    design = linear_test(axis=replace(AXIS, screw_pitch=None))
    wave = 3e-6 * np.sin(2 * np.pi * design.position / 0.016)
    said = _said(diagnosed(USUAL, design, known(design) + wave + noise(design)))
    assert "screw-pitch" in said
    assert "pitch of the screw: 16.0 mm fits, the job states no axis.screw_pitch." in said


def test_form_of_a_named_effect_is_nothing_that_stands_in_its_place(tmp_path: Path) -> None:
    """Beside "Missing effect: screw-pitch" it was said that "it is screw-pitch instead"."""
    silent = study(written(tmp_path, (", screw_pitch: 10", "")))
    found = silent.diagnose(INSTALLED)
    assert [each.identifier for each in found.together] == ["screw-pitch"]
    assert found.remainder is not None
    assert found.remainder.instead is None


def test_wave_beside_that_of_the_stated_pitch_contradicts_no_pitch() -> None:
    design = linear_test(41, 3, axis=replace(AXIS, screw_pitch=0.125))
    pulley = 5e-6 * np.sin(2 * np.pi * design.position / 0.125)
    teeth = 4e-6 * np.sin(2 * np.pi * design.position / 0.005)
    found = built(model_of("offset"), design, pulley + teeth + noise(design))
    (question,) = found.questions
    said = question.in_language(Language.ENGLISH)
    assert said == "pitch of the screw: 5.00 mm fits beside the 125 mm that the job states."


@pytest.mark.parametrize("length", [0.06, 0.075])
def test_wave_shorter_than_two_intervals_is_found_where_targets_lie_irregularly(length: float) -> None:
    places = np.sort(np.random.default_rng(4).uniform(0.0, 1.0, 21))
    design = linear_test(places=places, axis=replace(AXIS, screw_pitch=None))
    wave = 4e-6 * np.sin(2 * np.pi * design.position / length)
    (found,) = diagnosed(USUAL, design, known(design) + wave + noise(design)).together
    assert found.identifier == "periodic"


@pytest.mark.parametrize(("way", "sign"), [("up", 1), ("down", -1)])
def test_wear_of_one_flank_is_named_with_its_direction(way: str, sign: int) -> None:
    design = linear_test(25, 5)
    hump = 2.5e-6 * np.exp2(-((2.0 * (design.position - 0.3) / 0.2) ** 2))
    worn = np.where(np.sign(design.direction) == sign, hump, 0.0)
    (found,) = diagnosed(USUAL, design, known(design) + worn + noise(design, sigma=0.5e-6)).together
    assert found.identifier == "worn-zone"
    assert found.settings.model_dump() == {"acts_on": way}


def test_plain_lost_motion_leads_that_which_settles_where_every_reading_is_as_far_from_its_reversal() -> None:
    """In pendulum tests the way since the reversal is the overrun at nearly all readings."""
    design = pendulum_test(15, 4)
    names = []
    for seed in range(4):
        readings = 1.5e-6 * design.direction + noise(design, seed, 0.5e-6)
        names += [each.identifier for each in diagnosed(model_of("offset"), design, readings).together]
    assert set(names) == {"backlash"}


def test_millimetres_for_micrometres_are_told_before_any_cause() -> None:
    readings = 1e-3 * (straight(_DESIGN) + noise(_DESIGN))
    said = _said(diagnosed(model_of("offset"), _DESIGN, readings))
    assert said.startswith("The data look wrong: the deviations are no larger than 0.0")
    assert "Missing effects: scale-error and backlash" in said


def _with_given_play(lost_motion: float) -> AxisModel:
    """Return the usual model with the lost motion given, m."""
    terms = model_of("offset", "scale-error", "backlash").terms
    given = {"backlash": {"lost_motion": lost_motion}}
    return AxisModel(tuple(replace(each, fixed=given.get(each.effect.identifier, {})) for each in terms))


def test_given_value_of_the_wrong_sign_is_said_before_any_cause() -> None:
    readings = noise(_DESIGN) - 2e-6 * _DESIGN.direction
    found = diagnosed(_with_given_play(4e-6), _DESIGN, readings)
    assert found.verdict is DiagnosisVerdict.UNEXPLAINED
    assert found.remainder is None
    assert "backlash, reversal value of the whole axis: −4.11 µm" in _said(found)
    assert "fits, the job says 4.00 µm." in _said(found)


def test_given_value_that_is_a_little_wrong_is_said_before_an_effect_that_is_like_it() -> None:
    targets = np.array([0.0, 0.037, 0.081, 0.122, 0.160, 0.199])
    design = linear_test(6, 3, places=targets)
    readings = 5e-5 * design.position + 3e-6 * design.direction + noise(design, sigma=0.3e-6)
    terms = model_of("offset", "backlash").terms
    given = {"backlash": {"lost_motion": 5e-6}}
    model = AxisModel(tuple(replace(each, fixed=given.get(each.effect.identifier, {})) for each in terms))
    found = diagnosed(model, design, readings)
    assert found.together == ()
    assert "fits, the job says 5.00 µm." in _said(found)


def test_given_value_is_not_blamed_for_an_effect_that_is_missing() -> None:
    readings = noise(_DESIGN) - 2e-6 * _DESIGN.direction + 4e-6 * np.sin(2 * np.pi * _DESIGN.position / 0.01)
    found = diagnosed(_with_given_play(-4e-6), _DESIGN, readings)
    assert found.contradicted == ()
    assert [each.identifier for each in found.together] == ["screw-pitch"]


def test_value_that_is_given_for_the_readings_do_not_tell_it_contradicts_nothing() -> None:
    terms = model_of("offset", "scale-error", "cosine-error").terms
    given = {"scale-error": {"slope": 1e-5}}
    model = AxisModel(tuple(replace(each, fixed=given.get(each.effect.identifier, {})) for each in terms))
    ragged = 6e-6 * np.random.default_rng(3).uniform(-1, 1, 15)[_DESIGN.target] + 1e-5 * _DESIGN.position
    found = diagnosed(model, _DESIGN, ragged + noise(_DESIGN))
    assert found.verdict is DiagnosisVerdict.UNEXPLAINED
    assert found.contradicted == ()


def test_ratio_that_is_not_as_its_effect_means_it_is_said_with_that_meaning() -> None:
    targets = _DESIGN.target_positions
    between = np.random.default_rng(4).uniform(0, 20e-6, len(targets))  # no whole increments
    design = replace(_DESIGN, position=_DESIGN.position + between[np.searchsorted(targets, _DESIGN.position)])
    rounded = 0.4 * EFFECTS["control-increment"].columns(design, np.array([0.02e-3]))[:, 0]
    fitted = fit(model_of("offset", "control-increment"), design, rounded + noise(design))
    (asked,) = list_questions(fitted, {"control-increment"})
    said = asked.in_language(Language.ENGLISH)
    assert re.fullmatch(
        r"control-increment: a factor of 0\.\d+ fits \(1: each command is rounded\)\.", said
    ), said


@pytest.mark.parametrize("seed", [0, 1])
def test_two_runs_that_stand_off_are_these_two_and_not_every_run(seed: int) -> None:
    design = linear_test(11, 5, seed=seed)
    first = int(design.cycle.min())
    runs = 2.5 * SIGMA * np.isin(design.cycle, [first, first + 2])
    found = diagnosed(model_of("offset"), design, runs + noise(design, seed=seed + 50))
    assert {each.identifier for each in found.together} == {"first-run", "run-displaced"}
    assert found.remainder is None


@pytest.mark.parametrize("seed", [1, 2])
def test_one_run_of_three_stands_off_beside_a_warmth_that_passes(seed: int) -> None:
    """In time a curve that displaces every run is much like the warmth, and made it cheap."""
    design, warmth = linear_test(21, 3, seed=seed), EFFECTS["passing-warmth"]
    peak, spell = 0.1 * design.duration, 0.45 * design.duration
    passing = warmth.columns(design, np.array([peak, spell]))[:, 0]
    middle = np.unique(design.run)[1]
    deviation = SIGMA * (5.0 * passing / np.std(passing) + 9.3 * (design.run == middle))
    found = diagnosed(model_of("offset"), design, deviation + noise(design, seed=seed + 50))
    assert {each.identifier for each in found.together} == {"passing-warmth", "run-displaced"}
    assert found.remainder is None


def test_values_of_a_set_are_those_beside_the_others_of_it() -> None:
    slope, kink = 15e-6, 20e-6
    deviation = slope * _DESIGN.position + kink * np.maximum(0.0, _DESIGN.position - 0.5) + noise(_DESIGN)
    found = diagnosed(model_of("offset"), _DESIGN, deviation)
    assert {each.identifier for each in found.together} == {"scale-error", "scale-kink"}
    values = {each.identifier: each.estimates[0] for each in found.candidates}
    for name, true in (("scale-error", slope), ("scale-kink", kink)):
        assert abs(values[name].value - true) < values[name].expanded_uncertainty


@pytest.mark.parametrize("seed", [1, 6])
def test_a_steady_drift_is_a_drift_whose_end_nobody_saw(seed: int) -> None:
    design = linear_test(21, 5)
    drift = 4e-6 * design.time / design.duration
    scatter = np.random.default_rng(seed).normal(0.0, 2.5e-7, len(design.time))
    found = diagnosed(model_of("offset"), design, drift - 1e-6 * design.direction + scatter)
    assert {each.identifier for each in found.together} == {"thermal-drift", "backlash"}
    assert found.remainder is None


def test_a_name_that_noise_does_without_is_no_cause_because_a_curve_would_do_as_well() -> None:
    """Beside four causes a kink gained as little as a curve in its place, and led the stairs of a build."""
    random = np.random.default_rng(7)
    for targets, readings in ((21, 210), (31, 310)):  # of the tests before it
        random.uniform(size=targets)
        random.standard_normal(readings)
    places = np.round(np.clip(np.linspace(10, 990, 25) + random.uniform(-3.3, 3.3, 25), 10, 990), 3) / 1e3
    passes = np.arange(25) * 6.0 + np.arange(10)[:, np.newaxis] * (25 * 6 + 12)
    design = replace(linear_test(25, 5, places=places), conditions={}, time=passes.ravel())
    place, time = design.position, design.time
    pitch = 2e-6 * np.sin(2 * np.pi * place / 0.01 + 1)
    growth = 12e-6 * place * (1 - np.exp(-time / 2400))
    sound = pitch + growth + 8e-6 * place - 2e-6 * design.direction
    found = diagnosed(model_of("offset"), design, sound + 4e-7 * random.standard_normal(len(place)))
    names = {"scale-error", "backlash", "screw-pitch", "thermal-growth"}
    assert {each.identifier for each in found.together} == names


@pytest.mark.parametrize("seed", [6, 15])
def test_lost_motion_that_settles_after_each_reversal_is_no_bow_of_it(seed: int) -> None:
    """Neither of the two by itself takes the place of the bow, and beside it neither is needed."""
    shifts = np.random.default_rng(5).uniform(-5e-3, 5e-3, 26)
    places = np.clip(np.linspace(0, 0.5, 26) + shifts, 0, 0.5)
    design = replace(linear_test(26, 5, places=places), conditions={})
    place, up = design.position, design.direction
    way = np.where(up > 0, place + 5e-3, 0.505 - place)
    bow = 2e-6 * (1 - ((place - 0.25) / 0.25) ** 2)
    scatter = np.random.default_rng(seed).normal(0, 3.5e-7, len(place))
    found = diagnosed(model_of("offset"), design, up * (3e-6 * np.exp(-way / 0.06) - 1e-6) + bow + scatter)
    names = {"polynomial", "backlash", "reversal-relaxation"}
    assert {each.identifier for each in found.together} == names
