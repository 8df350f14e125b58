"""An emulated instrument on a line, in real time."""

from __future__ import annotations

import time
from collections.abc import Callable
from random import Random

from zlmreport.emulation.channels import Channel
from zlmreport.emulation.emulator import Emulator
from zlmreport.emulation.faults import Trouble, Troubles

#: How often an instrument that sends unasked is looked after, s.
_BEAT = 0.01


def serve(
    emulator: Emulator,
    channel: Channel,
    troubles: Troubles,
    *,
    is_over: Callable[[], bool] = lambda: False,
    clock: Callable[[], float] = time.monotonic,
) -> None:
    """Let an emulated instrument speak on a line until it is unplugged, or it is over.

    The line is left to the caller to close.

    Parameters
    ----------
    emulator
        The instrument.
    channel
        The line.
    troubles
        What goes wrong: here, what goes wrong on the line.
    is_over
        Asked at every beat.
    clock
        Time in s; it begins anywhere.
    """
    start = clock()
    noise = Random(1)  # noqa: S311 - no secret
    while not is_over():
        channel.wait(_BEAT)
        now = clock() - start
        if troubles.has(Trouble.UNPLUGGED, now):
            return
        sent = emulator.unasked(now) + emulator.answer(channel.receive(), now)
        channel.send(_garbled(sent, noise) if troubles.has(Trouble.GARBLED, now) else sent)


def _garbled(data: bytes, noise: Random) -> bytes:
    """Return bytes as a bad line delivers them: one in five is another, or none."""
    found = bytearray()
    for byte in data:
        luck = noise.random()
        if luck < 0.1:
            continue
        found.append(byte ^ (1 << noise.randrange(7)) if luck < 0.2 else byte)
    return bytes(found)
