"""An emulated readout that prints a number a line."""

from __future__ import annotations

from zlmreport.plugin import MILLIMETRE, Scene, Trouble

_RATE = 10.0


class TextEmulator:
    """A readout that watches an axis, in millimetres with four decimals."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._sent = 0

    def unasked(self, time: float) -> bytes:
        """Return the lines that are due."""
        lines = b""
        while (self._sent + 1) / _RATE <= time:
            self._sent += 1
            lines += self._line(self._sent / _RATE)
        return lines

    def answer(self, data: bytes, time: float) -> bytes:  # noqa: ARG002 - it takes no commands
        """Return nothing: it takes no commands."""
        return b""

    def _line(self, at: float) -> bytes:
        troubles = self._scene.troubles
        if troubles.has(Trouble.SKIPPED, at):
            return b""
        if troubles.has(Trouble.ERROR, at) or troubles.has(Trouble.LOST_BEAM, at):
            return b"Error\r\n"
        return b"%+.4f mm\r\n" % MILLIMETRE.from_si(self._scene.axis.position(at))
