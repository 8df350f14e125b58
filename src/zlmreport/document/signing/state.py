"""Whether a PDF is signed, by whom and when, whether that is trusted, and what was changed after it.

Trusted are the certificates that the user names, and what these have issued. Nothing is fetched from
anywhere: whether a certificate was revoked is asked of what the PDF keeps, and at the time of signing.
"""

from __future__ import annotations

import asyncio
import logging
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from enum import Enum
from io import BytesIO
from pathlib import Path
from typing import Any

import yaml

from zlmreport.errors import AccessError, InputError, Place, did_you_mean
from zlmreport.files import read, say_reason

# A signature states which bytes it covers; this name cannot be packed away.
_MARK = b"/ByteRange"
_MOST_SIGNATURES = 20
_MOST_TOLD = 6
#: Of what pyHanko says of bytes that it cannot read.
_LONGEST_DETAIL = 60
#: How an algorithm without parameters has none, in DER.
_NO_PARAMETERS = (b"", b"\x05\x00")


class Integrity(Enum):
    """What can be said of a PDF's signatures."""

    UNSIGNED = "unsigned"
    INTACT = "intact"
    ALTERED = "altered"
    UNCHECKED = "unchecked"


@dataclass(frozen=True, slots=True)
class Signature:
    """One signature."""

    signer: str  #: Name on the signer's certificate: anybody can make one with any name.
    #: SHA-256 of the certificate in hexadecimal, to compare with the one that the laboratory publishes.
    fingerprint: str
    #: When it was signed, by its time stamp or else by the signer's clock; None if neither says.
    time: datetime | None
    #: Whether the bytes that it covers are the bytes that were signed with the certificate's key.
    holds: bool
    covers_file: bool  #: Whether it covers the whole file: nothing was appended after it.
    #: Whether the certificate, or an authority that issued it, is among those that are trusted, both were
    #: valid when it was signed, and neither is known to have been revoked then.
    is_trusted: bool = False
    stamped_by: str = ""  #: Whose time stamp that is; empty if it is the signer's clock.
    is_time_trusted: bool = False  #: Whether the time stamp is intact and trusted.
    distrust: str = ""  #: Why it is not trusted, where that is known.
    is_stamp: bool = False  #: Whether it is the time stamp of the whole document, and nobody's signature.
    #: What was changed after it, in words; empty if that is nothing but proofs of its validity.
    changes: str = ""


@dataclass(frozen=True, slots=True)
class SignatureState:
    """What can be said of a PDF's signatures."""

    #: Intact if every signature holds and the last covers the whole file; altered otherwise. Unchecked if
    #: there is one, but pyHanko (``pip install 'zlmreport[sign]'``) is not installed.
    integrity: Integrity
    #: In the order in which they were made; those that cannot be read are absent.
    signatures: tuple[Signature, ...] = ()
    reason: str = ""  #: Why it is altered or unchecked, in words; empty otherwise.

    @property
    def is_trusted(self) -> bool:
        """Whether every signature is intact and trusted."""
        return self.integrity is Integrity.INTACT and all(each.is_trusted for each in self.signatures)

    @property
    def is_time_trusted(self) -> bool:
        """Whether every signature is intact, and has its time from a time stamp that is trusted."""
        return self.integrity is Integrity.INTACT and all(
            each.is_time_trusted for each in self.signatures if not each.is_stamp
        )


def read_signature_state(pdf: bytes, trusted: Sequence[Any] = ()) -> SignatureState:
    """Return what can be said of the signatures of a PDF, be it foreign, damaged or forged.

    `trusted` are certificates in the terms of asn1crypto. Nothing is fetched from anywhere.
    """
    if _MARK not in pdf:
        return SignatureState(Integrity.UNSIGNED)
    try:
        with silence_log():
            signatures = _read(pdf, trusted)
    except ImportError:
        return SignatureState(Integrity.UNCHECKED, reason="pyHanko is not installed: zlmreport[sign]")
    except Exception as error:  # noqa: BLE001 (pyHanko meets a forger's bytes with many kinds of them)
        detail = " ".join(str(error).split())[:_LONGEST_DETAIL]
        reason = f"its signature cannot be read: its bytes were changed, or are damaged ({detail})"
        return SignatureState(Integrity.ALTERED, reason=reason)
    reason = _say_fault(signatures)
    return SignatureState(Integrity.ALTERED if reason else Integrity.INTACT, signatures, reason)


@contextmanager
def silence_log() -> Iterator[None]:
    """Keep what pyHanko logs from the terminal: what matters of it is said by findings and errors."""
    loggers = [logging.getLogger(name) for name in ("pyhanko", "pyhanko_certvalidator")]
    levels = [each.level for each in loggers]
    for each in loggers:
        each.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for each, level in zip(loggers, levels, strict=True):
            each.setLevel(level)


def _say_fault(signatures: tuple[Signature, ...]) -> str:
    if all(each.is_stamp for each in signatures):
        return "what is left of its signature cannot be found"
    if not all(signature.holds for signature in signatures):
        return (
            "it is not what was signed: another program saved it again, or somebody changed it; ask for the "
            "file as it was issued"
        )
    if not signatures[-1].covers_file:
        added = signatures[-1].changes or "bytes to which nothing leads"
        return f"something was added after it was signed: {added}"
    changed = next((each.changes for each in signatures if each.changes), "")
    return f"it was changed after it was signed: {changed}" if changed else ""


def _read(pdf: bytes, trusted: Sequence[Any]) -> tuple[Signature, ...]:
    from pyhanko.pdf_utils.reader import PdfFileReader  # noqa: PLC0415 (an optional extra)
    from pyhanko.sign.validation.dss import DocumentSecurityStore  # noqa: PLC0415
    from pyhanko.sign.validation.errors import NoDSSFoundError  # noqa: PLC0415

    reader = PdfFileReader(BytesIO(pdf))
    embedded = reader.embedded_signatures
    if len(embedded) > _MOST_SIGNATURES:
        raise ValueError(f"it has {len(embedded)} signatures")
    try:
        kept = DocumentSecurityStore.read_dss(reader)
    except NoDSSFoundError:
        kept = None
    return tuple(
        _check_signature(each, _Trust(tuple(trusted), kept, tuple(each.other_embedded_certs)))
        for each in embedded
    )


def _check_signature(embedded: Any, trust: _Trust) -> Signature:
    from pyhanko.sign.validation.generic_cms import (  # noqa: PLC0415 (an optional extra)
        extract_tst_data_iter,
        message_imprint_checker,
        validate_sig_integrity,
    )
    from pyhanko.sign.validation.status import SignatureCoverageLevel  # noqa: PLC0415 (an optional extra)

    embedded.compute_integrity_info(skip_diff=True)
    certificate, is_stamp = embedded.signer_cert, embedded.sig_object_type == "/DocTimeStamp"
    time, stamped_by, is_time_trusted = embedded.self_reported_timestamp, "", False
    if is_stamp:
        holds, is_time_trusted, time = trust.check_stamp(
            embedded.signed_data, lambda _: embedded.compute_digest()
        )
    else:
        holds = all(
            validate_sig_integrity(embedded.signer_info, certificate, "data", embedded.compute_digest())
        )
        for stamp in extract_tst_data_iter(embedded.signer_info, signed=False):
            is_intact, is_time_trusted, time = trust.check_stamp(
                stamp, message_imprint_checker(embedded.signer_info)
            )
            stamped_by, holds = _name_stamper(stamp), holds and is_intact
    holds = holds and _is_as_written(embedded)
    distrust = "" if is_stamp else trust.say_against(certificate, time)
    return Signature(
        signer=certificate.subject.human_friendly,
        fingerprint=certificate.sha256.hex(),
        time=time,
        holds=holds,
        covers_file=embedded.coverage == SignatureCoverageLevel.ENTIRE_FILE,
        is_trusted=is_time_trusted if is_stamp else bool(trust.trusted) and not distrust,
        stamped_by=stamped_by,
        is_time_trusted=is_time_trusted,
        distrust=distrust,
        is_stamp=is_stamp,
        changes=_describe_changes(embedded.reader, embedded.signed_revision),
    )


def _is_as_written(embedded: Any) -> bool:
    """Whether what no key signs of a signature is as who signs writes it: no byte of it is free.

    That is the version, which follows from the rest (RFC 5652, 5.1), the list of digest algorithms, among
    which is the signer's, parameters that algorithms do not have, and the zeros behind the signature in the
    room that was kept for it.
    """
    from asn1crypto.cms import ContentInfo, DigestAlgorithms  # noqa: PLC0415 (comes with pyHanko)

    message = ContentInfo.load(embedded.pkcs7_content)
    signed, signer = message["content"], embedded.signer_info
    is_plain = (
        signer["version"].native == "v1" and signed["encap_content_info"]["content_type"].native == "data"
    )
    listed, of_signer = signed["digest_algorithms"], signer["digest_algorithm"]
    algorithms = [*listed, of_signer]
    if signer["signature_algorithm"]["algorithm"].native != "rsassa_pss":  # whose parameters are used
        algorithms.append(signer["signature_algorithm"])
    return (
        signed["version"].native == ("v1" if is_plain else "v3")
        and of_signer["algorithm"].native in [each["algorithm"].native for each in listed]
        and all(each["parameters"].dump() in _NO_PARAMETERS for each in algorithms)
        and listed.dump() == DigestAlgorithms([*listed]).dump()
        and not any(embedded.pkcs7_content[len(message.dump()) :])
    )


def _name_stamper(stamp: Any) -> str:
    from pyhanko.sign.general import extract_certificate_info  # noqa: PLC0415

    name: str = extract_certificate_info(stamp).signer_cert.subject.human_friendly
    return name


def _describe_changes(reader: Any, signed: int) -> str:
    """Return in words what later revisions changed of what a signature covers, but for proofs of validity.

    What is new is seen only where something that is old leads to it. So nothing old may be changed, but for
    the catalog, to which the proofs are added, and an empty field that takes the time stamp of the document.
    """
    before, now = reader.get_historical_resolver(signed), reader
    told = [] if before.trailer_view.raw_get("/Root") == now.trailer.raw_get("/Root") else ["another catalog"]
    is_harmless = not told
    for revision in range(signed + 1, reader.xrefs.total_revisions):
        freed = reader.xrefs.refs_freed_in_revision(revision)
        told += ["objects that are taken out"] * bool(freed)
        is_harmless = is_harmless and not freed
        for reference in sorted(
            reader.xrefs.explicit_refs_in_revision(revision), key=lambda each: each.idnum
        ):
            changed = reader.get_object(reference, revision=revision)
            is_new = reader.xrefs.get_introducing_revision(reference) > signed
            old = None if is_new else before.get_object(reference)
            is_harmless = is_harmless and (is_new or _is_kept(old, changed))
            told.append(_describe_object(old, changed))
    told = [] if is_harmless else [*dict.fromkeys(filter(None, told))]
    more = len(told) - _MOST_TOLD
    return ", ".join(told[:_MOST_TOLD]) + (f" and {more} more" if more > 0 else "")


def _find_differing_keys(old: Any, changed: Any) -> set[str]:
    """Return the keys under which two dictionaries differ."""
    return {
        key
        for key in old.keys() | changed.keys()
        if key not in old or key not in changed or old.raw_get(key) != changed.raw_get(key)
    }


def _is_kept(old: Any, changed: Any) -> bool:
    """Whether an object was changed in nothing but proofs of validity."""
    if type(old) is not type(changed) or not isinstance(old, dict):
        return bool(type(old) is type(changed) and old == changed)
    keys = _find_differing_keys(old, changed)
    if hasattr(old, "data"):
        return not keys and bool(old.data == changed.data)
    if old.get("/Type") == "/Catalog":
        return keys <= {"/DSS", "/Extensions"}
    is_stamp = keys == {"/V"} and "/V" not in old and changed["/V"].get("/Type") == "/DocTimeStamp"
    return not keys or is_stamp


def _describe_object(old: Any, changed: Any) -> str:
    """Return what an object is that a later revision brings or changes; nothing for what leads to others."""
    entries = changed if isinstance(changed, dict) else {}
    kind, subtype = str(entries.get("/Type", "")), str(entries.get("/Subtype", ""))
    said = ""
    if "/FT" in entries:
        said = f"the form field {str(entries.get('/T', ''))!r}"
    elif kind == "/Annot" or "/Rect" in entries:
        said = f"an annotation ({subtype.removeprefix('/')})"
    elif kind == "/Sig":
        said = "a further signature"
    elif old is not None and kind in {"/Page", "/Catalog"}:
        said = f"the {kind[1:].lower()}'s {', '.join(sorted(_find_differing_keys(old, changed)))}"
    elif old is not None:
        what = "the content of a stream" if hasattr(changed, "data") else "an object"
        said = f"{what} ({kind or 'no type'})"
    return "" if old is not None and _is_kept(old, changed) else said


@dataclass(frozen=True, slots=True)
class _Trust:
    """Whom a user trusts, and what a PDF keeps of certificates and their revocations."""

    trusted: tuple[Any, ...]
    kept: Any
    others: tuple[Any, ...]

    def _make_context(self, moment: datetime) -> Any:
        from pyhanko_certvalidator import ValidationContext  # noqa: PLC0415

        settings = {
            "trust_roots": list(self.trusted),
            "other_certs": list(self.others),
            "moment": moment,
            "allow_fetching": False,
            "revocation_mode": "soft-fail",
            "retroactive_revinfo": True,
        }
        return self.kept.as_validation_context(settings) if self.kept else ValidationContext(**settings)

    def say_against(self, signer: Any, moment: datetime | None) -> str:
        """Return what speaks against trust in a signer's certificate at the time of signing; None is now."""
        from pyhanko_certvalidator import CertificateValidator, errors  # noqa: PLC0415

        when = moment or datetime.now(UTC)
        if not signer.not_valid_before <= when <= signer.not_valid_after:
            return "its certificate was not valid then"
        if signer.sha256 in {each.sha256 for each in self.trusted}:
            return ""
        validator: Any = CertificateValidator(
            signer, intermediate_certs=list(self.others), validation_context=self._make_context(when)
        )
        try:
            asyncio.run(validator.async_validate_usage(set()))
        except errors.RevokedError as error:
            return f"its certificate was revoked on {error.revocation_dt:%Y-%m-%d}"
        except (errors.PathError, errors.ValidationError):
            return "of unknown trust"
        return ""

    def check_stamp(self, stamp: Any, imprint: Callable[[str], bytes]) -> tuple[bool, bool, datetime]:
        """Return whether a time stamp is intact, whether it is trusted, and its time."""
        from pyhanko.sign.validation.generic_cms import validate_tst_signed_data  # noqa: PLC0415

        time: datetime = stamp["encap_content_info"]["content"].parsed["gen_time"].native
        found = asyncio.run(validate_tst_signed_data(stamp, self._make_context(time), imprint))
        is_intact = bool(found["intact"] and found["valid"])
        return is_intact, is_intact and found.get("trust_problem_indic") is None, time


#: Of a file of certificates, bytes: the authorities of all the world take less.
_LARGEST = 16 * 1024 * 1024
_ENDINGS = frozenset({".cer", ".crt", ".der", ".pem"})
_CONFIGURATION = Path("zlmreport", "config.yaml")
_KEY = "trusted"


def read_trusted_certificates(path: Path, place: Place) -> tuple[Any, ...]:
    """Return the certificates of a file, or of all files in a folder, in the terms of asn1crypto.

    `path`: A certificate, PEM or DER, or several in one file (PEM); or a folder of such files, those that end
        in ``.pem``, ``.crt``, ``.cer`` or ``.der``, in small letters or capitals.

    Raises `AccessError` if it cannot be read; `InputError` if it is no certificate, or a folder without one;
    or if pyHanko is not installed.
    """
    try:
        files = (
            sorted(each for each in path.iterdir() if each.suffix.casefold() in _ENDINGS)
            if path.is_dir()
            else [path]
        )
        contents = [(each, read(each, _LARGEST)) for each in files]
    except OSError as error:
        raise AccessError.at(place, f"{path} cannot be read: {say_reason(error)}") from error
    if not contents:
        endings = ", ".join(sorted(_ENDINGS))
        raise InputError.at(
            place, f"{path} holds no certificate: no file whose name ends in one of {endings}"
        )
    return tuple(each for file, content in contents for each in _read_certificates(file, content, place))


def _read_certificates(file: Path, content: bytes, place: Place) -> list[Any]:
    try:
        from asn1crypto import pem, x509  # noqa: PLC0415 (comes with pyHanko, an optional extra)
    except ImportError as error:
        raise InputError.at(
            place, f"trust needs pyHanko ({error}); install it: pip install 'zlmreport[sign]'"
        ) from error
    try:
        is_text = pem.detect(content)
        blocks = [each for *_, each in pem.unarmor(content, multiple=True)] if is_text else [content]
        found = [x509.Certificate.load(each, strict=True) for each in blocks]
        for each in found:
            _ = each.native
    except (TypeError, ValueError) as error:
        raise InputError.at(place, f"{file} is no certificate (X.509, as PEM or DER)") from error
    return found


def find_trusted_by_user(environment: Mapping[str, str] = os.environ) -> Path | None:
    """Return what the user's configuration names as trusted; None if it names nothing.

    The configuration is ``zlmreport/config.yaml`` in ``$XDG_CONFIG_HOME`` or else in ``~/.config``, with the
    one key `trusted`: a file or a folder, relative to the configuration.

    Raises `AccessError` or `InputError` if it cannot be read, or has another key.
    """
    folders = (Path(environment.get("XDG_CONFIG_HOME", "")), Path(environment.get("HOME", ""), ".config"))
    folder = next((each for each in folders if each.is_absolute()), None)
    if folder is None or not (folder / _CONFIGURATION).is_file():
        return None
    file = folder / _CONFIGURATION
    try:
        read = yaml.safe_load(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise AccessError.at(Place(str(file)), f"cannot be read: {error.strerror or error}") from error
    except (UnicodeDecodeError, yaml.YAMLError) as error:
        raise InputError.at(Place(str(file)), "is no YAML; write trusted: FOLDER") from error
    if not isinstance(read, dict | None):
        raise InputError.at(Place(str(file)), "is no list of keys; write trusted: FOLDER")
    keys = read or {}
    for key in keys:
        if key != _KEY:
            raise InputError.at(Place(str(file)), f"unknown key {key!r}; {did_you_mean(str(key), [_KEY])}")
    named = keys.get(_KEY)
    if named is not None and not isinstance(named, str):
        raise InputError.at(Place(str(file)), f"{_KEY} is no name of a file or folder")
    return file.parent / named if named else None
