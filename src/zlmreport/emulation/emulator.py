"""What an emulated instrument is: bytes in, bytes out, and no port and no clock."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

from zlmreport.emulation.axis import EmulatedAxis, MovingAxis
from zlmreport.emulation.faults import Troubles


@dataclass(frozen=True, slots=True)
class Scene:
    """What an emulated instrument looks at.

    Attributes
    ----------
    axis
        The axis that it measures.
    troubles
        What goes wrong, and when. Whether the line is unplugged or garbled is no matter of the instrument.
    """

    axis: EmulatedAxis = field(default_factory=MovingAxis)
    troubles: Troubles = field(default_factory=Troubles)


class Emulator(Protocol):
    """An instrument that is not there.

    Times are in seconds from the start of the emulation and never go back.
    """

    def unasked(self, time: float) -> bytes:
        """Return what the instrument has sent of its own accord since it was last asked this."""

    def answer(self, data: bytes, time: float) -> bytes:
        """Return what the instrument answers to bytes from the host; they may be part of a command."""
