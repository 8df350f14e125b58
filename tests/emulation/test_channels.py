"""The lines on which an emulated instrument is reached."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest

from zlmreport.emulation.channels import LocalSocket, PseudoTerminal
from zlmreport.errors import AccessError
from zlmreport.live.port import Framing, Port


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
                assert port.read(5.0)
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
        for _ in range(20):
            terminal.send(b"a line that nobody reads\r\n")
            terminal.wait(0.01)
        assert not terminal.is_read


def test_a_terminal_notices_that_it_is_asked() -> None:
    with PseudoTerminal() as terminal, Port(terminal.address, Framing(), 1.0) as port:
        port.write(b"question")
        terminal.wait(5.0)
        assert terminal.receive() == b"question"
        assert terminal.is_read


def test_a_socket_notices_that_it_is_called() -> None:
    with LocalSocket() as channel:
        assert not channel.is_read
        with socket.create_connection(("127.0.0.1", int(channel.address.rpartition(":")[2])), timeout=5):
            channel.wait(5.0)
            assert channel.is_read


def test_a_socket_serves_one_host_after_the_other() -> None:
    with LocalSocket() as channel:
        address = ("127.0.0.1", int(channel.address.rpartition(":")[2]))
        for _ in range(2):
            with socket.create_connection(address, timeout=5) as host:
                channel.wait(5.0)
                host.sendall(b"question")
                channel.wait(5.0)
                assert channel.receive() == b"question"
                channel.send(b"answer")
                assert host.recv(100) == b"answer"
            channel.wait(5.0)
            assert channel.receive() == b""


def test_a_port_that_is_taken_is_told() -> None:
    with LocalSocket() as channel, pytest.raises(AccessError, match="cannot be opened"):
        LocalSocket(int(channel.address.rpartition(":")[2]))
