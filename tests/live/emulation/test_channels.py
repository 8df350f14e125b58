"""Where emulated instruments are found, and that they are served there in real time."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest

from processes import PATIENCE
from zlmreport.live.emulation.channels import LocalSocket, PseudoTerminal, serve
from zlmreport.live.emulation.troubles import Planned, Troubles
from zlmreport.plugin import AccessError
from zlmreport.plugin.instrument import Framing, Port, Trouble


def test_a_terminal_has_the_name_that_it_is_given_as_long_as_it_lives(tmp_path: Path) -> None:
    link = tmp_path / "interferometer"
    with PseudoTerminal(link) as terminal:
        assert terminal.address == str(link)
        assert Path(os.path.realpath(link)).is_char_device()
    assert not os.path.lexists(link)


def test_a_name_that_is_taken_is_left_alone(tmp_path: Path) -> None:
    taken = tmp_path / "taken"
    taken.write_text("mine", encoding="utf-8")
    with pytest.raises(AccessError, match="choose another"):
        PseudoTerminal(taken)
    assert taken.read_text(encoding="utf-8") == "mine"


def test_a_terminal_that_nobody_reads_does_not_hold_up_the_instrument() -> None:
    with PseudoTerminal() as terminal:
        terminal.send(b"x" * 1_000_000)
        assert terminal.receive() == b""


def test_a_terminal_notices_that_it_is_read() -> None:
    with PseudoTerminal() as terminal:
        with Port(terminal.address, Framing(), 1.0) as port:
            for _ in range(5):
                terminal.send(b"line")
                assert port.read(PATIENCE)
        assert terminal.is_read


def test_a_terminal_notices_a_reader_who_comes_late() -> None:
    with PseudoTerminal() as terminal:
        for _ in range(2000):
            terminal.send(b"a line that nobody reads\r\n")
        for _ in range(3):
            with Port(terminal.address, Framing(), 1.0):  # which forgets what waits
                terminal.send(b"line")
        assert terminal.is_read


def test_a_terminal_that_nobody_reads_knows_it() -> None:
    with PseudoTerminal() as terminal:
        for _ in range(100):  # faster than a busy computer delivers them
            terminal.send(b"a line that nobody reads\r\n")
            terminal.wait(0.0005)
        assert not terminal.is_read


def test_a_terminal_notices_that_it_is_asked() -> None:
    with PseudoTerminal() as terminal, Port(terminal.address, Framing(), 1.0) as port:
        port.write(b"question")
        terminal.wait(PATIENCE)
        assert terminal.receive() == b"question"
        assert terminal.is_read


def test_a_socket_notices_that_it_is_called() -> None:
    with LocalSocket() as channel:
        assert not channel.is_read
        with socket.create_connection(
            ("127.0.0.1", int(channel.address.rpartition(":")[2])), timeout=PATIENCE
        ):
            channel.wait(PATIENCE)
            assert channel.is_read


def test_a_socket_serves_one_host_after_the_other() -> None:
    with LocalSocket() as channel:
        address = ("127.0.0.1", int(channel.address.rpartition(":")[2]))
        for _ in range(2):
            with socket.create_connection(address, timeout=PATIENCE) as host:
                channel.wait(PATIENCE)
                host.sendall(b"question")
                channel.wait(PATIENCE)
                assert channel.receive() == b"question"
                channel.send(b"answer")
                assert host.recv(100) == b"answer"
            channel.wait(PATIENCE)
            assert channel.receive() == b""


def test_a_port_that_is_taken_is_told() -> None:
    with LocalSocket() as channel, pytest.raises(AccessError, match="cannot be opened"):
        LocalSocket(int(channel.address.rpartition(":")[2]))


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
