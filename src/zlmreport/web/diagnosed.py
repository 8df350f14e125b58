"""A diagnosis as the page shows it: verdict, failures with their readings, candidates with their evidence."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from zlmreport.certificate.linked import failure_values
from zlmreport.language import Language
from zlmreport.model.diagnosis import Diagnosis
from zlmreport.model.effect import Effect
from zlmreport.model.study import Study
from zlmreport.presenting.diagnosis import CandidateRow, DiagnosisRows
from zlmreport.web.panels import error_values, parameter_values


def diagnosed(
    diagnosis: Diagnosis, study: Study, effects: Sequence[Effect], language: Language
) -> dict[str, Any]:
    """Return a diagnosis in one language."""
    rows = DiagnosisRows.of(diagnosis, language, {each.identifier: each.title for each in effects})
    return {
        "verdict": diagnosis.verdict.value,
        "statement": rows.statement,
        "failures": [failure_values(each, diagnosis, study) for each in rows.failures],
        "candidates": [_candidate(each, rows) for each in rows.candidates],
        "serious": sum(each.is_serious for each in rows.candidates),
        "hidden": [
            {"effects": list(each.effects), "reason": each.reason}
            for each in (*rows.hidden, *rows.not_tested)
        ],
        "notExcluded": list(rows.not_excluded),
        "remarks": list(rows.remarks),
    }


def _candidate(row: CandidateRow, diagnosed: DiagnosisRows) -> dict[str, Any]:
    return {
        "effect": row.effect,
        "title": row.title,
        "argument": row.argument,
        "probability": f"{row.probability} %",
        "share": row.candidate.probability,
        "p": row.p,
        "rmsBefore": diagnosed.error.rms,
        "rmsAfter": row.error.rms,
        "error": error_values(row.error),
        "parameters": [parameter_values(each) for each in row.parameters],
        "explains": row.explains,
        "equals": list(row.equals),
        "tell": row.tell_apart_by,
    }
