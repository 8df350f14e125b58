"""What every format says of a certificate: its results file, its table, and whether its pages hold."""

from __future__ import annotations

import csv
import io
import json
from importlib.resources import files
from typing import Any

from jsonschema import Draft202012Validator

from installed import registry
from zlmreport import pipeline
from zlmreport.plugin.extension import Job
from zlmreport.plugin.renderer import Certificate
from zlmreport.verification.verify import verify

#: Of the results file, as users are promised it.
VALIDATOR = Draft202012Validator(
    json.loads((files("zlmreport_plugins.renderers") / "results.schema.json").read_text("utf-8"))
)


def results_of(certificate: Certificate) -> Any:
    """Return the results file of a certificate, read again."""
    return json.loads(registry().renderer("json").render(certificate), parse_constant=_refuse)


def rows_of(certificate: Certificate) -> list[dict[str, str]]:
    """Return the rows of the table of a certificate."""
    return list(csv.DictReader(io.StringIO(registry().renderer("csv").render(certificate).decode())))


def parameters_of(certificate: Certificate) -> dict[str, str]:
    """Return the parameters in the table of a certificate, as they are written."""
    rows = rows_of(certificate)
    return {row["symbol"]: row["value"] for row in rows if not row["target"] and row["quantity"] == "value"}


def is_verified(job: Job) -> bool:
    """Return whether the PDF that a job makes holds."""
    documents = pipeline.run(job, registry()).documents
    for each in documents:
        each.path.write_bytes(each.content)
    (page,) = (each.path for each in documents if each.path.suffix == ".pdf")
    return verify(page, registry()).holds


def _refuse(constant: str) -> None:
    raise AssertionError(f"{constant} is no JSON")
