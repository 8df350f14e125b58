"""An axis that moves through positions and rests at each, as an instrument sees it."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from random import Random
from typing import Protocol

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
    """An axis that goes to one position after the other, rests, and begins again.

    Attributes
    ----------
    course
        The positions, m; the axis starts at the first.
    feed
        m/s.
    dwell
        How long it rests at each, s.
    noise
        Standard deviation of what shakes it, m; white.
    drift
        By how much everything moves away, m/s.
    seed
        Of the noise: the same seed gives the same noise at the same time.
    """

    course: Sequence[float] = (0.0,)
    feed: float = 0.05
    dwell: float = 3.0
    noise: float = 0.0
    drift: float = 0.0
    seed: int = 1

    def position(self, time: float) -> float:
        """Return where the axis is, m, with noise and drift."""
        return self._on_course(time) + self.drift * time + self._shaken(time)

    def _on_course(self, time: float) -> float:
        stops = [*self.course, self.course[0]]
        ways = [abs(there - here) for here, there in pairwise(stops)]
        leaves = [0.0, *accumulate(self.dwell + way / self.feed for way in ways)]
        since = math.fmod(max(time, 0.0), leaves[-1])
        leg = min(bisect_right(leaves, since) - 1, len(ways) - 1)
        travelled = max(0.0, since - leaves[leg] - self.dwell) * self.feed
        here, there = stops[leg], stops[leg + 1]
        return here + math.copysign(min(travelled, ways[leg]), there - here)

    def _shaken(self, time: float) -> float:
        if not self.noise:
            return 0.0
        return Random(f"{self.seed} {round(time / _NOISE_GRAIN)}").gauss(0.0, self.noise)  # noqa: S311 - no secret
