"""Instruments that answer questions."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import TypeVar

from zlmreport.live.port import Port
from zlmreport.live.reading import Fault, LiveReading

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
    while (left := until - time.monotonic()) > 0:
        arrived += port.read(left)
        answer = understood(arrived)
        if answer is not None:
            return answer
    return arrived


def at_rate(rate: float, question: Callable[[], LiveReading]) -> Iterator[LiveReading]:
    """Yield the answers to a question that is put at a rate, without end.

    An instrument that is slower, or a caller that is, gets no burst of questions afterwards.

    Parameters
    ----------
    rate
        1/s.
    question
        Asks, and returns the reading.
    """
    due = time.monotonic()
    while True:
        yield question()
        due = max(due + 1 / rate, time.monotonic())
        time.sleep(max(0.0, due - time.monotonic()))


def unreadable(now: float, message: str) -> LiveReading:
    """Return what stands for a reading that was not understood."""
    return LiveReading(float("nan"), now, Fault.UNREADABLE, message=message)
