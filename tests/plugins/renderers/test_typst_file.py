"""A PDF by Typst as a file: what it claims, what it carries, and that it depends on nothing else."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any

import pikepdf
import pytest
from PIL import Image

from document.typesetting import samples
from installed import registry
from pdf_conformance import complaints
from plugins.renderers.pdf_pages import elements, fonts
from plugins.renderers.test_pdf_attachments import ATTACHED, specifications
from plugins.renderers.typst_pages import read, sample
from processes import PYTHON, run
from zlmreport.plugin import AccessError, Language
from zlmreport.plugin.renderer import Certificate

TESTS = Path(samples.__file__).parents[2]


def _with_logo(kind: str) -> Certificate:
    picture = BytesIO()
    Image.new("RGB", (30, 10), "navy").save(picture, kind)
    plain = samples.certificate(standards=0)
    assert plain.letterhead is not None
    letterhead = replace(plain.letterhead, logo=picture.getvalue(), logo_type=f"image/{kind}")
    return replace(plain, letterhead=letterhead)


_CERTIFICATES = {
    "English": samples.certificate,
    "German": lambda: samples.certificate(Language.GERMAN),
    "Letter": lambda: samples.certificate(paper="Letter"),
    "no letterhead, no date of issue": lambda: samples.certificate(standards=0, letterhead=None, issued=None),
    "PNG logo": lambda: _with_logo("png"),
    "JPEG logo": lambda: _with_logo("jpeg"),
    "attachments": lambda: replace(samples.certificate(standards=0), attachments=ATTACHED),
    "attachments, no date of issue": lambda: replace(
        samples.certificate(standards=0), attachments=ATTACHED, issued=None
    ),
    "tables over several pages": lambda: samples.certificate(readings=samples.measurements(targets=150)),
}


@pytest.mark.parametrize("made", _CERTIFICATES.values(), ids=_CERTIFICATES)
def test_it_conforms(made: Callable[[], Certificate]) -> None:
    assert complaints(registry().renderer("pdf-typst").render(made())) == []


def test_it_claims_both_standards() -> None:
    packet = sample().trailer["/Root"]["/Metadata"].get_object().get_data().decode()
    assert "<pdfaid:part>3</pdfaid:part><pdfaid:conformance>A</pdfaid:conformance>" in packet
    assert "<pdfuaid:part>1</pdfuaid:part>" in packet


def test_metadata_tell_what_the_document_is_and_who_made_it() -> None:
    metadata = sample().metadata
    assert metadata is not None
    assert metadata.title == "Calibration certificate CAL-2026-0117"
    assert metadata.author == "Laboratory for Machine Metrology"
    assert metadata.subject == "Positioning by SAMPLE 1:2026"
    assert metadata["/Keywords"] == "positioning, SAMPLE 1:2026"
    assert (metadata.creator or "").startswith(registry().renderer("pdf-typst").creator)


def test_its_dates_are_the_date_of_issue() -> None:
    metadata = sample().metadata
    assert metadata is not None
    assert {metadata["/CreationDate"], metadata["/ModDate"]} == {"D:20261120000000Z"}


@pytest.mark.parametrize("language", Language)
def test_it_says_its_language(language: Language) -> None:
    assert sample(language).trailer["/Root"]["/Lang"] == language.value


def test_each_graph_has_its_alternative_text() -> None:
    expected = {figure.alternative.in_language(Language.GERMAN) for figure in samples.certificate().figures}
    assert {figure.get("/Alt") for figure in elements(sample(Language.GERMAN), "/Figure")} == expected


def test_tables_are_tagged_as_tables_with_headings_and_captions() -> None:
    reader = sample()
    assert len(list(elements(reader, "/TH"))) > 50
    assert len(list(elements(reader, "/TD"))) > 700
    assert len(list(elements(reader, "/Caption"))) == 8 + 4


def test_titles_are_tagged_by_their_level() -> None:
    assert len(list(elements(sample(), "/H1"))) == 1
    assert len(list(elements(sample(), "/H2"))) == 4


def test_only_the_bundled_typeface_is_used_and_embedded() -> None:
    names = {str(font["/BaseFont"]).partition("+")[2] for page in sample().pages for font in fonts(page)}
    assert names == {"IBMPlexSans", "IBMPlexSans-Italic", "IBMPlexSans-SmBld"}  # its own name


@pytest.mark.parametrize("attached", ATTACHED, ids=lambda each: each.name)
def test_a_file_is_carried_byte_for_byte_and_described(attached: Any) -> None:
    reader = read(replace(samples.certificate(standards=0), attachments=ATTACHED))
    entry = specifications(reader)[attached.name]
    stream = entry["/EF"]["/F"]
    assert stream.get_data() == attached.content
    assert stream["/Subtype"] == f"/{attached.media_type}"
    assert entry["/AFRelationship"] == f"/{attached.relationship.value}"
    assert entry["/Desc"] == attached.description
    assert sorted(each.get_object()["/UF"] for each in reader.root_object["/AF"]) == sorted(
        each.name for each in ATTACHED
    )


def test_the_logo_says_whose_it_is() -> None:
    texts = [figure.get("/Alt") for figure in elements(read(_with_logo("png")), "/Figure")]
    assert "Laboratory for Machine Metrology" in texts


def test_a_viewer_finds_nothing_to_run_or_to_load() -> None:
    with pikepdf.open(BytesIO(registry().renderer("pdf-typst").render(samples.certificate()))) as pdf:
        assert "/OpenAction" not in pdf.Root
        assert "/JavaScript" not in pdf.Root.get("/Names", {})


def test_its_structure_is_compressed_and_no_object_is_lost() -> None:
    certificate = samples.certificate()
    pdf = registry().renderer("pdf-typst").render(certificate)
    assert len(pdf) < 1.1 * len(registry().renderer("pdf").render(certificate))
    with pikepdf.open(BytesIO(pdf)) as opened:
        assert opened.check_pdf_syntax() == []
        kinds = [each.get("/Type") for each in opened.objects if isinstance(each, pikepdf.Dictionary)]
    assert kinds.count("/StructElem") > 800
    assert b"/StructElem" not in pdf


def test_the_order_of_documents_does_not_matter() -> None:
    first = registry().renderer("pdf-typst").render(samples.certificate())
    registry().renderer("pdf-typst").render(samples.certificate(Language.GERMAN))
    assert registry().renderer("pdf-typst").render(samples.certificate()) == first


def test_without_the_package_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "typst", None)
    monkeypatch.delitem(sys.modules, "zlmreport_plugins.renderers.pdf_typst.press", raising=False)
    with pytest.raises(AccessError, match=r"pip install 'zlmreport\[typst\]'"):
        registry().renderer("pdf-typst").render(samples.certificate(standards=0))


def test_printing_needs_neither_matplotlib_nor_weasyprint() -> None:
    program = (
        "import sys; from zlmreport.testing.certificates import sample_certificate;"
        "from zlmreport_plugins.renderers.pdf_typst import TypstRenderer;"
        "TypstRenderer().render(sample_certificate());"
        "print(*{'matplotlib', 'weasyprint', 'jinja2'} & set(sys.modules))"
    )
    done = run(PYTHON, "-c", program, check=True)
    assert done.stdout.split() == []
