"""A PDF by Typst as a file: what it claims, what it carries, and that it depends on nothing else."""

from __future__ import annotations

import sys
from io import BytesIO
from pathlib import Path

import pikepdf
import pytest

from document.typesetting import samples
from installed import registry
from plugins.renderers.pdf_pages import elements, fonts, read, sample
from processes import PYTHON, run
from zlmreport.plugin import AccessError, Language

TESTS = Path(samples.__file__).parents[2]


def test_it_claims_both_standards() -> None:
    packet = sample(press="pdf-typst").trailer["/Root"]["/Metadata"].get_object().get_data().decode()
    assert "<pdfaid:part>3</pdfaid:part><pdfaid:conformance>A</pdfaid:conformance>" in packet
    assert "<pdfuaid:part>1</pdfuaid:part>" in packet


def test_its_dates_are_the_date_of_issue() -> None:
    metadata = sample(press="pdf-typst").metadata
    assert {metadata["/CreationDate"], metadata["/ModDate"]} == {"D:20261120000000Z"}


def test_captions_are_tagged() -> None:
    assert len(list(elements(sample(press="pdf-typst"), "/Caption"))) == 8 + 4


def test_only_the_bundled_typeface_is_used_and_embedded() -> None:
    pages = sample(press="pdf-typst").pages
    names = {str(font["/BaseFont"]).partition("+")[2] for page in pages for font in fonts(page)}
    assert names == {"IBMPlexSans", "IBMPlexSans-Italic", "IBMPlexSans-SmBld"}  # its own name


def test_the_logo_says_whose_it_is() -> None:
    texts = [figure.get("/Alt") for figure in elements(read(samples.with_logo(), "pdf-typst"), "/Figure")]
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
