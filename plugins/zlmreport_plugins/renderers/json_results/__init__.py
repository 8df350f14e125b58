"""The results file (JSON): every number of a certificate at full precision, for programs.

Micrometres, or seconds of arc on a rotary axis; positions in millimetres or degrees; symbols in ASCII.
What a test does not define is absent: there is no NaN, and no zero in its place. The format is published
as a JSON schema in ``results.schema.json`` above this module.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

from zlmreport.plugin import (
    MICROMETRE,
    MILLIMETRE,
    SQUARENESS,
    Approach,
    Axis,
    Language,
    MeasurementSet,
    NominalCircle,
    Words,
    hookimpl,
)
from zlmreport.plugin.renderer import (
    COVERAGE_PROBABILITY,
    Budget,
    Certificate,
    CertificateSource,
    NoBudget,
    Relationship,
    Renderer,
    report_changes,
    report_evaluation,
)
from zlmreport.plugin.source import SourceFile

if TYPE_CHECKING:
    from zlmreport.plugin.extension import Job

SCHEMA = "zlmreport/results/1"

Json: TypeAlias = dict[str, Any]

#: Of a minute.
_SECONDS = 60.0
_DIRECTIONS = {Approach.POSITIVE: "fwd", Approach.NEGATIVE: "bwd"}


class JsonResultsRenderer:
    """The results file."""

    identifier = "json"
    title = Words("Results file (JSON)")
    suffix = ".json"
    relationship = Relationship.DATA
    needs_layout = False

    def render(self, certificate: Certificate) -> bytes:
        """Return the file, UTF-8."""
        text = json.dumps(collect_results(certificate), indent=2, ensure_ascii=False, allow_nan=False)
        # Half a surrogate pair has no UTF-8, but an escape that JSON knows.
        return f"{text}\n".encode("utf-8", "backslashreplace")


def collect_results(certificate: Certificate) -> Json:
    """Return the results as values of JSON."""
    if certificate.parts:
        return _collect_parts(certificate)
    measurements = certificate.measurements
    return {
        "schema": SCHEMA,
        "certificate": _collect_certificate(certificate),
        "evaluations": [
            report_evaluation(evaluation, certificate.language) for evaluation in certificate.evaluations
        ],
        **(_collect_as_found(certificate) if certificate.evaluations_as_found else {}),
        **_collect_uncertainty(certificate.budget, certificate.measurements.axis, certificate.language),
        **_collect_doubtful(certificate),
        "model": _collect_model(certificate),
        "measurements": _collect_measurements(measurements, certificate.job),
        **(_collect_tests(certificate) if certificate.tests else {}),
        "provenance": _collect_provenance(certificate),
    }


def _collect_parts(certificate: Certificate) -> Json:
    """Return the results of one document of several measurements: all of them, and each by itself."""
    whole = {name: collect_results(part) for name, part in certificate.parts.items()}
    return {
        "schema": SCHEMA,
        "certificate": _collect_certificate(certificate),
        "evaluations": [
            {**evaluation, "measurement": name}
            for name, part in whole.items()
            for evaluation in part["evaluations"]
        ],
        **_collect_uncertainty(certificate.budget, certificate.measurements.axis, certificate.language),
        **_collect_doubtful(certificate),
        "model": _collect_model(certificate),
        "parts": {
            name: {key: value for key, value in part.items() if key in _OF_A_PART}
            for name, part in whole.items()
        },
        "provenance": _collect_provenance(certificate),
    }


#: What the results of one of several measurements have of their own.
_OF_A_PART = ("evaluations", "as_found", "uncertainty", "model", "measurements", "tests")


def _collect_certificate(certificate: Certificate) -> Json:
    identity: Json = {
        "number": certificate.number,
        "title": certificate.title,
        "language": certificate.language.value,
    }
    if certificate.digest:
        identity["digest"] = certificate.digest
    if certificate.issued is not None:
        identity["issued"] = certificate.issued.isoformat()
    amends = certificate.job.keys.certificate.amends if certificate.job else None
    if amends:
        identity["amends"] = {"number": amends.number, "kind": amends.kind, "reason": amends.reason}
    return identity


def _collect_as_found(certificate: Certificate) -> Json:
    found = certificate.evaluations_as_found
    measurements = found[0].measurements
    job = certificate.job.as_found if certificate.job else None
    provenance = measurements.provenance
    return {
        "as_found": {
            "evaluations": [report_evaluation(evaluation, certificate.language) for evaluation in found],
            "changes": [report_changes(*pair) for pair in zip(found, certificate.evaluations, strict=True)],
            **_collect_uncertainty(certificate.budget_as_found, measurements.axis, certificate.language),
            "measurements": _collect_measurements(measurements, job),
            "source": provenance.source,
            "files": [_collect_file(file) for file in provenance.files],
        }
    }


def _collect_tests(certificate: Certificate) -> Json:
    """Return what is known of each of several measured lines."""
    found = {
        each.name: {
            "evaluations": [report_evaluation(of.evaluation, certificate.language) for of in each.evaluated],
            **_collect_uncertainty(each.budget, each.measurements.axis, certificate.language),
            "measurements": _collect_measurements(each.measurements, each.job),
            "source": each.measurements.provenance.source,
            "files": [_collect_file(file) for file in each.measurements.provenance.files],
        }
        for each in certificate.tests
    }
    return {"tests": found}


def _collect_doubtful(certificate: Certificate) -> Json:
    """Return what the first page marks as doubtful; nothing where it marks nothing."""
    said = [each.in_language(certificate.language) for each in (*certificate.doubts, *certificate.evidence)]
    return {"doubtful": said} if said else {}


def _collect_uncertainty(budget: Budget | NoBudget | None, axis: Axis, language: Language) -> Json:
    """Return an uncertainty budget, or why there is none; nothing where nobody asked for one."""
    if budget is None:
        return {}
    gaps = {"missing": list(budget.missing), "negligible": dict(budget.negligible)}
    if isinstance(budget, NoBudget):
        reason = budget.reason.in_language(language)
        return {"uncertainty": {"state": "incomplete", **gaps, "not_evaluated": reason, "contributions": []}}
    unit = axis.deviation_unit
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
    if budget.tests:  # each line has its own
        state = "complete" if budget.is_complete else "incomplete"
        return {"uncertainty": {"state": state, **gaps, "contributions": []}}
    longer = budget.uncorrected_expansion
    return {
        "uncertainty": {
            "state": "complete" if budget.is_complete else "incomplete",
            **gaps,
            "unit": unit.ascii,
            "coverage_probability": COVERAGE_PROBABILITY,
            "contributions": contributions,
            "combined_standard_uncertainty": unit.from_si(budget.standard_uncertainty),
            # By how much the measured length was longer than at 20 °C, micrometres; null if unknown.
            "uncorrected_expansion": None if longer is None else MICROMETRE.from_si(longer),
            # In no u, and in every U whole.
            "known_errors": [
                {
                    "name": each.name.in_language(language),
                    "stated": each.stated.in_language(language),
                    "source": each.source.in_language(language),
                    "largest": unit.from_si(each.largest),
                }
                for each in budget.known_errors
            ],
        }
    }


def _collect_model(certificate: Certificate) -> Json:
    """Return the error model with its parameters and its error; empty where the job names none."""
    diagnosis = certificate.diagnosis
    if diagnosis is None:
        return {"effects": [], "parameters": [], "error": {}}
    from zlmreport.plugin.effect import (
        report_error,
        report_model,
        report_precision,
    )

    error = report_error(diagnosis.error, certificate.measurements.axis)
    simplified = certificate.job is not None and certificate.job.keys.agreement.simplified
    return {
        **report_model(diagnosis.fit),
        "error": {key: value for key, value in error.items() if value is not None},
        "verdict": diagnosis.verdict.value,
        **report_precision(diagnosis.fit, with_residuals=not simplified),
    }


def _collect_measurements(measurements: MeasurementSet, job: Job | None) -> Json:
    axis = measurements.axis
    stated = _find_places(job) if job else {}
    at = {name: list(each) if isinstance(each, tuple) else each for name, each in stated.items()}
    return {
        "axis": axis.name,
        "kind": axis.kind.value,
        "units": {"position": axis.position_unit.ascii, "deviation": axis.deviation_unit.ascii},
        **({} if axis.measurand.is_position else {"measurand": axis.measurand.identifier}),
        **({"error": axis.error} if axis.error else {}),
        **({"circle": _collect_circle(axis.circle)} if axis.circle else {}),
        **({"at": at} if at else {}),
        "runs": len(measurements.runs),
        "readings": sum(not math.isnan(value) for value in measurements.deviation.tolist()),
        "missing": list(_list_missing(measurements)),
        "excluded": list(_list_excluded(measurements)),
    }


def _find_places(job: Job) -> Json:
    """Return where the other axes stood; of squareness each line says it of the other's axis."""
    measurement = job.keys.measurement
    places: Json = {}
    if job.axis.measurand.identifier == SQUARENESS.identifier:
        for line in measurement.tests.values():
            places |= line.at
    return places | measurement.at


def _collect_circle(circle: NominalCircle) -> Json:
    return {
        "plane": circle.plane,
        "radius": _round_as_typed(MILLIMETRE.from_si(circle.radius)),
        "feed": _round_as_typed(MILLIMETRE.from_si(circle.feed) * _SECONDS),
        "centre": [_round_as_typed(MILLIMETRE.from_si(each)) for each in circle.centre],
        "calibrated_length": circle.is_calibrated,
    }


def _round_as_typed(value: float) -> float:
    """Return a number as somebody wrote it, which SI and back may have changed in its last digit."""
    return float(f"{value:.12g}")


def _list_missing(measurements: MeasurementSet) -> Iterator[Json]:
    for reading in measurements.missing():
        yield {
            "target": measurements.axis.typed(reading.target_position),
            "direction": _DIRECTIONS[reading.approach],
            "run": reading.run,
        }


def _list_excluded(measurements: MeasurementSet) -> Iterator[Json]:
    for each in measurements.provenance.exclusions:
        yield {
            "target": measurements.axis.typed(each.target_position),
            "direction": _DIRECTIONS[each.approach],
            "run": each.run,
            "deviation": measurements.axis.deviation_unit.from_si(each.deviation),
            "reason": each.reason,
        }


def _collect_provenance(certificate: Certificate) -> Json:
    parts = tuple(certificate.parts.values()) or (certificate,)
    read = [line for part in parts for line in part.measurements.lines]
    files = dict.fromkeys(file for each in read for file in each.provenance.files)
    language = certificate.language
    return {
        "generator": certificate.generator,
        "plugins": dict(sorted(certificate.plugins.items())),
        "source": ", ".join(dict.fromkeys(each.provenance.source for each in read)),
        "files": [_collect_file(file) for file in files],
        "sources": [_collect_source(source) for source in certificate.sources],
        "remarks": [words.in_language(language) for each in read for words in each.provenance.remarks],
        "corrections": [
            {
                "name": each.name.in_language(language),
                "method": each.method.in_language(language),
                "inputs": each.inputs.in_language(language),
                "largest": line.axis.deviation_unit.from_si(each.largest),
            }
            for line in read
            for each in line.provenance.corrections
        ],
    }


def _collect_file(file: SourceFile) -> Json:
    return {"name": file.name, "sha256": file.sha256, "size": file.size}


def _collect_source(source: CertificateSource) -> Json:
    """Return a file that the certificate was made from, under its name as an attachment."""
    return {
        "role": source.role.value,
        "name": source.name,
        "path": source.path,
        "sha256": source.file.sha256,
        "size": source.file.size,
    }


@hookimpl
def zlmreport_renderers() -> list[Renderer]:
    """Offer the results file."""
    return [JsonResultsRenderer()]
