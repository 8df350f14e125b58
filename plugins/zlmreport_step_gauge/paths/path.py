"""The data of a probing path: travels, touches, speeds, duration, settings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise
from typing import TypeAlias

from zlmreport.plugin import Place

#: x, y, z in the coordinates of the machine, m; of a direction, 1.
Point: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Travel:
    """A straight move of the tip's centre, nothing being measured.

    Attributes
    ----------
    to
        Where it ends, m.
    face
        Number of the face that it leads to or away from; 0 for the beginning and the end of the path.
    cycle
        Number of the cycle, from 1; 0 for the beginning and the end of the path.
    """

    to: Point
    face: int = 0
    cycle: int = 0


@dataclass(frozen=True, slots=True)
class Probing:
    """A measuring move towards a face, against its outward normal.

    Attributes
    ----------
    face
        Number of the face, from 1 at the beginning of the gauge.
    cycle
        Number of the cycle, from 1.
    target
        Where the face should be: the point on its surface, m.
    normal
        Outward unit normal of the face.
    """

    face: int
    cycle: int
    target: Point
    normal: Point

    def away(self, distance: float) -> Point:
        """Return the point in front of the face at a distance from it, m."""
        return shift(self.target, self.normal, distance)


Move: TypeAlias = Travel | Probing


@dataclass(frozen=True, slots=True)
class ProbingPath:
    """The path of a probe over a step gauge.

    Attributes
    ----------
    number
        Of the job.
    gauge
        Name and serial number of the gauge.
    moves
        In the order in which they are made; the first leads to the safe position.
    tip_radius
        Nominal, m.
    approach, search, retract
        Distances of the tip's surface from the face, m: at which a measuring move begins, how far behind the
        face it gives up, and how far the tip draws back when it has touched.
    speed, measuring_speed
        Of moves and of measuring moves, m/s.
    radius_correction
        Whether the machine is to report points of the surface and not centres of the tip.
    place
        Where the path is asked for: for messages about what cannot be programmed.
    """

    number: str
    gauge: str
    moves: tuple[Move, ...]
    tip_radius: float
    approach: float
    search: float
    retract: float
    speed: float
    measuring_speed: float
    radius_correction: bool
    place: Place

    @property
    def probings(self) -> tuple[Probing, ...]:
        """The measuring moves."""
        return tuple(move for move in self.moves if isinstance(move, Probing))

    @property
    def stops(self) -> tuple[Point, ...]:
        """Where the tip's centre is at the end of each move, m; at a face it has touched it."""
        return tuple(
            move.to if isinstance(move, Travel) else move.away(self.tip_radius) for move in self.moves
        )

    @property
    def first_cycle(self) -> tuple[tuple[Move, Point], ...]:
        """The moves of the first cycle with where they end, and those before and after all cycles."""
        return tuple(
            (move, stop) for move, stop in zip(self.moves, self.stops, strict=True) if move.cycle <= 1
        )

    @property
    def length(self) -> float:
        """The way of the tip's centre, m."""
        return sum(math.dist(*step) for step in pairwise(self.stops))

    @property
    def duration(self) -> float:
        """Time that the motion takes, s, as if the machine needed none to speed up and slow down."""
        return sum(self._compute_durations())

    def _compute_durations(self) -> Iterator[float]:
        for move, step in zip(self.moves[1:], pairwise(self.stops), strict=True):
            yield math.dist(*step) / (self.measuring_speed if isinstance(move, Probing) else self.speed)


def shift(point: Point, direction: Point, distance: float) -> Point:
    """Return the point at a distance, m, in the direction of a unit vector."""
    x, y, z = (at + distance * by for at, by in zip(point, direction, strict=True))
    return x, y, z


class PathKind(Enum):
    """How the probe goes from face to face."""

    VERTICAL = "vertical"
    HORIZONTAL = "horizontal"


@dataclass(frozen=True, slots=True)
class PathSettings:
    """How faces are probed. Lengths in m; distances are of the tip's surface."""

    kind: PathKind  #: Over the top, or round the side (the right one of who looks along the gauge).
    clearance: float  #: Distance from the blocks while the tip passes them.
    #: approach, search and retract: As those of `ProbingPath`.
    approach: float
    search: float
    retract: float
    #: How far below the top of the blocks their faces are probed; None for half their height.
    depth: float | None
    #: How far before the first face a path round the side comes into the line of the gauge; 0 if it comes
    #: from the side.
    lead_in: float
    cycles: int  #: How often each face is probed.
    tip_radius: float  #: Nominal.
    stylus_allowance: float  #: What must stay free between the tip and everything that it does not measure.
    #: speed and measuring_speed: m/s.
    speed: float
    measuring_speed: float
    radius_correction: bool  #: As that of `ProbingPath`.
    #: Where the path begins and ends; None for over the first face and over the last one that is probed.
    safe_position: Point | None = None
    #: What the tip's centre can reach: first and last position in x, y and z; None for anywhere.
    working_volume: tuple[tuple[float, float], tuple[float, float], tuple[float, float]] | None = None
