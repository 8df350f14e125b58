"""A diagnosis as the page shows it: verdict, failures with their readings, candidates with their evidence."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from zlmreport.language import Language, Words
from zlmreport.measurement.conditions import CONDITION_NAMES
from zlmreport.model import wording
from zlmreport.model.diagnosis import Candidate, Diagnosis
from zlmreport.model.effect import Effect
from zlmreport.model.failures.failure import Failure, ResidualTest
from zlmreport.model.statements import serious_candidates, verdict_statement
from zlmreport.model.study import Study
from zlmreport.web.panels import error_numbers, parameter

_IN_TIME = {ResidualTest.TIME_ORDER, ResidualTest.PERIOD_IN_TIME}
#: Nobody knows the tails of real scatter better: below, a smaller chance is no stronger evidence.
_LEAST_P = 1e-6
_SMALL_P = 1e-3
#: Share of an effect that a plan sees, below which it hides it.
_HIDDEN = 0.1
_HIDES = Words(
    en="{share} of it is visible beside this model",
    de="neben diesem Modell sind {share} davon sichtbar",
)
_FOUND_FROM = Words(
    en="{share} of it is visible beside this model; found from {size} rms on",
    de="neben diesem Modell sind {share} davon sichtbar; gefunden ab {size} quadratischem Mittel",
)
#: A blank at which no line ends.
_HELD = "\N{NO-BREAK SPACE}"
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def diagnosed(
    diagnosis: Diagnosis, study: Study, effects: Sequence[Effect], language: Language
) -> dict[str, Any]:
    """Return a diagnosis in one language."""
    titles = {each.identifier: each.title.in_language(language) for each in effects}
    not_testable: dict[str, list[str]] = {}
    for each in diagnosis.not_testable:
        not_testable.setdefault(each.reason.in_language(language), []).append(each.effect)
    serious = serious_candidates(diagnosis)
    return {
        "verdict": diagnosis.verdict.value,
        "statement": verdict_statement(diagnosis).in_language(language),
        "failures": [_failure(each, diagnosis, study, language) for each in diagnosis.failures],
        "candidates": [
            {**_candidate(each, diagnosis, language), "title": titles[each.identifier]}
            for each in diagnosis.candidates
        ],
        "serious": len(serious),
        "hidden": [
            *_hidden(diagnosis, language),
            *({"effects": names, "reason": reason} for reason, names in not_testable.items()),
        ],
        "notExcluded": list(diagnosis.not_excluded),
        "remarks": [each.in_language(language) for each in diagnosis.remarks],
    }


def _hidden(diagnosis: Diagnosis, language: Language) -> Iterator[dict[str, Any]]:
    """Yield the effects that this test hardly sees, or only when they are large."""
    axis = diagnosis.fit.design.axis
    for each in diagnosis.visibility:
        if each.share >= _HIDDEN:
            continue
        words = _HIDES.given(share=percent(each.share))
        if math.isfinite(each.smallest_rms):
            words = _FOUND_FROM.given(
                share=percent(each.share), size=wording.deviation(axis, each.smallest_rms)
            )
        yield {"effects": [each.effect], "reason": words.in_language(language)}


def argument(effect: Effect) -> str:
    """Return an effect as a job would name it, with its keys unless they are the usual ones."""
    settings = effect.settings.model_dump(mode="json", exclude_defaults=True)
    return f"{effect.identifier}: {json.dumps(settings)}" if settings else effect.identifier


def _failure(failure: Failure, diagnosis: Diagnosis, study: Study, language: Language) -> dict[str, Any]:
    axis, where = "position", failure.where
    if failure.test is ResidualTest.RUNS:
        axis = "run"
    elif failure.test in _IN_TIME:
        axis = "time"
    elif failure.test is ResidualTest.CONDITION:
        axis = where.in_language(Language.ENGLISH)
        where = CONDITION_NAMES.get(axis, where)
    return {
        "statement": failure.statement.in_language(language),
        "where": where.in_language(language),
        "p": chance(failure.p_value, language),
        "axis": axis,
        "readings": _readings(failure, diagnosis, study),
    }


def _readings(failure: Failure, diagnosis: Diagnosis, study: Study) -> list[int]:
    """Return the places of the readings that show a failure, in the measurement set; none where all do."""
    if failure.test is ResidualTest.OUTLIERS:
        return [int(each) for each in diagnosis.outliers]
    kept = study.observed.reading[~np.isin(study.observed.reading, diagnosis.outliers)]
    return [int(each) for each in kept[failure.readings]]


def _candidate(candidate: Candidate, diagnosis: Diagnosis, language: Language) -> dict[str, Any]:
    design = diagnosis.fit.design
    discriminate_by = candidate.discriminate_by
    return {
        "effect": candidate.identifier,
        "argument": argument(candidate.effect),
        "probability": percent(candidate.probability),
        "share": candidate.probability,
        "p": chance(candidate.p_value, language, is_extrapolated=candidate.p_value_is_extrapolated),
        "rmsBefore": wording.deviation(design.axis, diagnosis.error.rms).in_language(language),
        "rmsAfter": wording.deviation(design.axis, candidate.error.rms).in_language(language),
        "error": list(error_numbers(candidate.error, design, language)),
        "parameters": [parameter(each, design, language) for each in candidate.estimates],
        "explains": candidate.explains.in_language(language),
        "equals": list(candidate.equals),
        "tell": "" if discriminate_by is None else discriminate_by.in_language(language),
    }


def chance(value: float, language: Language, *, is_extrapolated: bool = False) -> str:
    """Write a chance with as many digits as it is known to: one if no simulated test comes near it."""
    if value < _LEAST_P:
        return _HELD.join(("p", "<", "10⁻⁶"))
    sign, digits = ("≈", 0) if is_extrapolated else ("=", 1)
    if value >= _SMALL_P:
        return _HELD.join(("p", sign, wording.number(value, 3).in_language(language)))
    mantissa, _, exponent = f"{value:.{digits}e}".partition("e")
    mantissa = mantissa.replace(".", language.decimal_sign)
    return _HELD.join(("p", sign, f"{mantissa}·10{str(int(exponent)).translate(_SUPERSCRIPTS)}"))


def percent(share: float) -> str:
    """Write a probability in whole per cent."""
    if 0 < share < 0.005:
        return "< 1 %"
    return f"{100 * share:.0f} %"
