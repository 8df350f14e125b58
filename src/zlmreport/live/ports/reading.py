"""A reading as it arrives, and what may be wrong with it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Flag, auto
from types import MappingProxyType

#: What a reading carries whose instrument measures no conditions.
NO_CONDITIONS: Mapping[str, float] = MappingProxyType({})


class Fault(Flag):
    """What is wrong with a reading; several may be at once."""

    #: The beam is broken, or a signal is too weak: counts were lost.
    BEAM_LOST = auto()
    #: The axis moved faster than the instrument counts: counts were lost.
    TOO_FAST = auto()
    #: The instrument began anew: its zero is another one.
    RESTARTED = auto()
    #: The instrument reports an error of its own.
    DEVICE_ERROR = auto()
    #: What arrived is no reading: garbled, cut off, or against the reading before.
    UNREADABLE = auto()


#: Of a sound reading.
NO_FAULT = Fault(0)

#: Faults after which the instrument's zero is gone.
_LOSES_ZERO = Fault.BEAM_LOST | Fault.TOO_FAST | Fault.RESTARTED


@dataclass(frozen=True, slots=True)
class LiveReading:
    """One reading of a live instrument.

    Attributes
    ----------
    value
        Position, m or rad, by the instrument's own zero; NaN where nothing was understood.
    time
        When it was taken, s, on the scale of `time.monotonic`: of samples that an instrument numbers by their
        numbers, of an answer when it came, of a line that came unasked when it arrived. Who reads it later
        finds the same time.
    faults
        What is wrong with it.
    skipped
        How many readings the instrument took between the one before and this one that did not arrive;
        0 for an instrument that does not number them.
    message
        What is wrong, in a sentence for the operator; empty if nothing is.
    conditions
        The latest values of the instrument's own sensors, SI (K, Pa, 1), under the names of
        `zlmreport.measurement.measurement_set`. It is the same object until one changes.
    within
        It may have been taken so long before `time`, s: between question and answer, or between two looks
        at the line. A standstill counts as so much shorter.
    """

    value: float
    time: float
    faults: Fault = NO_FAULT
    skipped: int = 0
    message: str = ""
    conditions: Mapping[str, float] = field(default_factory=lambda: NO_CONDITIONS)
    within: float = 0.0

    @property
    def is_usable(self) -> bool:
        """Whether the value holds; readings that were skipped before it do not harm it."""
        return not self.faults

    @property
    def loses_zero(self) -> bool:
        """Whether no later reading can be compared with an earlier one, however sound it looks."""
        return bool(self.faults & _LOSES_ZERO)
