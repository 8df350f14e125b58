"""What ``zlmreport verify --json`` prints: every finding, ``zlmreport/verification/1``."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from zlmreport import __version__
from zlmreport.verification.findings import Finding, Verification

SCHEMA = "zlmreport/verification/1"


def as_json(path: Path, found: Verification, exit_code: int) -> dict[str, Any]:
    """Return all that was found; values are in the units of the results file."""
    return {
        "schema": SCHEMA,
        "zlmreport": __version__,
        "exit_code": exit_code,
        "file": str(path),
        "holds": found.holds,
        "differences": found.differences,
        "certificate": asdict(found.identity),
        "signature": _finding(found.signature),
        "files": _findings(found.files),
        "values": [
            {
                "path": "/".join(value.path),
                "stated": value.stated,
                "recomputed": value.recomputed,
                "verdict": value.verdict.value,
            }
            for value in found.values
        ],
        "pages": _findings(found.pages),
        "document": _findings(found.document),
        "remarks": list(found.remarks),
    }


def _findings(findings: Iterable[Finding]) -> list[dict[str, str]]:
    return [_finding(each) for each in findings]


def _finding(finding: Finding) -> dict[str, str]:
    return {"subject": finding.subject, "verdict": finding.verdict.value, "detail": finding.detail}
