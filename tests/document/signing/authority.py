"""An authority of the tests' own: it issues certificates, stamps times, and lists revocations."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread
from typing import Any

from asn1crypto import keys, tsp, x509 as asn1_x509
from cryptography import x509
from cryptography.hazmat.primitives import hashes
from cryptography.hazmat.primitives.asymmetric import rsa
from cryptography.hazmat.primitives.serialization import Encoding, NoEncryption, PrivateFormat
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID
from pyhanko.sign.timestamps import DummyTimeStamper

from document.signing.keys import elliptic, rsa_key

_YEAR = timedelta(days=365)


@dataclass(slots=True)
class Authority:
    """One authority for signers and for time stamps.

    `now` is what its clock says; `revoked` are serial numbers with the time of their revocation.
    """

    address: str
    now: datetime = field(default_factory=lambda: datetime.now(UTC).replace(microsecond=0))
    revoked: dict[int, datetime] = field(default_factory=dict)
    key: rsa.RSAPrivateKey = field(default_factory=lambda: rsa.generate_private_key(65537, 2048))
    is_broken: bool = False

    @property
    def certificate(self) -> x509.Certificate:
        """Its own, by itself."""
        usage = x509.KeyUsage(
            *([False] * 5), key_cert_sign=True, crl_sign=True, encipher_only=False, decipher_only=False
        )
        return (
            self._begun("Test Authority", self.key.public_key(), 1)
            .add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
            .add_extension(usage, critical=True)
            .sign(self.key, hashes.SHA256())
        )

    def issued(self, name: str = "Laboratory", serial: int = 2, public: Any = None) -> x509.Certificate:
        """Return a certificate for the usual key, or for another."""
        return self._leaf(name, serial, public or elliptic().public_key()).sign(self.key, hashes.SHA256())

    def _leaf(self, name: str, serial: int, public: Any) -> x509.CertificateBuilder:
        where = [x509.UniformResourceIdentifier(f"{self.address}/crl")]
        point = x509.DistributionPoint(where, None, None, None)
        return self._begun(name, public, serial).add_extension(
            x509.CRLDistributionPoints([point]), critical=False
        )

    def _begun(self, name: str, public: Any, serial: int) -> x509.CertificateBuilder:
        return (
            x509.CertificateBuilder()
            .subject_name(x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, name)]))
            .issuer_name(x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "Test Authority")]))
            .public_key(public)
            .serial_number(serial)
            .not_valid_before(datetime.now(UTC) - 2 * _YEAR)
            .not_valid_after(datetime.now(UTC) + _YEAR)
        )

    def revocations(self) -> bytes:
        """Return the list of revocations, signed now."""
        now = datetime.now(UTC).replace(microsecond=0)
        listed = x509.CertificateRevocationListBuilder(
            self.certificate.subject, now - timedelta(hours=1), now + timedelta(days=1)
        )
        for serial, when in self.revoked.items():
            one = x509.RevokedCertificateBuilder().serial_number(serial).revocation_date(when).build()
            listed = listed.add_revoked_certificate(one)
        return listed.sign(self.key, hashes.SHA256()).public_bytes(Encoding.DER)

    def stamped(self, request: bytes) -> bytes:
        """Answer a request for a time stamp."""
        usage = x509.ExtendedKeyUsage([ExtendedKeyUsageOID.TIME_STAMPING])
        certificate = (
            self._leaf("Test Clock", 3, rsa_key().public_key())
            .add_extension(usage, critical=True)
            .sign(self.key, hashes.SHA256())
        )
        packed = rsa_key().private_bytes(Encoding.DER, PrivateFormat.PKCS8, NoEncryption())
        own, root = (
            asn1_x509.Certificate.load(each.public_bytes(Encoding.DER))
            for each in (certificate, self.certificate)
        )
        stamper = DummyTimeStamper(own, keys.PrivateKeyInfo.load(packed), [root], fixed_dt=self.now)
        response: bytes = stamper.request_tsa_response(tsp.TimeStampReq.load(request)).dump()
        return response


@contextmanager
def authority() -> Iterator[Authority]:
    """Start an authority, and end it."""
    known: list[Authority] = []

    class Answers(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            request = self.rfile.read(int(self.headers["Content-Length"]))
            self._answer(known[0].stamped(request), "application/timestamp-reply")

        def do_GET(self) -> None:
            self._answer(known[0].revocations(), "application/pkix-crl")

        def _answer(self, content: bytes, kind: str) -> None:
            self.send_response(500 if known[0].is_broken else 200)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(content)))
            self.end_headers()
            self.wfile.write(content)

        def log_message(self, *_: object) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Answers)
    known.append(Authority(f"http://127.0.0.1:{server.server_port}"))
    thread = Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield known[0]
    finally:
        server.shutdown()
        server.server_close()
        thread.join()
