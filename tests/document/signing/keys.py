"""Keys made on the spot: nothing that signs is kept in the project."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from functools import cache

from cryptography import x509
from cryptography.hazmat.primitives import hashes
from cryptography.hazmat.primitives.asymmetric import ec, rsa
from cryptography.hazmat.primitives.serialization import (
    BestAvailableEncryption,
    Encoding,
    NoEncryption,
    PrivateFormat,
    pkcs12,
)
from cryptography.x509.oid import NameOID

PASSWORD = "päss word"
NAME = "Laboratory for Machine Metrology"
_DAY = timedelta(days=1)


@cache
def elliptic() -> ec.EllipticCurvePrivateKey:
    return ec.generate_private_key(ec.SECP256R1())


@cache
def rsa_key() -> rsa.RSAPrivateKey:
    return rsa.generate_private_key(65537, 2048)


def certificate_of(key, first: timedelta = -_DAY, last: timedelta = _DAY) -> x509.Certificate:
    """A certificate that its own key has signed."""
    today = datetime.now(UTC)
    subject = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, NAME)])
    return (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(subject)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(today + first)
        .not_valid_after(today + last)
        .sign(key, hashes.SHA256())
    )


def pkcs12_file(path, key=None, certificate=None, password: str = PASSWORD):
    """Write a PKCS#12 file and return its path."""
    key = key or elliptic()
    encryption = BestAvailableEncryption(password.encode()) if password else NoEncryption()
    certificate = certificate or certificate_of(key)
    path.write_bytes(pkcs12.serialize_key_and_certificates(b"signature", key, certificate, None, encryption))
    return path


def in_der(key) -> bytes:
    """The key alone, unencrypted."""
    return key.private_bytes(Encoding.DER, PrivateFormat.TraditionalOpenSSL, NoEncryption())
