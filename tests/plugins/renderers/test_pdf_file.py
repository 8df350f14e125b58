"""The PDF by WeasyPrint as a file: what it claims, what it carries, and that it depends on nothing else."""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from datetime import date
from hashlib import md5
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
from pypdf import PdfReader
from weasyprint import HTML

from document.typesetting import samples
from environments import ROOT
from installed import load_job, registry
from pdf_conformance import complaints
from plugins.renderers.pdf_pages import ATTACHED, fonts, read, sample, specifications
from processes import PYTHON, ZLMREPORT, run
from zlmreport import pipeline
from zlmreport.plugin import AccessError, Language
from zlmreport_plugins.renderers.pdf import press

TESTS = Path(samples.__file__).parents[2]


def test_its_dates_are_the_date_of_issue() -> None:
    metadata = sample().metadata
    assert (metadata["/CreationDate"], metadata["/ModDate"]) == ("D:20261120", "D:20261120")


def test_without_a_date_of_issue_it_has_no_dates() -> None:
    metadata = read(samples.certificate(standards=0, issued=None)).metadata
    assert metadata is not None
    assert not {"/CreationDate", "/ModDate"} & set(metadata)


def test_bookmarks_lead_to_sections_tables_and_figures() -> None:
    assert _titles(sample().outline) == [
        "Calibration certificate",
        "1 Test conditions",
        ["Table 1 Requirements of the standard"],
        "2 Results by SAMPLE 1:2026",
        [
            "Table 2 Parameters of the axis",
            "Figure 1 Mean deviations, spread and reversal value of the axis",
            "Figure 2 Mean deviations, spread and reversal value of the axis",
            "Table 3 Definitions",
            "Table 4 Table by position",
        ],
        "3 Results by SAMPLE 1:2026",
        [
            "Table 5 Parameters of the axis",
            "Figure 3 Mean deviations, spread and reversal value of the axis",
            "Figure 4 Mean deviations, spread and reversal value of the axis",
            "Table 6 Definitions",
            "Table 7 Table by position",
        ],
        "4 Readings",
        ["Table 8 Deviations, all readings"],
    ]


def test_every_font_is_embedded_and_of_the_bundled_family() -> None:
    names = set()
    for page in sample().pages:
        for font in fonts(page):
            descendant = font["/DescendantFonts"][0].get_object()
            assert "/FontFile2" in descendant["/FontDescriptor"].get_object()
            names.add(str(font["/BaseFont"]).partition("+")[2].replace("-", ""))
    assert names == {"IBMPlexSans", "IBMPlexSansItalic", "IBMPlexSansSemiBold"}


def test_the_logo_is_printed() -> None:
    reader = read(samples.with_logo())
    assert [image.image.size for image in reader.pages[0].images if image.image] == [(30, 10)]


_WATCHED = """
import sys
opened = []
from document.typesetting import samples
from zlmreport_plugins.renderers.pdf import PdfRenderer, press
customer = "<img src='file:///etc/passwd'> <link href='http://example.com/'>"
PdfRenderer().render(samples.certificate(standards=1))
sys.addaudithook(lambda event, arguments: opened.append((event, str(arguments[0])))
    if event in {"open", "socket.connect", "socket.getaddrinfo", "urllib.Request"} else None)
PdfRenderer().render(samples.certificate(standards=1, customer=customer))
print([entry for entry in opened if not entry[1].startswith((sys.base_prefix, sys.prefix))])
"""


def test_each_element_looks_as_by_the_style_sheet_of_weasyprint_which_is_left_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    certificate = samples.certificate()
    pdf = press.find_press().print(certificate)
    ours = press.style_sheet
    monkeypatch.setattr(
        press,
        "style_sheet",
        lambda *names, **look: ours(*(each for each in names if each != "elements"), **look),
    )
    monkeypatch.setattr(press._Document, "_ua_stylesheets", HTML._ua_stylesheets)
    assert press.Press().print(certificate) == pdf


def test_fonts_that_were_unpacked_to_print_go_with_the_program(tmp_path: Path) -> None:
    """A machine that prints each night has no more files each morning."""
    (tmp_path / "temporary").mkdir()
    run(*ZLMREPORT, "init", tmp_path / "job", check=True)
    settings = os.environ | {"TMPDIR": str(tmp_path / "temporary")}
    run(*ZLMREPORT, tmp_path / "job" / "job.yaml", "--format", "pdf", env=settings, check=True)
    assert list((tmp_path / "temporary").iterdir()) == []


@pytest.mark.long
def test_it_opens_no_file() -> None:
    watched = run(PYTHON, "-c", _WATCHED, env={**os.environ, "PYTHONPATH": str(TESTS)}, check=True)
    assert watched.stdout == "[]\n"


def test_without_pango_the_user_is_told_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "zlmreport_plugins.renderers.pdf.press", None)
    with pytest.raises(AccessError, match=r"WeasyPrint cannot be loaded.*Pango.*apt-get install"):
        registry().renderer("pdf").render(samples.certificate(standards=0))


def _titles(outline: list[Any]) -> list[Any]:
    return [_titles(entry) if isinstance(entry, list) else entry.title for entry in outline]


def test_the_file_opens_without_a_complaint() -> None:
    PdfReader(BytesIO(registry().renderer("pdf").render(samples.certificate(standards=0))), strict=True)


@pytest.mark.long
def test_a_certificate_with_a_diagnosis_conforms() -> None:
    loaded = load_job(Path(ROOT, "configs", "hidden-effect", "job.yaml"), formats=("pdf",))
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
    assert (metadata.dc_identifier, metadata.dc_language) == ("CAL-2026-0117", ["de"])


def test_metadata_can_be_read_without_unpacking_the_file() -> None:
    content = registry().renderer("pdf").render(samples.certificate(standards=0))
    assert b"<pdfuaid:part>1</pdfuaid:part>" in content


def test_viewers_show_the_title_and_walk_in_the_order_of_the_structure() -> None:
    reader: PdfReader = sample()
    assert reader.trailer["/Root"]["/ViewerPreferences"]["/DisplayDocTitle"].value is True
    assert {page["/Tabs"] for page in reader.pages} == {"/S"}


def printed(issued: date | None = date(2026, 11, 20)) -> PdfReader:
    return read(replace(samples.certificate(standards=0), attachments=ATTACHED, issued=issued))


@pytest.fixture(scope="module")
def reader() -> PdfReader:
    return printed()


def test_a_file_has_its_size_and_checksum(reader: PdfReader) -> None:
    parameters = specifications(reader)["job.yaml"]["/EF"]["/F"]["/Params"]
    assert parameters["/Size"] == len(b"axis: {}\n")
    assert parameters["/CheckSum"].original_bytes == md5(b"axis: {}\n", usedforsecurity=False).digest()


@pytest.mark.parametrize(
    ("issued", "moment"), [(date(2026, 11, 20), "D:20261120000000Z"), (None, "D:19700101000000Z")]
)
def test_dates_of_files_come_from_the_certificate_and_not_from_the_clock(
    issued: date | None, moment: str
) -> None:
    for entry in specifications(printed(issued)).values():
        parameters = entry["/EF"]["/F"]["/Params"]
        assert (parameters["/CreationDate"], parameters["/ModDate"]) == (moment, moment)


def test_without_files_there_is_no_list_of_them() -> None:
    reader = read(samples.certificate(standards=0))
    assert "/AF" not in reader.root_object
    assert "/EmbeddedFiles" not in reader.root_object.get("/Names", {})
