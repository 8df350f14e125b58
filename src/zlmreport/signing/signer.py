"""Who signs: a key in a PKCS#12 file or in a PKCS#11 token, opened before any work is done."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, TypeAlias
from urllib.parse import unquote

from zlmreport.errors import AccessError, InputError, Place, did_you_mean
from zlmreport.files import read, reason

#: Of a key with its certificates, bytes.
_LARGEST = 1024 * 1024
#: Takes the bytes of a PDF, and what the signature is called in it for those who hear it read; returns the
#: signed PDF.
Signer: TypeAlias = Callable[[bytes, str], bytes]


@contextmanager
def open_signer(named: str, ask_password: Callable[[str], str], place: Place) -> Iterator[Signer]:
    """Open the key that a user names.

    Parameters
    ----------
    named
        A PKCS#12 file (``laboratory.p12``), or the address of a key in a PKCS#11 token (``pkcs11:…``).
    ask_password
        Returns the password of the file, or the PIN of the token; it is told what the password is of.
    place
        Where the key is named, for messages.

    Raises
    ------
    InputError
        If pyHanko is not installed, the password or the address is wrong, or the certificate is not valid
        today.
    AccessError
        If the file or the token cannot be read.
    """
    try:
        from zlmreport.signing.pades import Pades  # noqa: PLC0415 (brings pyHanko, an optional extra)
    except ImportError as error:
        raise InputError.at(
            place, f"signing needs pyHanko ({error}); install it: pip install 'zlmreport[sign]'"
        ) from error
    if named.startswith(SCHEME):
        uri = parse_token_uri(named, place)
        opened: AbstractContextManager[Any] = _in_token(uri, ask_password(f"token {uri.token}"), place)
    else:
        opened = nullcontext(_in_file(Path(named), ask_password, place))
    with opened as key:
        yield Pades(key, place)


def _valid(key: Any, named: str, place: Place) -> Any:
    """Return a key whose certificate is valid now: viewers refuse what any other has signed."""
    begin, end = key.signing_cert.not_valid_before, key.signing_cert.not_valid_after
    if not begin <= datetime.now(UTC) <= end:
        raise InputError.at(
            place, f"the certificate of {named} is valid from {begin:%Y-%m-%d} to {end:%Y-%m-%d}, not today"
        )
    return key


def _in_file(path: Path, ask_password: Callable[[str], str], place: Place) -> Any:
    from cryptography.hazmat.primitives.serialization import pkcs12  # noqa: PLC0415 (an optional extra)
    from pyhanko.sign.signers import SimpleSigner  # noqa: PLC0415 (an optional extra)

    try:
        content = read(path, _LARGEST)
    except OSError as error:
        raise AccessError.at(place, f"{path} cannot be read: {reason(error)}") from error
    password = ask_password(str(path)).encode() or None
    try:
        key, certificate, _ = pkcs12.load_key_and_certificates(content, password)
    except ValueError as error:
        raise InputError.at(
            place, f"{path} cannot be opened: either the password is wrong, or it is no PKCS#12 file"
        ) from error
    if key is None or certificate is None:
        raise InputError.at(place, f"{path} holds no key with its certificate; export both into it")
    return _valid(SimpleSigner.load_pkcs12_data(content, [], password), str(path), place)


@contextmanager
def _in_token(uri: TokenUri, pin: str, place: Place) -> Iterator[Any]:
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
            valid = _valid(key, f"token {uri.token}", place)
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
    """A key in a token.

    Attributes
    ----------
    module
        The driver: a shared library.
    token
        Label of the token.
    label
        Label of the key and its certificate.
    """

    module: Path
    token: str
    label: str


def parse_token_uri(text: str, place: Place) -> TokenUri:
    """Read an address.

    Raises
    ------
    InputError
        If it lacks a part, or has one that is not known here. A PIN in it is refused: everybody on the
        machine can read a command line.
    """
    found: dict[str, str] = {}
    for name, value in _attributes(text):
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


def _attributes(text: str) -> Iterator[tuple[str, str]]:
    path, _, query = text.removeprefix(SCHEME).partition("?")
    for attribute in (*path.split(";"), *query.split("&")):
        if attribute:
            name, _, value = attribute.partition("=")
            yield name, unquote(value)
