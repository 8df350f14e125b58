"""The live instrument ``text-readout``."""

from __future__ import annotations

import time
from collections.abc import Iterator

from zlmreport.plugin import (
    Emulator,
    LiveConnection,
    LiveReading,
    Options,
    Patience,
    Port,
    Scene,
    Words,
    ask_instrument,
    readings_at_rate,
    streamed_readings,
    unreadable_reading,
)
from zlmreport_plugins.instruments.text_readout.decoder import TextDecoder
from zlmreport_plugins.instruments.text_readout.emulator import TextEmulator
from zlmreport_plugins.instruments.text_readout.options import TextReadoutOptions

#: How long to wait for bytes, s.
_WAIT = 0.1


class TextReadout:
    """Any readout that sends a number in a line, unasked or on request: a display, a gauge, a counter.

    What a line looks like, the job says. Such lines have no checksum: a pattern that fits all of a line and
    nothing else keeps out most of what a bad cable delivers. A line that says that there is no reading
    counts as lost counts. There is no command for a zero.
    """

    identifier = "text-readout"
    title = Words(en="Any readout with a number a line", de="Jede Anzeige mit einer Zahl je Zeile")
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
    """Ask for a line, and return what it says."""

    def line_in(arrived: bytes) -> tuple[bytes] | None:
        whole = arrived.lstrip(b"\r\n").splitlines(keepends=True)
        return (whole[0],) if whole and whole[0].endswith((b"\r", b"\n")) else None

    answer = ask_instrument(port, request, line_in, wait)
    now = time.monotonic()
    if isinstance(answer, bytes):
        patience.hear(answer, now)
        patience.check(now)
        return unreadable_reading(now, "the readout did not answer")
    understood = decoder.understood
    reading = decoder.reading(answer[0], now)
    patience.hear(answer[0], now)
    if decoder.understood != understood:
        patience.understand(now)
    patience.check(now)
    return reading
