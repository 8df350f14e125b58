"""The axis before an emulated instrument, its noise, and the conditions of the room."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import accumulate, pairwise
from random import Random
from types import MappingProxyType
from typing import Protocol

from zlmreport.live.emulation.troubles import Troubles
from zlmreport.measurement.refractive_index import STANDARD_HUMIDITY, STANDARD_PRESSURE
from zlmreport.measurement.units import REFERENCE_TEMPERATURE

#: How finely noise is laid out in time, s: a device that asks twice within it gets the same.
_NOISE_GRAIN = 1e-4


class EmulatedAxis(Protocol):
    """Where an axis is.

    The emulated devices ask nothing else of it, so that an axis with an error model may take the place of a
    plain one.
    """

    def position(self, time: float) -> float:
        """Return the position that an ideal instrument shows, m, at a time in s from the start."""


@dataclass(frozen=True, slots=True)
class MovingAxis:
    """An axis that goes to one position after the other, rests, and begins again."""

    course: Sequence[float] = (0.0,)  #: The positions, m; the axis starts at the first.
    feed: float = 0.05  #: m/s.
    dwell: float = 3.0  #: How long it rests at each, s.
    noise: float = 0.0  #: Standard deviation of what shakes it, m; white.
    drift: float = 0.0  #: By how much everything moves away, m/s.
    seed: int = 1  #: Of the noise: the same seed gives the same noise at the same time.

    def position(self, time: float) -> float:
        """Return where the axis is, m, with noise and drift."""
        return self._find_place_on_course(time) + self.drift * time + self._shake(time)

    def _find_place_on_course(self, time: float) -> float:
        stops = [*self.course, self.course[0]]
        ways = [abs(there - here) for here, there in pairwise(stops)]
        leaves = [0.0, *accumulate(self.dwell + way / self.feed for way in ways)]
        since = math.fmod(max(time, 0.0), leaves[-1])
        leg = min(bisect_right(leaves, since) - 1, len(ways) - 1)
        travelled = max(0.0, since - leaves[leg] - self.dwell) * self.feed
        here, there = stops[leg], stops[leg + 1]
        return here + math.copysign(min(travelled, ways[leg]), there - here)

    def _shake(self, time: float) -> float:
        if not self.noise:
            return 0.0
        return Random(f"{self.seed} {round(time / _NOISE_GRAIN)}").gauss(0.0, self.noise)  # noqa: S311 - no secret


#: The conditions of a room that is as it should be, SI.
STANDARD_CONDITIONS: Mapping[str, float] = MappingProxyType(
    {
        "air_temperature": REFERENCE_TEMPERATURE,
        "air_pressure": STANDARD_PRESSURE,
        "relative_humidity": STANDARD_HUMIDITY,
        "axis_temperature": REFERENCE_TEMPERATURE,
    }
)


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
    conditions: Callable[[float], Mapping[str, float]] = lambda _: STANDARD_CONDITIONS

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
