"""The diagnosis on tests that hide something, or nothing: what it names, and what it leaves open."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from model.axis_tests import (
    EFFECTS,
    INSTALLED,
    SIGMA,
    USUAL,
    hidden,
    known,
    linear_test,
    model_of,
    noise,
    observations,
    pendulum_test,
    realistic_noise,
)
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict, diagnose
from zlmreport.model.diagnosis.error_numbers import compute_error_numbers
from zlmreport.model.diagnosis.finding import ContestFinding, find
from zlmreport.model.diagnosis.report import report
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.fit import Fit, fit
from zlmreport.model.fitting.observations import select_readings
from zlmreport.plugin import Axis, AxisKind, FloatArray, Language
from zlmreport.plugin.effect import Design

DESIGN = linear_test()
#: Air that changes so much that its effects have a plausible size.
_LIVELY_AIR = replace(
    DESIGN,
    conditions={**DESIGN.conditions, "air_temperature": 293.35 + 8.0 * np.sin(DESIGN.time / 250.0 + 1.0)},
)
#: Hidden effects with their searched parameters.
HIDDEN = {
    "screw-pitch": [0.01],
    "encoder-interpolation": [20e-6],
    "periodic": [0.31],
    "scale-joint": [0.52],
    "scale-kink": [0.4],
    "compensation-sign": [],
    "compensation-shift": [],
    "abbe": [],
    "backlash-gradient": [],
    "backlash-bow": [],
    "reversal-relaxation": [0.05],
    "directional-pitch": [0.01],
    "scale-expansion": [],
    "thermal-growth": [300.0],
    "thermal-drift": [300.0],
    "air-index": [],
    "dead-path": [],
    "time-periodic": [290.0],
    "datum-step": [910.0],
    "first-run": [],
}


def _diagnosis(
    added: FloatArray | float, *, model: AxisModel = USUAL, design: Design = DESIGN, seed: int = 2
) -> AxisDiagnosis:
    readings = known(design) + realistic_noise(design, seed) + added
    return diagnose(model, observations(design, readings), INSTALLED)


@cache
def _hiding(effect: str) -> AxisDiagnosis:
    """Return the diagnosis of a test that hides an effect."""
    design = _LIVELY_AIR if effect in {"air-index", "dead-path"} else DESIGN
    return _diagnosis(hidden(design, effect, HIDDEN[effect], size=1.5), design=design)


@pytest.mark.long
@pytest.mark.parametrize("effect", HIDDEN)
def test_a_hidden_effect_is_named_first_or_among_its_equals(effect: str) -> None:
    found = _hiding(effect)
    assert found.verdict is DiagnosisVerdict.MISSING
    assert effect in {found.candidates[0].identifier, *found.candidates[0].equals}


def test_a_parameter_that_is_given_its_true_value_leaves_nothing_to_be_found() -> None:
    """What a given value makes of the readings is no part of what the comparison is about."""
    free = _diagnosis(0.0)
    (lost_motion,) = (each for each in free.fit.estimates if each.effect == "backlash")
    fixed = {"lost_motion": lost_motion.value}
    model = AxisModel(
        tuple(
            replace(term, fixed=fixed) if term.effect.identifier == "backlash" else term
            for term in USUAL.terms
        )
    )
    given = _diagnosis(0.0, model=model)
    assert given.verdict is free.verdict is DiagnosisVerdict.ADEQUATE
    assert given.fit.noise.sigma == pytest.approx(free.fit.noise.sigma, rel=0.05)


@cache
def screw() -> AxisDiagnosis:
    """Return the diagnosis of a test that hides the pitch of a screw."""
    return _diagnosis(hidden(DESIGN, "screw-pitch", [0.01], size=2.0))


def test_adding_the_effect_takes_the_error_to_the_noise() -> None:
    first, floor = screw().candidates[0], screw().error.noise_rms
    assert floor is not None
    assert screw().error.rms > 1.8 * floor
    assert first.error.rms < 1.25 * floor  # irregular geometry and slow drift remain
    assert first.share is not None
    assert first.share > 0.9
    assert first.error.cross_validated_rms is not None
    assert first.error.cross_validated_rms < 0.6 * (screw().error.cross_validated_rms or 0.0)


def test_the_first_candidate_has_the_amplitude_that_was_hidden() -> None:
    estimates = {each.parameter.name: each for each in screw().candidates[0].estimates}
    truth = hidden(DESIGN, "screw-pitch", [0.01], size=2.0)
    columns = EFFECTS["screw-pitch"].columns(DESIGN, np.array([0.01]))
    expected = np.linalg.lstsq(columns, truth, rcond=None)[0]
    for name, value in zip(("sine", "cosine"), expected, strict=False):
        assert abs(estimates[name].value - value) < 2 * estimates[name].expanded_uncertainty


def test_candidates_come_best_first_with_probabilities_of_one_whole() -> None:
    evidence = [each.evidence for each in screw().candidates]
    assert evidence == sorted(evidence, reverse=True)
    assert sum(each.probability for each in screw().candidates) <= 1 + 1e-12
    assert screw().candidates[0].probability > 0.95


@pytest.mark.long
def test_where_nothing_is_missing_the_model_is_adequate_and_nothing_is_named() -> None:
    found = [_diagnosis(0.0, seed=seed) for seed in range(10)]
    # Each is a false alarm with 5 %: of ten, three or more are with 1 %.
    assert [each.verdict for each in found].count(DiagnosisVerdict.ADEQUATE) >= 8
    quiet = found[2]
    assert (quiet.verdict, quiet.candidates, quiet.together) == (DiagnosisVerdict.ADEQUATE, (), ())
    assert quiet.remainder is None


@pytest.mark.parametrize("size", [1.5, 4.0])
def test_a_wave_in_time_has_its_name_also_where_its_period_had_to_be_searched_for(size: float) -> None:
    short = linear_test(21, 3)
    short = replace(short, time=short.time * 0.273)
    model = model_of("offset")
    causes = {"time-periodic": [61.0], "backlash-bow": []}
    parts = [hidden(short, name, theta, size=size, model=model) for name, theta in causes.items()]
    readings = np.sum(parts, axis=0) + 5e-6 * (short.time > 400.0) + noise(short)
    found = diagnose(model, observations(short, readings), INSTALLED)
    assert {each.identifier for each in found.together} == {*causes, "datum-step"}
    assert found.remainder is None


@pytest.mark.parametrize(("runs", "waves"), [(5, 21.4), (3, 14.2)])
def test_a_cooler_that_switches_often_while_an_axis_is_measured_has_its_name(runs: int, waves: float) -> None:
    design, model = linear_test(21, runs), model_of("offset")
    causes = {"time-periodic": [design.duration / waves], "backlash": []}
    parts = [hidden(design, name, theta, size=1.5, model=model) for name, theta in causes.items()]
    found = diagnose(model, observations(design, np.sum(parts, axis=0) + noise(design)), INSTALLED)
    assert {each.identifier for each in found.together} == set(causes)
    assert found.remainder is None


@pytest.mark.parametrize("seed", [2, pytest.param(6, marks=pytest.mark.long)])
def test_what_explains_nothing_is_not_named_for_making_others_cheaper(seed: int) -> None:
    # A bow of the lost motion and a worn zone are much like what varies once a turn; some geometry stays.
    places = np.round(np.sort(np.random.default_rng(5).uniform(0, 2 * np.pi, 31)), 3)
    design = linear_test(31, 5, axis=Axis("C", kind=AxisKind.ROTARY, travel=(0.0, 2 * np.pi)), places=places)
    lost_motion = 8 + 4 * np.sin(design.position + 2.2 * seed)
    geometry = 0.5 * np.random.default_rng(seed).standard_normal(31)[design.target]
    deviation = SIGMA * (lost_motion * design.direction + geometry) + noise(design, seed)
    found = diagnose(model_of("offset"), observations(design, deviation), INSTALLED)
    assert {each.identifier for each in found.together} == {"backlash", "lost-motion-turn"}


def test_waves_in_time_are_sought_as_far_as_each_has_eight_readings() -> None:
    def count_waves(targets: int, runs: int) -> float:
        design = linear_test(targets, runs)
        return float(np.max(design.duration / EFFECTS["time-periodic"].grid(design)))

    assert count_waves(21, 5) == pytest.approx(24)
    assert count_waves(21, 3) == pytest.approx(126 / 8)
    assert count_waves(9, 3) == pytest.approx(9)


def test_a_shape_that_no_effect_has_is_left_without_a_name() -> None:
    place = DESIGN.position
    shape = (
        np.where((place > 0.3) & (place < 0.55), 1.0, 0.0) * DESIGN.direction * np.sin(DESIGN.time / 200.0)
    )
    found = _diagnosis(6e-6 * shape)
    assert found.verdict is DiagnosisVerdict.UNEXPLAINED
    assert found.remainder is not None
    assert found.remainder.rms > 0.5 * SIGMA


def test_what_is_left_without_a_name_is_described_by_its_shape() -> None:
    smooth = np.exp(-0.5 * ((DESIGN.time / DESIGN.duration - 0.6) / 0.06) ** 2)
    found = _diagnosis(5e-6 * smooth)
    assert found.verdict is DiagnosisVerdict.UNEXPLAINED
    assert found.remainder is not None
    assert "in time" in found.remainder.shape.in_language(Language.ENGLISH)
    assert found.remainder.low < 0.6 * DESIGN.duration < found.remainder.high


@pytest.mark.long
def test_two_missing_effects_are_found_together_and_one_after_another() -> None:
    both = hidden(DESIGN, "screw-pitch", [0.01], size=1.5) + hidden(
        DESIGN, "thermal-drift", [300.0], size=1.5
    )
    first = _diagnosis(both)
    assert first.verdict is DiagnosisVerdict.MISSING
    assert {each.identifier for each in first.together} == {"screw-pitch", "thermal-drift"}
    second = _diagnosis(both, model=USUAL.with_effect(first.together[0]))
    assert second.verdict is DiagnosisVerdict.MISSING
    assert [each.identifier for each in second.together] == list(first.further)
    third = _diagnosis(both, model=second.fit.model.with_effect(second.together[0]))
    assert third.verdict is DiagnosisVerdict.ADEQUATE


def test_effects_with_the_same_columns_are_named_together_with_what_tells_them_apart() -> None:
    model = model_of("offset", "backlash")
    readings = noise(DESIGN) - 12e-6 * DESIGN.position
    found = diagnose(model, observations(DESIGN, readings), [EFFECTS["scale-error"], EFFECTS["cosine-error"]])
    first = found.candidates[0]
    assert first.identifier == "scale-error"  # the more general of the two
    assert first.equals == ("cosine-error",)
    assert first.discriminate_by is not None
    assert "beam" in first.discriminate_by.en


def test_what_cannot_be_tried_is_said_and_named_where_it_would_look_alike() -> None:
    bare = replace(DESIGN, conditions={})
    found = _diagnosis(hidden(DESIGN, "thermal-growth", [300.0], size=2.0), design=bare)
    reasons = {each.effect: each.reason.en for each in found.not_testable}
    assert reasons["scale-expansion"] == "no column {column} was logged beside the readings"
    assert found.candidates[0].identifier == "thermal-growth"
    assert {"scale-expansion", "screw-expansion"} <= set(found.not_excluded)


def test_effects_of_another_kind_of_axis_are_not_named_as_alike() -> None:
    found = _diagnosis(hidden(DESIGN, "periodic", [0.31], size=2.0))
    assert found.candidates[0].identifier == "periodic"
    assert "gear-mesh" in {each.effect for each in found.not_testable}
    assert "gear-mesh" not in found.not_excluded


def test_of_two_that_explain_as_much_the_one_that_assumes_less_leads() -> None:
    scatter = noise(DESIGN)
    # The temperature hardly changes, and by chance a little as the readings scatter.
    change = 0.0002 * scatter / SIGMA + 0.001 * np.random.default_rng(9).standard_normal(len(scatter))
    design = replace(DESIGN, conditions={"axis_temperature": 291.15 - change})
    effects = [EFFECTS["datum-temperature"], EFFECTS["offset"]]
    found = diagnose(model_of("scale-error", "backlash"), observations(design, scatter + 3e-6), effects)
    first, second = found.candidates
    assert (first.identifier, second.identifier) == ("offset", "datum-temperature")
    assert first.equals == ("datum-temperature",)
    assert first.evidence < second.evidence


def test_readings_that_stand_off_one_after_another_are_not_set_aside() -> None:
    block = np.zeros(len(DESIGN.position))
    block[60:66] = 9e-6
    found = _diagnosis(block)
    assert not set(found.outliers.tolist()) & set(range(60, 66))
    assert found.verdict is DiagnosisVerdict.UNEXPLAINED


@pytest.mark.long
def test_drift_that_the_linear_method_hides_in_the_scatter_is_found() -> None:
    found = _hiding("thermal-drift")
    assert "time-order" in {each.test.value for each in found.failures}
    assert "lack-of-fit" not in {each.test.value for each in found.failures}


def test_a_broken_reading_is_set_aside_and_does_not_hide_the_effect() -> None:
    added = hidden(DESIGN, "screw-pitch", [0.01], size=1.5)
    added[[40, 130]] += [25e-6, -25e-6]
    found = _diagnosis(added)
    assert found.outliers.tolist() == [40, 130]
    assert found.candidates[0].identifier == "screw-pitch"
    assert "outliers" in {each.test.value for each in found.failures}


@pytest.mark.long
def test_the_same_readings_give_the_same_diagnosis() -> None:
    added = hidden(DESIGN, "screw-expansion", size=1.0)
    assert json.dumps(report(_diagnosis(added))) == json.dumps(report(_diagnosis(added)))


@pytest.mark.long
def test_the_unit_of_the_deviations_changes_no_verdict() -> None:
    readings = known(DESIGN) + realistic_noise(DESIGN) + hidden(DESIGN, "screw-expansion", size=1.0)
    found = [diagnose(USUAL, observations(DESIGN, scale * readings), INSTALLED) for scale in (1.0, 7.0)]
    assert found[0].verdict is found[1].verdict
    assert [each.identifier for each in found[0].together] == [each.identifier for each in found[1].together]
    # What is usual of rivals knows its unit; what the readings say of the leading effect does not.
    assert found[1].candidates[0].evidence == pytest.approx(found[0].candidates[0].evidence, rel=1e-6)


def test_a_pendulum_test_hides_warm_up_and_the_diagnosis_says_so() -> None:
    shares = {}
    for name, design in (("linear", DESIGN), ("pendulum", pendulum_test())):
        found = {each.effect: each.share for each in _diagnosis(0.0, design=design).visibility}
        shares[name] = found["thermal-growth"]
    assert shares["linear"] > 0.3
    assert shares["pendulum"] < 0.05


def test_too_few_readings_are_refused_with_what_would_do() -> None:
    few = np.flatnonzero((DESIGN.run == 1) & (DESIGN.target < 5))
    design = select_readings(DESIGN, few)
    with pytest.raises(ModelError, match="a diagnosis needs at least 6 readings more than parameters"):
        diagnose(USUAL, observations(design, known(DESIGN)[few]), INSTALLED)


def test_readings_without_any_scatter_are_diagnosed() -> None:
    found = diagnose(model_of("offset"), observations(DESIGN, np.zeros(len(DESIGN.position))), INSTALLED)
    assert found.verdict is DiagnosisVerdict.ADEQUATE


class TestReport:
    """The results file of a diagnosis."""

    @property
    def written(self) -> dict[str, Any]:
        return report(screw())

    def test_it_has_what_is_promised(self) -> None:
        assert self.written["schema"] == "zlmreport/diagnosis/1"
        assert self.written["verdict"] == "missing"
        assert self.written["model"]["effects"] == ["polynomial", "backlash"]
        assert set(self.written["error"]) == {
            "rms",
            "noise_rms",
            "chi2_per_dof",
            "cross_validated_rms",
            "unit",
        }
        first = self.written["candidates"][0]
        assert first["effect"] == "screw-pitch"
        promised = {
            "p_value",
            "probability",
            "rms_after",
            "cross_validated_rms_after",
            "parameters",
            "explains",
        }
        assert promised | {"indistinguishable_from", "discriminate_by"} <= set(first)

    def test_it_speaks_in_micrometres_and_millimetres(self) -> None:
        assert self.written["error"]["rms"] == pytest.approx(1e6 * screw().error.rms)
        parameters = {each["name"]: each for each in self.written["candidates"][0]["parameters"]}
        assert (parameters["period"]["value"], parameters["period"]["unit"]) == (10.0, "mm")
        lost_motion = next(
            each for each in self.written["model"]["parameters"] if each["effect"] == "backlash"
        )
        assert lost_motion["value"] == pytest.approx(-3.0, abs=0.5)
        assert lost_motion["unit"] == "um"

    def test_it_is_json_without_infinite_numbers(self) -> None:
        assert json.loads(json.dumps(self.written, allow_nan=False)) == self.written

    def test_its_sentences_are_in_the_language_asked_for(self) -> None:
        english = self.written["candidates"][0]["explains"]
        german = report(screw(), Language.GERMAN)["candidates"][0]["explains"]
        assert re.match(r"explains (9\d|100) % of what the noise leaves open", english)
        assert re.match(r"erklärt (9\d|100) % dessen, was das Rauschen offen lässt", german)


def test_more_readings_than_memory_holds_are_refused_with_what_they_would_take() -> None:
    design = linear_test(50, 220)
    with pytest.raises(ModelError, match="22000 readings, which takes at least 1 min and 5 GB"):
        diagnose(model_of("offset"), observations(design, noise(design)), INSTALLED)


def test_the_share_that_is_done_is_told_and_grows() -> None:
    design, shares = linear_test(11, 3), []
    diagnose(model_of("offset"), observations(design, noise(design)), INSTALLED, told=shares.append)
    assert shares == sorted(shares)
    assert 0 < shares[0] < 0.1
    assert 0.4 < shares[-1] <= 1


@pytest.mark.long
@pytest.mark.parametrize(
    ("effect", "theta", "size", "asked"),
    [
        ("backlash", [], -800e-6, "20 times what is usual for a screw; a belt"),
        ("screw-pitch", [0.01], 60e-6, "7.5 times what is usual for a screw; bent"),
        ("scale-expansion", [], -4e-6, "compensated twice, or too much"),
    ],
)
def test_what_is_large_leads_and_is_asked_for(
    effect: str, theta: list[float], size: float, asked: str
) -> None:
    column = EFFECTS[effect].columns(DESIGN, np.array(theta))[:, 0]
    found = diagnose(model_of("offset"), observations(DESIGN, size * column + noise(DESIGN)), INSTALLED)
    leading = found.candidates[0]
    assert [each.identifier for each in found.together] == [effect]
    assert (leading.identifier, leading.is_large, leading.is_plausible) == (effect, True, True)
    assert leading.question is not None
    assert asked in leading.question.in_language(Language.ENGLISH)


def test_a_rising_line_is_no_cosine_error() -> None:
    rising = 20e-6 * DESIGN.position + noise(DESIGN)
    found = diagnose(model_of("offset"), observations(DESIGN, rising), INSTALLED)
    leading = found.candidates[0]
    assert leading.identifier == "scale-error"
    assert "cosine-error" not in leading.equals


@pytest.mark.long
@pytest.mark.parametrize("size", [6e-6, 10e-6])
def test_what_is_left_beside_a_bow_is_told_and_is_no_larger_than_what_the_whole_set_leaves(
    size: float,
) -> None:
    place = DESIGN.position
    there = np.where((place > 0.3) & (place < 0.55), size, 0.0)
    bowed = 30e-6 * ((place - 0.5) / 0.5) ** 3 + there * DESIGN.direction * np.sin(DESIGN.time / 200.0)
    found = diagnose(model_of("offset"), observations(DESIGN, bowed + noise(DESIGN)), INSTALLED)
    assert found.remainder is not None
    assert found.remainder.rms <= found.error_after.rms


def test_a_set_that_the_readings_do_not_determine_is_not_adequate(monkeypatch: pytest.MonkeyPatch) -> None:
    # So small that χ² alone would let it pass.
    readings = known(DESIGN) + hidden(DESIGN, "scale-kink", [0.6], size=0.5) + noise(DESIGN)
    assert diagnose(USUAL, observations(DESIGN, readings), INSTALLED).verdict is DiagnosisVerdict.MISSING

    def refuse(*_: object) -> None:
        raise ModelError(["the readings do not determine it"])

    for module in ("diagnosis", "candidate"):
        monkeypatch.setattr(f"zlmreport.model.diagnosis.{module}.fit_with_member", refuse)
    found = diagnose(USUAL, observations(DESIGN, readings), INSTALLED)
    assert found.together == ()
    assert found.verdict is DiagnosisVerdict.UNEXPLAINED


def test_what_only_a_curve_without_a_name_would_replace_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    design = linear_test(11, 3)

    def find_curve_instead(
        fitted: Fit, *tried: Any, may_go: frozenset[str] = frozenset(), **rest: Any
    ) -> ContestFinding:
        return replace(find(fitted, *tried, **rest), makeshift=tuple(may_go))

    monkeypatch.setattr("zlmreport.model.diagnosis.diagnosis.find", find_curve_instead)
    lost = observations(design, 2e-6 * design.direction + noise(design))
    found = diagnose(model_of("offset", "backlash"), lost, INSTALLED, may_go=frozenset({"backlash"}))
    assert (found.verdict, found.remainder) == (DiagnosisVerdict.ADEQUATE, None)


def test_a_first_run_that_stands_off_is_no_noise_whether_it_is_in_the_model_or_not() -> None:
    design = pendulum_test()  # every target is read in one go: in each the first readings jump
    readings = known(design) + 8 * SIGMA * (design.run == 1) + noise(design)
    for more in ((), ("first-run",)):
        fitted = fit(model_of(*USUAL.identifiers, *more), design, readings)
        assert compute_error_numbers(fitted).noise_rms == pytest.approx(SIGMA, rel=0.1)


@pytest.mark.parametrize("place", [0.0, 0.1])
def test_a_test_of_one_target_shows_what_changes_in_time_and_with_the_direction(place: float) -> None:
    design = linear_test(1, 10, places=np.array([place]))
    quiet = 3e-6 + noise(design)

    def name(deviation: FloatArray) -> set[str]:
        found = diagnose(model_of("offset"), observations(design, deviation), INSTALLED)
        assert found.remainder is None
        return {
            each for one in found.candidates[:1] for each in (one.identifier, *one.equals) if found.together
        }

    assert name(quiet) == set()
    assert "backlash" in name(quiet + 2e-6 * design.direction)
    assert "thermal-drift" in name(quiet + 5e-6 * -np.expm1(-design.time / 300.0))
