"""The format and the size of a picture, read from its first bytes without unpacking it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Picture:
    """What a file says of the picture in it.

    Attributes
    ----------
    media_type
        ``image/png`` or ``image/jpeg``.
    width, height
        In pixels; 0 where the file does not say, and so is damaged.
    for_printing_press
        Whether its colours are those of inks (CMYK).
    """

    media_type: str
    width: int = 0
    height: int = 0
    for_printing_press: bool = False


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
