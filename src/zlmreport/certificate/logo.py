"""The laboratory's logo: read once, recognised by its bytes, bounded in size."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from zlmreport.certificate.picture import describe
from zlmreport.errors import AccessError, InputError, Place
from zlmreport.measurement.provenance import SourceFile

_LARGEST = 2 * 1024 * 1024
#: A few bytes can stand for a picture that fills the memory.
_MOST_PIXELS = 16_000_000


@dataclass(frozen=True, slots=True)
class Logo:
    """A picture as it was read, and its media type."""

    file: SourceFile
    media_type: str


def read_logo(path: Path, place: Place) -> Logo:
    """Return the logo.

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
        If it is too large, or neither PNG nor JPEG: formats that hold a picture and nothing else. If its
        colours are those of a printing press, for which an archived document has no meaning.
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
    picture = describe(content)
    if picture is None:
        raise InputError.at(place, f"the logo {path.name} is neither PNG nor JPEG; save it as one of them")
    pixels = picture.width * picture.height
    if not pixels:
        raise InputError.at(place, f"the logo {path.name} is damaged; save it again")
    if pixels > _MOST_PIXELS:
        raise InputError.at(
            place,
            f"the logo {path.name} has {picture.width} by {picture.height} pixels; 2000 by 1000 are plenty",
        )
    if picture.for_printing_press:
        raise InputError.at(
            place, f"the logo {path.name} is in CMYK colours, for a printing press; save it in RGB colours"
        )
    return Logo(SourceFile.of(path, content), picture.media_type)
