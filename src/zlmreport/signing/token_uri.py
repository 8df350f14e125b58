"""The address of a key in a PKCS#11 token, in the manner of RFC 7512.

``pkcs11:token=Laboratory;object=Signature?module-path=/usr/lib/softhsm/libsofthsm2.so``
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote

from zlmreport.errors import InputError, Place, did_you_mean

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
