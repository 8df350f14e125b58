"""When to give an instrument up: it is silent, or what it sends is not what it should be."""

from __future__ import annotations

from zlmreport.live.port import Port, shown

#: Nonsense from an instrument that was understood before comes from a bad line: it gets so many times longer.
_BAD_LINE = 5


class Patience:
    """Watches what arrives, and ends the wait with a message that says what to look at.

    Parameters
    ----------
    port
        Where the instrument is.
    timeout
        How long it may be silent, or send what is not understood before anything was, s.
    expected
        What should come: ``lines of a µMD1``.
    advice
        What to look at if something else comes: ``name the instrument that it is``.
    now
        The time, s.
    """

    def __init__(self, port: Port, timeout: float, expected: str, advice: str, now: float) -> None:
        self._port = port
        self._timeout = timeout
        self._expected = expected
        self._advice = advice
        self._heard_at = now
        self._understood_at = now
        self._has_understood = False
        self._nonsense = b""

    def hear(self, data: bytes, now: float) -> None:
        """Take note of what arrived, before it is known what it is."""
        if data:
            self._heard_at = now
            self._nonsense = (self._nonsense + data)[:100]

    def understand(self, now: float) -> None:
        """Take note that it made sense."""
        self._understood_at = now
        self._has_understood = True
        self._nonsense = b""

    def check(self, now: float) -> None:
        """Raise an `AccessError` if the instrument has had its time."""
        seconds = f"{self._timeout:g} s"
        if now - max(self._heard_at, self._understood_at) >= self._timeout:
            happened = "has stopped sending" if self._has_understood else "sends nothing"
            self._port.fail(
                f"the instrument {happened}: {self._expected} should have come within {seconds}; "
                "look at its cable, its power and its settings for the interface"
            )
        longest = self._timeout * (_BAD_LINE if self._has_understood else 1)
        if now - self._understood_at < longest:
            return
        self._port.fail(f"what arrives are no {self._expected}: {shown(self._nonsense)}; {self._advice}")
