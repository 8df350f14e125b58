"""Errors reach whoever can mend them, from another process, too."""

from __future__ import annotations

import pickle

import pytest

from zlmreport import ZlmreportError
from zlmreport.errors import NOWHERE, did_you_mean
from zlmreport.model.effects.model_error import ModelError
from zlmreport.plugin import AccessError, InputError, Place, Problem


@pytest.mark.parametrize("kind", [InputError, AccessError])
def test_an_error_comes_out_of_another_process_as_it_went_in(kind: type[ZlmreportError]) -> None:
    error = kind([Problem(Place("job.yaml", 3, 5), "wrong"), Problem(Place("x.csv"), "missing")])
    there = pickle.loads(pickle.dumps(error))
    assert type(there) is kind
    assert there.problems == error.problems
    assert str(there) == str(error)


def test_what_a_model_cannot_carry_comes_out_of_another_process_as_it_went_in() -> None:
    there = pickle.loads(pickle.dumps(ModelError(["no reading", "no run"])))
    assert there.sentences == ("no reading", "no run")
    assert str(there) == "no reading; no run"


def test_a_standard_without_its_edition_is_answered_with_the_last_one() -> None:
    known = ["iso230-2:1997", "iso230-2:2014", "iso230-3", "nmtba"]
    assert did_you_mean("ISO230-2", known).startswith("did you mean 'iso230-2:2014'? (known: ")


def test_what_is_known_is_listed_once() -> None:
    known = "known: a, b"
    said = [f"unknown key 'x'; {known}", f"unknown key 'aa'; did you mean 'a'? ({known})", "other; known: c"]
    error = InputError(Problem(NOWHERE, each) for each in said)
    assert str(error).splitlines() == [
        "zlmreport: unknown key 'x'; known: a, b",
        "zlmreport: unknown key 'aa'; did you mean 'a'?",
        "zlmreport: other; known: c",
    ]
    assert [each.message for each in error.problems] == said
