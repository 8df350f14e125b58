"""Bytes to lines."""

from __future__ import annotations

import re

_END = re.compile(rb"[\r\n]+")


class Lines:
    """Collects bytes as they arrive, and hands out the lines that are whole.

    Parameters
    ----------
    longest
        Beyond so many bytes without an end it is no line, and they are handed out as they are: so a wrong
        baud rate fills no memory.
    """

    def __init__(self, longest: int = 1000) -> None:
        self._longest = longest
        self._rest = b""

    def feed(self, data: bytes) -> list[bytes]:
        """Return the lines that end in these bytes, without their ends; empty ones are left out."""
        *whole, self._rest = _END.split(self._rest + data)
        if len(self._rest) > self._longest:
            whole.append(self._rest)
            self._rest = b""
        return [line for line in whole if line]
