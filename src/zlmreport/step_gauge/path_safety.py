"""Holds a path against what is in its way: the gauge itself, and the end of the machine's travel."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from zlmreport.errors import InputError, Problem
from zlmreport.quantities.arrays import FloatArray
from zlmreport.quantities.units import MILLIMETRE
from zlmreport.step_gauge.path import Move, Point, Probing, ProbingPath
from zlmreport.step_gauge.path_frame import GaugeFrame
from zlmreport.step_gauge.path_obstacles import Obstacles

#: How many moves a message names; one that fails mostly fails at every block.
_NAMED = 5
#: Rounding of the arithmetic, m.
_ROUNDING = 1e-9


@dataclass(frozen=True, slots=True)
class Room:
    """The room that a tip has.

    Attributes
    ----------
    frame
        The gauge's own coordinates.
    obstacles
        What it must not touch.
    tip_radius
        m.
    allowance
        What must stay free beside the tip, m.
    volume
        First and last position in x, y and z that its centre can reach, m; None for anywhere.
    """

    frame: GaugeFrame
    obstacles: Obstacles
    tip_radius: float
    allowance: float
    volume: tuple[tuple[float, float], tuple[float, float], tuple[float, float]] | None


def is_free(room: Room, start: Point, end: Point, clearance: float) -> bool:
    """Return whether the tip stays clear of everything on a straight move, by a distance, m."""
    return bool((_gaps(room, np.array([start]), np.array([end])) >= clearance - _ROUNDING).all())


def refuse_collisions(path: ProbingPath, room: Room) -> None:
    """Refuse a path with a move that touches what it does not measure, or that leaves the working volume.

    A measuring move touches its own block, and so does the one that leads away from it.

    Raises
    ------
    InputError
        With the moves and the faces to which they lead.
    """
    problems = [*_outside(path, room), *_collisions(path, room)]
    if len(problems) > _NAMED:
        more = f"{len(problems) - _NAMED} more moves of the path cannot be made"
        problems = [*problems[:_NAMED], Problem(path.place, more)]
    if problems:
        raise InputError(problems)


def least_gap(path: ProbingPath, room: Room) -> tuple[float, str]:
    """Return how near the tip's surface comes to what it does not measure, m, and to what."""
    gaps = _gaps_of_path(path, room)
    nearest = int(gaps.min(axis=0).argmin())
    return float(gaps[:, nearest].min()), room.obstacles.names[nearest]


def _collisions(path: ProbingPath, room: Room) -> Iterator[Problem]:
    gaps = _gaps_of_path(path, room)
    for index in np.flatnonzero((gaps < room.allowance - _ROUNDING).any(axis=1)).tolist():
        nearest = int(gaps[index].argmin())
        gap = float(gaps[index, nearest])
        name = room.obstacles.names[nearest]
        left = f"only {MILLIMETRE.from_si(gap):.3g} mm are left beside {name}"
        finds = f"the tip runs into {name}" if gap <= _ROUNDING else left
        yield Problem(
            path.place,
            f"{_said(index + 2, path.moves[index + 1], path.stops[index + 1])}: {finds}, and "
            f"{MILLIMETRE.from_si(room.allowance):.3g} mm must stay free; change approach, clearance or "
            "safe_position, or take a smaller tip",
        )


def _gaps_of_path(path: ProbingPath, room: Room) -> FloatArray:
    """Return what is left beside the tip on each move after the first, m; infinite for what it measures."""
    stops = np.array(path.stops)
    moves, of_move = np.unique(np.hstack([stops[:-1], stops[1:]]), axis=0, return_inverse=True)
    gaps = _gaps(room, moves[:, :3], moves[:, 3:])[of_move.ravel()]  # a cycle is like the next
    numbers = np.array([*room.obstacles.blocks, 0])
    for index, (before, move) in enumerate(pairwise(path.moves)):
        touched = move if isinstance(move, Probing) else before
        if isinstance(touched, Probing):
            gaps[index, numbers == (touched.face + 1) // 2] = np.inf
    return gaps


def _outside(path: ProbingPath, room: Room) -> Iterator[Problem]:
    if room.volume is None:
        return
    for number, (move, stop) in enumerate(zip(path.moves, path.stops, strict=True), start=1):
        for name, at, (first, last) in zip("xyz", stop, room.volume, strict=True):
            if not first <= at <= last:
                low, high = MILLIMETRE.from_si(first), MILLIMETRE.from_si(last)
                yield Problem(
                    path.place,
                    f"{_said(number, move, stop)}: {name} leaves the working volume, {low:g} to {high:g} mm; "
                    "move the gauge, or choose a smaller clearance",
                )
                break


def _said(number: int, move: Move, stop: Point) -> str:
    where = ", ".join(f"{MILLIMETRE.from_si(at):.3f}" for at in stop)
    if not move.face:
        return f"move {number}, to ({where}) mm"
    kind = "measuring move" if isinstance(move, Probing) else "move"
    return f"{kind} {number} at face {move.face}, to ({where}) mm"


def _gaps(room: Room, starts: FloatArray, ends: FloatArray) -> FloatArray:
    """Return what is left between the tip's surface and each obstacle on straight moves, m."""
    own = room.frame.to_gauge
    return room.obstacles.distances(own(starts), own(ends)) - room.tip_radius
