"""Whose signatures are trusted: certificates that the user names, or an authority that issued them."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import yaml

from zlmreport.errors import AccessError, InputError, Place, did_you_mean
from zlmreport.files import read, reason

#: Of a file of certificates, bytes: the authorities of all the world take less.
_LARGEST = 16 * 1024 * 1024
_ENDINGS = frozenset({".cer", ".crt", ".der", ".pem"})
_CONFIGURATION = Path("zlmreport", "config.yaml")
_KEY = "trusted"


def trusted_certificates(path: Path, place: Place) -> tuple[Any, ...]:
    """Return the certificates of a file, or of all files in a folder, in the terms of asn1crypto.

    Parameters
    ----------
    path
        A certificate, PEM or DER, or several in one file (PEM); or a folder of such files, those that end in
        ``.pem``, ``.crt``, ``.cer`` or ``.der``.
    place
        Where it is named, for messages.

    Raises
    ------
    AccessError
        If it cannot be read.
    InputError
        If it is no certificate, or a folder without one; or if pyHanko is not installed.
    """
    try:
        files = (
            sorted(each for each in path.iterdir() if each.suffix in _ENDINGS) if path.is_dir() else [path]
        )
        contents = [(each, read(each, _LARGEST)) for each in files]
    except OSError as error:
        raise AccessError.at(place, f"{path} cannot be read: {reason(error)}") from error
    if not contents:
        endings = ", ".join(sorted(_ENDINGS))
        raise InputError.at(
            place, f"{path} holds no certificate: no file whose name ends in one of {endings}"
        )
    return tuple(each for file, content in contents for each in _certificates(file, content, place))


def _certificates(file: Path, content: bytes, place: Place) -> list[Any]:
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


def trusted_by_user(environment: Mapping[str, str] = os.environ) -> Path | None:
    """Return what the user's configuration names as trusted; None if it names nothing.

    The configuration is ``zlmreport/config.yaml`` in ``$XDG_CONFIG_HOME`` or else in ``~/.config``, with the
    one key `trusted`: a file or a folder, relative to the configuration.

    Raises
    ------
    AccessError, InputError
        If it cannot be read, or has another key.
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


def is_trusted(signer: Any, others: Sequence[Any], trusted: Sequence[Any], moment: datetime | None) -> bool:
    """Whether a signer's certificate is trusted, or was issued by an authority that is.

    Nothing is fetched from anywhere: whether a certificate was revoked is not asked.

    Parameters
    ----------
    signer, others
        The certificate, and others that the signature carries, in the terms of asn1crypto.
    trusted
        The certificates that are trusted.
    moment
        When it was signed: both must be valid then. None for now.
    """
    from pyhanko_certvalidator import CertificateValidator, ValidationContext  # noqa: PLC0415 (optional)
    from pyhanko_certvalidator.errors import (  # noqa: PLC0415 (optional)
        PathBuildingError,
        PathValidationError,
        ValidationError,
    )

    when = moment or datetime.now(UTC)
    if not signer.not_valid_before <= when <= signer.not_valid_after:
        return False
    if signer.sha256 in {each.sha256 for each in trusted}:
        return True
    context = ValidationContext(
        trust_roots=list(trusted), other_certs=list(others), moment=when, allow_fetching=False
    )
    validator: Any = CertificateValidator(signer, intermediate_certs=list(others), validation_context=context)
    try:
        asyncio.run(validator.async_validate_usage(set()))
    except (PathBuildingError, PathValidationError, ValidationError):
        return False
    return True
