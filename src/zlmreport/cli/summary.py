"""The machine-readable summary ``zlmreport/summary/1``: what ``--json`` prints."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from zlmreport import __version__
from zlmreport.cli.results import Result
from zlmreport.errors import Problem
from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.language import Language

SCHEMA = "zlmreport/summary/1"


def summary(results: Sequence[Result], exit_code: int) -> dict[str, Any]:
    """Return what became of all jobs; values in full precision, µm or ″, as in the results file."""
    return {
        "schema": SCHEMA,
        "zlmreport": __version__,
        "exit_code": exit_code,
        "jobs": [_job(result) for result in results],
    }


def _job(result: Result) -> dict[str, Any]:
    certificate = result.job.keys.certificate if result.job else None
    return {
        "job": str(result.path),
        "number": certificate.number if certificate else None,
        "kind": certificate.kind if certificate else None,
        "status": "failed" if result.error else "done",
        "conforms": result.conforms,
        "files": [str(path) for path in result.files],
        "evaluations": [_evaluation(evaluation) for evaluation in result.evaluations],
        "missing_readings": _missing_readings(result),
        "problems": [_problem(problem) for problem in (result.error.problems if result.error else ())],
    }


def _evaluation(evaluation: Evaluation) -> dict[str, Any]:
    unit = evaluation.measurements.axis.deviation_unit

    def in_unit(value: float | None) -> float | None:
        return None if value is None else unit.from_si(value)

    return {
        "standard": evaluation.standard,
        "parameters": [
            {
                "symbol": parameter.quantity.symbol,
                "name": parameter.quantity.name.in_language(Language.ENGLISH),
                "value": in_unit(parameter.value),
                "unit": unit.ascii,
                "expanded_uncertainty": in_unit(parameter.expanded_uncertainty),
                "coverage_factor": parameter.coverage_factor,
                "limit": in_unit(parameter.limit),
                "conforms": parameter.conforms,
            }
            for parameter in evaluation.parameters
        ],
        "requirements": [
            {
                "requirement": finding.requirement.in_language(Language.ENGLISH),
                "found": finding.found.in_language(Language.ENGLISH),
                "met": finding.met,
            }
            for finding in evaluation.findings
        ],
    }


def _missing_readings(result: Result) -> list[dict[str, Any]]:
    if not result.evaluations:
        return []
    measurements = result.evaluations[0].measurements
    unit = measurements.axis.position_unit
    return [
        {
            "target": unit.from_si(reading.target_position),
            "unit": unit.ascii,
            "direction": "+" if reading.approach > 0 else "-",
            "run": reading.run,
        }
        for reading in measurements.missing()
    ]


def _problem(problem: Problem) -> dict[str, Any]:
    return {
        "file": problem.place.file,
        "line": problem.place.line or None,
        "column": problem.place.column or None,
        "message": problem.message,
    }
