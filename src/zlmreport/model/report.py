"""A diagnosis as the results file of `zlmreport model diagnose --json`: full precision, micrometres or ″."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import Any

import numpy as np

from zlmreport.language import Language, Words
from zlmreport.measurement.axis import Axis
from zlmreport.model import wording
from zlmreport.model.design import Design
from zlmreport.model.diagnosis import EXPLAINS, Candidate, Diagnosis, ErrorNumbers, Verdict
from zlmreport.model.effect import Parameter, unit_of
from zlmreport.model.estimate import Estimate
from zlmreport.model.fit import Fit
from zlmreport.model.noise import Noise
from zlmreport.model.profile import intervals
from zlmreport.model.residuals import Failure
from zlmreport.model.visibility import Visibility
from zlmreport.quantities.units import Unit

SCHEMA = "zlmreport/diagnosis/1"
#: Probability from which on a candidate is worth a word.
_SERIOUS = 0.01

_ADEQUATE = Words(
    en="The model describes the readings: nothing is left that their scatter does not explain.",
    de="Das Modell beschreibt die Messwerte: Es bleibt nichts übrig, was ihre Streuung nicht erklärt.",
)
_MISSING = Words(
    en="Missing effect: {effects}, which explains the rest.",
    de="Fehlender Einfluss: {effects}; er erklärt den Rest.",
)
_MISSING_IN_PART = Words(
    en="Missing effect: {effects}. It explains {share} % of what the repeats leave open; the rest "
    "cannot be told from irregular scatter.",
    de="Fehlender Einfluss: {effects}. Er erklärt {share} % dessen, was die Wiederholungen offen lassen; "
    "der Rest ist von unregelmäßiger Streuung nicht zu unterscheiden.",
)
_FAULTY = Words(
    en="The data look wrong, and no cause is sought before they are right: {statement}. Remedy: {remedy}.",
    de="Die Daten sehen falsch aus, und vorher wird keine Ursache gesucht: {statement}. Abhilfe: {remedy}.",
)
_IMPOSSIBLE = Words(
    en="{statement} {effects} would explain it only with physically impossible values.",
    de="{statement} {effects} würde es nur mit physikalisch unmöglichen Werten erklären.",
)
_MISSING_TOGETHER = Words(
    en="Missing effects: {effects}, which together explain the rest.",
    de="Fehlende Einflüsse: {effects}; zusammen erklären sie den Rest.",
)
_UNEXPLAINED = Words(
    en="Something is left that no installed effect explains.",
    de="Es bleibt etwas übrig, das kein installierter Einfluss erklärt.",
)
_SHAPE = Words(
    en="Something is left that no installed effect explains: {shape}; root mean square {size}, largest "
    "at {where}.",
    de="Es bleibt etwas übrig, das kein installierter Einfluss erklärt: {shape}; quadratischer Mittelwert "
    "{size}, am größten bei {where}.",
)
_OR = Words(en="{one} or {other}", de="{one} oder {other}")
_AND = Words(en="{one} and {other}", de="{one} und {other}")


def report(
    diagnosis: Diagnosis,
    language: Language = Language.ENGLISH,
    experiment: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Return a diagnosis as plain values for a JSON file.

    `experiment`: What tells the first candidate from its equals, with these under the key ``effects``.
    """
    fitted = diagnosis.fit
    axis = fitted.design.axis
    return {
        "schema": SCHEMA,
        "model": report_model(fitted),
        "error": report_error(diagnosis.error, axis),
        "noise": report_noise(fitted.noise, axis),
        "verdict": diagnosis.verdict.value,
        "p_value": diagnosis.p_value,
        "failures": [_failure(each, language) for each in diagnosis.failures],
        "candidates": [
            {
                **_candidate(each, fitted.design, language),
                "experiment": experiment if experiment and each.identifier in experiment["effects"] else None,
            }
            for each in diagnosis.candidates
        ],
        "implausible": [_candidate(each, fitted.design, language) for each in diagnosis.implausible],
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
        "faults": [
            {
                "fault": each.kind.value,
                "run": each.run,
                "probability": each.probability,
                "statement": each.statement.in_language(language),
                "remedy": each.remedy.in_language(language),
            }
            for each in diagnosis.faults
        ],
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


def report_precision(fitted: Fit, *, with_residuals: bool = True) -> dict[str, Any]:
    """Return how well a model is known: covariance and intervals of its parameters, and what it leaves.

    Without residuals where single readings are not to be told.
    """
    residuals = {"residuals": _residuals(fitted.of_the_job)} if with_residuals else {}
    return {"covariance": _covariance(fitted), "intervals": _intervals(fitted), **residuals}


def _covariance(fitted: Fit) -> dict[str, Any]:
    """Return how the estimated parameters hang together, in the units in which they are reported."""
    units = [_unit(each, fitted.design) for _, each in fitted.columns]
    covariance = fitted.uncertainties.covariance
    scale = np.array([each.per_si for each in units])
    deviations = np.sqrt(np.diagonal(covariance))
    deviations = np.where(deviations > 0, deviations, 1.0)
    return {
        "parameters": [f"{effect}.{each.name}" for effect, each in fitted.columns],
        "units": [each.ascii for each in units],
        "covariance": (covariance * np.outer(scale, scale)).tolist(),
        "correlation": (covariance / np.outer(deviations, deviations)).tolist(),
    }


def _intervals(fitted: Fit) -> list[dict[str, Any]]:
    """Return from where to where the readings leave each parameter; null where they exclude nothing."""
    return [
        {
            "parameter": f"{each.effect}.{each.parameter.name}",
            "unit": (unit := _unit(each.parameter, fitted.design)).ascii,
            "low": each.low * unit.per_si if isfinite(each.low) else None,
            "high": each.high * unit.per_si if isfinite(each.high) else None,
            "open": [side for side in ("low", "high") if getattr(each, f"{side}_is_open")],
        }
        for each in intervals(fitted)
    ]


def _residuals(fitted: Fit) -> list[dict[str, Any]]:
    """Return what the model leaves of each reading, in the order in which they were taken."""
    design = fitted.design
    unit = design.axis.deviation_unit
    positions = design.axis.position_unit.from_si(design.position).tolist()
    residuals = unit.from_si(fitted.residual).tolist()
    signs = ["+" if each > 0 else "-" for each in design.direction.tolist()]
    return [
        {"target": target, "direction": sign, "run": run, "residual": residual, "unit": unit.ascii}
        for target, sign, run, residual in zip(positions, signs, design.run.tolist(), residuals, strict=True)
    ]


def _unit(parameter: Parameter, design: Design) -> Unit:
    return unit_of(parameter.dimension, design.axis.kind, time_is_counted=design.time_is_counted)


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


def report_noise(noise: Noise, axis: Axis) -> dict[str, Any]:
    """Return what scatters: where readings are weighted, also where they scatter least and most."""
    unit = axis.deviation_unit
    least, largest = noise.span
    ends = (("least", least), ("largest", largest)) if least < largest else ()
    return {
        "repeatability": unit.from_si(noise.sigma),
        **{f"{end}_repeatability": unit.from_si(size) for end, size in ends},
        **{source.value.replace(" ", "_"): unit.from_si(noise.amount(source)) for source in noise.ratios},
    }


def _estimate(estimate: Estimate, design: Design) -> dict[str, Any]:
    unit = _unit(estimate.parameter, design)
    found = {
        "name": estimate.parameter.name,
        "value": estimate.value * unit.per_si,
        "unit": unit.ascii,
        "expanded_uncertainty": estimate.expanded_uncertainty * unit.per_si,
        "coverage_factor": estimate.coverage_factor,
        "given": estimate.is_given,
        "plausibility": estimate.plausibility(time_is_counted=design.time_is_counted).name.lower(),
    }
    if estimate.equals:
        found["equals"] = estimate.equals
    if estimate.at_bound:
        found["at_bound"] = estimate.at_bound
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
    discriminate_by, remedy = candidate.discriminate_by, candidate.effect.remedy
    return {
        "effect": candidate.identifier,
        "settings": candidate.effect.settings.model_dump(mode="json"),
        "p_value": candidate.p_value,
        "p_value_extrapolated": candidate.p_value_is_extrapolated,
        "probability": candidate.probability,
        "plausible": candidate.is_plausible,
        "rms_after": after["rms"],
        "chi2_per_dof_after": after["chi2_per_dof"],
        "cross_validated_rms_after": after["cross_validated_rms"],
        "parameters": [_estimate(each, design) for each in candidate.estimates],
        "share": candidate.share,
        "explains": candidate.explains.in_language(language),
        "indistinguishable_from": list(candidate.equals),
        "discriminate_by": "" if discriminate_by is None else discriminate_by.in_language(language),
        "remedy": remedy.in_language(language) if remedy else "",
    }


def _visibility(seen: Visibility, axis: Axis) -> dict[str, Any]:
    unit = axis.deviation_unit
    finite = seen.smallest_rms < float("inf")
    return {
        "effect": seen.effect,
        "share": seen.share,
        "smallest_rms": unit.from_si(seen.smallest_rms) if finite else None,
    }


def verdict_statement(diagnosis: Diagnosis) -> Words:
    """Return the verdict in a sentence, with the names of what is missing or the shape of what has none."""
    if diagnosis.verdict is Verdict.ADEQUATE:
        return _ADEQUATE
    if diagnosis.verdict is Verdict.UNEXPLAINED:
        return _unexplained(diagnosis)
    leading = diagnosis.candidates[0]
    first = listed([leading.identifier, *leading.equals], _OR)
    if diagnosis.further:
        return _MISSING_TOGETHER.given(effects=listed([first, *diagnosis.further], _AND))
    if leading.share is None or leading.share >= EXPLAINS:
        return _MISSING.given(effects=first)
    return _MISSING_IN_PART.given(effects=first, share=wording.number(100 * leading.share, 0))


def _unexplained(diagnosis: Diagnosis) -> Words:
    fault = next((each for each in diagnosis.faults if each.explains), None)
    if fault is not None:
        return _FAULTY.given(statement=fault.statement, remedy=fault.remedy)
    unnamed, left = diagnosis.unnamed, _UNEXPLAINED
    if unnamed is not None:
        size = wording.deviation(diagnosis.fit.design.axis, unnamed.size)
        left = _SHAPE.given(shape=unnamed.shape, size=size, where=unnamed.where)
    if not diagnosis.implausible:
        return left
    names = listed([each.identifier for each in diagnosis.implausible], _OR)
    return _IMPOSSIBLE.given(statement=left, effects=names)


def serious_candidates(diagnosis: Diagnosis) -> tuple[Candidate, ...]:
    """Return the candidates that are worth a word: the first, its equals, and what is not improbable."""
    return tuple(
        each
        for each in diagnosis.candidates
        if each is diagnosis.candidates[0] or each.equals or each.probability >= _SERIOUS
    )


def listed(names: Sequence[str | Words], last: Words = _AND) -> Words:
    """Return names in a row: commas between them, and a word before the last."""
    *others, final = names
    if not others:
        return Words("{one}", "{one}").given(one=final)
    row = others[0]
    for name in others[1:]:
        row = Words("{one}, {other}", "{one}, {other}").given(one=row, other=name)
    return last.given(one=row, other=final)
