"""What an operator is told of a port that does not open, and of an instrument that does not speak."""

from __future__ import annotations

import builtins
import os
import socket
import termios
from typing import Any, Literal

import pytest

from processes import PATIENCE
from zlmreport.live.emulation.channels import PseudoTerminal
from zlmreport.plugin import AccessError, InputError
from zlmreport.plugin.instrument import Framing, Patience, Port


def test_a_port_that_is_not_there_is_named_with_those_that_are() -> None:
    with pytest.raises(
        AccessError, match=r"^/dev/nothing: there is no such port; (there are|no serial port)"
    ):
        Port("/dev/nothing", Framing(), 1.0)


def test_a_port_that_is_in_use_is_told() -> None:
    with PseudoTerminal() as terminal, Port(terminal.address, Framing(), 1.0):  # noqa: SIM117
        with pytest.raises(AccessError, match="in use by another program; close that first"):
            Port(terminal.address, Framing(), 1.0)


def test_an_address_where_nobody_listens_is_told() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        address = f"socket://127.0.0.1:{server.getsockname()[1]}"
    with pytest.raises(AccessError, match=r"cannot be reached .*; look at the address"):
        Port(address, Framing(), 1.0)


def test_permission_says_which_group_may(monkeypatch: pytest.MonkeyPatch) -> None:
    import serial

    def refused(*_: Any, **__: Any) -> None:
        raise serial.SerialException(13, "could not open port /dev/ttyUSB0: Permission denied")

    monkeypatch.setattr(serial, "serial_for_url", refused)
    with pytest.raises(AccessError, match="usermod -aG dialout"):
        Port("/dev/ttyUSB0", Framing(), 1.0)


def test_a_word_that_is_no_port_is_a_mistake_in_the_job() -> None:
    with pytest.raises(InputError, match="is no port"):
        Port("nonsense://x", Framing(), 1.0)


def test_without_pyserial_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    imported = builtins.__import__

    def without(name: str, *others: Any, **named: Any) -> Any:
        if name == "serial":
            raise ImportError(name)
        return imported(name, *others, **named)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(AccessError, match=r"pip install 'zlmreport\[capture\]'"):
        Port("loop://", Framing(), 1.0)


@pytest.mark.parametrize("framing", [Framing(9600, 7, "E", 2), Framing(2_000_000), Framing(110, 8, "O", 1)])
def test_bytes_go_there_and_back_with_any_framing(framing: Framing) -> None:
    with PseudoTerminal() as terminal, Port(terminal.address, framing, 1.0) as port:
        port.write(b"there")
        terminal.wait(PATIENCE)
        assert terminal.receive() == b"there"
        terminal.send(b"back")
        assert port.read(PATIENCE) == b"back"


def test_a_terminal_that_is_unplugged_is_told() -> None:
    with PseudoTerminal() as terminal, Port(terminal.address, Framing(), 1.0) as port:
        terminal.close()
        with pytest.raises(AccessError, match=r"is gone .*; look at its cable and its power"):
            port.read(PATIENCE)


def test_what_was_there_before_is_dropped() -> None:
    with Port("loop://", Framing(), 1.0) as port:
        port.write(b"old")
        port.drop_input()
        port.write(b"new")
        assert port.read(PATIENCE) == b"new"


def test_a_read_ends_when_its_time_is_over() -> None:
    with Port("loop://", Framing(), 1.0) as port:
        assert port.read(0.01) == b""


def _patience(port: Port) -> Patience:
    return Patience(port, 2.0, "lines of a µMD1", "look whether it is that instrument", 10.0)


def test_silence_is_borne_for_the_time_out_and_not_longer() -> None:
    with Port("loop://", Framing(), 1.0) as port:
        patience = _patience(port)
        patience.check(11.9)
        with pytest.raises(AccessError, match="sends nothing: lines of a µMD1 should have come within 2 s"):
            patience.check(12.0)


def test_an_instrument_that_falls_silent_has_stopped_sending() -> None:
    with Port("loop://", Framing(), 1.0) as port:
        patience = _patience(port)
        patience.hear(b"line", 11.0)
        patience.understand(11.0)
        patience.check(12.9)
        with pytest.raises(AccessError, match="has stopped sending"):
            patience.check(13.0)


def test_nonsense_is_shown() -> None:
    with Port("loop://", Framing(), 1.0) as port:
        patience = _patience(port)
        patience.hear(b"\xff\x00garbage", 11.5)
        with pytest.raises(AccessError, match=r"no lines of a µMD1: '\\xff\\x00garbage'; look whether"):
            patience.check(12.0)


def test_an_instrument_that_was_understood_gets_longer_on_a_bad_line() -> None:
    with Port("loop://", Framing(), 1.0) as port:
        patience = _patience(port)
        patience.understand(10.0)
        for now in range(11, 20):
            patience.hear(b"garbage", float(now))
            patience.check(float(now))
        patience.hear(b"garbage", 20.0)
        with pytest.raises(AccessError, match="what arrives are no lines"):
            patience.check(20.0)


@pytest.mark.parametrize(("parity", "checked"), [("E", termios.INPCK), ("O", termios.INPCK), ("N", 0)])
def test_parity_is_checked_where_there_is_one(parity: Literal["N", "E", "O"], checked: int) -> None:
    with PseudoTerminal() as terminal, Port(terminal.address, Framing(bits=7, parity=parity), 1.0):
        descriptor = os.open(terminal.address, os.O_RDWR | os.O_NOCTTY)
        flags = termios.tcgetattr(descriptor)[0]
        os.close(descriptor)
    # neither IGNPAR nor PARMRK: a byte of wrong parity arrives as NUL
    assert flags & (termios.INPCK | termios.IGNPAR | termios.PARMRK) == checked


def test_a_message_shows_the_beginning_of_long_nonsense() -> None:
    with Port("loop://", Framing(), 1.0) as port:
        patience = _patience(port)
        patience.understand(10.0)
        for now in range(11, 21):
            patience.hear(b"x" * 1000, float(now))
        with pytest.raises(AccessError, match=f"what arrives are no lines of a µMD1: '{'x' * 24}'…;"):
            patience.check(20.0)
