"""A build ends: each step is one that was not taken before."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import chain, repeat

import numpy as np

from model.axis_tests import (
    EFFECTS,
    INSTALLED,
    hidden,
    linear_test,
    model_of,
    noise,
    observations,
    pendulum_test,
)
from model.hidden_effect import example as study_of_example, example_diagnosis
from zlmreport.cli.model_lines import tell_build
from zlmreport.measurement.arrays import read_only_integers
from zlmreport.model.diagnosis.building import (
    Built,
    build,
    is_outstanding,
    list_needless,
    name_changes,
    name_steps,
)
from zlmreport.model.diagnosis.contest import Told
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict
from zlmreport.model.diagnosis.error_numbers import compute_error_numbers
from zlmreport.model.diagnosis.finding import find
from zlmreport.model.diagnosis.report import build_values
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.fitting.fit import fit
from zlmreport.model.fitting.sessions import add_zeros


def test_a_step_is_named_with_what_the_readings_do_not_tell_from_it() -> None:
    example = example_diagnosis()
    first = replace(example.candidates[0], effect=EFFECTS["scale-kink"], equals=("first-run", "backlash"))
    said = chain(
        [
            replace(example, together=(EFFECTS["scale-kink"],), candidates=(first,)),
            replace(example, together=(EFFECTS["first-run"],), candidates=()),
        ],
        repeat(replace(example, together=(), verdict=DiagnosisVerdict.ADEQUATE)),
    )

    def diagnosing(model: AxisModel, _may_go: frozenset[str], _told: Told) -> AxisDiagnosis:
        return replace(next(said), fit=fit(model, example.fit.design, example.fit.deviation))

    found = build(model_of("offset"), diagnosing)
    # What came in later is told from it.
    assert name_steps(found.steps) == ("+ scale-kink or backlash", "+ first-run")


def test_what_another_effect_contains_is_told_to_have_gone_and_what_only_passed_is_not() -> None:
    example = example_diagnosis()
    said = chain(
        [
            replace(example, together=(EFFECTS["first-run"], EFFECTS["backlash"]), candidates=()),
            replace(example, together=(EFFECTS["polynomial"],), makeshift=("first-run",), candidates=()),
        ],
        repeat(replace(example, together=(), verdict=DiagnosisVerdict.ADEQUATE)),
    )

    def diagnosing(model: AxisModel, _may_go: frozenset[str], _told: Told) -> AxisDiagnosis:
        return replace(next(said), fit=fit(model, example.fit.design, example.fit.deviation))

    found = build(model_of("offset"), diagnosing)
    assert found.model.identifiers == ("backlash", "polynomial")
    assert name_steps(found.steps) == ("+ first-run", "+ backlash", "+ polynomial", "− first-run")
    assert name_changes(found) == ("+ backlash", "+ polynomial", "− offset")


def test_two_effects_that_each_take_the_place_of_the_other_end_a_build() -> None:
    built, asked = _build_to_and_fro()
    assert asked == [("offset",), ("offset", "scale-kink"), ("offset", "first-run")]
    assert built.exchange is not None


def test_of_effects_that_take_each_others_place_those_stay_that_leave_less() -> None:
    built, asked = _build_to_and_fro()
    errors = {
        names: compute_error_numbers(fit(model_of(*names), built.first.fit.design, built.first.fit.deviation))
        for names in asked[1:]
    }
    assert built.model.identifiers == min(errors, key=lambda names: errors[names].rms)
    assert built.steps[-1].after.rms == built.last.error.rms


def test_the_last_stair_is_the_error_of_the_model_that_was_built() -> None:
    example = example_diagnosis()
    again = replace(example.error, rms=2 * example.error.rms)

    def diagnosing(model: AxisModel, _may_go: frozenset[str], _told: Told) -> AxisDiagnosis:
        if "first-run" not in model.identifiers:
            return replace(
                example,
                fit=fit(model, example.fit.design, example.fit.deviation),
                together=(EFFECTS["first-run"],),
            )
        return replace(example, error=again, together=(), verdict=DiagnosisVerdict.ADEQUATE)

    built = build(model_of("offset"), diagnosing)
    assert built.steps[-1].after == built.last.error == again


def test_what_came_in_and_is_no_more_than_likely_is_told_with_what_is_nearly_as_likely() -> None:
    example = example_diagnosis()
    first = replace(example.candidates[0], effect=EFFECTS["first-run"], probability=0.27)
    other = replace(first, effect=EFFECTS["backlash"], probability=0.46)

    def diagnosing(model: AxisModel, _may_go: frozenset[str], _told: Told) -> AxisDiagnosis:
        fitted = fit(model, example.fit.design, example.fit.deviation)
        if "first-run" in model.identifiers:
            return replace(example, fit=fitted, together=(), candidates=(), verdict=DiagnosisVerdict.ADEQUATE)
        return replace(example, fit=fitted, together=(first.effect,), candidates=(first, other))

    built = build(model_of("offset"), diagnosing)
    lines = " ".join(
        " ".join(tell_build(built, study_of_example().job, "job.yaml", None, is_tried=True)).split()
    )
    assert "not sure: first-run 27 % and backlash 46 %; else another effect, or something without" in lines
    assert [each["effects"] for each in build_values(built)["doubts"]] == [["first-run"], ["backlash"]]


def test_what_only_takes_the_place_of_another_is_not_advised_again() -> None:
    built, _ = _build_to_and_fro()
    (kept,) = {"scale-kink", "first-run"} & set(built.model.identifiers)
    (other,) = {"scale-kink", "first-run"} - {kept}
    assert build_values(built)["exchange"] == {"in": [other], "out": [kept]}
    lines = " ".join(
        " ".join(tell_build(built, study_of_example().job, "job.yaml", None, is_tried=False)).split()
    )
    assert f"{other} in place of {kept} would do as well: the readings do not tell which it is" in lines
    assert "Missing effect" not in lines
    assert "model add" not in lines


def _build_to_and_fro() -> tuple[Built, list[tuple[str, ...]]]:
    """Return what is built of two effects each of which takes the place of the other, and what was asked."""
    example = example_diagnosis()
    asked: list[tuple[str, ...]] = []

    def diagnosing(model: AxisModel, _may_go: frozenset[str], _told: Told) -> AxisDiagnosis:
        asked.append(model.identifiers)
        fitted = fit(model, example.fit.design, example.fit.deviation)
        has_kink = "scale-kink" in model.identifiers
        comes, goes = ("first-run", "scale-kink") if has_kink else ("scale-kink", "first-run")
        makeshift = (goes,) if goes in model.identifiers else ()
        error = compute_error_numbers(fitted)
        return replace(example, fit=fitted, error=error, together=(EFFECTS[comes],), makeshift=makeshift)

    return build(model_of("offset"), diagnosing), asked


def test_what_goes_out_for_what_comes_in_is_one_stair_with_it() -> None:
    example = example_diagnosis()

    def diagnosing(model: AxisModel, _may_go: frozenset[str], _told: Told) -> AxisDiagnosis:
        fitted = fit(model, example.fit.design, example.fit.deviation)
        said: dict[tuple[str, ...], tuple[tuple[str, ...], tuple[str, ...]]] = {
            ("offset", "cosine-error"): (("scale-error",), ("cosine-error",)),
            ("offset", "scale-error"): (("scale-kink",), ("scale-error",)),
        }
        coming, going = said.get(model.identifiers, ((), ()))
        return replace(
            example,
            fit=fitted,
            error=compute_error_numbers(fitted),
            together=tuple(EFFECTS[each] for each in coming),
            makeshift=going,
            candidates=(),
            verdict=DiagnosisVerdict.MISSING if coming else DiagnosisVerdict.ADEQUATE,
        )

    built = build(model_of("offset", "cosine-error"), diagnosing)
    lines = " ".join(
        " ".join(tell_build(built, study_of_example().job, "job.yaml", None, is_tried=True)).split()
    )
    stairs = re.sub(r" [0-9.]+(?= →| µm; noise)", "", lines.partition("; noise")[0] + "; noise")
    assert "→ − cosine-error, + scale-error → + scale-kink, − scale-error µm; noise" in stairs


def test_what_stands_in_a_model_does_not_give_way_to_what_is_no_better() -> None:
    # A slope is a cosine error and a wrong scale alike: which was named first is no matter, once it is there.
    design, model = pendulum_test(15, 4), model_of("offset", "cosine-error")
    slope = hidden(design, "cosine-error", size=0.7, model=model_of("offset"))
    readings = observations(design, slope + noise(design, 3))
    fitted = fit(model, readings.design, readings.deviation)
    found = find(fitted, INSTALLED, may_go=frozenset({"cosine-error"}), is_left=True)
    assert (found.named, found.makeshift) == ((), ())


def test_what_is_much_like_a_makeshift_comes_in_once_that_is_out() -> None:
    example, asked = example_diagnosis(), list[tuple[str, ...]]()

    def diagnosing(model: AxisModel, _may_go: frozenset[str], _told: Told) -> AxisDiagnosis:
        asked.append(model.identifiers)
        fitted = fit(model, example.fit.design, example.fit.deviation)
        if "scale-error" in model.identifiers:
            return replace(example, fit=fitted, together=(), verdict=DiagnosisVerdict.ADEQUATE)
        return replace(
            example,
            fit=fitted,
            together=(EFFECTS["scale-error"],),
            makeshift=("cosine-error",),
            candidates=(),
        )

    found = build(model_of("offset", "cosine-error"), diagnosing)
    assert asked == [("offset", "cosine-error"), *2 * [("offset", "scale-error")]]
    assert name_steps(found.steps) == ("− cosine-error", "+ scale-error")


def test_what_is_far_from_usual_is_asked_once_it_was_added() -> None:
    found = example_diagnosis()
    design = found.fit.design
    said = chain(
        [replace(found, together=(EFFECTS["backlash"],))],
        repeat(replace(found, together=(), verdict=DiagnosisVerdict.ADEQUATE)),
    )

    def diagnosing(model: AxisModel, _may_go: frozenset[str], _told: Told) -> AxisDiagnosis:
        return replace(next(said), fit=fit(model, design, 400e-6 * design.direction + noise(design)))

    built = build(model_of("offset"), diagnosing)
    (question,) = build_values(built)["questions"]
    assert question.startswith("800 µm: 20 times what is usual for a screw;")
    lines = tell_build(built, study_of_example().job, "job.yaml", None, is_tried=True)
    assert question in " ".join(" ".join(lines).split())


def test_a_build_ends_where_nothing_is_missing_of_the_job_as_it_is_written() -> None:
    example = example_diagnosis()

    def diagnosing(model: AxisModel, may_go: frozenset[str], _told: Told) -> AxisDiagnosis:
        missing = [each for each in ("first-run", "backlash") if each not in model.identifiers]
        # As long as the first may go, a shape without a name is told in the place of the second.
        named = () if may_go or not missing else (EFFECTS[missing[0]],)
        verdict = DiagnosisVerdict.MISSING if named else DiagnosisVerdict.UNEXPLAINED
        fitted = fit(model, example.fit.design, example.fit.deviation)
        return replace(example, fit=fitted, together=named, makeshift=(), verdict=verdict)

    built = build(model_of("offset"), diagnosing)
    assert built.model.identifiers == ("offset", "first-run", "backlash")
    assert build(built.model, diagnosing).steps == ()


def test_what_stood_in_a_model_and_may_not_be_there_is_told_in_the_end() -> None:
    example = example_diagnosis()
    design = example.fit.design
    deviation = 3e-6 * design.direction + noise(design)

    def diagnosing(model: AxisModel, _may_go: frozenset[str], _told: Told) -> AxisDiagnosis:
        fitted = fit(model, design, deviation)
        return replace(example, fit=fitted, together=(), verdict=DiagnosisVerdict.ADEQUATE)

    built = build(model_of("offset", "backlash", "first-run"), diagnosing)
    assert built.needless == ("first-run",)
    assert build_values(built)["needless"] == ["first-run"]
    lines = " ".join(tell_build(built, study_of_example().job, "job.yaml", None, is_tried=True))
    assert "zlmreport model remove job.yaml first-run" in " ".join(lines.split())


def test_effect_whose_numbers_go_together_is_there_where_far_more_is_left_without_it() -> None:
    design = linear_test()
    slow = 6e-6 * (1.0 - np.exp(-design.time / (8.0 * design.duration))) * 8.0  # nearly a line in time
    fitted = fit(model_of("offset", "thermal-drift"), design, slow + noise(design))
    size = next(each for each in fitted.estimates if each.effect == "thermal-drift")
    assert abs(size.value) < size.expanded_uncertainty
    assert is_outstanding("thermal-drift", fitted)


def test_zero_of_a_session_is_no_effect_that_could_be_taken_out() -> None:
    example = example_diagnosis()
    count = len(example.fit.design.position)
    design = replace(example.fit.design, session=read_only_integers(np.arange(count) >= count // 2))
    model = add_zeros(model_of("offset", "backlash"), design)
    fitted = fit(model, design, 3e-6 * design.direction + noise(design))
    assert not is_outstanding("session-zero", fitted)
    adequate = replace(example, fit=fitted, together=(), verdict=DiagnosisVerdict.ADEQUATE)
    assert list_needless(adequate) == ()
