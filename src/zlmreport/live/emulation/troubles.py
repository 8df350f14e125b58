"""What goes wrong with an emulated instrument, and when: lost beam, garbled lines, no cable."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum


class Trouble(StrEnum):
    """A fault that an emulated instrument has on request, as the command line names it."""

    LOST_BEAM = "lost-beam"
    SKIPPED = "skipped"
    ERROR = "error"
    GARBLED = "garbled"
    UNPLUGGED = "unplugged"


#: How long each lasts, s; nobody plugs in again.
_LASTS = {
    Trouble.LOST_BEAM: 0.5,
    Trouble.SKIPPED: 0.05,
    Trouble.ERROR: 0.5,
    Trouble.GARBLED: 0.2,
    Trouble.UNPLUGGED: float("inf"),
}


@dataclass(frozen=True, slots=True)
class Planned:
    """A fault that will happen."""

    trouble: Trouble  #: Which.
    start: float  #: When, s from the start of the emulation.

    def is_on(self, time: float) -> bool:
        """Return whether it is happening."""
        return self.start <= time < self.start + _LASTS[self.trouble]


@dataclass(frozen=True, slots=True)
class Troubles:
    """All faults that will happen."""

    planned: Sequence[Planned] = ()

    def has(self, trouble: Trouble, time: float) -> bool:
        """Return whether a kind of fault is happening at a time, s from the start."""
        return any(each.trouble is trouble and each.is_on(time) for each in self.planned)

    def begins(self, trouble: Trouble, before: float, time: float) -> bool:
        """Return whether a kind of fault has begun after one moment and up to another, s from the start."""
        return any(each.trouble is trouble and before < each.start <= time for each in self.planned)
