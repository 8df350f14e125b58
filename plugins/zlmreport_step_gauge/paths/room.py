"""Refuses a path that collides with the gauge or leaves the machine's travel."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from zlmreport.plugin import MILLIMETRE, FloatArray, InputError, Problem, read_only_floats
from zlmreport_step_gauge.gauge import GaugeLocation, StepGauge
from zlmreport_step_gauge.paths.path import Move, Point, Probing, ProbingPath

#: How many moves a message names; one that fails mostly fails at every block.
_NAMED = 5
#: Rounding of the arithmetic, m.
_ROUNDING = 1e-9


@dataclass(frozen=True, slots=True)
class Room:
    """The room that a tip has."""

    frame: GaugeFrame  #: The gauge's own coordinates.
    obstacles: Obstacles  #: What it must not touch.
    tip_radius: float  #: m.
    allowance: float  #: What must stay free beside the tip, m.
    #: First and last position in x, y and z that its centre can reach, m; None for anywhere.
    volume: tuple[tuple[float, float], tuple[float, float], tuple[float, float]] | None


def is_free(room: Room, start: Point, end: Point, clearance: float) -> bool:
    """Return whether the tip stays clear of everything on a straight move, by a distance, m."""
    return bool((_measure_gaps(room, np.array([start]), np.array([end])) >= clearance - _ROUNDING).all())


def refuse_collisions(path: ProbingPath, room: Room) -> None:
    """Refuse a path with a move that touches what it does not measure, or that leaves the working volume.

    A measuring move touches its own block, and so does the one that leads away from it.

    Raises `InputError` with the moves and the faces to which they lead.
    """
    problems = [*_find_outside(path, room), *_find_collisions(path, room)]
    if len(problems) > _NAMED:
        more = f"{len(problems) - _NAMED} more moves of the path cannot be made"
        problems = [*problems[:_NAMED], Problem(path.place, more)]
    if problems:
        raise InputError(problems)


def find_least_gap(path: ProbingPath, room: Room) -> tuple[float, str]:
    """Return how near the tip's surface comes to what it does not measure, m, and to what."""
    gaps = _measure_gaps_of_path(path, room)
    nearest = int(gaps.min(axis=0).argmin())
    return float(gaps[:, nearest].min()), room.obstacles.names[nearest]


def _find_collisions(path: ProbingPath, room: Room) -> Iterator[Problem]:
    gaps = _measure_gaps_of_path(path, room)
    for index in np.flatnonzero((gaps < room.allowance - _ROUNDING).any(axis=1)).tolist():
        nearest = int(gaps[index].argmin())
        gap = float(gaps[index, nearest])
        name = room.obstacles.names[nearest]
        left = f"only {MILLIMETRE.from_si(gap):.3g} mm are left beside {name}"
        finds = f"the tip runs into {name}" if gap <= _ROUNDING else left
        yield Problem(
            path.place,
            f"{_say_collision(index + 2, path.moves[index + 1], path.stops[index + 1])}: {finds}, and "
            f"{MILLIMETRE.from_si(room.allowance):.3g} mm must stay free; change approach, clearance or "
            "safe_position, or take a smaller tip",
        )


def _measure_gaps_of_path(path: ProbingPath, room: Room) -> FloatArray:
    """Return what is left beside the tip on each move after the first, m; infinite for what it measures."""
    stops = np.array(path.stops)
    moves, of_move = np.unique(np.hstack([stops[:-1], stops[1:]]), axis=0, return_inverse=True)
    gaps = _measure_gaps(room, moves[:, :3], moves[:, 3:])[of_move.ravel()]  # a cycle is like the next
    numbers = np.array([*room.obstacles.blocks, 0])
    for index, (before, move) in enumerate(pairwise(path.moves)):
        touched = move if isinstance(move, Probing) else before
        if isinstance(touched, Probing):
            gaps[index, numbers == (touched.face + 1) // 2] = np.inf
    return gaps


def _find_outside(path: ProbingPath, room: Room) -> Iterator[Problem]:
    if room.volume is None:
        return
    for number, (move, stop) in enumerate(zip(path.moves, path.stops, strict=True), start=1):
        for name, at, (first, last) in zip("xyz", stop, room.volume, strict=True):
            if not first <= at <= last:
                low, high = MILLIMETRE.from_si(first), MILLIMETRE.from_si(last)
                yield Problem(
                    path.place,
                    f"{_say_collision(number, move, stop)}: {name} leaves the working volume, "
                    f"{low:g} to {high:g} mm; move the gauge, or choose a smaller clearance",
                )
                break


def _say_collision(number: int, move: Move, stop: Point) -> str:
    where = ", ".join(f"{MILLIMETRE.from_si(at):.3f}" for at in stop)
    if not move.face:
        return f"move {number}, to ({where}) mm"
    kind = "measuring move" if isinstance(move, Probing) else "move"
    return f"{kind} {number} at face {move.face}, to ({where}) mm"


def _measure_gaps(room: Room, starts: FloatArray, ends: FloatArray) -> FloatArray:
    """Return what is left between the tip's surface and each obstacle on straight moves, m."""
    own = room.frame.to_gauge
    return room.obstacles.measure_distances(own(starts), own(ends)) - room.tip_radius


@dataclass(frozen=True, slots=True)
class GaugeFrame:
    """Where a gauge lies, as a change of coordinates."""

    origin: FloatArray  #: (3,): Centre of the first block of the section, m.
    #: (3, 3): Rows: unit vectors along the gauge, across it to the right of who looks along it, and out of
    #: its top.
    axes: FloatArray

    @classmethod
    def of(cls, location: GaugeLocation) -> GaugeFrame:
        """Return the frame of a location."""
        along = np.array(location.direction)
        upward = np.array(location.upward) - np.dot(location.upward, along) * along
        upward /= np.linalg.norm(upward)
        axes = [along, np.cross(along, upward), upward]
        return cls(read_only_floats(location.begin), read_only_floats(axes))

    def to_machine(self, along: float, across: float, upward: float) -> Point:
        """Return a point of the gauge, m, in the coordinates of the machine."""
        x, y, z = (self.origin + np.array([along, across, upward]) @ self.axes).tolist()
        return x, y, z

    def to_gauge(self, points: ArrayLike) -> FloatArray:
        """Return points of the machine, shape (..., 3), m, in the gauge's own coordinates."""
        own: FloatArray = (np.asarray(points) - self.origin) @ self.axes.T
        return own

    def turn(self, along: float) -> Point:
        """Return the direction along the gauge (1) or against it (−1)."""
        x, y, z = (along * self.axes[0] + 0.0).tolist()
        return x, y, z


#: The base is taken as wide as the blocks and so many times as deep as they are high: no calibration says.
_BASE_DEPTH = 3.0
#: Enough to find the point of a move that is nearest to a box to a part in 10¹⁰ of the move.
_STEPS = 60


@dataclass(frozen=True, slots=True)
class Obstacles:
    """Boxes in the gauge's own coordinates."""

    blocks: tuple[int, ...]  #: Numbers of the blocks, in their order; the last box of all is the base.
    #: lower and upper: (b + 1, 3): Corners: along, across and upward, m from the centre of the first block of
    #: the section.
    lower: FloatArray
    upper: FloatArray

    @property
    def names(self) -> tuple[str, ...]:
        """What messages call them."""
        return (*(f"block {number}" for number in self.blocks), "the base of the gauge")

    def measure_distances(self, starts: FloatArray, ends: FloatArray) -> FloatArray:
        """Return how near points that move straight come to each box, m, shape (m, b + 1); 0 inside.

        `starts`, `ends`, (m, 3): In the gauge's own coordinates, m.
        """
        shape = (len(starts), len(self.lower))
        low, high = np.zeros(shape), np.ones(shape)
        for _ in range(_STEPS):  # the distance from a box is a convex function along a line
            third = (high - low) / 3
            is_left = self._measure_distance(starts, ends, low + third) < self._measure_distance(
                starts, ends, high - third
            )
            low, high = np.where(is_left, low, low + third), np.where(is_left, high - third, high)
        nearest = [self._measure_distance(starts, ends, at) for at in (low, np.zeros(shape), np.ones(shape))]
        found: FloatArray = np.min(nearest, axis=0)
        return found

    def _measure_distance(self, starts: FloatArray, ends: FloatArray, share: FloatArray) -> FloatArray:
        at = starts[:, None, :] + share[..., None] * (ends - starts)[:, None, :]
        outside = np.maximum(np.maximum(self.lower - at, at - self.upper), 0.0)
        distance: FloatArray = np.linalg.norm(outside, axis=-1)
        return distance


def make_obstacles(gauge: StepGauge, first_block: int, width: float, height: float) -> Obstacles:
    """Return the boxes of a gauge.

    `gauge`: The whole gauge: blocks outside the section that is used stand in the way, too.
    `first_block`: Number of the block whose centre is the origin.
    `width`, `height`: Of the blocks, m.
    """
    ends = {block: find_block_ends(gauge, block) for block in gauge.blocks}
    origin = sum(ends[first_block]) / 2
    lower = [(low - origin, -width / 2, -height / 2) for low, _ in ends.values()]
    upper = [(high - origin, width / 2, height / 2) for _, high in ends.values()]
    lower.append((lower[0][0], -width / 2, -(0.5 + _BASE_DEPTH) * height))
    upper.append((upper[-1][0], width / 2, -height / 2))
    return Obstacles(tuple(ends), read_only_floats(lower), read_only_floats(upper))


def find_block_ends(gauge: StepGauge, block: int) -> tuple[float, float]:
    """Return the nominal distances of a block's faces from the reference face, m."""
    low, high = sorted(face.nominal for face in gauge.faces if face.block == block)
    return low, high
