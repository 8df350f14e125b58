"""The lines on which an emulated instrument is reached."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest

from zlmreport.emulation.channels import LocalSocket, PseudoTerminal
from zlmreport.errors import AccessError


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
