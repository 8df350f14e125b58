"""Who made a certificate: only a signature by a key that is trusted tells."""

from __future__ import annotations

import json
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest
from cryptography import x509
from cryptography.hazmat.primitives import hashes
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.hazmat.primitives.serialization import Encoding
from cryptography.x509.oid import NameOID

from document.signing.keys import PASSWORD, certificate_of, elliptic, pkcs12_file
from verification.issued import READINGS, issue, lay_out
from zlmreport.cli import main
from zlmreport.document.signing.signer import open_signer
from zlmreport.document.signing.state import (
    find_trusted_by_user,
    read_signature_state,
    read_trusted_certificates,
)
from zlmreport.plugin import AccessError, InputError, Place

PLACE = Place("zlmreport --trusted")
Run = Callable[..., tuple[int, dict[str, Any]]]


def signed(pdf: bytes, folder: Path, **made: Any) -> bytes:
    file = pkcs12_file(folder / "key.p12", **made)
    with open_signer(str(file), lambda _: PASSWORD, Place("--sign")) as signer:
        return signer(pdf, "Electronic signature")


def pem(path: Path, certificate: x509.Certificate) -> Path:
    path.write_bytes(certificate.public_bytes(Encoding.PEM))
    return path


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Verify the bytes of a PDF: the exit code, and what is printed as JSON."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "configuration"))
    path = tmp_path / "report.pdf"

    def verify(pdf: bytes, *options: str) -> tuple[int, dict[str, Any]]:
        path.write_bytes(pdf)
        code = main(["verify", str(path), "--json", *options])
        return code, json.loads(capsys.readouterr().out)

    return verify


@pytest.mark.long
def test_a_signature_is_trusted_if_its_certificate_is(issued: bytes, tmp_path: Path, run: Run) -> None:
    certificate = certificate_of(elliptic())
    pdf = signed(issued, tmp_path, certificate=certificate)
    trusted = pem(tmp_path / "laboratory.pem", certificate)
    code, found = run(pdf, "--trusted", str(trusted), "--require-signature")
    assert (code, found["verdict"], found["trusted"]) == (0, "holds", True)
    assert "by the signer's own clock, which nothing proves" in found["signature"]["detail"]
    assert found["time_trusted"] is False


@pytest.mark.long
def test_without_trust_a_signed_certificate_is_consistent_and_no_more(
    issued: bytes, tmp_path: Path, run: Run
) -> None:
    pdf = signed(issued, tmp_path)
    code, found = run(pdf)
    assert (code, found["verdict"], found["trusted"]) == (0, "holds", False)
    code, found = run(pdf, "--require-signature")
    assert (code, found["verdict"], found["trusted"]) == (1, "does-not-hold", False)
    assert "a signature that is trusted is required" in found["signature"]["detail"]


@pytest.mark.long
def test_a_consistent_forgery_is_never_trusted(tmp_path: Path, run: Run) -> None:
    forged = issue(lay_out(tmp_path, x_axis=READINGS.replace(".", ".0")))
    code, found = run(forged)
    assert (code, found["holds"], found["trusted"]) == (0, True, False)
    trusted = pem(tmp_path / "laboratory.pem", certificate_of(elliptic()))
    code, found = run(forged, "--trusted", str(trusted), "--require-signature")
    assert (code, found["holds"], found["trusted"]) == (1, False, False)


def state(pdf: bytes, trusted: Path) -> bool:
    return read_signature_state(pdf, read_trusted_certificates(trusted, PLACE)).is_trusted


def test_a_certificate_of_the_same_name_is_not_the_one_that_is_trusted(issued: bytes, tmp_path: Path) -> None:
    own = certificate_of(elliptic())
    other_key = ec.generate_private_key(ec.SECP256R1())
    pdf = signed(issued, tmp_path, key=other_key, certificate=certificate_of(other_key))
    assert not state(pdf, pem(tmp_path / "laboratory.pem", own))


def test_what_a_trusted_authority_issued_is_trusted(issued: bytes, tmp_path: Path) -> None:
    authority, certificate = issued_by_authority()
    pdf = signed(issued, tmp_path, certificate=certificate)
    folder = tmp_path / "trusted"
    folder.mkdir()
    pem(folder / "other.crt", certificate_of(ec.generate_private_key(ec.SECP256R1())))
    assert not state(pdf, folder)
    pem(folder / "AUTHORITY.PEM", authority)
    assert state(pdf, folder)


def test_a_trusted_signature_is_not_trusted_after_a_change(issued: bytes, tmp_path: Path) -> None:
    certificate = certificate_of(elliptic())
    pdf = bytearray(signed(issued, tmp_path, certificate=certificate))
    pdf[2000] ^= 1
    assert not state(bytes(pdf), pem(tmp_path / "laboratory.pem", certificate))


def test_the_users_configuration_names_who_is_trusted(tmp_path: Path) -> None:
    environment = {"XDG_CONFIG_HOME": str(tmp_path)}
    assert find_trusted_by_user(environment) is None
    file = tmp_path / "zlmreport" / "config.yaml"
    file.parent.mkdir()
    file.write_text("trusted: laboratories\n")
    assert find_trusted_by_user(environment) == file.parent / "laboratories"
    assert find_trusted_by_user({}) is None


@pytest.mark.parametrize("text", ["trust: laboratories", "trusted: [a, b]", "trusted", "a: [", "- 1"])
def test_a_configuration_that_is_wrong_is_refused(tmp_path: Path, text: str) -> None:
    file = tmp_path / "zlmreport" / "config.yaml"
    file.parent.mkdir()
    file.write_text(text)
    with pytest.raises(InputError, match="trusted"):
        find_trusted_by_user({"XDG_CONFIG_HOME": str(tmp_path)})


def test_what_is_no_certificate_is_refused(tmp_path: Path) -> None:
    with pytest.raises(AccessError, match="cannot be read"):
        read_trusted_certificates(tmp_path / "none.pem", PLACE)
    with pytest.raises(InputError, match="holds no certificate"):
        read_trusted_certificates(tmp_path, PLACE)
    (tmp_path / "text.pem").write_text("-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n")
    with pytest.raises(InputError, match=r"text\.pem is no certificate"):
        read_trusted_certificates(tmp_path, PLACE)


def issued_by_authority() -> tuple[x509.Certificate, x509.Certificate]:
    """Return an authority's certificate, and one that it issued for the usual key."""
    key, today = ec.generate_private_key(ec.SECP256R1()), datetime.now(UTC)
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "Authority")])

    def builder(subject: x509.Name, public: ec.EllipticCurvePublicKey) -> x509.CertificateBuilder:
        return (
            x509.CertificateBuilder()
            .subject_name(subject)
            .issuer_name(name)
            .public_key(public)
            .serial_number(x509.random_serial_number())
            .not_valid_before(today - timedelta(days=2))
            .not_valid_after(today + timedelta(days=2))
        )

    authority = (
        builder(name, key.public_key())
        .add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
        .add_extension(x509.SubjectKeyIdentifier.from_public_key(key.public_key()), critical=False)
        .sign(key, hashes.SHA256())
    )
    laboratory = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "Laboratory")])
    certificate = (
        builder(laboratory, elliptic().public_key())
        .add_extension(x509.AuthorityKeyIdentifier.from_issuer_public_key(key.public_key()), critical=False)
        .sign(key, hashes.SHA256())
    )
    return authority, certificate
