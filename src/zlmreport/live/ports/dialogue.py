"""Questions and answers of an instrument, their rhythm, and after how long a silence it is given up."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Protocol, TypeVar

from zlmreport.live.ports.clock import ArrivalClock
from zlmreport.live.ports.port import Port, show_beginning
from zlmreport.live.ports.reading import Fault, LiveReading

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


#: Nonsense from an instrument that was understood before comes from a bad line: it gets so many times longer.
_BAD_LINE = 5


class Patience:
    """Watches what arrives, and ends the wait with a message that says what to look at.

    Parameters
    ----------
    port
        Where the instrument is.
    timeout
        How long it may be silent, or send what is not understood before anything was, s.
    expected
        What should come: ``lines of a µMD1``.
    advice
        What to look at if something else comes: ``name the instrument that it is``.
    now
        The time, s.
    """

    def __init__(self, port: Port, timeout: float, expected: str, advice: str, now: float) -> None:
        self._port = port
        self._timeout = timeout
        self._expected = expected
        self._advice = advice
        self._heard_at = now
        self._understood_at = now
        self._has_understood = False
        self._nonsense = b""

    def hear(self, data: bytes, now: float) -> None:
        """Take note of what arrived, before it is known what it is."""
        if data:
            self._heard_at = now
            self._nonsense = (self._nonsense + data)[:100]

    def understand(self, now: float) -> None:
        """Take note that it made sense."""
        self._understood_at = now
        self._has_understood = True
        self._nonsense = b""

    def check(self, now: float) -> None:
        """Raise an `AccessError` if the instrument has had its time.

        `now`: When it was looked at last, s: time in which the computer did something else is not its own.
        """
        seconds = f"{self._timeout:g} s"
        if now - max(self._heard_at, self._understood_at) >= self._timeout:
            happened = "has stopped sending" if self._has_understood else "sends nothing"
            self._port.fail(
                f"the instrument {happened}: {self._expected} should have come within {seconds}; "
                "look at its cable, its power and its settings for the interface"
            )
        longest = self._timeout * (_BAD_LINE if self._has_understood else 1)
        if now - self._understood_at < longest:
            return
        self._port.fail(
            f"what arrives are no {self._expected}: {show_beginning(self._nonsense)}; {self._advice}"
        )


class WrongDeviceError(Exception):
    """What arrives is understood, and shows that it is another instrument than the one that was named."""


class Decoder(Protocol):
    """Bytes to readings, without a port: so that every documented line can be tried."""

    understood: int  #: How many lines made sense so far, those among them that hold no reading.

    def feed(self, data: bytes, now: float) -> Sequence[LiveReading]:
        """Return the readings that these bytes complete; `now` is when they arrived, s.

        Raises `WrongDeviceError` if it is another instrument; the text says which, or what to do.
        """


def stream(port: Port, decoder: Decoder, patience: Patience, wait: float) -> Iterator[LiveReading]:
    """Yield readings as they arrive, without end.

    A decoder that knows no better gives each reading the time at which its bytes were read; such readings get
    that of an `ArrivalClock`.

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
    clock = ArrivalClock()
    while True:
        data = port.read(wait)
        now = time.monotonic()
        patience.hear(data, now)
        try:
            readings = decoder.feed(data, now)
        except WrongDeviceError as error:
            port.fail(str(error))
        if readings and all(reading.time == now for reading in readings):
            readings = clock.stamp(readings, now, port.empty_at)
        if decoder.understood != understood:
            understood = decoder.understood
            patience.understand(now)
        yield from readings
        patience.check(now if data else port.empty_at)


Answer = TypeVar("Answer")


def ask(
    port: Port, request: bytes, understood: Callable[[bytes], Answer | None], wait: float
) -> Answer | bytes:
    """Send a question and return its answer.

    Parameters
    ----------
    port
        Where the instrument is. What is still in it is the answer to an earlier question, and is dropped.
    request
        The question.
    understood
        Returns the answer in what has arrived so far, or None if it is not whole yet.
    wait
        How long to wait for the whole, s.

    Returns
    -------
    Answer or bytes
        What `understood` makes of it; in its place the bytes that came if they never became an answer.
    """
    port.drop_input()
    port.write(request)
    arrived = b""
    until = time.monotonic() + wait
    left = wait
    while True:
        arrived += port.read(max(0.0, left))
        answer = understood(arrived)
        if answer is not None:
            return answer
        if left <= 0:  # looked at once more: where the computer was late, the answer may wait there
            return arrived
        left = until - time.monotonic()


def ask_at_rate(rate: float, question: Callable[[], LiveReading]) -> Iterator[LiveReading]:
    """Yield the answers to a question that is put at a rate, without end.

    An instrument that is slower, or a caller that is, gets no burst of questions afterwards. A reading was
    taken between its question and its time.

    Parameters
    ----------
    rate
        1/s.
    question
        Asks, and returns the reading.
    """
    due = time.monotonic()
    while True:
        asked = time.monotonic()
        reading = question()
        yield replace(reading, within=max(0.0, reading.time - asked))
        due = max(due + 1 / rate, time.monotonic())
        time.sleep(max(0.0, due - time.monotonic()))


def make_unreadable(now: float, message: str) -> LiveReading:
    """Return what stands for a reading that was not understood."""
    return LiveReading(float("nan"), now, Fault.UNREADABLE, message=message)
