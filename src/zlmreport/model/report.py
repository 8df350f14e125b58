"""A diagnosis as the results file of `zlmreport model diagnose --json`: full precision, micrometres or ″."""

from __future__ import annotations

from typing import Any

from zlmreport.language import Language
from zlmreport.measurement.axis import Axis
from zlmreport.model.design import Design
from zlmreport.model.diagnosis import Candidate, Diagnosis, ErrorNumbers
from zlmreport.model.estimate import Estimate
from zlmreport.model.failures.failure import Failure
from zlmreport.model.fit import Fit
from zlmreport.model.noise import Noise
from zlmreport.model.parameter import unit_of
from zlmreport.model.visibility import Visibility

SCHEMA = "zlmreport/diagnosis/1"


def report(diagnosis: Diagnosis, language: Language = Language.ENGLISH) -> dict[str, Any]:
    """Return a diagnosis as plain values for a JSON file.

    Parameters
    ----------
    diagnosis
        The diagnosis.
    language
        Of its sentences; names and verdicts are the same in every language.
    """
    fitted = diagnosis.fit
    axis = fitted.design.axis
    return {
        "schema": SCHEMA,
        "model": report_model(fitted),
        "error": report_error(diagnosis.error, axis),
        "noise": _noise(fitted.noise, axis),
        "verdict": diagnosis.verdict.value,
        "p_value": diagnosis.p_value,
        "failures": [_failure(each, language) for each in diagnosis.failures],
        "candidates": [_candidate(each, fitted.design, language) for each in diagnosis.candidates],
        "further": list(diagnosis.further),
        "unexplained": None
        if diagnosis.unnamed is None
        else {
            "shape": diagnosis.unnamed.shape.in_language(language),
            "where": diagnosis.unnamed.where.in_language(language),
            "rms": axis.deviation_unit.from_si(diagnosis.unnamed.size),
        },
        "not_testable": [
            {"effect": each.effect, "reason": each.reason.in_language(language)}
            for each in diagnosis.not_testable
        ],
        "not_excluded": list(diagnosis.not_excluded),
        "visibility": [_visibility(each, axis) for each in diagnosis.visibility],
        "outliers": diagnosis.outliers.tolist(),
        "remarks": [each.in_language(language) for each in diagnosis.remarks],
    }


def report_model(fitted: Fit) -> dict[str, Any]:
    """Return the effects of a fitted model with their parameters."""
    return {
        "effects": list(fitted.model.identifiers),
        "parameters": [
            {"effect": each.effect, **_estimate(each, fitted.design)} for each in fitted.estimates
        ],
    }


def report_error(error: ErrorNumbers, axis: Axis) -> dict[str, Any]:
    """Return how far readings and model are apart."""
    return {
        "rms": axis.deviation_unit.from_si(error.rms),
        "noise_rms": _in_unit(error.noise_rms, axis),
        "chi2_per_dof": error.chi2_per_dof,
        "cross_validated_rms": _in_unit(error.cross_validated_rms, axis),
        "unit": axis.deviation_unit.ascii,
    }


def _in_unit(value: float | None, axis: Axis) -> float | None:
    return None if value is None else axis.deviation_unit.from_si(value)


def _noise(noise: Noise, axis: Axis) -> dict[str, Any]:
    return {
        "repeatability": axis.deviation_unit.from_si(noise.sigma),
        **{
            source.value.replace(" ", "_"): axis.deviation_unit.from_si(noise.amount(source))
            for source in noise.ratios
        },
    }


def _estimate(estimate: Estimate, design: Design) -> dict[str, Any]:
    unit = unit_of(estimate.parameter.dimension, design.axis.kind, time_is_counted=design.time_is_counted)
    found = {
        "name": estimate.parameter.name,
        "value": estimate.value * unit.per_si,
        "unit": unit.ascii,
        "expanded_uncertainty": estimate.expanded_uncertainty * unit.per_si,
        "coverage_factor": estimate.coverage_factor,
        "given": estimate.is_given,
        "plausibility": estimate.plausibility(time_is_counted=design.time_is_counted).name.lower(),
    }
    if estimate.expected is not None:
        found["expected"] = estimate.expected * unit.per_si
    return found


def _failure(failure: Failure, language: Language) -> dict[str, Any]:
    return {
        "test": failure.test.value,
        "p_value": failure.p_value,
        "where": failure.where.in_language(language),
        "statement": failure.statement.in_language(language),
    }


def _candidate(candidate: Candidate, design: Design, language: Language) -> dict[str, Any]:
    after = report_error(candidate.error, design.axis)
    discriminate_by = candidate.discriminate_by
    return {
        "effect": candidate.identifier,
        "settings": candidate.effect.settings.model_dump(mode="json"),
        "p_value": candidate.p_value,
        "p_value_extrapolated": candidate.p_value_is_extrapolated,
        "probability": candidate.probability,
        "rms_after": after["rms"],
        "chi2_per_dof_after": after["chi2_per_dof"],
        "cross_validated_rms_after": after["cross_validated_rms"],
        "parameters": [_estimate(each, design) for each in candidate.estimates],
        "share": candidate.share,
        "explains": candidate.explains.in_language(language),
        "indistinguishable_from": list(candidate.equals),
        "discriminate_by": "" if discriminate_by is None else discriminate_by.in_language(language),
    }


def _visibility(seen: Visibility, axis: Axis) -> dict[str, Any]:
    unit = axis.deviation_unit
    finite = seen.smallest_rms < float("inf")
    return {
        "effect": seen.effect,
        "share": seen.share,
        "smallest_rms": unit.from_si(seen.smallest_rms) if finite else None,
    }
