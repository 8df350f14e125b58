"""The checker of PDFs finds what is wrong, and nothing else."""

from __future__ import annotations

from io import BytesIO

import pikepdf
import pytest

from document.typesetting import samples
from installed import registry
from pdf_conformance import complaints


@pytest.fixture(scope="module")
def sound() -> bytes:
    return registry().renderer("pdf").render(samples.certificate(standards=0))


def _with_stream(sound: bytes, content: bytes) -> bytes:
    """Return a file with one more stream, uncompressed."""
    with pikepdf.open(BytesIO(sound)) as pdf:
        pdf.Root["/ZlmStream"] = pdf.make_indirect(pikepdf.Stream(pdf, content))
        saved = BytesIO()
        pdf.save(saved, compress_streams=False, object_stream_mode=pikepdf.ObjectStreamMode.preserve)
    return saved.getvalue()


def test_a_stream_that_ends_in_the_byte_of_a_return_is_in_order(sound: bytes) -> None:
    assert complaints(_with_stream(sound, b"123456\r")) == []


def test_a_stream_that_is_longer_than_it_says_is_found(sound: bytes) -> None:
    content = _with_stream(sound, b"123456\r")
    assert content.count(b"/Length 7 ") == 1
    assert complaints(content.replace(b"/Length 7 ", b"/Length 3 "))


def test_a_claim_that_is_missing_is_found(sound: bytes) -> None:
    claim = b"<pdfuaid:part>1</pdfuaid:part>"
    assert sound.count(claim) == 1
    found = complaints(sound.replace(claim, b" " * len(claim)))
    assert any(complaint.startswith("PDFUA1-ID-PART") for complaint in found)


def test_a_damaged_file_is_found(sound: bytes) -> None:
    start = sound.index(b"stream\n") + 100
    damaged = sound[:start] + b"\0" * 100 + sound[start + 100 :]
    assert any(complaint.startswith("qpdf: ") for complaint in complaints(damaged))
