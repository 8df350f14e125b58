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

from zlmreport.certificate.document import Certificate
from zlmreport.evaluation.evaluation import Evaluation, Parameter
from zlmreport.hookspecs import hookimpl
from zlmreport.language import Language, Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.report import report_error, report_model
from zlmreport.quantities.units import Unit

SCHEMA = "zlmreport/results/1"

Json: TypeAlias = dict[str, Any]

_DIRECTIONS = {Approach.POSITIVE: "fwd", Approach.NEGATIVE: "bwd"}


class JsonResultsRenderer:
    """The results file."""

    identifier = "json"
    title = Words(en="Results file (JSON)", de="Ergebnisdatei (JSON)")
    suffix = ".json"

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
    return identity


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


def _parameter(parameter: Parameter, unit: Unit, language: Language) -> Json:
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
    return values


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
    for symbol, values in columns.items():
        value = float(values[index])
        if not math.isnan(value):
            row[symbol] = measurements.axis.deviation_unit.from_si(value)
    return row


def _model(certificate: Certificate) -> Json:
    """Return the error model with its parameters and its error; empty where the job names none."""
    diagnosis = certificate.diagnosis
    if diagnosis is None:
        return {"effects": [], "parameters": [], "error": {}}
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
    }


def _missing(measurements: MeasurementSet) -> Iterator[Json]:
    for reading in measurements.missing():
        yield {
            "target": _target(measurements.axis, reading.target_position),
            "direction": _DIRECTIONS[reading.approach],
            "run": reading.run,
        }


def _provenance(certificate: Certificate) -> Json:
    provenance = certificate.measurements.provenance
    return {
        "generator": certificate.generator,
        "plugins": dict(sorted(certificate.plugins.items())),
        "source": provenance.source,
        "files": [{"name": file.name, "sha256": file.sha256, "size": file.size} for file in provenance.files],
        "remarks": [words.in_language(certificate.language) for words in provenance.remarks],
    }


def _target(axis: Axis, position: float) -> float:
    """Return a target position as it was typed: 15 digits undo the rounding of the way to SI and back."""
    return float(f"{axis.position_unit.from_si(position):.15g}")


@hookimpl
def zlmreport_renderers() -> list[JsonResultsRenderer]:
    """Offer the renderer."""
    return [JsonResultsRenderer()]
