"""An instrument whose port is open."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import TracebackType
from typing import Self

from zlmreport.live.port import Port
from zlmreport.live.reading import LiveReading


class LiveConnection:
    """A connection made of its parts; it closes the port when it is left.

    Parameters
    ----------
    port
        Where the instrument is.
    readings
        Begins to read, and yields without end.
    zero
        Lets the instrument begin to count from here; None if it cannot be told to.
    """

    def __init__(
        self,
        port: Port,
        readings: Callable[[], Iterator[LiveReading]],
        zero: Callable[[], None] | None = None,
    ) -> None:
        self._port = port
        self._readings = readings
        self._zero = zero
        self.can_zero = zero is not None

    def __enter__(self) -> Self:
        """Return the connection."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close the port."""
        self._port.close()

    def readings(self) -> Iterator[LiveReading]:
        """Yield readings as they arrive, without end."""
        return self._readings()

    def zero(self) -> None:
        """Let the instrument count from here."""
        if self._zero is None:
            self._port.fail(
                "this instrument cannot be set to zero from here; press its key, or leave it as it is"
            )
        self._zero()
