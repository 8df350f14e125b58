"""A signature with a time stamp tells later, without a network, when it was made and whether it was valid."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from datetime import timedelta
from io import BytesIO
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from cryptography.hazmat.primitives.serialization import Encoding
from pyhanko.pdf_utils.generic import ArrayObject, DictionaryObject, NumberObject, TextStringObject, pdf_name
from pyhanko.pdf_utils.incremental_writer import IncrementalPdfFileWriter
from pyhanko_certvalidator import ValidationContext

from document.signing.authority import Authority, authority
from document.signing.conftest import PLACE
from document.signing.keys import PASSWORD, certificate_of, elliptic, pkcs12_file
from pdf_conformance import complaints
from zlmreport.document.signing.signer import open_signer
from zlmreport.document.signing.state import (
    Integrity,
    _Trust,
    read_signature_state,
    read_trusted_certificates,
)
from zlmreport.plugin import AccessError


@pytest.fixture(scope="module")
def own() -> Iterator[Authority]:
    with authority() as one:
        yield one


def roots(of: Authority, folder: Path) -> tuple[Any, ...]:
    file = folder / "authority.pem"
    file.write_bytes(of.certificate.public_bytes(Encoding.PEM))
    return read_trusted_certificates(file, PLACE)


def signed_by(own: Authority, pdf: bytes, folder: Path, authorities: tuple[Any, ...]) -> bytes:
    file = pkcs12_file(folder / "laboratory.p12", certificate=own.issued())
    with open_signer(str(file), lambda _: PASSWORD, PLACE, authorities) as signer:
        return signer(pdf, "Electronic signature", own.address)


@pytest.fixture(scope="module")
def stamped(own: Authority, unsigned: bytes, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    folder = tmp_path_factory.mktemp("stamped")
    return signed_by(own, unsigned, folder, roots(own, folder))


def test_the_time_is_the_stamps_and_trusted_if_its_authority_is(
    stamped: bytes, own: Authority, tmp_path: Path
) -> None:
    state = read_signature_state(stamped, roots(own, tmp_path))
    assert (state.integrity, state.is_trusted, state.is_time_trusted) == (Integrity.INTACT, True, True)
    signature, kept = state.signatures
    assert (signature.time, signature.stamped_by) == (own.now, "Common Name: Test Clock")
    assert signature.is_time_trusted
    assert (kept.is_stamp, kept.covers_file, kept.time) == (True, True, own.now)


def test_without_trust_the_stamp_is_intact_and_no_more(stamped: bytes) -> None:
    state = read_signature_state(stamped)
    assert (state.integrity, state.is_trusted) == (Integrity.INTACT, False)
    assert [each.is_time_trusted for each in state.signatures] == [False, False]


def test_a_stamp_of_another_authority_is_not_trusted(stamped: bytes, tmp_path: Path) -> None:
    with authority() as other:
        state = read_signature_state(stamped, roots(other, tmp_path))
    assert (state.integrity, state.is_trusted) == (Integrity.INTACT, False)


def test_a_stamped_certificate_still_is_for_archives_and_for_everybody(
    stamped: bytes, unsigned: bytes
) -> None:
    """The checker knows no second revision, which every level above B-B has."""
    assert stamped.startswith(unsigned)
    (one,) = complaints(stamped)
    assert one.startswith("PDFA3A-SIGNATURE-BYTERANGE-001")


def test_a_stamp_that_is_altered_is_found(stamped: bytes) -> None:
    place = stamped.rindex(b"/DocTimeStamp")
    altered = bytearray(stamped)
    altered[place - 40] ^= 1
    assert read_signature_state(bytes(altered)).integrity is Integrity.ALTERED


def test_a_certificate_that_is_revoked_signs_nothing(unsigned: bytes, tmp_path: Path) -> None:
    with authority() as own:
        own.revoked[2] = own.now - timedelta(hours=2)
        with pytest.raises(AccessError, match=r"certificate\.signature\.timestamp: .*revoked"):
            signed_by(own, unsigned, tmp_path, roots(own, tmp_path))


def test_what_was_revoked_later_was_valid_when_it_signed(own: Authority, tmp_path: Path) -> None:
    from asn1crypto import crl, x509

    signer = x509.Certificate.load(own.issued().public_bytes(Encoding.DER))
    trusted = roots(own, tmp_path)
    own.revoked[2] = own.now - timedelta(days=2)
    listed = [crl.CertificateList.load(own.revocations())]
    own.revoked.clear()
    kept = SimpleNamespace(as_validation_context=lambda settings: ValidationContext(**settings, crls=listed))
    trust = _Trust(trusted, kept, ())
    assert trust.say_against(signer, own.now - timedelta(days=3)) == ""
    assert trust.say_against(signer, own.now - timedelta(days=1)).startswith(
        "its certificate was revoked on 20"
    )


def test_a_service_that_does_not_answer_is_named(unsigned: bytes, tmp_path: Path) -> None:
    with authority() as own:
        own.is_broken = True
        with pytest.raises(AccessError, match=f"with a time stamp of {own.address} no signature"):
            signed_by(own, unsigned, tmp_path, roots(own, tmp_path))


def test_a_certificate_without_its_authority_cannot_be_kept(
    own: Authority, unsigned: bytes, tmp_path: Path
) -> None:
    with authority() as other:
        file = pkcs12_file(tmp_path / "laboratory.p12", certificate=other.issued())
        with (
            open_signer(str(file), lambda _: PASSWORD, PLACE) as signer,
            pytest.raises(AccessError, match="no signature could be kept"),
        ):
            signer(unsigned, "Electronic signature", own.address)


def _catalog(writer: Any) -> None:
    writer.root[pdf_name("/PageMode")] = pdf_name("/UseOutlines")
    writer.update_root()


def _annotation(writer: Any) -> None:
    page = writer.root["/Pages"]["/Kids"][0]
    corners = ArrayObject(map(NumberObject, (0, 0, 100, 100)))
    stamp = {"/Type": pdf_name("/Annot"), "/Subtype": pdf_name("/Stamp"), "/Rect": corners}
    added = writer.add_object(DictionaryObject({pdf_name(key): value for key, value in stamp.items()}))
    page["/Annots"].append(added)
    writer.update_container(page["/Annots"])


def _field(writer: Any) -> None:
    field = {"/FT": pdf_name("/Tx"), "/T": TextStringObject("Value")}
    fields = writer.root["/AcroForm"]["/Fields"]
    fields.append(writer.add_object(DictionaryObject({pdf_name(key): value for key, value in field.items()})))
    writer.update_container(fields)


def _content(writer: Any) -> None:
    page = writer.root["/Pages"]["/Kids"][0]
    content = page["/Contents"]
    stream = content[0] if isinstance(content, ArrayObject) else content
    stream._data = stream.data + b"\n"
    stream._encoded_data = None
    writer.update_container(stream)


@pytest.mark.parametrize("file", ["signed", "stamped"])
@pytest.mark.parametrize(
    ("change", "named"),
    [
        (_catalog, "the catalog's /PageMode"),
        (_annotation, "an annotation (Stamp)"),
        (_field, "the form field 'Value'"),
        (_content, "the content of a stream"),
    ],
)
def test_what_was_changed_after_signing_is_named(
    file: str, change: Callable[[Any], None], named: str, request: pytest.FixtureRequest
) -> None:
    writer: Any = IncrementalPdfFileWriter(BytesIO(request.getfixturevalue(file)))
    writer._update_meta = lambda: None
    change(writer)
    changed = BytesIO()
    writer.write(changed)
    state = read_signature_state(changed.getvalue())
    assert state.integrity is Integrity.ALTERED
    assert state.reason.startswith("something was added after it was signed: ")
    assert named in state.reason


def test_a_further_signature_does_not_heal_a_change(signed: bytes, tmp_path: Path) -> None:
    """Who changes a page and signs it all again covers the whole file; the first signature tells."""
    from pyhanko.sign.fields import SigFieldSpec, append_signature_field
    from pyhanko.sign.signers import PdfSignatureMetadata, PdfSigner, SimpleSigner

    file = pkcs12_file(tmp_path / "other.p12", certificate=certificate_of(elliptic()))
    key = SimpleSigner.load_pkcs12_data(file.read_bytes(), [], PASSWORD.encode())
    writer: Any = IncrementalPdfFileWriter(BytesIO(signed))
    writer._update_meta = lambda: None
    _annotation(writer)
    append_signature_field(writer, SigFieldSpec("Other"))
    signer: Any = PdfSigner(PdfSignatureMetadata(field_name="Other"), key)
    signer._enforce_certification_constraints = lambda _: None  # a forger's program does not ask
    again = signer.sign_pdf(writer).getvalue()
    state = read_signature_state(again)
    assert state.integrity is Integrity.ALTERED
    assert state.reason.startswith("it was changed after it was signed: ")
    assert "an annotation (Stamp)" in state.reason
