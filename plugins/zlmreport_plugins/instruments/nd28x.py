"""HEIDENHAIN ND 28x displays: their questions and answers, and an emulated one."""

from __future__ import annotations

import re
import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

from pydantic import Field

from zlmreport.plugin import INCH, MILLIMETRE, Options, Words, hookimpl
from zlmreport.plugin.instrument import (
    Emulator,
    Fault,
    Framing,
    Instrument,
    LiveConnection,
    LiveReading,
    Patience,
    PolledOptions,
    Port,
    Scene,
    Trouble,
    ask_instrument,
    readings_at_rate,
    unreadable_reading,
)

ACK, NAK, STX, PRINT = b"\x06", b"\x15", b"\x02", b"\x02"


def write_command(name: str) -> bytes:
    """Return the bytes of a command such as ``A0200``."""
    return b"\x1b" + name.encode("ascii") + b"\r"


IDENTIFICATION = write_command("A0000")
CURRENT_POSITION = write_command("A0200")
ERROR_TEXT = write_command("A0301")


class PrintedUnit(StrEnum):
    """What the unit's place of a printed value holds."""

    MILLIMETRE = " "
    INCH = '"'
    FAULT = "?"


@dataclass(frozen=True, slots=True)
class Printed:
    """A printed value."""

    #: As displayed, in the display's unit; a display may show a distance to go in place of a position.
    value: float
    unit: PrintedUnit  #: Its unit, or that it is no value.


#: STX, sign, 9 digits without a point, CR LF.
_POSITION = re.compile(rb"\x02([+-])([0-9]{9})\r\n")
#: Sign, 10 characters right-justified with a point, blank, unit, sort, series, CR LF.
_PRINT = re.compile(rb"([+ -])([ 0-9.]{10}) ([ \"?])[^\r\n]{2}\r\n")
_TEXT = re.compile(rb"\x02([^\r\n]*(?:\r\n[^\r\n]+)*)\r\n")
#: Of the last digit of a position, by unit: 0.0001 mm, 0.00001 inch.
STEPS_PER_UNIT = {PrintedUnit.MILLIMETRE: 1e4, PrintedUnit.INCH: 1e5}


def find_position_in(answer: bytes) -> int | None:
    """Return a current position (``A0200``) in steps of the display; None if the answer is no such thing."""
    found = _POSITION.fullmatch(answer)
    return int(found[1] + found[2]) if found else None


def find_printed_in(answer: bytes) -> Printed | None:
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


def find_text_in(answer: bytes) -> str | None:
    """Return a text (``A0000``, ``A0301`` and others), its lines in one; None if the answer is not whole."""
    found = _TEXT.fullmatch(answer)
    return " ".join(found[1].decode("ascii", "replace").split()) if found else None


_COMMAND = re.compile(rb"\x1b([A-Z][0-9]{4})\r|\x02|\x1b[^\r]*\r|[^\x1b\x02]")
#: The key CL.
_CLEAR = b"T0100"
_HELD, _GO_ON = b"\x13", b"\x11"
#: Texts of the display, of which the manuals give the form and not the words.
_TEXTS: Mapping[bytes, bytes] = {
    b"A0000": b"ND-287    \r\n646118-01 \r\nV1-01     ",
    b"A0400": b"646118-01 ",
    b"A0800": b"0 0 0 0 0 0 0 0",
    b"A0900": b"0 0 0 0 0 0",
}
#: An error text has 33 characters; without an error they are blank.
_ERROR_WIDTH = 33


class Nd28xEmulator:
    """A display that watches an axis, in millimetres."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._rest = b""
        self._cleared_at = -1.0

    def unasked(self, time: float) -> bytes:  # noqa: ARG002 - it speaks when it is asked
        """Return nothing: it speaks when it is asked."""
        return b""

    def answer(self, data: bytes, time: float) -> bytes:
        """Return its answers to the commands that are whole."""
        data = (self._rest + data).replace(_HELD, b"").replace(_GO_ON, b"")
        answers = b""
        end = 0
        while found := _COMMAND.match(data, end):
            end = found.end()
            if found[0] == PRINT:
                answers += self._print_value(time)
            elif found[0].startswith(b"\x1b"):
                answers += self._answer_command(found[1] or b"", time)
        self._rest = data[end:][:20]
        return b"" if self._scene.troubles.has(Trouble.SKIPPED, time) else answers

    def _answer_command(self, name: bytes, time: float) -> bytes:
        if name in _TEXTS:
            return STX + _TEXTS[name] + b"\r\n"
        if name == b"A0100":
            return STX + b"%10.4f\r\n" % self._round_shown(time)
        if name == b"A0200":
            return STX + b"%+010d\r\n" % round(self._round_shown(time) * 1e4)
        if name == b"A0301":
            text = b"Signal fault X1" if self._has_fault(time) else b""
            return STX + text.ljust(_ERROR_WIDTH) + b"\r\n"
        if name == b"F0200":
            return self._print_value(time)
        if name == _CLEAR:
            self._cleared_at = time
        return ACK if name[:1] in {b"F", b"S", b"T"} else NAK

    def _print_value(self, time: float) -> bytes:
        shown = self._round_shown(time)
        sign = b"-" if shown < 0 else b" "
        unit = b"?" if self._has_fault(time) else b" "
        return sign + b"%10.4f" % abs(shown) + b" " + unit + b"  \r\n"

    def _has_fault(self, time: float) -> bool:
        """Return whether it shows a fault: it does until somebody clears it."""
        troubles = self._scene.troubles
        return any(
            troubles.begins(trouble, self._cleared_at, time) for trouble in (Trouble.ERROR, Trouble.LOST_BEAM)
        )

    def _round_shown(self, time: float) -> float:
        """Return what it shows, mm: whole tenths of a micrometre."""
        return round(MILLIMETRE.from_si(self._scene.axis.position(time)), 4) + 0.0


#: Bits on the line of a question and its answer: 7 and 42 characters at most, of 11 bits each.
_BITS = 49 * 11
_UNITS = {PrintedUnit.MILLIMETRE: MILLIMETRE, PrintedUnit.INCH: INCH}


class Nd28xOptions(PolledOptions):
    """Where the display is."""

    baud_rate: Literal[110, 150, 300, 600, 1200, 2400, 4800, 9600, 19_200, 38_400, 57_600, 115_200] = Field(
        9600, description="As it is set in the display."
    )


class Nd28x:
    """A HEIDENHAIN position display of the family ND 281B, 221B, 231B, 7xx, 28x.

    With it, any encoder of 11 µA or 1 Vpp measures an axis: a comparator system, a length gauge. It answers
    questions, with 7 data bits, even parity and 2 stop bits. Each reading is the current position and after
    it the displayed value in print, whose unit tells a fault: so a fault at any time up to the position is
    seen. Then the error text is asked for. Linear encoders only: how a display answers for an angle encoder
    is not documented well enough.

    After a fault the counts are taken as lost. A display has no command that is documented to set it to zero.
    """

    identifier = "nd28x"
    title = Words("HEIDENHAIN position display ND 28x")
    options: type[Options] = Nd28xOptions

    def open(self, options: Nd28xOptions) -> LiveConnection:
        """Open its port."""
        framing = Framing(options.baud_rate, bits=7, parity="E", stop_bits=2)
        port = Port(options.port, framing, options.timeout)

        def readings() -> Iterator[LiveReading]:
            patience = Patience(
                port,
                options.timeout,
                "answers of a HEIDENHAIN display",
                f"look whether its interface is set to {framing}",
                time.monotonic(),
            )
            return readings_at_rate(options.rate, lambda: _ask_for_reading(port, options, patience))

        return LiveConnection(port, readings)

    def emulator(self, scene: Scene) -> Emulator:
        """Return one that shows millimetres."""
        return Nd28xEmulator(scene)


def _ask_for_reading(port: Port, options: Nd28xOptions, patience: Patience) -> LiveReading:
    wait = options.timeout / 8 + _BITS / options.baud_rate
    position = ask_instrument(port, CURRENT_POSITION, find_position_in, wait)
    now = time.monotonic()
    printed = ask_instrument(port, PRINT, find_printed_in, wait)
    heard_at = time.monotonic()
    for answer in (position, printed):
        if isinstance(answer, bytes):
            patience.hear(answer, heard_at)
    if isinstance(printed, bytes):
        patience.check(heard_at)
        return unreadable_reading(now, "the display did not answer, or not clearly")
    if printed.unit is PrintedUnit.FAULT:
        patience.understand(heard_at)
        text = ask_instrument(port, ERROR_TEXT, find_text_in, wait)
        said = f" ({text})" if isinstance(text, str) and text else ""
        return LiveReading(
            float("nan"),
            now,
            Fault.DEVICE_ERROR | Fault.BEAM_LOST,
            message=f"the display reports a fault{said}: clear it there, look at the encoder's signal, "
            "then begin the run again",
        )
    if isinstance(position, bytes):
        patience.check(heard_at)
        return unreadable_reading(now, "the display did not answer, or not clearly")
    patience.understand(heard_at)
    in_unit = position / STEPS_PER_UNIT[printed.unit]
    return LiveReading(_UNITS[printed.unit].to_si(in_unit) * options.factor, now)


@hookimpl
def zlmreport_instruments() -> Iterable[Instrument]:
    """Return the displays."""
    return [Nd28x()]
