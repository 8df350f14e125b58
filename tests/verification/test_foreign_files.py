"""A file that anyone sent is opened without trust: within bounds, and without reading anything else."""

from __future__ import annotations

import contextlib
import gzip
import sys
import zlib
from base64 import encodebytes
from collections.abc import Callable
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest
from fontTools.ttLib import TTFont
from fontTools.ttLib.tables._g_l_y_f import Glyph, GlyphComponent
from pikepdf import Array, Pdf
from pypdf import PdfReader, PdfWriter
from pypdf.generic import ArrayObject, DictionaryObject, EncodedStreamObject, NameObject, TextStringObject

from installed import registry
from refusals import refused
from verification.altering import descendant, every_font, rewritten, with_program
from verification.issued import JOB, altered, content_of, specification, with_results, with_source
from zlmreport.plugin import AccessError, InputError
from zlmreport.plugin.registry import DISABLE, find_plugins
from zlmreport.verification.findings import CheckedCertificate
from zlmreport.verification.verify import verify

Verify = Callable[[bytes], CheckedCertificate]
SECRET = "secret-of-this-machine"


def blank(change: Callable[[PdfWriter], None] = lambda _: None) -> bytes:
    """Return a PDF of one empty page."""
    writer = PdfWriter()
    writer.add_blank_page(100, 100)
    change(writer)
    saved = BytesIO()
    writer.write(saved)
    return saved.getvalue()


def refusal(verified: Verify, pdf: bytes) -> str:
    (problem,) = refused(verified, pdf).problems
    assert Path(problem.place.file).name == "certificate.pdf"
    return problem.message


def test_a_foreign_pdf_is_no_certificate(verified: Verify) -> None:
    said = refusal(verified, blank())
    assert "is no certificate of zlmreport" in said
    assert "printed to PDF, scanned, split or joined" in said


def test_a_foreign_pdf_with_attachments_is_no_certificate(verified: Verify) -> None:
    pdf = blank(lambda writer: writer.add_attachment("data.json", b'{"schema": "other/1"}'))
    assert "is no certificate of zlmreport" in refusal(verified, pdf)


def put_together(program: TTFont) -> None:
    """Let each glyph consist of the one before it, twice: nobody counts the parts of the last."""
    names = program.getGlyphOrder()
    for part, name in pairwise(names):
        made = Glyph()
        made.numberOfContours = -1
        made.components = [GlyphComponent(), GlyphComponent()]
        for each in made.components:
            each.glyphName, each.flags, each.x, each.y = part, 0x0003, 0, 0
        program["glyf"][name] = made


def list_endless_widths(opened: Pdf) -> None:
    for font in every_font(opened):
        descendant(font).W = Array([-(2**31), 65_535, 500])


def test_a_font_that_lists_widths_without_end_is_refused(issued: bytes, verified: Verify) -> None:
    assert "widths are listed as in no certificate" in refusal(
        verified, rewritten(issued, list_endless_widths)
    )


def test_glyphs_of_parts_without_end_are_no_glyphs_of_the_certificate(
    issued: bytes, verified: Verify
) -> None:
    def change(opened: Pdf) -> None:
        for font in every_font(opened):
            with_program(font, put_together)

    found = verified(rewritten(issued, change))
    assert "its fonts differ" in [each.detail for each in found.pages]


def test_an_encrypted_pdf_is_refused(issued: bytes, verified: Verify) -> None:
    pdf = altered(issued, lambda writer: writer.encrypt("password", algorithm="RC4-128"))
    said = refusal(verified, pdf)
    assert "is encrypted" in said
    assert "qpdf --decrypt" in said


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9, 0.99])
def test_a_truncated_file_never_holds(issued: bytes, verified: Verify, share: float) -> None:
    with contextlib.suppress(InputError):
        assert not verified(issued[: int(share * len(issued))]).holds


@pytest.mark.parametrize("content", [b"", b"text", b"PK\x03\x04", b"\x89PNG\r\n\x1a\n"])
def test_what_is_no_pdf_is_refused(verified: Verify, content: bytes) -> None:
    assert "is no PDF" in refusal(verified, content)


def _zipped(pdf: bytes) -> bytes:
    packed = BytesIO()
    with ZipFile(packed, "w") as archive:
        archive.writestr("certificate.pdf", pdf)
    return packed.getvalue()


@pytest.mark.parametrize(
    ("sent", "said"),
    [
        (_zipped, "is no PDF, but a ZIP archive: take the certificate out of it, and verify that"),
        (gzip.compress, "is no PDF, but a file packed by gzip: unpack it, and verify that"),
        (encodebytes, "is no PDF, but a mail or a part of one: save the attachment in it"),
        (lambda pdf: b"From: a@b.example\n\n" + encodebytes(pdf), "is no PDF, but a mail or a part of one"),
        (lambda _: b"\x78\x9f\x3e\x22" + bytes(40), "is no PDF, but the winmail.dat of a mail: ask for"),
        (lambda _: b"<!DOCTYPE html><p>502 Bad Gateway", "is no PDF, but a page in HTML: get the PDF itself"),
        (lambda pdf: b"\n" * 7 + pdf, "7 bytes stand before the PDF, such as the head of a mail; save the"),
        (lambda pdf: pdf.replace(b"\n", b"\r\n"), "it was sent as text, with other ends of lines; get it"),
        (lambda pdf: bytes(each & 127 for each in pdf), "keeps seven bits of each byte; get it again, as a"),
        (lambda pdf: pdf[: len(pdf) // 2], "its end is missing; get it again"),
    ],
    ids=["zip", "gzip", "base64", "mail", "winmail", "page", "head", "text", "seven bits", "half"],
)
def test_what_a_mail_or_a_transfer_made_of_a_certificate_is_told(
    sent: Callable[[bytes], bytes], said: str, issued: bytes, verified: Verify
) -> None:
    assert said in refusal(verified, sent(issued))


@pytest.mark.parametrize("content", [b"%PDF-1.7\n", b"%PDF-1.7\n1 0 obj\n<<", b"%PDF-1.7\n" + b"[" * 100_000])
def test_a_damaged_pdf_is_refused(verified: Verify, content: bytes) -> None:
    assert "is damaged" in refusal(verified, content)


def test_pages_that_hold_themselves_are_refused(verified: Verify) -> None:
    def circle(writer: PdfWriter) -> None:
        pages = writer.root_object["/Pages"]
        pages[NameObject("/Kids")] = ArrayObject([pages.indirect_reference])

    assert "is damaged" in refusal(verified, blank(circle))


def test_a_page_whose_stream_is_damaged_is_refused(issued: bytes, verified: Verify) -> None:
    def damage(writer: PdfWriter) -> None:
        stream = writer.pages[0]["/Contents"].get_object()
        stream._data = stream._data[:-20]

    assert "is damaged, and cannot be read as a certificate: a stream" in refusal(
        verified, altered(issued, damage)
    )


def test_nothing_that_a_damaged_file_brings_about_is_printed(
    issued: bytes, verified: Verify, capfd: pytest.CaptureFixture[str]
) -> None:
    with contextlib.suppress(InputError):
        verified(issued[: len(issued) // 2])
    assert capfd.readouterr() == ("", "")


def test_a_file_that_is_not_there_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(AccessError, match=r"none\.pdf: cannot be read: no such file"):
        verify(tmp_path / "none.pdf", registry())


def test_a_folder_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(AccessError, match="cannot be read: it is a folder"):
        verify(tmp_path, registry())


def test_an_attachment_that_unpacks_without_end_is_refused(verified: Verify) -> None:
    def bomb(writer: PdfWriter) -> None:
        writer.add_attachment("zeros", b"")
        stream = EncodedStreamObject()
        stream._data = zlib.compress(bytes(200 * 1024 * 1024), 9)
        stream[NameObject("/Filter")] = NameObject("/FlateDecode")
        specification(writer, "zeros")["/EF"][NameObject("/F")] = writer._add_object(stream)

    assert "files of more than 64 MiB in all" in refusal(verified, blank(bomb))


def test_attachments_that_are_too_large_together_are_refused(verified: Verify) -> None:
    def large(writer: PdfWriter) -> None:
        for number in range(3):
            writer.add_attachment(f"zeros-{number}", b"")
            stream = EncodedStreamObject()
            stream._data = zlib.compress(bytes(30 * 1024 * 1024), 9)
            stream[NameObject("/Filter")] = NameObject("/FlateDecode")
            specification(writer, f"zeros-{number}")["/EF"][NameObject("/F")] = writer._add_object(stream)

    assert "files of more than 64 MiB in all" in refusal(verified, blank(large))


def test_more_than_64_attachments_are_refused(verified: Verify) -> None:
    def many(writer: PdfWriter) -> None:
        for number in range(65):
            writer.add_attachment(f"{number:02}.txt", b"")

    assert "more than 64 files" in refusal(verified, blank(many))


def test_a_list_of_attachments_that_holds_itself_is_refused(verified: Verify) -> None:
    def circle(writer: PdfWriter) -> None:
        node = DictionaryObject()
        reference = writer._add_object(node)
        node[NameObject("/Kids")] = ArrayObject([reference])
        names = DictionaryObject({NameObject("/EmbeddedFiles"): reference})
        writer.root_object[NameObject("/Names")] = names

    assert "without end" in refusal(verified, blank(circle))


@pytest.mark.parametrize(
    "name", ["../job.yaml", "/etc/job.yaml", "a\\b.yaml", "..", "", "a\nb", "x" * 300, "\u202elmay.boj"]
)
def test_an_attachment_whose_name_is_a_path_or_cannot_be_seen_is_refused(verified: Verify, name: str) -> None:
    def attach(writer: PdfWriter) -> None:
        writer.add_attachment("plain", b"")
        entry = specification(writer, "plain")
        entry[NameObject("/UF")] = entry[NameObject("/F")] = TextStringObject(name)

    assert "whose name is none" in refusal(verified, blank(attach))


def test_two_attachments_of_one_name_are_refused(verified: Verify) -> None:
    def attach(writer: PdfWriter) -> None:
        writer.add_attachment("same", b"1")
        writer.add_attachment("other", b"2")
        entry = specification(writer, "other")
        entry[NameObject("/F")] = entry[NameObject("/UF")] = TextStringObject("same")

    assert "two files of the name 'same'" in refusal(verified, blank(attach))


@pytest.mark.parametrize("levels", [0, 12])
def test_a_job_inside_a_pdf_reads_no_other_file(
    issued: bytes, verified: Verify, tmp_path: Path, levels: int
) -> None:
    secret = tmp_path / "secret.csv"
    secret.write_text(f"{SECRET},1\n")
    named = str(secret) if not levels else "../" * levels + str(secret).lstrip("/")
    job = JOB.replace("file: x-axis.csv", f"file: {named}").encode()
    opened: list[str] = []
    listening = True

    def listen(event: str, arguments: tuple[object, ...]) -> None:
        if listening and event == "open":
            opened.append(str(arguments[0]))

    sys.addaudithook(listen)
    with pytest.raises(AccessError) as refused:
        verified(with_source(issued, "job.yaml", job))
    listening = False
    assert not [path for path in opened if path.endswith("secret.csv") and "not attached" not in path]
    assert SECRET not in str(refused.value)
    assert "secret.csv: cannot be read: there is no such file" in str(refused.value)


@pytest.mark.parametrize("name", ["/etc/passwd", "../../../../../../../../etc/passwd"])
def test_a_job_inside_a_pdf_extends_no_other_file(issued: bytes, verified: Verify, name: str) -> None:
    job = JOB.replace("extends: ../laboratory.yaml", f"extends: {name}").encode()
    with pytest.raises(InputError, match="passwd' is no YAML file") as refused:
        verified(with_source(issued, "job.yaml", job))
    assert "root" not in str(refused.value)


def test_a_job_inside_a_pdf_extends_no_file_of_the_same_kind_outside(
    issued: bytes, verified: Verify, tmp_path: Path
) -> None:
    secret = tmp_path / "secret.yaml"
    secret.write_text(SECRET, encoding="utf-8")
    job = JOB.replace("extends: ../laboratory.yaml", f"extends: {secret}").encode()
    with pytest.raises(AccessError, match=r"secret\.yaml cannot be read: no such file") as refused:
        verified(with_source(issued, "job.yaml", job))
    assert SECRET not in str(refused.value)


def test_a_job_inside_a_pdf_writes_nothing(
    issued: bytes, verified: Verify, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    verified(issued)
    assert [path.name for path in tmp_path.iterdir()] == ["certificate.pdf"]


def test_problems_with_an_attached_file_name_it_and_not_where_it_was_unpacked(
    issued: bytes, verified: Verify
) -> None:
    readings = content_of(issued, "x-axis.csv").replace(b"2.9", b"much")
    (problem,) = refused(verified, with_source(issued, "x-axis.csv", readings)).problems
    assert str(problem).startswith("certificate.pdf: x-axis.csv:4:9: ")


@pytest.mark.parametrize("path", ["", "..", "/", "a\0b.yaml", "\ud800.yaml", "x" * 400, "../" * 5000])
def test_a_job_whose_stated_path_is_none_is_told_from_the_job(
    issued: bytes, verified: Verify, path: str
) -> None:
    def state(results: dict[str, Any]) -> None:
        results["provenance"]["sources"][0]["path"] = path

    with contextlib.suppress(AccessError):  # the laboratory is not found from there
        assert not verified(with_results(issued, state)).holds


@pytest.mark.long
def test_results_that_are_nested_without_end_are_refused(issued: bytes, verified: Verify) -> None:
    nested: Any = 1.0
    for _ in range(900):
        nested = [nested]

    def nest(results: dict[str, Any]) -> None:
        results["evaluations"][0]["parameters"][0]["value"] = nested

    with contextlib.suppress(InputError):
        assert not verified(with_results(issued, nest)).holds


def test_a_yaml_bomb_inside_a_pdf_is_refused(issued: bytes, verified: Verify) -> None:
    bomb = b"a: &a [x, x, x, x, x, x, x, x, x]\n" + b"".join(
        b"%c: &%c [%s]\n" % (c + 1, c + 1, b", ".join([b"*%c" % c] * 9)) for c in range(ord("a"), ord("k"))
    )
    with pytest.raises(InputError):
        verified(with_source(issued, "job.yaml", JOB.encode() + bomb))


def test_forms_that_draw_one_another_without_end_are_not_read(issued: bytes, verified: Verify) -> None:
    def nest(writer: PdfWriter) -> None:
        drawn = None
        for _ in range(30):
            form = EncodedStreamObject()
            form._data = b"/X Do " * 10 if drawn else b"BT ET"
            form.update(
                {NameObject("/Type"): NameObject("/XObject"), NameObject("/Subtype"): NameObject("/Form")}
            )
            if drawn:
                objects = DictionaryObject({NameObject("/X"): drawn})
                form[NameObject("/Resources")] = DictionaryObject({NameObject("/XObject"): objects})
            drawn = writer._add_object(form)
        page = writer.pages[1]
        page["/Resources"].get_object()["/XObject"].get_object()[NameObject("/X")] = drawn
        stream = page["/Contents"].get_object()
        stream.set_data(stream.get_data() + b"\n/X Do\n")

    found = verified(altered(issued, nest))
    assert not found.holds


def test_a_signed_copy_of_the_pages_alone_is_no_certificate(issued: bytes, verified: Verify) -> None:
    def without_creator(writer: PdfWriter) -> None:
        for page in PdfReader(BytesIO(issued)).pages:
            writer.add_page(page)

    assert "is no certificate of zlmreport" in refusal(verified, blank(without_creator))


@pytest.mark.parametrize("identifier", ["json", "pdf"])
def test_without_a_plugin_that_it_needs_a_verification_says_so(
    issued: bytes, tmp_path: Path, identifier: str
) -> None:
    (tmp_path / "certificate.pdf").write_bytes(issued)
    with pytest.raises(InputError, match=f"no plugin provides format '{identifier}'"):
        verify(tmp_path / "certificate.pdf", find_plugins({DISABLE: identifier}))


def test_a_place_in_what_a_certificate_carries_is_told_with_its_name(issued: bytes, tmp_path: Path) -> None:
    (tmp_path / "certificate.pdf").write_bytes(issued)
    with pytest.raises(InputError, match=r"certificate\.pdf: \S+\.yaml:\d+:\d+: no plugin provides"):
        verify(tmp_path / "certificate.pdf", find_plugins({DISABLE: "laser-csv"}))


def test_a_plugin_that_breaks_is_named_and_ends_nothing_with_a_traceback(
    issued: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object) -> None:
        raise ZeroDivisionError("in a plugin")

    monkeypatch.setattr("zlmreport.pipeline.compose", broken)
    (tmp_path / "certificate.pdf").write_bytes(issued)
    with pytest.raises(InputError, match="cannot be evaluated again: ZeroDivisionError: in a plugin"):
        verify(tmp_path / "certificate.pdf", registry())
