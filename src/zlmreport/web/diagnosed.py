"""A diagnosis as the page shows it: verdict, failures with their readings, candidates with their evidence."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from typing import Any

from zlmreport.certificate.linked_failures import chance, failure
from zlmreport.language import Language, Words
from zlmreport.model import wording
from zlmreport.model.diagnosis import Candidate, Diagnosis
from zlmreport.model.effect import Effect
from zlmreport.model.report import serious_candidates, verdict_statement
from zlmreport.model.study import Study
from zlmreport.web.panels import error_numbers, parameter

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
        "failures": [failure(each, diagnosis, study, language) for each in diagnosis.failures],
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


def percent(share: float) -> str:
    """Write a probability in whole per cent."""
    if 0 < share < 0.005:
        return "< 1 %"
    return f"{100 * share:.0f} %"
