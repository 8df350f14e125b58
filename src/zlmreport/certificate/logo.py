"""The laboratory's logo: read once, recognised by its first bytes without unpacking it, bounded in size."""

from __future__ import annotations

from pathlib import Path

from zlmreport.errors import AccessError, InputError, Place
from zlmreport.files import read, reason
from zlmreport.measurement.provenance import SourceFile
from zlmreport.values import dataclass

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

    Raises `AccessError` if it cannot be read; `InputError` if it is too large, or neither PNG nor JPEG:
    formats that hold a picture and nothing else. If its colours are those of a printing press, for which an
    archived document has no meaning.
    """
    try:
        content = read(path, _LARGEST)
    except OSError as error:
        raise AccessError.at(place, f"the logo {path} cannot be read: {reason(error)}") from error
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


@dataclass(frozen=True, slots=True)
class Picture:
    """What a file says of the picture in it."""

    media_type: str  #: ``image/png`` or ``image/jpeg``.
    #: width and height: In pixels; 0 where the file does not say, and so is damaged.
    width: int = 0
    height: int = 0
    for_printing_press: bool = False  #: Whether its colours are those of inks (CMYK).


def describe(content: bytes) -> Picture | None:
    """Return what there is to say of a picture; None for what is neither PNG nor JPEG."""
    if content.startswith(b"\x89PNG\r\n\x1a\n"):
        return _png(content)
    if content.startswith(b"\xff\xd8\xff"):
        return _jpeg(content)
    return None


def _png(content: bytes) -> Picture:
    """Read the header (ISO/IEC 15948), which comes first and knows no inks."""
    if content[12:16] != b"IHDR":
        return Picture("image/png")
    return Picture("image/png", int.from_bytes(content[16:20]), int.from_bytes(content[20:24]))


def _jpeg(content: bytes) -> Picture:
    """Read the first header of a frame (ISO/IEC 10918-1, B.2.2): C0 to CF, but for C4, C8 and CC."""
    place = 2
    while content[place : place + 1] == b"\xff" and place + 10 <= len(content):
        marker = content[place + 1]
        if 0xC0 <= marker <= 0xCF and marker not in {0xC4, 0xC8, 0xCC}:
            height = int.from_bytes(content[place + 5 : place + 7])
            width = int.from_bytes(content[place + 7 : place + 9])
            return Picture("image/jpeg", width, height, for_printing_press=content[place + 9] == 4)
        place += 2 + int.from_bytes(content[place + 2 : place + 4])
    return Picture("image/jpeg")
