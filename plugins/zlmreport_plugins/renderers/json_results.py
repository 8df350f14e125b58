"""The results file: every number of a certificate at full precision, for programs.

Micrometres, or seconds of arc on a rotary axis; positions in millimetres or degrees; symbols in ASCII.
What a test does not define is absent: there is no NaN, and no zero in its place. The format is published
as a JSON schema in ``results.schema.json`` beside this module.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any, TypeAlias

from zlmreport.plugin import (
    COVERAGE_PROBABILITY,
    Approach,
    Axis,
    Certificate,
    CertificateSource,
    Decision,
    EvaluatedParameter,
    Evaluation,
    Language,
    MeasurementSet,
    NoBudget,
    Relationship,
    SourceFile,
    Unit,
    Words,
    hookimpl,
)

SCHEMA = "zlmreport/results/1"

Json: TypeAlias = dict[str, Any]

_DIRECTIONS = {Approach.POSITIVE: "fwd", Approach.NEGATIVE: "bwd"}


class JsonResultsRenderer:
    """The results file."""

    identifier = "json"
    title = Words(en="Results file (JSON)", de="Ergebnisdatei (JSON)")
    suffix = ".json"
    relationship = Relationship.DATA

    def render(self, certificate: Certificate) -> bytes:
        """Return the file, UTF-8."""
        text = json.dumps(_results(certificate), indent=2, ensure_ascii=False, allow_nan=False)
        # Half a surrogate pair has no UTF-8, but an escape that JSON knows.
        return f"{text}\n".encode("utf-8", "backslashreplace")


def _results(certificate: Certificate) -> Json:
    measurements = certificate.measurements
    return {
        "schema": SCHEMA,
        "certificate": _certificate(certificate),
        "evaluations": [
            _evaluation(evaluation, certificate.language) for evaluation in certificate.evaluations
        ],
        **_as_found(certificate),
        **_uncertainty(certificate),
        "model": _model(certificate),
        "measurements": _measurements(measurements),
        "provenance": _provenance(certificate),
    }


def _certificate(certificate: Certificate) -> Json:
    identity: Json = {
        "number": certificate.number,
        "title": certificate.title,
        "language": certificate.language.value,
    }
    if certificate.issued is not None:
        identity["issued"] = certificate.issued.isoformat()
    amends = certificate.job.keys.certificate.amends if certificate.job else None
    if amends:
        identity["amends"] = {"number": amends.number, "kind": amends.kind, "reason": amends.reason}
    return identity


def _as_found(certificate: Certificate) -> Json:
    """Return the results of the axis before it was adjusted; nothing where it was not."""
    found = certificate.evaluations_as_found
    if not found:
        return {}
    measurements = found[0].measurements
    provenance = measurements.provenance
    return {
        "as_found": {
            "evaluations": [_evaluation(evaluation, certificate.language) for evaluation in found],
            "measurements": _measurements(measurements),
            "source": provenance.source,
            "files": [_file(file) for file in provenance.files],
        }
    }


def _evaluation(evaluation: Evaluation, language: Language) -> Json:
    axis = evaluation.measurements.axis
    return {
        "standard": evaluation.standard,
        "designation": evaluation.designation,
        "parameters": [
            _parameter(parameter, axis.deviation_unit, language) for parameter in evaluation.parameters
        ],
        "positions": [
            _position(evaluation, index) for index in range(len(evaluation.measurements.target_positions))
        ],
        "findings": [
            {
                "requirement": finding.requirement.in_language(language),
                "found": finding.found.in_language(language),
                "met": finding.met,
                "basis": finding.basis.value,
            }
            for finding in evaluation.findings
        ],
    }


def _parameter(parameter: EvaluatedParameter, unit: Unit, language: Language) -> Json:
    values: Json = {
        "symbol": parameter.quantity.symbol,
        "name": parameter.quantity.name.in_language(language),
        "value": unit.from_si(parameter.value),
        "unit": unit.ascii,
    }
    if parameter.expanded_uncertainty is not None:
        values["expanded_uncertainty"] = unit.from_si(parameter.expanded_uncertainty)
    if parameter.coverage_factor is not None:
        values["coverage_factor"] = parameter.coverage_factor
    if parameter.limit is not None:
        values["limit"] = unit.from_si(parameter.limit)
        values["conforms"] = parameter.conforms
    if parameter.decision is not None:
        values["decision"] = _decision(parameter.decision, unit)
    return values


def _decision(decision: Decision, unit: Unit) -> Json:
    stated: Json = {"statement": decision.conformity.value}
    if decision.acceptance_limit is not None:
        stated["acceptance_limit"] = unit.from_si(decision.acceptance_limit)
    if decision.rejection_limit is not None:
        stated["rejection_limit"] = unit.from_si(decision.rejection_limit)
    if decision.risk is not None:
        stated["risk"] = decision.risk
    return stated


def _position(evaluation: Evaluation, index: int) -> Json:
    measurements = evaluation.measurements
    statistics = evaluation.statistics
    row: Json = {"target": _target(measurements.axis, float(measurements.target_positions[index]))}
    for approach in measurements.approaches:
        row[f"n_{_DIRECTIONS[approach]}"] = int(statistics.count[approach.index, index])
    columns = {
        "mean_fwd": statistics.mean_positive,
        "mean_bwd": statistics.mean_negative,
        "mean": statistics.mean_bidirectional,
        "s_fwd": statistics.s_positive,
        "s_bwd": statistics.s_negative,
        "reversal": statistics.reversal_value,
        **{column.quantity.symbol: column.values for column in evaluation.columns},
    }
    expanded = evaluation.mean_uncertainty
    if expanded is not None:
        columns |= {
            "U_mean_fwd": expanded.by_approach[Approach.POSITIVE.index],
            "U_mean_bwd": expanded.by_approach[Approach.NEGATIVE.index],
            "U_mean": expanded.bidirectional,
        }
    for symbol, values in columns.items():
        value = float(values[index])
        if not math.isnan(value):
            row[symbol] = measurements.axis.deviation_unit.from_si(value)
    return row


def _uncertainty(certificate: Certificate) -> Json:
    """Return the uncertainty budget, or why there is none; nothing where nobody asked for one."""
    budget, language = certificate.budget, certificate.language
    if budget is None:
        return {}
    if isinstance(budget, NoBudget):
        return {"uncertainty": {"not_evaluated": budget.reason.in_language(language)}}
    unit = certificate.measurements.axis.deviation_unit
    contributions = [
        {
            "name": each.name.in_language(language),
            "stated": each.stated.in_language(language),
            "source": each.source.in_language(language),
            "distribution": each.distribution.value,
            "acts": each.acts.value,
            "standard_uncertainty": unit.from_si(each.standard_uncertainty),
            "share": budget.share(each),
        }
        for each in budget.contributions
    ]
    return {
        "uncertainty": {
            "unit": unit.ascii,
            "coverage_probability": COVERAGE_PROBABILITY,
            "contributions": contributions,
            "combined_standard_uncertainty": unit.from_si(budget.standard_uncertainty),
            "not_considered": [words.in_language(language) for words in budget.not_considered],
        }
    }


def _model(certificate: Certificate) -> Json:
    """Return the error model with its parameters and its error; empty where the job names none."""
    diagnosis = certificate.diagnosis
    if diagnosis is None:
        return {"effects": [], "parameters": [], "error": {}}
    from zlmreport.plugin import report_error, report_model  # noqa: PLC0415 - brings the error model

    error = report_error(diagnosis.error, certificate.measurements.axis)
    return {
        **report_model(diagnosis.fit),
        "error": {key: value for key, value in error.items() if value is not None},
        "verdict": diagnosis.verdict.value,
    }


def _measurements(measurements: MeasurementSet) -> Json:
    axis = measurements.axis
    return {
        "axis": axis.name,
        "kind": axis.kind.value,
        "units": {"position": axis.position_unit.ascii, "deviation": axis.deviation_unit.ascii},
        "runs": len(measurements.runs),
        "readings": sum(not math.isnan(value) for value in measurements.deviation.tolist()),
        "missing": list(_missing(measurements)),
        "excluded": list(_excluded(measurements)),
    }


def _missing(measurements: MeasurementSet) -> Iterator[Json]:
    for reading in measurements.missing():
        yield {
            "target": _target(measurements.axis, reading.target_position),
            "direction": _DIRECTIONS[reading.approach],
            "run": reading.run,
        }


def _excluded(measurements: MeasurementSet) -> Iterator[Json]:
    for each in measurements.provenance.exclusions:
        yield {
            "target": _target(measurements.axis, each.target_position),
            "direction": _DIRECTIONS[each.approach],
            "run": each.run,
            "deviation": measurements.axis.deviation_unit.from_si(each.deviation),
            "reason": each.reason,
        }


def _provenance(certificate: Certificate) -> Json:
    provenance = certificate.measurements.provenance
    return {
        "generator": certificate.generator,
        "plugins": dict(sorted(certificate.plugins.items())),
        "source": provenance.source,
        "files": [_file(file) for file in provenance.files],
        "sources": [_source(source) for source in certificate.sources],
        "remarks": [words.in_language(certificate.language) for words in provenance.remarks],
        "corrections": [
            {
                "name": each.name.in_language(certificate.language),
                "method": each.method.in_language(certificate.language),
                "inputs": each.inputs.in_language(certificate.language),
                "largest": certificate.measurements.axis.deviation_unit.from_si(each.largest),
            }
            for each in provenance.corrections
        ],
    }


def _file(file: SourceFile) -> Json:
    return {"name": file.name, "sha256": file.sha256, "size": file.size}


def _source(source: CertificateSource) -> Json:
    """Return a file that the certificate was made from, under its name as an attachment."""
    return {
        "role": source.role.key,
        "name": source.name,
        "path": source.path,
        "sha256": source.file.sha256,
        "size": source.file.size,
    }


def _target(axis: Axis, position: float) -> float:
    """Return a target position as it was typed: 15 digits undo the rounding of the way to SI and back."""
    return float(f"{axis.position_unit.from_si(position):.15g}")


@hookimpl
def zlmreport_renderers() -> list[JsonResultsRenderer]:
    """Offer the renderer."""
    return [JsonResultsRenderer()]
