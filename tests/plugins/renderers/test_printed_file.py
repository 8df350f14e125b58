"""What holds of a PDF as a file, whichever renderer prints it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from document.typesetting import samples
from installed import registry
from pdf_conformance import complaints
from plugins.renderers.pdf_pages import ATTACHED, elements, read, sample, specifications
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import Attachment, Certificate

_CARRYING = replace(samples.certificate(standards=0), attachments=ATTACHED)
_CERTIFICATES = {
    "English": samples.certificate,
    "German": lambda: samples.certificate(Language.GERMAN),
    "German, Letter": lambda: samples.certificate(Language.GERMAN, "Letter"),
    "no letterhead, no date of issue": lambda: samples.certificate(standards=0, letterhead=None, issued=None),
    "PNG logo": lambda: samples.with_logo("png"),
    "JPEG logo": lambda: samples.with_logo("jpeg"),
    "attachments": lambda: _CARRYING,
    "attachments, no date of issue": lambda: replace(_CARRYING, issued=None),
    "tables over several pages": lambda: samples.certificate(
        readings=samples.measurements(targets=150), standards=1
    ),
}


@pytest.mark.parametrize("made", _CERTIFICATES.values(), ids=_CERTIFICATES)
def test_it_keeps_what_it_claims(press: str, made: Callable[[], Certificate]) -> None:
    assert complaints(registry().renderer(press).render(made())) == []


def test_metadata_tell_what_the_document_is_and_what_made_it(press: str) -> None:
    metadata = sample(press=press).metadata
    assert metadata.title == "Calibration certificate CAL-2026-0117"
    assert metadata.author == "Laboratory for Machine Metrology"
    assert metadata.subject == "Positioning by SAMPLE 1:2026"
    assert metadata["/Keywords"] == "positioning, SAMPLE 1:2026"
    assert (metadata.creator or "").startswith({"pdf": "zlmreport 0.1.0"}.get(press, "Typst"))


@pytest.mark.parametrize("language", Language)
def test_it_says_its_language(press: str, language: Language) -> None:
    assert sample(language, press=press).trailer["/Root"]["/Lang"] == language.value


def test_each_graph_has_its_alternative_text(press: str) -> None:
    expected = [figure.alternative.in_language(Language.GERMAN) for figure in samples.certificate().figures]
    figures = elements(sample(Language.GERMAN, press=press), "/Figure")
    assert [figure["/Alt"] for figure in figures] == expected


def test_tables_are_tagged_as_tables_with_headings(press: str) -> None:
    reader = sample(press=press)
    assert len(list(elements(reader, "/TH"))) > 50
    assert len(list(elements(reader, "/TD"))) > 700


def test_titles_are_tagged_by_their_level(press: str) -> None:
    reader = sample(press=press)
    assert len(list(elements(reader, "/H1"))) == 1
    assert len(list(elements(reader, "/H2"))) == 4


@pytest.mark.parametrize("attached", ATTACHED, ids=lambda each: each.name)
def test_a_file_is_carried_byte_for_byte_and_described(press: str, attached: Attachment) -> None:
    entry = specifications(read(_CARRYING, press))[attached.name]
    stream = entry["/EF"]["/F"]
    assert stream.get_data() == attached.content
    assert stream["/Subtype"] == f"/{attached.media_type}"
    assert entry["/AFRelationship"] == f"/{attached.relationship.value}"
    assert entry["/Desc"] == attached.description


def test_each_file_is_associated_with_the_document_once(press: str) -> None:
    associated = [each.get_object()["/UF"] for each in read(_CARRYING, press).root_object["/AF"]]
    assert sorted(associated) == sorted(each.name for each in ATTACHED)
