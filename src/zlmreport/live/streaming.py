"""Instruments that send unasked."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from typing import Protocol

from zlmreport.live.patience import Patience
from zlmreport.live.port import Port
from zlmreport.live.reading import LiveReading


class WrongDeviceError(Exception):
    """What arrives is understood, and shows that it is another instrument than the one that was named."""


class Decoder(Protocol):
    """Bytes to readings, without a port: so that every documented line can be tried.

    Attributes
    ----------
    understood
        How many lines made sense so far, those among them that hold no reading.
    """

    understood: int

    def feed(self, data: bytes, now: float) -> Sequence[LiveReading]:
        """Return the readings that these bytes complete; `now` is when they arrived, s.

        Raises
        ------
        WrongDeviceError
            If it is another instrument; the text says which, or what to do.
        """


def streamed(port: Port, decoder: Decoder, patience: Patience, wait: float) -> Iterator[LiveReading]:
    """Yield readings as they arrive, without end.

    Parameters
    ----------
    port
        Where the instrument is.
    decoder
        What understands it.
    patience
        When to give up.
    wait
        How long to wait for bytes before looking at that again, s.
    """
    understood = decoder.understood
    while True:
        data = port.read(wait)
        now = time.monotonic()
        patience.hear(data, now)
        try:
            readings = decoder.feed(data, now)
        except WrongDeviceError as error:
            port.fail(str(error))
        if decoder.understood != understood:
            understood = decoder.understood
            patience.understand(now)
        yield from readings
        patience.check(now)
