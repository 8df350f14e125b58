"""The way to the first face that is probed and from the last one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from zlmreport.step_gauge.path import Move, Point, Travel
from zlmreport.step_gauge.path_safety import Room, is_free
from zlmreport.step_gauge.path_settings import PathSettings


def with_ends(inner: Sequence[Move], settings: PathSettings, room: Room) -> tuple[Move, ...]:
    """Return moves with those to the first of their points and from the last.

    The tip goes straight from the safe position and back to it where that is free by the clearance, and else
    by way of the point over the first or the last one, at the clearance over the blocks.
    """
    first, last = _end(inner[0]), _end(inner[-1])
    return (*reversed(list(_way(first, settings, room))), *inner, *_way(last, settings, room))


def _way(point: Point, settings: PathSettings, room: Room) -> Iterator[Move]:
    """Yield the moves from a point to the safe position."""
    safe = settings.safe_position
    if safe is None or not is_free(room, point, safe, settings.clearance):
        above = _above(point, settings, room)
        if above != point:
            yield Travel(above)
    if safe is not None:
        yield Travel(safe)


def _above(point: Point, settings: PathSettings, room: Room) -> Point:
    """Return the point over the blocks that lies above another."""
    along, across, upward = room.frame.to_gauge(point).tolist()
    over = float(room.obstacles.upper[0, 2]) + settings.clearance + settings.tip_radius
    return point if abs(upward - over) < 1e-9 else room.frame.to_machine(along, across, over)


def _end(move: Move) -> Point:
    return move.to if isinstance(move, Travel) else move.target
