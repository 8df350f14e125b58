"""The live instrument ``nd28x``."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from zlmreport.plugin import (
    INCH,
    MILLIMETRE,
    Emulator,
    Fault,
    Framing,
    LiveConnection,
    LiveReading,
    Options,
    Patience,
    PolledOptions,
    Port,
    Scene,
    Words,
    ask_instrument,
    readings_at_rate,
    unreadable_reading,
)
from zlmreport_plugins.instruments.nd28x import dialogue
from zlmreport_plugins.instruments.nd28x.dialogue import PrintedUnit
from zlmreport_plugins.instruments.nd28x.emulator import Nd28xEmulator

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
    title = Words(en="HEIDENHAIN position display ND 28x", de="HEIDENHAIN-Positionsanzeige ND 28x")
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
            return readings_at_rate(options.rate, lambda: _reading(port, options, patience))

        return LiveConnection(port, readings)

    def emulator(self, scene: Scene) -> Emulator:
        """Return one that shows millimetres."""
        return Nd28xEmulator(scene)


def _reading(port: Port, options: Nd28xOptions, patience: Patience) -> LiveReading:
    """Ask for a reading."""
    wait = options.timeout / 8 + _BITS / options.baud_rate
    position = ask_instrument(port, dialogue.CURRENT_POSITION, dialogue.position_in, wait)
    now = time.monotonic()
    printed = ask_instrument(port, dialogue.PRINT, dialogue.printed_in, wait)
    heard_at = time.monotonic()
    for answer in (position, printed):
        if isinstance(answer, bytes):
            patience.hear(answer, heard_at)
    if isinstance(printed, bytes):
        patience.check(heard_at)
        return unreadable_reading(now, "the display did not answer, or not clearly")
    if printed.unit is PrintedUnit.FAULT:
        patience.understand(heard_at)
        text = ask_instrument(port, dialogue.ERROR_TEXT, dialogue.text_in, wait)
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
    in_unit = position / dialogue.STEPS_PER_UNIT[printed.unit]
    return LiveReading(_UNITS[printed.unit].to_si(in_unit) * options.factor, now)
