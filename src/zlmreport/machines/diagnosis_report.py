"""A diagnosis of a machine as plain values for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from zlmreport.language import Language
from zlmreport.machines.comparison import ComparedTest
from zlmreport.machines.course import CircularTest
from zlmreport.machines.diagnosis import CircleCandidate, MachineDiagnosis, find_verdict_after_build
from zlmreport.machines.report import collect_compared_sizes, collect_stretch
from zlmreport.machines.study import CircleStudy, EstimatedTerm, find_noise_of_both
from zlmreport.machines.subjects.findings import list_absent, list_findings, say_how_told, say_verdict
from zlmreport.machines.subjects.tests import describe_stretch

SCHEMA, BUILD, CHANGE = "zlmreport/diagnosis/1", "zlmreport/build/1", "zlmreport/machine-change/1"
_MICRO = 1e6
_MOST_FAILURES = 3


def collect_diagnosis(
    diagnosis: MachineDiagnosis,
    tests: Sequence[ComparedTest],
    complete: Sequence[ComparedTest],
    language: Language = Language.ENGLISH,
) -> dict[str, Any]:
    """Return a diagnosis as plain values.

    `tests`: The tests beside the model as it is.
    `complete`: The same beside the model with all that was found.
    """
    noise, of_readings = diagnosis.noise, diagnosis.noise_of_readings
    return {
        "schema": SCHEMA,
        **_collect_fit(diagnosis.study, noise),
        "verdict": diagnosis.verdict.value,
        "statement": say_verdict(diagnosis).in_language(language),
        "p_value": diagnosis.p_value.value,
        "set": list(diagnosis.found),
        "candidates": [_collect_candidate(each, diagnosis, language) for each in diagnosis.candidates],
        "remainder": _collect_remainder(diagnosis, language),
        "tests": _collect_tests(tests, of_readings),
        "complete": {
            **_collect_fit(diagnosis.complete, noise),
            "tests": _collect_tests(complete, of_readings),
        },
        "findings": [each.in_language(language) for each in list_findings(diagnosis.complete)],
        "beside": [
            {
                "effect": each.effect,
                "parameters": [_collect_parameter(one) for one in each.estimates],
                "statements": [sentence.in_language(language) for sentence in each.sentences],
            }
            for each in list_absent(diagnosis.complete, diagnosis.catalogue)
        ],
        "not_testable": list(diagnosis.not_testable),
        "failures": [
            {
                "test": each.name,
                "statement": describe_stretch(stretch, is_circle=is_circle).in_language(language),
                **collect_stretch(stretch, is_circle=is_circle),
            }
            for each in tests
            for is_circle in (isinstance(each.test, CircularTest),)
            for stretch in each.fails[:_MOST_FAILURES]
        ],
        "faults": [],
    }


def build_values(diagnosis: MachineDiagnosis, language: Language = Language.ENGLISH) -> dict[str, Any]:
    """Return the steps by which a model came about."""
    return {
        "schema": BUILD,
        "steps": [
            {
                "effect": each.effect,
                "rms_before": _MICRO * each.before,
                "rms_after": _MICRO * each.after,
                "noise_rms": _MICRO * each.noise,
                "unit": "um",
            }
            for each in diagnosis.steps
        ],
        "verdict": find_verdict_after_build(diagnosis).value,
        "remainder": _collect_remainder(diagnosis, language),
        **_collect_fit(diagnosis.complete, diagnosis.noise),
    }


def change_values(
    before: CircleStudy, after: CircleStudy, tests: tuple[Sequence[ComparedTest], Sequence[ComparedTest]]
) -> dict[str, Any]:
    """Return what a change of the model did; `tests` are those beside the model before and after it."""
    noise, of_readings = find_noise_of_both(before, after)
    return {
        "schema": CHANGE,
        **{
            name: {
                **_collect_fit(study, noise),
                "tests": _collect_tests(compared, of_readings),
            }
            for name, study, compared in zip(("before", "after"), (before, after), tests, strict=True)
        },
    }


def _collect_fit(study: CircleStudy, noise_rms: float) -> dict[str, Any]:
    """Return the effects of a model with their parameters, and how far circles and model are apart.

    `noise_rms`: Of the model that describes them, m.
    """
    left = study.rms
    return {
        "model": {
            "effects": list(study.names),
            "parameters": [_collect_parameter(each) for each in study.estimates],
        },
        "error": {
            "rms": _MICRO * left,
            "noise_rms": _MICRO * noise_rms,
            "chi2_per_dof": (left / noise_rms) ** 2 if noise_rms else None,
            "unit": "um",
        },
    }


def _collect_tests(tests: Sequence[ComparedTest], noise_of_readings: float) -> list[dict[str, Any]]:
    return [{**collect_compared_sizes(each), "noise_rms": _MICRO * noise_of_readings} for each in tests]


def _collect_remainder(diagnosis: MachineDiagnosis, language: Language) -> dict[str, Any] | None:
    """Return what is left without a name."""
    left = diagnosis.remainder
    if left is None:
        return None
    total = diagnosis.complete.rms
    return {
        "rms": _MICRO * left.rms,
        "share": min(1.0, (left.rms / total) ** 2) if total else 0.0,
        "shape": left.shape.in_language(language),
        "unit": "um",
    }


def _collect_parameter(found: EstimatedTerm) -> dict[str, Any]:
    """Return a parameter; without U where it was only tried at some values."""
    unit, u = found.unit, found.expanded_uncertainty
    values = {
        "effect": found.effect,
        "name": found.name,
        "value": unit.from_si(found.value),
        "unit": unit.ascii,
    }
    return (
        values if u is None else {**values, "expanded_uncertainty": unit.from_si(u), "coverage_factor": 2.0}
    )


def _collect_candidate(
    candidate: CircleCandidate, diagnosis: MachineDiagnosis, language: Language
) -> dict[str, Any]:
    """Return an effect that might be missing."""
    equals = candidate.indistinguishable_from
    return {
        "effect": candidate.effect.identifier,
        "title": candidate.effect.title.in_language(language),
        "evidence": candidate.evidence,
        "probability": candidate.probability,
        "p_value": candidate.p_value.value,
        "rms_after": _MICRO * candidate.rms_after,
        "plausible": candidate.is_plausible,
        "explains": candidate.effect.explains.in_language(language),
        "parameters": [_collect_parameter(each) for each in candidate.estimates],
        "indistinguishable_from": list(equals),
        "discriminate_by": say_how_told(candidate, diagnosis).in_language(language) if equals else "",
        "unit": "um",
    }
