"""Who signs, and how: a PAdES signature (ETSI EN 319 142-1) that leaves PDF/A-3a and PDF/UA-1 as they are.

The key is in a PKCS#12 file or in a PKCS#11 token, and is opened before any work is done. Without a time
stamp the signature is of level B-B. With one it is of level B-LTA: what tells whether certificates were
revoked is embedded, and a second stamp over the whole file keeps all that.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import Any, TypeAlias
from urllib.parse import unquote

from zlmreport.document.signing.state import silence_log
from zlmreport.errors import AccessError, InputError, Place, did_you_mean
from zlmreport.files import demand

#: Of a key with its certificates, bytes.
_LARGEST = 1024 * 1024
#: Takes the bytes of a PDF, what the signature is called in it for those who hear it read, and the address of
#: a service of time stamps (RFC 3161), or None; returns the signed PDF.
Signer: TypeAlias = Callable[[bytes, str, str | None], bytes]
_FIELD, _STAMP_FIELD = "Signature", "Timestamp"
_DIGEST = "sha256"
#: Of a service of time stamps or of revocations, in seconds.
_PATIENCE = 20


@contextmanager
def open_signer(
    named: str, ask_password: Callable[[str], str], place: Place, authorities: Sequence[Any] = ()
) -> Iterator[Signer]:
    """Open the key that a user names.

    `named`: A PKCS#12 file (``laboratory.p12``), or the address of a key in a PKCS#11 token (``pkcs11:…``).
    `ask_password`: Returns the password of the file, or the PIN of the token; it is told what the password is
        of.
    `authorities`: Certificates of those that issued the signer's and the time stamps', where these do not
        bring them.

    Raises `InputError` if pyHanko is not installed, the password or the address is wrong, or the certificate
    is not valid today; `AccessError` if the file or the token cannot be read.
    """
    try:
        import pkcs11.exceptions  # noqa: F401, PLC0415 (an optional extra, as all of pyHanko below)
        import pyhanko.sign.signers  # noqa: F401, PLC0415
    except ImportError as error:
        raise InputError.at(
            place, f"signing needs pyHanko ({error}); install it: pip install 'zlmreport[sign]'"
        ) from error
    if named.startswith(SCHEME):
        uri = parse_token_uri(named, place)
        opened: AbstractContextManager[Any] = _open_token(uri, ask_password(f"token {uri.token}"), place)
    else:
        opened = nullcontext(_read_key_file(Path(named), ask_password, place))
    with opened as key:
        yield partial(_signed, key, tuple(authorities), place)


def _signed(  # noqa: PLR0913, PLR0917 - the first three are the signer's
    key: Any, authorities: Sequence[Any], place: Place, pdf: bytes, name: str, stamp_url: str | None = None
) -> bytes:
    """Return the signed PDF: the signature is appended, covers the file, and allows no change after it."""
    from pkcs11.exceptions import PKCS11Error  # noqa: PLC0415
    from pyhanko.sign.fields import (  # noqa: PLC0415
        MDPPerm,
        SigFieldSpec,
        SigSeedSubFilter,
        append_signature_field,
    )
    from pyhanko.sign.general import SigningError  # noqa: PLC0415
    from pyhanko.sign.signers import PdfSignatureMetadata, PdfSigner  # noqa: PLC0415
    from pyhanko.sign.timestamps import HTTPTimeStamper  # noqa: PLC0415
    from pyhanko_certvalidator import errors  # noqa: PLC0415

    stamper = HTTPTimeStamper(stamp_url, timeout=_PATIENCE) if stamp_url else None
    writer = _make_increment(pdf if pdf.endswith(b"\n") else pdf + b"\n")
    for field in (
        (_FIELD, _STAMP_FIELD) if stamper else (_FIELD,)
    ):  # a field that came later would be a change
        append_signature_field(writer, SigFieldSpec(field, readable_field_name=name))
        _tag_widget(writer, writer.root["/AcroForm"]["/Fields"].raw_get(-1))
    settings = PdfSignatureMetadata(
        field_name=_FIELD,
        md_algorithm=_DIGEST,
        subfilter=SigSeedSubFilter.PADES,
        certify=True,
        docmdp_permissions=MDPPerm.NO_CHANGES,
    )
    try:
        with silence_log():
            signed: bytes = PdfSigner(settings, key, timestamper=stamper).sign_pdf(writer).getvalue()
            return _stamp_as_a_whole(signed, key, authorities, stamper) if stamper else signed
    except (PKCS11Error, SigningError) as error:
        raise AccessError.at(place, f"the key did not sign: {str(error) or type(error).__name__}") from error
    except (OSError, errors.ValidationError, errors.PathError, errors.CRLValidationError) as error:
        raise AccessError.at(
            Place("certificate.signature.timestamp"),
            f"with a time stamp of {stamp_url} no signature could be kept that tells later whether it was "
            f"valid: {' '.join(str(error).split()) or type(error).__name__}",
        ) from error


def _stamp_as_a_whole(pdf: bytes, key: Any, authorities: Sequence[Any], stamper: Any) -> bytes:
    """Return a signed PDF with all that tells later whether its certificates were valid, stamped as a whole.

    The certificates that bring themselves count as roots here: this collects, and trusts nobody.
    """
    from pyhanko.pdf_utils.reader import PdfFileReader  # noqa: PLC0415
    from pyhanko.sign.signers import PdfTimeStamper  # noqa: PLC0415
    from pyhanko.sign.validation.dss import DocumentSecurityStore, collect_validation_info  # noqa: PLC0415
    from pyhanko_certvalidator import ValidationContext  # noqa: PLC0415
    from pyhanko_certvalidator.fetchers.requests_fetchers import RequestsFetcherBackend  # noqa: PLC0415

    writer = _make_increment(pdf)
    signature = PdfFileReader(BytesIO(pdf)).embedded_regular_signatures[-1]
    others = [*key.cert_registry, *signature.other_embedded_certs, *_list_stamps_certificates(signature)]
    own = [each for each in (key.signing_cert, *others) if each.self_signed in {"maybe", "yes"}]
    context = ValidationContext(
        trust_roots=[*authorities, *own],
        other_certs=others,
        allow_fetching=True,
        fetcher_backend=RequestsFetcherBackend(per_request_timeout=_PATIENCE),
        revocation_mode="hard-fail",
    )
    paths = asyncio.run(collect_validation_info(signature, context))
    DocumentSecurityStore.supply_dss_in_writer(
        writer, signature.sig_object.raw_get("/Contents"), paths=paths, validation_context=context
    )
    stamped: bytes = (
        PdfTimeStamper(stamper, field_name=_STAMP_FIELD).timestamp_pdf(writer, _DIGEST).getvalue()
    )
    return stamped


def _make_increment(pdf: bytes) -> Any:
    """Return what is to be appended to a PDF: nothing but what is added to it.

    pyHanko would write the metadata anew with the time of signing, in a form that PDF/A does not allow.
    """
    from pyhanko.pdf_utils.incremental_writer import IncrementalPdfFileWriter  # noqa: PLC0415

    writer: Any = IncrementalPdfFileWriter(BytesIO(pdf))
    writer._update_meta = lambda: None  # noqa: SLF001 - there is no setting for it
    return writer


def _list_stamps_certificates(signature: Any) -> Iterator[Any]:
    """Yield the certificates that the time stamps of a signature bring."""
    from pyhanko.sign.validation.generic_cms import extract_tst_data_iter  # noqa: PLC0415

    for stamp in extract_tst_data_iter(signature.signer_info, signed=False):
        yield from (each.chosen for each in stamp["certificates"] if each.name == "certificate")


def _tag_widget(writer: Any, widget: Any) -> None:
    """Give the signature's widget a place at the end of a tagged document's structure, as PDF/UA asks."""
    from pyhanko.pdf_utils.generic import (  # noqa: PLC0415
        ArrayObject,
        DictionaryObject,
        NameObject,
        NumberObject,
    )

    def dictionary(**entries: Any) -> Any:
        return DictionaryObject({NameObject(f"/{name}"): value for name, value in entries.items()})

    if "/StructTreeRoot" not in writer.root:
        return
    root = writer.root["/StructTreeRoot"]
    document = root["/K"].raw_get(0)
    places = root["/ParentTree"]["/Nums"]
    place = NumberObject(places[-2] + 1)
    field = widget.get_object()
    page = field.raw_get("/P")
    reference = writer.add_object(dictionary(Type=NameObject("/OBJR"), Obj=widget, Pg=page))
    form = writer.add_object(
        dictionary(
            Type=NameObject("/StructElem"),
            S=NameObject("/Form"),
            P=document,
            Pg=page,
            K=ArrayObject([reference]),
        )
    )
    field[NameObject("/StructParent")] = place
    document.get_object()["/K"].append(form)
    places.extend([place, form])
    writer.mark_update(document)
    writer.update_container(places)


def _require_valid(key: Any, named: str, place: Place) -> Any:
    """Return a key whose certificate is valid now: viewers refuse what any other has signed."""
    begin, end = key.signing_cert.not_valid_before, key.signing_cert.not_valid_after
    if not begin <= datetime.now(UTC) <= end:
        raise InputError.at(
            place, f"the certificate of {named} is valid from {begin:%Y-%m-%d} to {end:%Y-%m-%d}, not today"
        )
    return key


def _read_key_file(path: Path, ask_password: Callable[[str], str], place: Place) -> Any:
    from cryptography.hazmat.primitives.serialization import pkcs12  # noqa: PLC0415 (an optional extra)
    from pyhanko.sign.signers import SimpleSigner  # noqa: PLC0415 (an optional extra)

    content = demand(path, _LARGEST, place)
    password = ask_password(str(path)).encode() or None
    try:
        key, certificate, _ = pkcs12.load_key_and_certificates(content, password)
    except ValueError as error:
        raise InputError.at(
            place, f"{path} cannot be opened: either the password is wrong, or it is no PKCS#12 file"
        ) from error
    if key is None or certificate is None:
        raise InputError.at(place, f"{path} holds no key with its certificate; export both into it")
    return _require_valid(SimpleSigner.load_pkcs12_data(content, [], password), str(path), place)


@contextmanager
def _open_token(uri: TokenUri, pin: str, place: Place) -> Iterator[Any]:
    from pkcs11.exceptions import PKCS11Error  # noqa: PLC0415 (an optional extra)
    from pyhanko.config.pkcs11 import TokenCriteria  # noqa: PLC0415 (an optional extra)
    from pyhanko.sign.general import SigningError  # noqa: PLC0415 (an optional extra)
    from pyhanko.sign.pkcs11 import PKCS11Signer, open_pkcs11_session  # noqa: PLC0415 (an optional extra)

    with ExitStack() as stack:
        try:
            session = stack.enter_context(
                open_pkcs11_session(
                    str(uri.module), token_criteria=TokenCriteria(label=uri.token), user_pin=pin or None
                )
            )
            key = PKCS11Signer(session, cert_label=uri.label, key_label=uri.label)
            valid = _require_valid(key, f"token {uri.token}", place)
        except (PKCS11Error, SigningError, OSError) as error:
            raise AccessError.at(
                place,
                f"the key {uri.label!r} of token {uri.token!r} cannot be opened by {uri.module}: "
                f"{str(error) or type(error).__name__}",
            ) from error
        yield valid


SCHEME = "pkcs11:"

_KNOWN = ("token", "object", "module-path")
_EXAMPLE = "pkcs11:token=…;object=…?module-path=/usr/lib/…"


@dataclass(frozen=True, slots=True)
class TokenUri:
    """A key in a token."""

    module: Path  #: The driver: a shared library.
    token: str  #: Label of the token.
    label: str  #: Label of the key and its certificate.


def parse_token_uri(text: str, place: Place) -> TokenUri:
    """Read an address.

    Raises `InputError` if it lacks a part, or has one that is not known here. A PIN in it is refused:
    everybody on the machine can read a command line.
    """
    found: dict[str, str] = {}
    for name, value in _split_attributes(text):
        if name in {"pin-value", "pin-source"}:
            raise InputError.at(
                place, f"a PIN does not belong on the command line; leave {name} out: it is asked for"
            )
        if name not in _KNOWN:
            raise InputError.at(place, f"unknown part {name!r} in {text!r}; {did_you_mean(name, _KNOWN)}")
        found[name] = value
    missing = [name for name in _KNOWN if not found.get(name)]
    if missing:
        raise InputError.at(place, f"{text!r} lacks {', '.join(missing)}; write {_EXAMPLE}")
    return TokenUri(Path(found["module-path"]), found["token"], found["object"])


def _split_attributes(text: str) -> Iterator[tuple[str, str]]:
    path, _, query = text.removeprefix(SCHEME).partition("?")
    for attribute in (*path.split(";"), *query.split("&")):
        if attribute:
            name, _, value = attribute.partition("=")
            yield name, unquote(value)
