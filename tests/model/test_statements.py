"""What a diagnosis comes to, in a sentence that names names."""

from __future__ import annotations

from dataclasses import replace

import pytest

from model.hidden_effect import example_diagnosis
from zlmreport.language import Language, Words, same
from zlmreport.model.diagnosis import Unnamed, Verdict
from zlmreport.model.report import listed, verdict_statement


def said(**changes: object) -> str:
    return verdict_statement(replace(example_diagnosis(), **changes)).in_language(Language.ENGLISH)


def test_the_missing_effect_is_named() -> None:
    assert said() == "Missing effect: screw-pitch, which explains the rest."


def test_effects_that_look_alike_are_named_together() -> None:
    first = replace(example_diagnosis().candidates[0], equals=("periodic", "scale-joint"))
    assert said(candidates=(first,)) == (
        "Missing effect: screw-pitch, periodic or scale-joint, which explains the rest."
    )


def test_effects_that_are_found_after_one_another_are_named_together() -> None:
    assert said(further=("first-run", "abbe")) == (
        "Missing effects: screw-pitch, first-run and abbe, which together explain the rest."
    )


def test_an_adequate_model_is_said_to_describe_the_readings() -> None:
    assert said(verdict=Verdict.ADEQUATE).startswith("The model describes the readings")


def test_what_has_no_name_is_told_by_shape_size_and_place() -> None:
    unnamed = Unnamed(same("smooth in time"), same("250 mm"), 1.234e-6)
    assert said(verdict=Verdict.UNEXPLAINED, unnamed=unnamed) == (
        "Something is left that no installed effect explains: smooth in time; root mean square 1.2 µm, "
        "largest "
        "at 250 mm."
    )


def test_what_has_no_shape_either_is_still_said_to_be_there() -> None:
    assert said(verdict=Verdict.UNEXPLAINED, unnamed=None).startswith("Something is left")


@pytest.mark.parametrize("verdict", Verdict)
def test_every_verdict_has_a_german_sentence(verdict: Verdict) -> None:
    statement = verdict_statement(replace(example_diagnosis(), verdict=verdict))
    assert statement.in_language(Language.GERMAN) != statement.in_language(Language.ENGLISH)


@pytest.mark.parametrize(
    ("names", "row"), [(["a"], "a"), (["a", "b"], "a and b"), (["a", "b", "c"], "a, b and c")]
)
def test_names_stand_in_a_row(names: list[str | Words], row: str) -> None:
    assert listed(names).in_language(Language.ENGLISH) == row
