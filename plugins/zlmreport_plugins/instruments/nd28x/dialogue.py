"""The dialogue with a HEIDENHAIN display, byte by byte.

Source: the operating instructions of ND 287 (pages 102, 108, 130), ND 281B (pages 47, 61) and ND 522
(page 84). Commands are ``ESC xnnnn CR``; a single Ctrl-B asks for the displayed value in print.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum

ACK, NAK, STX, PRINT = b"\x06", b"\x15", b"\x02", b"\x02"


def command(name: str) -> bytes:
    """Return the bytes of a command such as ``A0200``."""
    return b"\x1b" + name.encode("ascii") + b"\r"


IDENTIFICATION = command("A0000")
CURRENT_POSITION = command("A0200")
ERROR_TEXT = command("A0301")


class PrintedUnit(StrEnum):
    """What the unit's place of a printed value holds."""

    MILLIMETRE = " "
    INCH = '"'
    FAULT = "?"


@dataclass(frozen=True, slots=True)
class Printed:
    """A printed value.

    Attributes
    ----------
    value
        As displayed, in the display's unit; a display may show a distance to go in place of a position.
    unit
        Its unit, or that it is no value.
    """

    value: float
    unit: PrintedUnit


#: STX, sign, 9 digits without a point, CR LF.
_POSITION = re.compile(rb"\x02([+-])([0-9]{9})\r\n")
#: Sign, 10 characters right-justified with a point, blank, unit, sort, series, CR LF.
_PRINT = re.compile(rb"([+ -])([ 0-9.]{10}) ([ \"?])[^\r\n]{2}\r\n")
_TEXT = re.compile(rb"\x02([^\r\n]*(?:\r\n[^\r\n]+)*)\r\n")
#: Of the last digit of a position, by unit: 0.0001 mm, 0.00001 inch.
STEPS_PER_UNIT = {PrintedUnit.MILLIMETRE: 1e4, PrintedUnit.INCH: 1e5}


def position_in(answer: bytes) -> int | None:
    """Return a current position (``A0200``) in steps of the display; None if the answer is no such thing."""
    found = _POSITION.fullmatch(answer)
    return int(found[1] + found[2]) if found else None


def printed_in(answer: bytes) -> Printed | None:
    """Return a printed value (Ctrl-B, ``F0200``); None if the answer is no such thing."""
    found = _PRINT.fullmatch(answer)
    if not found:
        return None
    unit = PrintedUnit(found[3].decode("ascii"))
    try:
        value = float((found[1] + found[2].replace(b" ", b"")).strip())
    except ValueError:
        if unit is not PrintedUnit.FAULT:
            return None
        value = float("nan")
    return Printed(value, unit)


def text_in(answer: bytes) -> str | None:
    """Return a text (``A0000``, ``A0301`` and others), its lines in one; None if the answer is not whole."""
    found = _TEXT.fullmatch(answer)
    return " ".join(found[1].decode("ascii", "replace").split()) if found else None
