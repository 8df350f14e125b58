"""Where an emulated instrument is found: a pseudo-terminal or a socket, served in real time."""

from __future__ import annotations

import os
import select
import socket
import struct
import time
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Protocol

from zlmreport.errors import AccessError, Place
from zlmreport.files import Closable
from zlmreport.live.emulation.emulator import Emulator
from zlmreport.live.emulation.troubles import Trouble, Troubles

#: As much as a line holds at least.
_CHUNK = 4096
#: As much as the driver of a serial port keeps for a host that is late, and for how long here: who takes
#: nothing for so long, s, is not there.
_KEPT, _AWAITED = 1 << 16, 1.0


class HostLine(Protocol):
    """A line to whoever reads the emulated instrument."""

    address: str  #: As a job names it: a path, or ``socket://host:number``.
    is_read: bool  #: Whether a host has ever read from it, spoken on it, or called.

    def wait(self, seconds: float) -> None:
        """Wait until something arrives, but no longer."""

    def receive(self) -> bytes:
        """Return what has arrived."""

    def send(self, data: bytes) -> None:
        """Send as much as the line takes; a serial line keeps little for a host that does not read."""


class PseudoTerminal(Closable):
    """A terminal that a program opens like a serial port.

    `link`: A name for it that does not change from one emulation to the next; it is removed in the end.

    Raises `AccessError` if the name is taken, or cannot be made.
    """

    def __init__(self, link: Path | None = None) -> None:
        try:
            import tty  # noqa: PLC0415 - not on every system
        except ImportError as error:
            message = "this system has no pseudo-terminals: put the instrument on a socket, with --port"
            raise AccessError.at(Place("zlmreport emulate"), message) from error
        self._ours, self._theirs = os.openpty()  # held open: or it would hang up when a host closes it
        tty.setraw(self._theirs)
        os.set_blocking(self._ours, False)
        name = os.ttyname(self._theirs)
        self._link = link
        self._sent = self._unread = 0
        self._kept = bytearray()
        self._taken_at = time.monotonic()
        self.is_read = False
        if link is not None:
            try:
                link.symlink_to(name)
            except OSError as error:
                self._hang_up()
                raise AccessError.at(
                    Place(str(link)), f"cannot be made a name of the port ({error.strerror}); choose another"
                ) from error
        self.address = str(link or name)

    def wait(self, seconds: float) -> None:
        """Wait until something arrives, but no longer."""
        select.select([self._ours], [], [], max(0.0, seconds))

    def receive(self) -> bytes:
        """Return what has arrived."""
        try:
            data = os.read(self._ours, _CHUNK)
        except BlockingIOError:
            return b""
        self.is_read = True
        return data

    def send(self, data: bytes) -> None:
        """Send as much as the line takes, and keep some of the rest for a host that reads.

        An instrument that this computer let speak late says much at once, which a real one would have said
        bit by bit; it is not lost for that. What has no room is, as at a serial port.
        """
        self._notice_reader()
        now = time.monotonic()
        if self._kept and (not self.is_read or now - self._taken_at > _AWAITED):
            self._kept.clear()
        if not self._kept:
            self._taken_at = now
        if not self._kept or len(self._kept) + len(data) <= _KEPT:
            self._kept += data
        try:
            while self._kept:
                sent = os.write(self._ours, self._kept)
                self._sent += sent
                del self._kept[:sent]
                self._taken_at = now
        except BlockingIOError:
            return

    def close(self) -> None:
        """Unplug it, and remove its name."""
        if self._ours < 0:
            return
        self._hang_up()
        if self._link is not None:
            self._link.unlink(missing_ok=True)

    def _notice_reader(self) -> None:
        """Notice whether somebody reads: what nobody reads stays in the line, and gets no less."""
        # Linux delivers what was sent a moment later, and on a busy computer much later; where nothing waits,
        # it has delivered all of it when a host's end has been asked whether something is there.
        select.select([self._theirs], [], [], 0.0)
        unread = self._count_waiting()
        self.is_read |= unread < self._unread or unread == 0 < self._sent
        self._unread = unread

    def _count_waiting(self) -> int:
        """Return how many bytes wait for a host."""
        import fcntl  # noqa: PLC0415 - where there are pseudo-terminals
        import termios  # noqa: PLC0415

        (count,) = struct.unpack("i", fcntl.ioctl(self._theirs, termios.FIONREAD, bytes(4)))
        return int(count)

    def _hang_up(self) -> None:
        os.close(self._ours)
        os.close(self._theirs)
        self._ours = -1


class LocalSocket(Closable):
    """A socket on this computer that serves one host after the other.

    `number`: Of the TCP port; 0 for any that is free.

    Raises `AccessError` if the port is taken.
    """

    def __init__(self, number: int = 0) -> None:
        try:
            self._listening = socket.create_server(("127.0.0.1", number))
        except OSError as error:
            raise AccessError.at(
                Place(f"TCP port {number}"), f"cannot be opened ({error.strerror}); choose another"
            ) from error
        self._listening.settimeout(0)
        self._host: socket.socket | None = None
        self.is_read = False
        self.address = f"socket://127.0.0.1:{self._listening.getsockname()[1]}"

    def wait(self, seconds: float) -> None:
        """Wait until something arrives or a host comes, but no longer."""
        select.select([self._host or self._listening], [], [], max(0.0, seconds))
        if self._host is None:
            try:
                self._host, _ = self._listening.accept()
            except BlockingIOError:
                return
            self._host.settimeout(0)
            self.is_read = True

    def receive(self) -> bytes:
        """Return what has arrived; a host that has gone makes room for the next."""
        if self._host is None:
            return b""
        try:
            data = self._host.recv(_CHUNK)
        except BlockingIOError:
            return b""
        except ConnectionError:
            data = b""
        if not data:
            self._drop_host()
        return data

    def send(self, data: bytes) -> None:
        """Send as much as the connection takes."""
        try:
            while data and self._host is not None:
                data = data[self._host.send(data) :]
        except BlockingIOError:
            return
        except ConnectionError:
            self._drop_host()

    def close(self) -> None:
        """Unplug it."""
        self._drop_host()
        self._listening.close()

    def _drop_host(self) -> None:
        if self._host is not None:
            self._host.close()
            self._host = None


#: How often an instrument that sends unasked is looked after, s.
_BEAT = 0.01


def serve(
    emulator: Emulator,
    channel: HostLine,
    troubles: Troubles,
    *,
    is_over: Callable[[], bool] = lambda: False,
    clock: Callable[[], float] = time.monotonic,
) -> None:
    """Let an emulated instrument speak on a line until it is unplugged, or it is over.

    The line is left to the caller to close.

    `troubles`: What goes wrong: here, what goes wrong on the line.
    `clock`: Time in s; it begins anywhere.
    """
    start = clock()
    noise = Random(1)  # noqa: S311 - no secret
    while not is_over():
        channel.wait(_BEAT)
        now = clock() - start
        if troubles.has(Trouble.UNPLUGGED, now):
            return
        sent = emulator.unasked(now) + emulator.answer(channel.receive(), now)
        channel.send(_garble(sent, noise) if troubles.has(Trouble.GARBLED, now) else sent)


def _garble(data: bytes, noise: Random) -> bytes:
    """Return bytes as a bad line delivers them: one in five is another, or none."""
    found = bytearray()
    for byte in data:
        luck = noise.random()
        if luck < 0.1:
            continue
        found.append(byte ^ (1 << noise.randrange(7)) if luck < 0.2 else byte)
    return bytes(found)
