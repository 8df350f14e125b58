"""What is physically impossible does not lead a diagnosis, and what is not needed does not either."""

from __future__ import annotations

from dataclasses import replace

import pytest

from model.axis_tests import INSTALLED, hidden, linear_test, model_of, noise, observations
from zlmreport.language import Language
from zlmreport.model.diagnosis import Diagnosis, Verdict, diagnose
from zlmreport.model.fit import fit
from zlmreport.model.report import report, verdict_statement
from zlmreport.model.steps import is_impossible

_DESIGN = linear_test(11, 3)
#: So many runs that none of them is taken for a faulty one.
_OFTEN = linear_test(11, 8)
_MODEL = model_of("offset", "scale-error", "backlash")


@pytest.fixture(scope="module")
def impossible() -> Diagnosis:
    """A slope that follows the air, but the wrong way round and six times too strong."""
    shape = hidden(_OFTEN, "air-index", size=4.0, model=_MODEL)
    return diagnose(_MODEL, observations(_OFTEN, -shape + noise(_OFTEN)), INSTALLED)


def test_impossible_estimate_never_comes_first(impossible: Diagnosis) -> None:
    assert all(each.identifier != "air-index" for each in impossible.candidates if each.is_plausible)
    assert all(each.is_plausible for each in impossible.candidates[:1])


def test_impossible_estimate_is_shown_as_what_it_is(impossible: Diagnosis) -> None:
    worse = replace(impossible.candidates[0], is_plausible=False)
    listed = report(replace(impossible, candidates=(), implausible=(worse,)))
    assert [(each["effect"], each["plausible"]) for each in listed["implausible"]] == [
        (worse.identifier, False)
    ]
    assert not listed["candidates"]


def test_slope_that_follows_the_air_the_wrong_way_round_is_impossible() -> None:
    shape = hidden(_OFTEN, "air-index", size=4.0, model=_MODEL)
    fitted = fit(model_of("offset", "air-index"), _OFTEN, -6 * shape + noise(_OFTEN))
    assert is_impossible(fitted, "air-index")


def test_plausible_estimate_is_not_impossible() -> None:
    deviation = hidden(_DESIGN, "scale-expansion", size=1.0, model=_MODEL)
    fitted = fit(model_of("offset", "scale-expansion"), _DESIGN, deviation + noise(_DESIGN))
    assert not is_impossible(fitted, "scale-expansion")


def test_only_impossible_candidates_leave_none(impossible: Diagnosis) -> None:
    worse = replace(
        impossible.candidates[0] if impossible.candidates else impossible.implausible[0], is_plausible=False
    )
    found = replace(impossible, verdict=Verdict.UNEXPLAINED, candidates=(), implausible=(worse,))
    said = verdict_statement(found).in_language(Language.ENGLISH)
    assert said.endswith(f"{worse.identifier} would explain it only with physically impossible values.")


@pytest.mark.parametrize(
    ("share", "words"), [(0.95, "explains the rest"), (0.24, "explains 24 % of what the repeats")]
)
def test_rest_is_explained_only_where_the_share_says_so(share: float, words: str) -> None:
    found = diagnose(
        _MODEL,
        observations(_DESIGN, hidden(_DESIGN, "screw-pitch", [0.01], size=3.0) + noise(_DESIGN)),
        INSTALLED,
    )
    leading = replace(found.candidates[0], share=share)
    said = verdict_statement(replace(found, candidates=(leading,)))
    assert words in said.in_language(Language.ENGLISH)
