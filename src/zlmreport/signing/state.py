"""Whether a PDF is signed, by whom, and whether it is still what was signed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from enum import Enum
from io import BytesIO
from typing import Any

from zlmreport.signing.trust import is_trusted

# A signature states which bytes it covers; this name cannot be packed away.
_MARK = b"/ByteRange"
_MOST_SIGNATURES = 20


class Integrity(Enum):
    """What can be said of a PDF's signatures."""

    UNSIGNED = "unsigned"
    INTACT = "intact"
    ALTERED = "altered"
    UNCHECKED = "unchecked"


@dataclass(frozen=True, slots=True)
class Signature:
    """One signature.

    Attributes
    ----------
    signer
        Name on the signer's certificate: anybody can make one with any name.
    fingerprint
        SHA-256 of the certificate in hexadecimal, to compare with the one that the laboratory publishes.
    stated_time
        When the signer's clock says that it was signed; None if it does not say.
    holds
        Whether the bytes that it covers are the bytes that were signed with the certificate's key.
    covers_file
        Whether it covers the whole file: nothing was appended after it.
    is_trusted
        Whether the certificate, or an authority that issued it, is among those that are trusted.
    """

    signer: str
    fingerprint: str
    stated_time: datetime | None
    holds: bool
    covers_file: bool
    is_trusted: bool = False


@dataclass(frozen=True, slots=True)
class SignatureState:
    """What can be said of a PDF's signatures.

    Attributes
    ----------
    integrity
        Intact if every signature holds and the last covers the whole file; altered otherwise. Unchecked if
        there is one, but pyHanko (``pip install 'zlmreport[sign]'``) is not installed.
    signatures
        In the order in which they were made; those that cannot be read are absent.
    reason
        Why it is altered or unchecked, in words; empty otherwise.
    """

    integrity: Integrity
    signatures: tuple[Signature, ...] = ()
    reason: str = ""

    @property
    def is_trusted(self) -> bool:
        """Whether every signature is intact and trusted."""
        return self.integrity is Integrity.INTACT and all(each.is_trusted for each in self.signatures)


def signature_state(pdf: bytes, trusted: Sequence[Any] = ()) -> SignatureState:
    """Return what can be said of the signatures of a PDF, be it foreign, damaged or forged.

    `trusted` are certificates in the terms of asn1crypto. Nothing is fetched from anywhere.
    """
    if _MARK not in pdf:
        return SignatureState(Integrity.UNSIGNED)
    try:
        signatures = _read(pdf, trusted)
    except ImportError:
        return SignatureState(Integrity.UNCHECKED, reason="pyHanko is not installed: zlmreport[sign]")
    except Exception as error:  # noqa: BLE001 (pyHanko meets a forger's bytes with many kinds of them)
        return SignatureState(Integrity.ALTERED, reason=f"its signature cannot be read: {error}")
    reason = _fault(signatures)
    return SignatureState(Integrity.ALTERED if reason else Integrity.INTACT, signatures, reason)


def _fault(signatures: tuple[Signature, ...]) -> str:
    if not signatures:
        return "what is left of its signature cannot be found"
    if not all(signature.holds for signature in signatures):
        return "it is not what was signed"
    if not signatures[-1].covers_file:
        return "something was added after it was signed"
    return ""


def _read(pdf: bytes, trusted: Sequence[Any]) -> tuple[Signature, ...]:
    from pyhanko.pdf_utils.reader import PdfFileReader  # noqa: PLC0415 (an optional extra)

    embedded = PdfFileReader(BytesIO(pdf)).embedded_signatures
    if len(embedded) > _MOST_SIGNATURES:
        raise ValueError(f"it has {len(embedded)} signatures")
    return tuple(_checked(each, trusted) for each in embedded)


def _checked(embedded: Any, trusted: Sequence[Any]) -> Signature:
    from pyhanko.sign.validation.generic_cms import validate_sig_integrity  # noqa: PLC0415 (an optional extra)
    from pyhanko.sign.validation.status import SignatureCoverageLevel  # noqa: PLC0415 (an optional extra)

    embedded.compute_integrity_info(skip_diff=True)
    certificate = embedded.signer_cert
    intact, valid = validate_sig_integrity(
        embedded.signer_info, certificate, "data", embedded.compute_digest()
    )
    return Signature(
        signer=certificate.subject.human_friendly,
        fingerprint=certificate.sha256.hex(),
        stated_time=embedded.self_reported_timestamp,
        holds=intact and valid,
        covers_file=embedded.coverage == SignatureCoverageLevel.ENTIRE_FILE,
        is_trusted=bool(trusted)
        and is_trusted(certificate, embedded.other_embedded_certs, trusted, embedded.self_reported_timestamp),
    )
