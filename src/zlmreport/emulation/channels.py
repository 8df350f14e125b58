"""Where an emulated instrument can be reached: a pseudo-terminal, or a socket on this computer."""

from __future__ import annotations

import os
import select
import socket
import tty
from pathlib import Path
from types import TracebackType
from typing import Protocol, Self

from zlmreport.errors import AccessError, Place

_CHUNK = 4096


class Channel(Protocol):
    """A line to whoever reads the emulated instrument.

    Attributes
    ----------
    address
        As a job names it: a path, or ``socket://host:number``.
    """

    address: str

    def wait(self, seconds: float) -> None:
        """Wait until something arrives, but no longer."""

    def receive(self) -> bytes:
        """Return what has arrived."""

    def send(self, data: bytes) -> None:
        """Send as much as the line takes; a serial line keeps nothing for a host that does not read."""


class PseudoTerminal:
    """A terminal that a program opens like a serial port.

    Parameters
    ----------
    link
        A name for it that does not change from one emulation to the next; it is removed in the end.

    Raises
    ------
    AccessError
        If the name is taken, or cannot be made.
    """

    def __init__(self, link: Path | None = None) -> None:
        self._ours, self._theirs = os.openpty()  # held open: or it would hang up when a host closes it
        tty.setraw(self._theirs)
        os.set_blocking(self._ours, False)
        name = os.ttyname(self._theirs)
        self._link = link
        if link is not None:
            try:
                link.symlink_to(name)
            except OSError as error:
                self._hang_up()
                raise AccessError.at(
                    Place(str(link)), f"cannot be made a name of the port ({error.strerror}); choose another"
                ) from error
        self.address = str(link or name)

    def __enter__(self) -> Self:
        """Return the terminal."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Unplug it."""
        self.close()

    def wait(self, seconds: float) -> None:
        """Wait until something arrives, but no longer."""
        select.select([self._ours], [], [], max(0.0, seconds))

    def receive(self) -> bytes:
        """Return what has arrived."""
        try:
            return os.read(self._ours, _CHUNK)
        except BlockingIOError:
            return b""

    def send(self, data: bytes) -> None:
        """Send as much as the line takes."""
        try:
            while data:
                data = data[os.write(self._ours, data) :]
        except BlockingIOError:
            return

    def close(self) -> None:
        """Unplug it, and remove its name."""
        if self._ours < 0:
            return
        self._hang_up()
        if self._link is not None:
            self._link.unlink(missing_ok=True)

    def _hang_up(self) -> None:
        os.close(self._ours)
        os.close(self._theirs)
        self._ours = -1


class LocalSocket:
    """A socket on this computer that serves one host after the other.

    Parameters
    ----------
    number
        Of the TCP port; 0 for any that is free.

    Raises
    ------
    AccessError
        If the port is taken.
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
        self.address = f"socket://127.0.0.1:{self._listening.getsockname()[1]}"

    def __enter__(self) -> Self:
        """Return the socket."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Unplug it."""
        self.close()

    def wait(self, seconds: float) -> None:
        """Wait until something arrives or a host comes, but no longer."""
        select.select([self._host or self._listening], [], [], max(0.0, seconds))
        if self._host is None:
            try:
                self._host, _ = self._listening.accept()
            except BlockingIOError:
                return
            self._host.settimeout(0)

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
