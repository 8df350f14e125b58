"""What a diagnosis comes to, in a sentence that names names."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from model.axis_tests import EFFECTS
from model.hidden_effect import example_diagnosis
from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict
from zlmreport.model.diagnosis.random_curves import Course
from zlmreport.model.diagnosis.remainder import NamesInstead, Remainder
from zlmreport.model.diagnosis.report import write_statement_after_build, write_verdict_statement
from zlmreport.model.diagnosis.residuals import Failure, ResidualTest
from zlmreport.plugin import MILLIMETRE, Language, same_in_all_languages as same

LEFT = Remainder(
    rms=1.234e-6,
    share=0.3,
    where=same("around 250 mm"),
    low=0.2,
    high=0.3,
    unit=MILLIMETRE,
    shape=same("a bump"),
    size=4e-6,
    peak=0.25,
    formula=None,
    course=Course.PLACE,
)


def said(**changes: object) -> str:
    return write_verdict_statement(replace(example_diagnosis(), **changes)).in_language(Language.ENGLISH)


def test_the_missing_effect_is_named() -> None:
    assert said() == "Missing effect: screw-pitch, which explains the rest."


def test_effects_that_look_alike_are_named_together() -> None:
    first = replace(example_diagnosis().candidates[0], equals=("periodic", "scale-joint"))
    assert said(candidates=(first,)) == (
        "Missing effect: screw-pitch, periodic or scale-joint, which explains the rest."
    )


def test_alternatives_beside_others_stand_in_brackets() -> None:
    first = replace(example_diagnosis().candidates[0], equals=("periodic", "scale-joint"))
    other = replace(first, effect=EFFECTS["abbe"], equals=())
    statement = said(together=(first.effect, other.effect), candidates=(first, other))
    assert statement.startswith("Missing effects: (screw-pitch, periodic or scale-joint) and abbe, which")


def test_effects_that_belong_together_are_named_together() -> None:
    first = example_diagnosis().candidates[0]
    others = [EFFECTS["first-run"], EFFECTS["abbe"]]
    candidates = (first, *(replace(first, effect=each) for each in others))
    assert said(together=(first.effect, *others), candidates=candidates) == (
        "Missing effects: screw-pitch, first-run and abbe, which together explain the rest."
    )


def test_a_question_says_of_which_of_several_effects_it_is() -> None:
    first = example_diagnosis().candidates[0]
    asked = replace(
        first, effect=EFFECTS["abbe"], question=same("−1675 mm: 5.6 times what is usual?"), is_large=True
    )
    told = said(together=(first.effect, asked.effect), candidates=(first, asked))
    assert told.endswith("explain the rest. abbe, −1675 mm: 5.6 times what is usual?")
    alone = said(together=(asked.effect,), candidates=(asked,))
    assert alone.endswith("explains the rest. −1675 mm: 5.6 times what is usual?")


def test_nothing_falls_where_the_error_does_not() -> None:
    before = example_diagnosis().error.rms
    after = replace(
        example_diagnosis().error_after, rms=1.2 * before, noise_rms=0.1 * before, chi2_per_dof=99.0
    )
    statement = said(error_after=after)
    assert "falls" not in statement
    assert "The error is" in statement


def test_an_error_that_is_the_same_to_the_digits_that_are_printed_stays() -> None:
    before = example_diagnosis().error.rms
    for share in (0.9999, 1.0001):
        after = replace(
            example_diagnosis().error_after, rms=share * before, noise_rms=0.1 * before, chi2_per_dof=99.0
        )
        assert re.search(r"The error stays \S+ µm with it\.", said(error_after=after))


def test_the_rest_is_explained_only_where_what_is_left_is_noise() -> None:
    after = replace(example_diagnosis().error_after, rms=1.4e-6, noise_rms=0.7e-6, chi2_per_dof=4.0)
    statement = said(error_after=after)
    assert "explains the rest" not in statement
    assert re.search(r"With it the error falls from .* µm to 1\.4 µm, over a noise of 0\.70 µm\.", statement)


def test_what_is_left_beside_a_name_is_told_after_it() -> None:
    statement = said(remainder=LEFT)
    assert statement.startswith("Missing effect: screw-pitch.")
    assert statement.endswith(
        "Beside that something is left without a name: a bump, around 250 mm; root mean square 1.2 µm."
    )


def test_what_is_left_after_a_build_stands_beside_its_steps_and_else_alone() -> None:
    last = replace(example_diagnosis(), verdict=DiagnosisVerdict.UNEXPLAINED, candidates=(), remainder=LEFT)
    after_steps, alone = (
        write_statement_after_build(last, has_steps=each).in_language(Language.ENGLISH)
        for each in (True, False)
    )
    left = "a bump, around 250 mm; root mean square 1.2 µm."
    assert after_steps == f"Beside that something is left without a name: {left}"
    assert alone == f"Something is left that no installed effect explains: {left}"


def test_what_others_take_the_place_of_is_told_as_well() -> None:
    assert said(makeshift=("periodic",)).endswith("Then no longer needed: periodic.")


def test_a_name_that_is_no_more_than_likely_is_told_with_its_chance_and_its_rivals() -> None:
    first = replace(example_diagnosis().candidates[0], probability=0.27)
    likelier = replace(first, effect=EFFECTS["backlash"], probability=0.46)
    less = replace(first, effect=EFFECTS["abbe"], probability=0.04)
    assert said(candidates=(first, likelier, less)) == (
        "Missing effect: screw-pitch, which explains the rest. Not sure: screw-pitch 27 % and backlash 46 %; "
        "else another effect, or something without a name."
    )


def test_a_name_that_is_sure_with_its_equals_is_told_without_a_chance() -> None:
    first = replace(example_diagnosis().candidates[0], equals=("periodic",), probability=0.5)
    other = replace(first, effect=EFFECTS["periodic"], equals=(), probability=0.4)
    assert said(candidates=(first, other)).endswith("screw-pitch or periodic, which explains the rest.")


def test_what_is_large_is_asked_after_its_name() -> None:
    first = replace(example_diagnosis().candidates[0], question=same("9 µm: is that so?"))
    assert said(candidates=(first,)).endswith("which explains the rest. 9 µm: is that so?")


def test_an_adequate_model_is_said_to_describe_the_readings() -> None:
    assert said(verdict=DiagnosisVerdict.ADEQUATE, failures=()).startswith(
        "The model describes the readings: nothing is left"
    )


def test_an_order_that_no_cause_has_is_told_with_the_error_that_it_leaves() -> None:
    example = example_diagnosis()
    error = replace(example.error, rms=5.54e-7, noise_rms=4.5e-7, chi2_per_dof=1.2)
    order = Failure(ResidualTest.TIME_ORDER, 0.002, same("by the end"), same("something moves with time"))
    assert said(verdict=DiagnosisVerdict.ADEQUATE, error=error, error_after=error, failures=(order,)) == (
        "The model describes the readings as far as their scatter lets it be seen: the error is 0.55 µm, "
        "over a noise of 0.45 µm. Yet something moves with time."
    )


@pytest.mark.parametrize("test", [ResidualTest.SPREAD, ResidualTest.OUTLIERS])
def test_unequal_scatter_makes_a_model_no_less_adequate(test: ResidualTest) -> None:
    scatter = Failure(test, 0.002, same("run 2"), same("the readings scatter unequally"))
    assert "Yet" not in said(verdict=DiagnosisVerdict.ADEQUATE, failures=(scatter,))


def test_what_has_no_name_is_told_by_shape_size_and_place() -> None:
    assert said(verdict=DiagnosisVerdict.UNEXPLAINED, candidates=(), remainder=LEFT) == (
        "Something is left that no installed effect explains: a bump, around 250 mm; root mean square 1.2 µm."
    )


@pytest.mark.parametrize(
    ("odds", "told"),
    [
        (0.06, "Less likely, at odds of 1 to 17, it is first-run and run-displaced instead."),
        (0.9, "As likely it is first-run and run-displaced instead."),
        (2.4, "More likely, at odds of 2 to 1, it is first-run and run-displaced instead."),
    ],
)
def test_names_that_are_not_told_from_what_has_none_are_told_with_their_odds(odds: float, told: str) -> None:
    effects = (EFFECTS["first-run"], EFFECTS["run-displaced"])
    left = replace(LEFT, instead=NamesInstead(effects, odds))
    statement = said(verdict=DiagnosisVerdict.UNEXPLAINED, candidates=(), remainder=left)
    assert statement.startswith("Something is left that no installed effect explains for sure: a bump")
    assert statement.endswith(told)
    assert "explains for sure" not in said(remainder=left)
    assert said(remainder=left).endswith(told)


def test_all_parts_of_what_has_no_name_are_told_with_their_places() -> None:
    also = replace(LEFT, shape=same("every run displaced as a whole"), where=same("most in run 2"))
    assert said(
        verdict=DiagnosisVerdict.UNEXPLAINED, candidates=(), remainder=replace(LEFT, further=(also,))
    ) == (
        "Something is left that no installed effect explains: a bump, around 250 mm, and every run displaced "
        "as a whole, most in run 2; root mean square 1.2 µm."
    )


def test_parts_at_one_place_are_told_with_it_once() -> None:
    also = replace(LEFT, shape=same("a step"))
    assert said(
        verdict=DiagnosisVerdict.UNEXPLAINED, candidates=(), remainder=replace(LEFT, further=(also,))
    ) == (
        "Something is left that no installed effect explains: a bump, and a step, around 250 mm; root mean "
        "square 1.2 µm."
    )


def test_a_model_of_which_few_readings_tell_no_more_is_not_said_to_leave_nothing() -> None:
    example = example_diagnosis()
    error = replace(example.error, rms=3.83e-6, noise_rms=3.08e-6, chi2_per_dof=1.58)
    few = {"error": error, "error_after": error, "lasting_noise": None, "failures": ()}
    assert said(verdict=DiagnosisVerdict.ADEQUATE, **few) == (
        "The model describes the readings as far as their scatter lets it be seen: the error is 3.8 µm, over "
        "a noise of 3.1 µm."
    )


def test_what_has_no_shape_either_is_still_said_to_be_there() -> None:
    assert said(verdict=DiagnosisVerdict.UNEXPLAINED).startswith("Something is left")


@pytest.mark.parametrize("verdict", DiagnosisVerdict)
def test_every_verdict_has_a_german_sentence(verdict: DiagnosisVerdict) -> None:
    statement = write_verdict_statement(replace(example_diagnosis(), verdict=verdict))
    assert statement.in_language(Language.GERMAN) != statement.in_language(Language.ENGLISH)
