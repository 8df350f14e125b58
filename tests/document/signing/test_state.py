"""Every change of a signed file is found."""

from __future__ import annotations

import sys
from datetime import UTC, datetime, timedelta
from io import BytesIO

import pikepdf
import pytest

from document.signing.conftest import PLACE
from document.signing.keys import NAME, PASSWORD, certificate_of, elliptic, pkcs12_file
from zlmreport.document.signing.signer import open_signer
from zlmreport.document.signing.state import Integrity, SignatureState, read_signature_state


def test_an_unsigned_file_is_unsigned(unsigned: bytes) -> None:
    assert read_signature_state(unsigned) == SignatureState(Integrity.UNSIGNED)


def test_a_signed_file_is_intact_and_tells_who_signed_it_and_when(signed: bytes) -> None:
    state = read_signature_state(signed)
    assert (state.integrity, state.reason) == (Integrity.INTACT, "")
    (signature,) = state.signatures
    assert signature.signer == f"Common Name: {NAME}"
    assert signature.holds
    assert signature.covers_file
    assert signature.time is not None
    assert abs(signature.time - datetime.now(UTC)) < timedelta(hours=1)


def test_the_fingerprint_is_that_of_the_certificate(unsigned: bytes, tmp_path) -> None:
    from cryptography.hazmat.primitives.hashes import SHA256

    certificate = certificate_of(elliptic())
    file = pkcs12_file(tmp_path / "laboratory.p12", certificate=certificate)
    with open_signer(str(file), lambda _: PASSWORD, PLACE) as signer:
        (signature,) = read_signature_state(signer(unsigned, "signature")).signatures
    assert signature.fingerprint == certificate.fingerprint(SHA256()).hex()


@pytest.mark.parametrize("where", [0.02, 0.1, 0.3, 0.5, 0.7, 0.9])
def test_one_bit_anywhere_in_what_was_signed_is_found(unsigned: bytes, signed: bytes, where: float) -> None:
    place = int(where * len(unsigned))
    altered = bytearray(signed)
    altered[place] ^= 1
    assert read_signature_state(bytes(altered)).integrity is Integrity.ALTERED


def test_a_signature_that_is_not_the_keys_is_found(signed: bytes) -> None:
    start = signed.rindex(b"/Contents <") + len(b"/Contents <")
    end = start + len(signed[start:].split(b">")[0].rstrip(b"0")) - 8
    altered = bytearray(signed)
    altered[end : end + 2] = b"00" if altered[end : end + 2] != b"00" else b"11"
    assert read_signature_state(bytes(altered)).integrity is Integrity.ALTERED


@pytest.mark.parametrize("where", [0, 2, 8])
def test_a_signature_of_which_a_byte_was_changed_is_told_so_in_few_words(signed: bytes, where: int) -> None:
    """Whoever verifies knows no ASN.1; what the library says of it is cut short."""
    place = signed.rindex(b"/Contents <") + len(b"/Contents <") + where
    altered = signed[:place] + (b"00" if signed[place : place + 2] != b"00" else b"11") + signed[place + 2 :]
    state = read_signature_state(altered)
    assert state.integrity is Integrity.ALTERED
    assert state.reason.startswith("its signature cannot be read: its bytes were changed, or are damaged (")
    assert len(state.reason) < 150


def test_what_no_key_signs_of_a_signature_is_as_it_is_written(signed: bytes) -> None:
    """The version and the list of algorithms stand before what is signed; libraries read them, and go on."""
    start = signed.rindex(b"/Contents <") + len(b"/Contents <")
    version = signed.index(b"02010131", start)
    content = signed.index(b"06092A864886F70D010701", start)  # id-data
    parameters = signed.index(b"0500A0", start)  # of the signer's digest, before what is signed
    for place in (*range(version, content), *range(parameters, parameters + 4)):
        altered = bytearray(signed)
        altered[place : place + 1] = b"%x" % (int(chr(altered[place]), 16) ^ 1)
        assert read_signature_state(bytes(altered)).integrity is Integrity.ALTERED, place - start


def test_nothing_hides_in_the_room_behind_a_signature(signed: bytes) -> None:
    start = signed.rindex(b"/Contents <")
    end = signed.index(b">", start)
    for altered in (
        signed[: end - 2] + b"01" + signed[end:],
        signed[: end - 200] + b"ab" * 100 + signed[end:],
    ):
        assert read_signature_state(altered).integrity is Integrity.ALTERED


def test_a_page_added_after_signing_is_found(signed: bytes) -> None:
    from pyhanko.pdf_utils.generic import NameObject, pdf_name
    from pyhanko.pdf_utils.incremental_writer import IncrementalPdfFileWriter

    writer = IncrementalPdfFileWriter(BytesIO(signed))
    writer.root[pdf_name("/PageMode")] = NameObject("/UseOutlines")
    writer.update_root()
    extended = BytesIO()
    writer.write(extended)
    state = read_signature_state(extended.getvalue())
    assert state.integrity is Integrity.ALTERED
    assert state.reason.startswith("something was added after it was signed: the catalog's /PageMode")
    assert state.signatures[0].holds


def test_a_file_written_anew_after_signing_is_found(signed: bytes) -> None:
    rewritten = BytesIO()
    with pikepdf.open(BytesIO(signed)) as pdf:
        pdf.save(rewritten)
    assert read_signature_state(rewritten.getvalue()).integrity is Integrity.ALTERED


@pytest.mark.parametrize("kept", [0.5, 0.99])
def test_a_truncated_file_is_altered_or_unsigned_but_never_intact(signed: bytes, kept: float) -> None:
    assert read_signature_state(signed[: int(kept * len(signed))]).integrity is not Integrity.INTACT


@pytest.mark.parametrize(
    "content", [b"", b"/ByteRange", b"%PDF-1.7\n/ByteRange [0 1 2 3]\n%%EOF\n", b"\0" * 100 + b"/ByteRange"]
)
def test_what_is_no_pdf_is_never_intact(content: bytes) -> None:
    assert read_signature_state(content).integrity in {Integrity.UNSIGNED, Integrity.ALTERED}


def test_without_pyhanko_a_signature_is_seen_and_not_judged(
    signed: bytes, unsigned: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pyhanko.pdf_utils.reader", None)
    assert read_signature_state(signed).integrity is Integrity.UNCHECKED
    assert "zlmreport[sign]" in read_signature_state(signed).reason
    assert read_signature_state(unsigned).integrity is Integrity.UNSIGNED
