"""An emulated HEIDENHAIN display."""

from __future__ import annotations

import re
from collections.abc import Mapping

from zlmreport.plugin import MILLIMETRE, Scene, Trouble
from zlmreport_plugins.instruments.nd28x.dialogue import ACK, NAK, PRINT, STX

_COMMAND = re.compile(rb"\x1b([A-Z][0-9]{4})\r|\x02|\x1b[^\r]*\r|[^\x1b\x02]")
#: The key CL.
_CLEAR = b"T0100"
_HELD, _GO_ON = b"\x13", b"\x11"
#: Texts of the display, of which the manuals give the form and not the words.
_TEXTS: Mapping[bytes, bytes] = {
    b"A0000": b"ND-287    \r\n646118-01 \r\nV1-01     ",
    b"A0400": b"646118-01 ",
    b"A0800": b"0 0 0 0 0 0 0 0",
    b"A0900": b"0 0 0 0 0 0",
}
#: An error text has 33 characters; without an error they are blank.
_ERROR_WIDTH = 33


class Nd28xEmulator:
    """A display that watches an axis, in millimetres."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._rest = b""
        self._cleared_at = -1.0

    def unasked(self, time: float) -> bytes:  # noqa: ARG002 - it speaks when it is asked
        """Return nothing: it speaks when it is asked."""
        return b""

    def answer(self, data: bytes, time: float) -> bytes:
        """Return its answers to the commands that are whole."""
        data = (self._rest + data).replace(_HELD, b"").replace(_GO_ON, b"")
        answers = b""
        end = 0
        while found := _COMMAND.match(data, end):
            end = found.end()
            if found[0] == PRINT:
                answers += self._printed(time)
            elif found[0].startswith(b"\x1b"):
                answers += self._to_command(found[1] or b"", time)
        self._rest = data[end:][:20]
        return b"" if self._scene.troubles.has(Trouble.SKIPPED, time) else answers

    def _to_command(self, name: bytes, time: float) -> bytes:
        if name in _TEXTS:
            return STX + _TEXTS[name] + b"\r\n"
        if name == b"A0100":
            return STX + b"%10.4f\r\n" % self._shown(time)
        if name == b"A0200":
            return STX + b"%+010d\r\n" % round(self._shown(time) * 1e4)
        if name == b"A0301":
            text = b"Signal fault X1" if self._has_fault(time) else b""
            return STX + text.ljust(_ERROR_WIDTH) + b"\r\n"
        if name == b"F0200":
            return self._printed(time)
        if name == _CLEAR:
            self._cleared_at = time
        return ACK if name[:1] in {b"F", b"S", b"T"} else NAK

    def _printed(self, time: float) -> bytes:
        shown = self._shown(time)
        sign = b"-" if shown < 0 else b" "
        unit = b"?" if self._has_fault(time) else b" "
        return sign + b"%10.4f" % abs(shown) + b" " + unit + b"  \r\n"

    def _has_fault(self, time: float) -> bool:
        """Return whether it shows a fault: it does until somebody clears it."""
        troubles = self._scene.troubles
        return any(
            troubles.begins(trouble, self._cleared_at, time) for trouble in (Trouble.ERROR, Trouble.LOST_BEAM)
        )

    def _shown(self, time: float) -> float:
        """Return what it shows, mm: whole tenths of a micrometre."""
        return round(MILLIMETRE.from_si(self._scene.axis.position(time)), 4) + 0.0
