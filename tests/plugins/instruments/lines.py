"""Emulated instruments on a pseudo-terminal, and what is read from them."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import islice
from typing import Any

from processes import PATIENCE
from zlmreport.live.emulation.channels import PseudoTerminal, serve
from zlmreport.live.emulation.troubles import Troubles
from zlmreport.plugin.instrument import Emulator, LiveReading
from zlmreport.plugin.protocols import Instrument


@contextmanager
def plugged_in(
    emulator: Emulator, begins_at: float = 0.0, clock: Callable[[], float] | None = None
) -> Iterator[str]:
    """Put an emulated instrument on a pseudo-terminal; yield its path.

    Its time begins at `begins_at`, s, and goes on from there; or it is that of a clock.
    """
    ended = threading.Event()
    channel = PseudoTerminal()
    started = time.monotonic()
    first = [0.0]

    def own_clock() -> float:
        """Return the time since the start, the first time 0: `serve` counts from what it is told first."""
        return first.pop() if first else time.monotonic() - started + begins_at

    def run() -> None:
        with channel:
            serve(emulator, channel, Troubles(), is_over=ended.is_set, clock=clock or own_clock)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    try:
        yield channel.address
    finally:
        ended.set()
        thread.join(PATIENCE)


def readings_of(instrument: Instrument, port: str, count: int, **keys: Any) -> list[LiveReading]:
    """Return the first readings of an instrument at a port."""
    with instrument.open(instrument.options.model_validate({"port": port, **keys})) as connection:
        return list(islice(connection.readings(), count))
