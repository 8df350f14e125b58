"""A certificate from real measurements, with everything that makes others trust it, in one piece."""

from __future__ import annotations

from pathlib import Path

import pytest
from dcclib.validation.schematron import SchematronValidator

from environments import ROOT
from installed import registry
from pdf_conformance import complaints
from verification.issued import with_page_content
from zlmreport import pipeline
from zlmreport.job.loading import load
from zlmreport.verification.verify import verify

JOB = """\
schema: zlmreport/job/1
extends: {example}
certificate: {{number: TRUST-1}}
laboratory: {{country: DE}}
evaluate: ["iso230-2:2014", vdi-dgq-3441]
decision_rule: guard-band
output: {{directory: {folder}, formats: [pdf, json, dcc]}}
"""


@pytest.fixture(scope="module")
def documents(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The files of the certificate, by their suffix."""
    folder = tmp_path_factory.mktemp("trust")
    job = folder / "job.yaml"
    example = ROOT / "configs" / "linear-axis" / "certificate.yaml"
    job.write_text(JOB.format(example=example, folder=folder / "out"), encoding="utf-8")
    made = pipeline.run(load(job, registry()), registry())
    return {document.path.suffix: document.content for document in made.documents}


@pytest.mark.long
def test_its_pdf_keeps_what_it_claims(documents):
    assert complaints(documents[".pdf"]) == []


@pytest.mark.long
def test_its_digital_certificate_keeps_the_rules_of_ptb(documents):
    text = documents[".xml"].decode().partition("?>")[2].lstrip()
    found = SchematronValidator.for_dcc().validate_str(text)

    assert found.failed_assertions == []
    assert [each.text for each in found.successful_reports if each.role == "error"] == []


@pytest.mark.long
def test_it_holds(documents, tmp_path):
    assert verify(_written(documents[".pdf"], tmp_path), registry()).holds


@pytest.mark.long
def test_it_does_not_hold_with_a_single_stroke_more(documents, tmp_path):
    altered = with_page_content(documents[".pdf"], 1, lambda content: content + b"\n0 0 m 9 9 l S")

    assert not verify(_written(altered, tmp_path), registry()).holds


def _written(content: bytes, folder: Path) -> Path:
    path = folder / "TRUST-1.pdf"
    path.write_bytes(content)
    return path
