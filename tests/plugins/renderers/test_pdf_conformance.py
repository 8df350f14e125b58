"""The PDF keeps what it claims, PDF/A-3a and PDF/UA-1, whatever stands in it."""

from __future__ import annotations

from dataclasses import replace
from io import BytesIO
from pathlib import Path

import pytest
from PIL import Image
from pypdf import PdfReader

from document.typesetting import samples
from environments import ROOT
from installed import registry
from pdf_conformance import complaints
from plugins.renderers.pdf_pages import sample
from zlmreport import pipeline
from zlmreport.job.loading import load
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import Certificate


def _with_logo() -> Certificate:
    picture = BytesIO()
    Image.new("RGB", (30, 10), "navy").save(picture, "PNG")
    plain = samples.certificate(standards=0)
    assert plain.letterhead is not None
    return replace(
        plain, letterhead=replace(plain.letterhead, logo=picture.getvalue(), logo_type="image/png")
    )


_CERTIFICATES = {
    "English": samples.certificate,
    "German, Letter": lambda: samples.certificate(Language.GERMAN, "Letter"),
    "no letterhead, no date of issue": lambda: samples.certificate(standards=0, letterhead=None, issued=None),
    "logo": _with_logo,
    "tables over several pages": lambda: samples.certificate(
        readings=samples.measurements(targets=60), standards=1
    ),
    "markup and control characters in a name": lambda: samples.certificate(
        standards=0, customer="<b>A & B</b> ]]> {{ 1 }} a\x00b\x1fc\u200b\ufffe"
    ),
}


@pytest.mark.parametrize("made", _CERTIFICATES.values(), ids=_CERTIFICATES)
def test_it_conforms(made) -> None:
    assert complaints(registry().renderer("pdf").render(made())) == []


@pytest.mark.long
def test_a_certificate_with_a_diagnosis_conforms() -> None:
    loaded = load(Path(ROOT, "configs", "hidden-effect", "job.yaml"), registry(), formats=("pdf",))
    (document,) = pipeline.run(loaded, registry()).documents
    assert complaints(document.content) == []


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
