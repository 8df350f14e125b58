"""What an emulated instrument is: bytes in, bytes out, and no port and no clock."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Protocol

from zlmreport.correction.refractive_index import STANDARD_HUMIDITY, STANDARD_PRESSURE
from zlmreport.emulation.axis import EmulatedAxis, MovingAxis
from zlmreport.emulation.faults import Troubles
from zlmreport.quantities.temperature import REFERENCE_TEMPERATURE

#: The conditions of a room that is as it should be, SI.
STANDARD_CONDITIONS: Mapping[str, float] = MappingProxyType(
    {
        "air_temperature": REFERENCE_TEMPERATURE,
        "air_pressure": STANDARD_PRESSURE,
        "relative_humidity": STANDARD_HUMIDITY,
        "axis_temperature": REFERENCE_TEMPERATURE,
    }
)


def standard_conditions(_time: float) -> Mapping[str, float]:
    """Return `STANDARD_CONDITIONS`, at any time."""
    return STANDARD_CONDITIONS


@dataclass(frozen=True, slots=True)
class Scene:
    """What an emulated instrument looks at.

    Attributes
    ----------
    axis
        The axis that it measures.
    troubles
        What goes wrong, and when. Whether the line is unplugged or garbled is no matter of the instrument.
    conditions
        Returns the conditions at a time in s from the start, SI, by the names in `CONDITION_NAMES`: what the
        instrument's own sensors measure, and the air that its beam passes. What is not among them is as in
        `STANDARD_CONDITIONS`.
    """

    axis: EmulatedAxis = field(default_factory=MovingAxis)
    troubles: Troubles = field(default_factory=Troubles)
    conditions: Callable[[float], Mapping[str, float]] = standard_conditions

    def condition(self, name: str, time: float) -> float:
        """Return a condition at a time in s from the start, SI."""
        return self.conditions(time).get(name, STANDARD_CONDITIONS[name])


class Emulator(Protocol):
    """An instrument that is not there.

    Times are in seconds from the start of the emulation and never go back.
    """

    def unasked(self, time: float) -> bytes:
        """Return what the instrument has sent of its own accord since it was last asked this."""

    def answer(self, data: bytes, time: float) -> bytes:
        """Return what the instrument answers to bytes from the host; they may be part of a command."""
