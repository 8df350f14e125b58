"""What other readers see: the same of a sound file, and something else of one that has two faces."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from verification.altering import rewritten
from verification.forgeries import plain
from verification.issued import altered
from verification.raw_forgeries import boxed, other_readings, together
from verification.test_trust import signed
from zlmreport.plugin import Place
from zlmreport.verification import readers
from zlmreport.verification.carrier import open_pdf
from zlmreport.verification.findings import VerificationVerdict
from zlmreport.verification.readers import (
    READERS,
    Reader,
    Seen,
    digest_attachments_of,
    find_differences,
    read_as_seen_by,
)


def told(pdf: bytes) -> list[str]:
    """Return what any reader sees otherwise than pypdf takes out."""
    carrier = open_pdf(pdf, Place("certificate.pdf"))
    return list(find_differences(pdf, digest_attachments_of(carrier), len(carrier.reader.pages)))


@pytest.mark.long
@pytest.mark.parametrize("printed", ["issued", "by_typst"])
def test_all_see_the_same_of_a_sound_file(
    printed: str, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    pdf: bytes = request.getfixturevalue(printed)
    for saved in (
        pdf,
        plain(pdf),
        rewritten(pdf, lambda _: None),
        altered(pdf, lambda _: None),
        signed(pdf, tmp_path),
    ):
        assert told(saved) == []


def test_three_of_other_makers_are_always_asked() -> None:
    assert [each.name for each in READERS if not each.command] == ["pypdf", "PDFium", "qpdf"]


def test_a_reader_that_does_not_end_leaves_it_open(issued: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    def see(_content: bytes) -> Seen:
        raise subprocess.TimeoutExpired(("pdftotext", "-q"), 60.0)

    monkeypatch.setattr(readers, "READERS", (Reader("Poppler", see),))
    carrier = open_pdf(issued, Place("certificate.pdf"))
    found = readers.compare(carrier, issued, is_drawn_alike=True)
    assert found.verdict is VerificationVerdict.OPEN
    assert found.detail == "pdftotext did not end within 60 s; verify it once more"


@pytest.mark.parametrize("name", ["PDFium", "qpdf"])
def test_a_second_copy_of_each_object_is_seen_where_the_file_is_put_together_anew(
    name: str, issued: bytes
) -> None:
    """This is how one file has two faces: the strict reading of its bytes refuses it before that."""
    faces = together(plain(issued), b"".join(boxed(issued).values()))
    assert any(each.startswith(f"{name} sees other pages where") for each in told(faces))


def test_other_readings_behind_the_table_are_seen(issued: bytes) -> None:
    faces = together(plain(issued), other_readings(issued)[1])
    assert any("takes out other attachments where" in each for each in told(faces))


def test_a_reader_that_cannot_open_a_file_sees_nothing() -> None:
    assert all(read_as_seen_by(each, b"%PDF-1.7\nnothing") is None for each in READERS if each.is_here)


def test_what_is_not_installed_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    missing = Reader("Other", lambda _: pytest.fail("is not asked"), "zlmreport-no-such-program")
    monkeypatch.setattr(readers, "READERS", (missing,))
    assert readers.name_absent() == ("Other",)
    assert list(find_differences(b"", (), 0)) == []
