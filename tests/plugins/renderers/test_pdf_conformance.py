"""The PDF keeps what it claims, PDF/A-3a and PDF/UA-1, whatever stands in it."""

from __future__ import annotations

from pathlib import Path

import pytest
from pypdf import PdfReader

from document.typesetting import samples
from environments import ROOT
from installed import registry
from pdf_conformance import complaints
from plugins.renderers.pdf_pages import sample
from zlmreport import pipeline
from zlmreport.job.loading import load
from zlmreport.plugin import Language


@pytest.mark.long
def test_a_certificate_with_a_diagnosis_conforms() -> None:
    loaded = load(Path(ROOT, "configs", "hidden-effect", "job.yaml"), registry(), formats=("pdf",))
    (document,) = pipeline.run(loaded, registry()).documents
    assert complaints(document.content) == []


def test_markup_and_control_characters_in_a_name_conform() -> None:
    customer = "<b>A & B</b> ]]> {{ 1 }} a\x00b\x1fc\u200b\ufffe"
    certificate = samples.certificate(standards=0, customer=customer)
    assert complaints(registry().renderer("pdf").render(certificate)) == []


def test_it_claims_both() -> None:
    reader = sample()
    packet = reader.trailer["/Root"]["/Metadata"].get_object().get_data().decode()
    assert 'pdfaid:part="3" pdfaid:conformance="A"' in packet
    assert "<pdfuaid:part>1</pdfuaid:part>" in packet


def test_its_number_and_language_are_metadata() -> None:
    metadata = sample(Language.GERMAN).xmp_metadata
    assert metadata is not None
    assert (metadata.dc_identifier, metadata.dc_language) == ("CAL-2026-0117", ["de"])


def test_metadata_can_be_read_without_unpacking_the_file() -> None:
    content = registry().renderer("pdf").render(samples.certificate(standards=0))
    assert b"<pdfuaid:part>1</pdfuaid:part>" in content


def test_viewers_show_the_title_and_walk_in_the_order_of_the_structure() -> None:
    reader: PdfReader = sample()
    assert reader.trailer["/Root"]["/ViewerPreferences"]["/DisplayDocTitle"].value is True
    assert {page["/Tabs"] for page in reader.pages} == {"/S"}
