"""A reader that only stores: whoever is late finds everything."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from itertools import count, islice

import pytest

from processes import PATIENCE
from zlmreport.live.ports.ahead import ReadAhead
from zlmreport.plugin import AccessError, Place
from zlmreport.plugin.instrument import Framing, LiveReading, Port


def _readings(number: int) -> Iterator[LiveReading]:
    return (LiveReading(float(each), each / 1000) for each in range(number))


def test_thirty_seconds_of_readings_wait_for_who_is_late_and_then_what_the_instrument_failed_with() -> None:
    stored = threading.Event()

    def readings() -> Iterator[LiveReading]:
        yield from _readings(30_000)
        stored.set()
        raise AccessError.at(Place("the port"), "the instrument is gone")

    ahead = ReadAhead(readings())
    assert stored.wait(PATIENCE)  # nobody has asked for one yet
    assert list(islice(ahead, 30_000)) == list(_readings(30_000))
    for _ in range(2):
        with pytest.raises(AccessError, match="is gone"):
            next(ahead)


def test_an_end_of_the_readings_is_an_end() -> None:
    assert len(list(ReadAhead(_readings(5)))) == 5


def test_after_the_end_nobody_reads_the_instrument() -> None:
    read = count()
    ahead = ReadAhead(LiveReading(0.0, float(next(read))) for _ in count())
    next(ahead)
    ahead.end()
    so_far = next(read)
    assert next(read) == so_far + 1


def test_who_gives_up_leaves_nobody_at_the_instrument() -> None:
    before = threading.active_count()
    ahead = ReadAhead(LiveReading(0.0, float(each)) for each in count())
    next(ahead)
    ahead.give_up()
    assert threading.active_count() == before


def test_an_interruption_by_the_instrument_reaches_who_asks() -> None:
    def readings() -> Iterator[LiveReading]:
        yield from _readings(1)
        raise KeyboardInterrupt

    ahead = ReadAhead(readings())
    next(ahead)
    with pytest.raises(KeyboardInterrupt):
        next(ahead)


def test_a_port_that_is_closed_lets_its_reader_go() -> None:
    port = Port("loop://", Framing(), 1.0)

    def readings() -> Iterator[LiveReading]:
        while True:
            port.read(PATIENCE)
            yield LiveReading(0.0, 0.0)

    ahead = ReadAhead(readings())
    port.close()
    with pytest.raises(AccessError, match="is closed"):
        next(ahead)
    ahead.end()
