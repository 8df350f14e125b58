"""A signature says who made a certificate; what it says is compared all the same."""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import pytest
from cryptography.hazmat.primitives.serialization import Encoding
from pypdf import PdfReader, PdfWriter
from pypdf.generic import ArrayObject, FloatObject, NameObject

from document.signing.authority import authority
from document.signing.keys import NAME, PASSWORD, pkcs12_file
from verification.issued import LABORATORY, altered, lay_out, with_digit
from zlmreport.cli import main
from zlmreport.cli.terminal import say
from zlmreport.document.signing.signer import open_signer
from zlmreport.plugin import Language, Place, Words
from zlmreport.verification.findings import CheckedCertificate, VerificationVerdict

Verify = Callable[[bytes], CheckedCertificate]
Sign = Callable[[bytes], bytes]


@pytest.fixture(scope="module")
def sign(tmp_path_factory: pytest.TempPathFactory) -> Sign:
    file = pkcs12_file(tmp_path_factory.mktemp("key") / "laboratory.p12")

    def signed(pdf: bytes) -> bytes:
        with open_signer(str(file), lambda _: PASSWORD, Place("--sign")) as signer:
            return signer(pdf, "Electronic signature")

    return signed


def test_an_unsigned_certificate_holds_and_the_finding_says_so(issued: bytes, verified: Verify) -> None:
    signature = verified(issued).signature
    assert (signature.verdict, say(signature.detail)) == (
        VerificationVerdict.OPEN,
        "not signed: nothing tells who made the file",
    )


def test_a_signed_certificate_holds_and_names_the_signer(issued: bytes, sign: Sign, verified: Verify) -> None:
    found = verified(sign(issued))
    assert found.holds
    assert found.signature.verdict is VerificationVerdict.HOLDS
    assert f"intact, by Common Name: {NAME}" in say(found.signature.detail)
    assert {each.verdict for each in (*found.pages, *found.document)} == {VerificationVerdict.HOLDS}


@pytest.mark.long
def test_a_certificate_with_a_time_stamp_holds_without_a_network(
    verified: Verify, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with authority() as own:
        laboratory = LABORATORY.replace("kind:", f"signature: {{timestamp: {own.address}}}, kind:")
        job = lay_out(tmp_path, laboratory=laboratory)
        (tmp_path / "zlmreport").mkdir()
        (tmp_path / "zlmreport" / "config.yaml").write_text("trusted: authority.pem\n")
        authorities = tmp_path / "zlmreport" / "authority.pem"
        authorities.write_bytes(own.certificate.public_bytes(Encoding.PEM))
        key = pkcs12_file(tmp_path / "key.p12", certificate=own.issued())
        monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
        monkeypatch.setenv("ZLMREPORT_SIGN_PASSWORD", PASSWORD)
        made = tmp_path / "made"
        assert main([str(job), "--sign", str(key), "--format", "pdf", "-o", str(made)]) == 0
    (document,) = made.glob("*.pdf")
    found = verified(document.read_bytes())
    assert found.holds
    assert {each.verdict for each in (*found.pages, *found.document, *found.files)} == {
        VerificationVerdict.HOLDS
    }
    assert "UTC by a time stamp of Common Name: Test Clock, of unknown trust" in say(found.signature.detail)
    assert "; kept with its proofs since 20" in say(found.signature.detail)


def test_a_signed_certificate_that_was_altered_before_does_not_hold(
    issued: bytes, sign: Sign, verified: Verify
) -> None:
    found = verified(sign(with_digit(issued, "7.26", "7.96")))
    assert found.signature.verdict is VerificationVerdict.HOLDS
    assert isinstance(found.signature.detail, Words)
    assert "intacta, de " in found.signature.detail.in_language(Language.SPANISH)
    assert not found.holds


def test_one_bit_of_what_was_signed_is_found(issued: bytes, sign: Sign, verified: Verify) -> None:
    pdf = bytearray(sign(issued))
    pdf[pdf.index(b"%\xf0") + 1] ^= 1  # in a comment that no page shows
    found = verified(bytes(pdf))
    assert found.signature.verdict is VerificationVerdict.DIFFERS
    assert say(found.signature.detail).endswith("ask for the file as it was issued")
    assert not found.holds


def test_a_change_after_the_signature_is_found(issued: bytes, sign: Sign, verified: Verify) -> None:
    writer = PdfWriter(BytesIO(sign(issued)), incremental=True)
    writer.pages[0][NameObject("/Rotate")] = FloatObject(180)
    changed = BytesIO()
    writer.write(changed)
    found = verified(changed.getvalue())
    assert say(found.signature.detail).startswith(
        "the file is signed, but something was added after it was signed"
    )
    assert "the page's /Rotate" in say(found.signature.detail)
    assert found.pages[0].verdict is VerificationVerdict.DIFFERS


def test_a_field_of_a_signature_that_covers_a_number_is_a_change(
    issued: bytes, sign: Sign, verified: Verify
) -> None:
    def enlarge(writer: PdfWriter) -> None:
        (page,) = (page for page in writer.pages if _fields(page))
        (field,) = _fields(page)
        field[NameObject("/Rect")] = ArrayObject(FloatObject(value) for value in (100, 100, 200, 200))

    found = verified(altered(sign(issued), enlarge))
    assert VerificationVerdict.DIFFERS in {each.verdict for each in found.pages}


def test_a_signature_that_was_taken_out_leaves_an_unsigned_certificate(
    issued: bytes, sign: Sign, verified: Verify
) -> None:
    signed = sign(issued)
    assert PdfReader(BytesIO(signed)).root_object["/AcroForm"]
    found = verified(signed[: len(issued)])
    assert found.signature.verdict is VerificationVerdict.OPEN
    assert found.holds


def _fields(page) -> list:
    annotations = page.get("/Annots", [])
    return [each.get_object() for each in annotations if each.get_object().get("/FT") == "/Sig"]
