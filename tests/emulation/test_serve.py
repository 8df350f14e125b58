"""An emulated instrument speaks on a line, and what goes wrong on the line goes wrong."""

from __future__ import annotations

from zlmreport.emulation.faults import Planned, Trouble, Troubles
from zlmreport.emulation.serve import serve


class _Channel:
    """A line that a test reads, on which a question comes at every beat."""

    address = "test"

    def __init__(self) -> None:
        self.sent: list[bytes] = []

    def wait(self, seconds: float) -> None: ...

    def receive(self) -> bytes:
        return b"?"

    def send(self, data: bytes) -> None:
        self.sent.append(data)


class _Echo:
    """An instrument that says what time it is, and repeats what it is told."""

    def unasked(self, time: float) -> bytes:
        return b"%d " % time

    def answer(self, data: bytes, _time: float) -> bytes:
        return data


def _served(*planned: Planned, beats: int = 5) -> list[bytes]:
    channel = _Channel()
    times = iter(range(100, 100 + beats + 1))
    left = iter([False] * beats + [True])
    serve(_Echo(), channel, Troubles(planned), is_over=lambda: next(left), clock=lambda: float(next(times)))
    return channel.sent


def test_it_speaks_by_the_time_since_its_start() -> None:
    assert _served() == [b"1 ?", b"2 ?", b"3 ?", b"4 ?", b"5 ?"]


def test_an_unplugged_line_ends_it() -> None:
    assert _served(Planned(Trouble.UNPLUGGED, 3.0)) == [b"1 ?", b"2 ?"]


def test_a_bad_line_garbles_what_is_sent() -> None:
    clean = b"".join(_served(beats=200))
    garbled = b"".join(_served(*(Planned(Trouble.GARBLED, float(at)) for at in range(201)), beats=200))
    # one byte in ten is dropped: the standard deviation of a share of 1000 bytes is about 1 %
    assert 0.85 < len(garbled) / len(clean) < 0.95
