"""The streams of a PDF, unpacked as they are: what is damaged is refused, and what has no end is cut off."""

from __future__ import annotations

import zlib
from typing import Any


class DamagedError(ValueError):
    """A stream that cannot be unpacked to its end; pypdf would mend it as well as it can, and say nothing."""


class TooLargeError(ValueError):
    """A stream that unpacks to more than is allowed."""


def unpacked(stream: Any, most: int) -> bytes:
    """Return the bytes of a stream of pypdf.

    Parameters
    ----------
    stream
        The stream.
    most
        Bytes that it may unpack to.

    Raises
    ------
    DamagedError
        If it is damaged.
    TooLargeError
        If it unpacks to more.
    """
    from pypdf.errors import LimitReachedError  # noqa: PLC0415 - slow to load

    packing = stream.get("/Filter")
    if packing in ("/FlateDecode", ["/FlateDecode"]) and "/DecodeParms" not in stream:
        unpacker = zlib.decompressobj()
        try:
            content = unpacker.decompress(stream._data, most + 1)  # noqa: SLF001 - only packed bytes tell damage
        except zlib.error as error:
            raise DamagedError(f"a stream cannot be unpacked: {error}") from error
        if len(content) <= most and not unpacker.eof:
            raise DamagedError("a stream ends before its end")
    else:
        try:
            content = stream.get_data()
        except LimitReachedError as error:
            raise TooLargeError from error
        content = content if isinstance(content, bytes) else content.encode("utf-8", "replace")
    if len(content) > most:
        raise TooLargeError
    return content
