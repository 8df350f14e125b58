"""Displays that send lines of text: pattern and framing from the job, and an emulated one."""

from __future__ import annotations

import math
import re
import time
from collections.abc import Iterable, Iterator
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from zlmreport.plugin import MILLIMETRE, POSITION_UNITS, Options, Words, hookimpl, unit_named
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
    WholeLines,
    ask_instrument,
    readings_at_rate,
    streamed_readings,
    unreadable_reading,
)

#: A number with decimal point or comma, its sign apart or not, and a unit if it has one.
USUAL = r"(?P<value>[+-]?\s*\d+(?:[.,]\d+)?)\s*(?P<unit>mm|inch|in|µm|um|deg)?"


def _is_pattern(text: str) -> str:
    try:
        re.compile(text)
    except re.error as error:
        raise ValueError(f"{text!r} is no regular expression: {error}") from error
    return text


def _is_unit(text: str) -> str:
    unit_named(text, POSITION_UNITS)
    return text


Pattern = Annotated[str, AfterValidator(_is_pattern)]


class TextReadoutOptions(PolledOptions):
    """Where the readout is, and what its lines look like."""

    baud_rate: Annotated[int, Field(gt=0)] = Field(9600, description="Bits a second.")
    bits: Literal[7, 8] = Field(8, description="Data bits of a byte.")
    parity: Literal["none", "even", "odd"] = Field("none", description="Parity of a byte.")
    stop_bits: Literal[1, 2] = Field(1, description="Stop bits of a byte.")
    request: str = Field(
        "",
        description='What makes the readout send a line: "M?\\r". Without it the readout sends of its own '
        "accord, and 'rate' is of no matter.",
    )
    pattern: Pattern = Field(
        USUAL,
        description="Regular expression of a whole line, blanks around it apart, with a group 'value' and, "
        "if the readout writes its unit, a group 'unit'.",
    )
    unit: Annotated[str, AfterValidator(_is_unit)] = Field(
        "mm", description="Of the value, where the line names none: mm, µm, inch, deg, arcsec."
    )
    no_reading: tuple[Pattern, ...] = Field(
        ("(?i)err",),
        description="Regular expressions of which a line holds one if it says that there is no reading.",
    )

    @model_validator(mode="after")
    def _pattern_has_a_value(self) -> Self:
        if "value" not in re.compile(self.pattern).groupindex:
            raise ValueError("'pattern' needs a group (?P<value>…) around the number")
        return self

    @property
    def framing(self) -> Framing:
        """How bytes travel."""
        parity = {"none": "N", "even": "E", "odd": "O"}[self.parity]
        return Framing(self.baud_rate, self.bits, parity, self.stop_bits)  # type: ignore[arg-type]  # one of these


class TextDecoder:
    """Understands one readout."""

    def __init__(self, options: TextReadoutOptions) -> None:
        self.understood = 0  #: How many lines were readings, or said that there is none.
        self._options = options
        self._pattern = re.compile(options.pattern)
        self._no_reading = [re.compile(each) for each in options.no_reading]
        self._unit = unit_named(options.unit, POSITION_UNITS)
        self._lines = WholeLines()

    def feed(self, data: bytes, now: float) -> list[LiveReading]:
        """Return the readings of the lines that these bytes complete."""
        return [self.read_line(line, now) for line in self._lines.feed(data)]

    def read_line(self, line: bytes, now: float) -> LiveReading:
        """Return what one line says."""
        text = line.decode("utf-8", "replace").strip()
        if any(pattern.search(text) for pattern in self._no_reading):
            self.understood += 1
            return LiveReading(
                float("nan"),
                now,
                Fault.DEVICE_ERROR | Fault.BEAM_LOST,
                message=f"the readout says {text[:40]!r}: clear it there, then begin the run again",
            )
        value = self._read_value(text)
        if value is None:
            return LiveReading(
                float("nan"),
                now,
                Fault.UNREADABLE,
                message=f"{text[:40]!r} is no reading by the pattern",
            )
        self.understood += 1
        return LiveReading(value * self._options.factor, now)

    def _read_value(self, text: str) -> float | None:
        """Return the value in a line, SI; None if it is no reading."""
        found = self._pattern.fullmatch(text)
        if found is None or found["value"] is None:
            return None
        groups = found.groupdict()
        try:
            number = float("".join(groups["value"].split()).replace(",", "."))
            unit = unit_named(groups["unit"], POSITION_UNITS) if groups.get("unit") else self._unit
        except ValueError:
            return None
        return unit.to_si(number) if math.isfinite(number) else None


_RATE = 10.0


class TextEmulator:
    """A readout that watches an axis, in millimetres with four decimals."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._sent = 0

    def unasked(self, time: float) -> bytes:
        """Return the lines that are due."""
        lines = b""
        while (self._sent + 1) / _RATE <= time:
            self._sent += 1
            lines += self._write_line(self._sent / _RATE)
        return lines

    def answer(self, data: bytes, time: float) -> bytes:  # noqa: ARG002 - it takes no commands
        """Return nothing: it takes no commands."""
        return b""

    def _write_line(self, at: float) -> bytes:
        troubles = self._scene.troubles
        if troubles.has(Trouble.SKIPPED, at):
            return b""
        if troubles.has(Trouble.ERROR, at) or troubles.has(Trouble.LOST_BEAM, at):
            return b"Error\r\n"
        return b"%+.4f mm\r\n" % MILLIMETRE.from_si(self._scene.axis.position(at))


#: How long to wait for bytes, s.
_WAIT = 0.1


class TextReadout:
    """Any readout that sends a number in a line, unasked or on request: a display, a gauge, a counter.

    What a line looks like, the job says. Such lines have no checksum: a pattern that fits all of a line and
    nothing else keeps out most of what a bad cable delivers. A line that says that there is no reading
    counts as lost counts. There is no command for a zero.
    """

    identifier = "text-readout"
    title = Words("Any readout with a number a line")
    options: type[Options] = TextReadoutOptions

    def open(self, options: TextReadoutOptions) -> LiveConnection:
        """Open its port."""
        port = Port(options.port, options.framing, options.timeout)

        def readings() -> Iterator[LiveReading]:
            patience = Patience(
                port,
                options.timeout,
                "lines that the pattern fits",
                f"look at the pattern, and whether the readout is set to {options.framing}",
                time.monotonic(),
            )
            decoder = TextDecoder(options)
            if options.request:
                request = options.request.encode("utf-8")
                wait = options.timeout / 4
                return readings_at_rate(options.rate, lambda: _answer(port, request, decoder, patience, wait))
            port.drop_input()
            return streamed_readings(port, _WithoutFirst(decoder), patience, _WAIT)

        return LiveConnection(port, readings)

    def emulator(self, scene: Scene) -> Emulator:
        """Return one that sends ten values in millimetres a second."""
        return TextEmulator(scene)


class _WithoutFirst:
    """A decoder that leaves out the first line, which may have begun before the port was open."""

    def __init__(self, decoder: TextDecoder) -> None:
        self.understood = 0
        self._decoder = decoder
        self._is_first = True

    def feed(self, data: bytes, now: float) -> list[LiveReading]:
        """Return the readings of the lines after the first."""
        readings = self._decoder.feed(data, now)
        self.understood = self._decoder.understood
        if readings and self._is_first:
            self._is_first = False
            return readings[1:]
        return readings


def _answer(port: Port, request: bytes, decoder: TextDecoder, patience: Patience, wait: float) -> LiveReading:
    no_answer = {b"", request.strip()}  # some readouts send back what they are asked

    def find_line(arrived: bytes) -> tuple[bytes] | None:
        whole = (line for line in arrived.splitlines(keepends=True) if line.endswith((b"\r", b"\n")))
        return next(((line,) for line in whole if line.strip() not in no_answer), None)

    answer = ask_instrument(port, request, find_line, wait)
    now = time.monotonic()
    if isinstance(answer, bytes):
        patience.hear(answer, now)
        patience.check(now)
        return unreadable_reading(now, "the readout did not answer")
    understood = decoder.understood
    reading = decoder.read_line(answer[0], now)
    patience.hear(answer[0], now)
    if decoder.understood != understood:
        patience.understand(now)
    patience.check(now)
    return reading


@hookimpl
def zlmreport_instruments() -> Iterable[Instrument]:
    """Return the readout."""
    return [TextReadout()]
