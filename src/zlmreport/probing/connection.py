"""The line to an I++ DME server: text over TCP."""

from __future__ import annotations

import socket
import time
from types import TracebackType
from typing import Self

from zlmreport.errors import AccessError, Place, Problem

_CHUNK = 4096
#: Longer than any line of the protocol: a wrong server fills no memory.
_LONGEST_LINE = 65536
#: How long a server may take to accept a connection, s.
_PATIENCE = 10.0


class Connection:
    """Lines to and from a server.

    Parameters
    ----------
    host, port
        Where it is.

    Raises
    ------
    AccessError
        If it cannot be reached; here and in every method, with what the operator can do.
    """

    def __init__(self, host: str, port: int) -> None:
        self.place = Place(f"{host}:{port}")
        try:
            self._socket = socket.create_connection((host, port), timeout=_PATIENCE)
        except OSError as error:
            raise AccessError.at(
                self.place,
                f"the machine's server cannot be reached ({_said(error)}); is it started, and are host and "
                "port right?",
            ) from error
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._rest = b""

    def __enter__(self) -> Self:
        """Return the connection."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Hang up."""
        self._socket.close()

    def send(self, line: str) -> None:
        """Send a line."""
        try:
            self._socket.sendall(f"{line}\r\n".encode("ascii"))
        except OSError as error:
            raise self._lost(_said(error)) from error

    def receive(self, patience: float) -> str | None:
        """Return the next line without its end; None if none comes within a time, s."""
        until = time.monotonic() + patience
        while b"\n" not in self._rest:
            if len(self._rest) > _LONGEST_LINE:
                raise self._lost("what it sends has no lines")
            self._socket.settimeout(max(0.001, until - time.monotonic()))
            try:
                data = self._socket.recv(_CHUNK)
            except TimeoutError:
                return None
            except OSError as error:
                raise self._lost(_said(error)) from error
            if not data:
                raise self._lost("it has hung up")
            self._rest += data
        line, _, self._rest = self._rest.partition(b"\n")
        return line.rstrip(b"\r").decode("ascii", errors="replace")

    def _lost(self, why: str) -> AccessError:
        message = (
            f"the connection to the machine is lost ({why}); look at the machine and the network, then start "
            "again: what was probed is kept"
        )
        return AccessError([Problem(self.place, message)])


def _said(error: OSError) -> str:
    return " ".join(str(error.strerror or error).split())[:200]
