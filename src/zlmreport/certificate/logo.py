"""The laboratory's logo: read once, recognised by its bytes, bounded in size."""

from __future__ import annotations

from pathlib import Path

from zlmreport.errors import AccessError, InputError, Place

_LARGEST = 2 * 1024 * 1024
_SIGNATURES = ((b"\x89PNG\r\n\x1a\n", "image/png"), (b"\xff\xd8\xff", "image/jpeg"))


def read_logo(path: Path, place: Place) -> tuple[bytes, str]:
    """Return the logo's bytes and media type.

    Parameters
    ----------
    path
        The file.
    place
        Where the job names it, for messages.

    Raises
    ------
    AccessError
        If it cannot be read.
    InputError
        If it is too large, or neither PNG nor JPEG: formats that hold a picture and nothing else.
    """
    try:
        with path.open("rb") as file:
            content = file.read(_LARGEST + 1)
    except OSError as error:
        raise AccessError.at(place, f"the logo {path} cannot be read: {error.strerror or error}") from error
    if len(content) > _LARGEST:
        raise InputError.at(
            place, f"the logo {path.name} is larger than 2 MiB; a logo of some 100 kB prints as well"
        )
    for signature, media_type in _SIGNATURES:
        if content.startswith(signature):
            return content, media_type
    raise InputError.at(place, f"the logo {path.name} is neither PNG nor JPEG; save it as one of them")
