"""Plans the path of a probe over a step gauge: over the top of its blocks, or round their side.

Each cycle probes the front faces on the way forward and the back faces on the way back, so that the machine
comes to each side of the blocks in one direction of travel; after Pahk and Kim, *Development of computer
aided calibration module for CMMs and machine tools using a compensated step gauge*.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

from zlmreport.plugin import MICROMETRE, MILLIMETRE, InputError, Place, Problem
from zlmreport.plugin.extension import Job
from zlmreport_step_gauge.calibration import cut_section, read_calibration
from zlmreport_step_gauge.gauge import Face, GaugeLocation, Side, StepGauge
from zlmreport_step_gauge.initial_points import read_initial_points
from zlmreport_step_gauge.keys import ProbingPathKeys, StepGaugeKeys
from zlmreport_step_gauge.location import locate
from zlmreport_step_gauge.paths.path import Move, PathKind, PathSettings, Point, Probing, ProbingPath, Travel
from zlmreport_step_gauge.paths.room import (
    GaugeFrame,
    Obstacles,
    Room,
    find_block_ends,
    is_free,
    make_obstacles,
    refuse_collisions,
)


@dataclass(frozen=True, slots=True)
class PlannedPath:
    """A path that is free, with what it leads round."""

    path: ProbingPath
    settings: PathSettings  #: How it was planned.
    frame: GaugeFrame  #: The gauge's own coordinates.
    room: Room  #: The room that the tip has between its blocks and its base.

    @property
    def obstacles(self) -> Obstacles:
        """The blocks and the base of the gauge."""
        return self.room.obstacles


@dataclass(frozen=True, slots=True)
class _Stations:
    """Where the tip's centre goes for a face; in the gauge's own coordinates, m."""

    frame: GaugeFrame  #: These coordinates.
    level: float  #: Height at which faces are probed.
    aside: tuple[float, float]  #: Across and upward: where the tip passes the blocks.
    reach: float  #: Distance of the tip's centre from the face at the start of a measuring move.

    def place_before(self, face: Face, origin: float) -> float:
        """Return where along the gauge the measuring move to a face begins."""
        return face.nominal - origin + face.side * self.reach

    def place_in_line(self, along: float) -> Point:
        """Return a point in the line of the faces' centres."""
        return self.frame.to_machine(along, 0.0, self.level)

    def place_passing(self, along: float) -> Point:
        """Return the point beside or above it where the tip passes the blocks."""
        return self.frame.to_machine(along, *self.aside)


def plan_path(  # noqa: PLR0913 - a gauge, where it lies, and how, for whom
    gauge: StepGauge,
    section: StepGauge,
    location: GaugeLocation,
    settings: PathSettings,
    *,
    size: tuple[float, float],
    number: str,
    place: Place,
) -> PlannedPath:
    """Return the path over the faces of a section, every move of it free.

    `size`: Width and height of the blocks, m.

    Raises `InputError` if the tip would touch what it does not measure, or leave the working volume: with the
    moves.
    """
    frame = GaugeFrame.of(location)
    width, height = size
    first = section.blocks[0]
    boxes = make_obstacles(gauge, first, width, height)
    beside = settings.clearance + settings.tip_radius
    level = 0.0 if settings.depth is None else height / 2 - settings.depth
    stations = _Stations(
        frame=frame,
        level=level,
        aside=(0.0, height / 2 + beside)
        if settings.kind is PathKind.VERTICAL
        else (width / 2 + beside, level),
        reach=settings.approach + settings.tip_radius,
    )
    room = Room(frame, boxes, settings.tip_radius, settings.stylus_allowance, settings.working_volume)
    inner = list(_plan_inner(section, settings, stations, sum(find_block_ends(gauge, first)) / 2))
    path = ProbingPath(
        number=number,
        gauge=" ".join(part for part in (gauge.name, gauge.serial) if part),
        moves=_add_ends(inner, settings, room),
        tip_radius=settings.tip_radius,
        approach=settings.approach,
        search=settings.search,
        retract=settings.retract,
        speed=settings.speed,
        measuring_speed=settings.measuring_speed,
        radius_correction=settings.radius_correction,
        place=place,
    )
    refuse_collisions(path, room)
    return PlannedPath(path, settings, frame, room)


def _plan_inner(
    section: StepGauge, settings: PathSettings, stations: _Stations, origin: float
) -> Iterator[Move]:
    """Yield the moves from the first face to the last one that is probed."""
    fronts = [face for face in section.faces if face.side is Side.FRONT]
    backs = [face for face in reversed(section.faces) if face.side is Side.BACK]
    if settings.lead_in and settings.kind is PathKind.HORIZONTAL:
        start = stations.place_before(fronts[0], origin) - settings.lead_in
        yield Travel(stations.place_in_line(start))
        yield Travel(stations.place_passing(start))
    for cycle in range(1, settings.cycles + 1):
        for face in (*fronts, *backs):
            before = stations.place_before(face, origin)
            normal = stations.frame.turn(float(face.side))
            yield Travel(stations.place_passing(before), face.number, cycle)
            yield Travel(stations.place_in_line(before), face.number, cycle)
            yield Probing(face.number, cycle, stations.place_in_line(face.nominal - origin), normal)
            yield Travel(stations.place_in_line(before), face.number, cycle)
            yield Travel(stations.place_passing(before), face.number, cycle)


def find_remaining(planned: PlannedPath, done: Collection[tuple[int, int]]) -> ProbingPath:
    """Return a path without the faces of the cycles that are done.

    All moves to a face and away from it begin and end where the tip passes the blocks, so that those of
    others can be left out; what then follows upon each other is held against the gauge again.

    Raises `InputError` if a move of what is left is not free.
    """
    left = [move for move in planned.path.moves if move.cycle and (move.face, move.cycle) not in done]
    if not left:
        return replace(planned.path, moves=())
    path = replace(planned.path, moves=_add_ends(left, planned.settings, planned.room))
    refuse_collisions(path, planned.room)
    return path


def _add_ends(inner: Sequence[Move], settings: PathSettings, room: Room) -> tuple[Move, ...]:
    """Return moves with those to the first of their points and from the last.

    The tip goes straight from the safe position and back to it where that is free by the clearance, and else
    by way of the point over the first or the last one, at the clearance over the blocks.
    """
    first, last = _end(inner[0]), _end(inner[-1])
    return (*reversed(list(_plan_way(first, settings, room))), *inner, *_plan_way(last, settings, room))


def _plan_way(point: Point, settings: PathSettings, room: Room) -> Iterator[Move]:
    """Yield the moves from a point to the safe position."""
    safe = settings.safe_position
    if safe is None or not is_free(room, point, safe, settings.clearance):
        above = _find_above(point, settings, room)
        if above != point:
            yield Travel(above)
    if safe is not None:
        yield Travel(safe)


def _find_above(point: Point, settings: PathSettings, room: Room) -> Point:
    """Return the point over the blocks that lies above another."""
    along, across, upward = room.frame.to_gauge(point).tolist()
    over = float(room.obstacles.upper[0, 2]) + settings.clearance + settings.tip_radius
    return point if abs(upward - over) < 1e-9 else room.frame.to_machine(along, across, over)


def _end(move: Move) -> Point:
    return move.to if isinstance(move, Travel) else move.target


def plan_path_of_job(job: Job, keys: StepGaugeKeys) -> PlannedPath:
    """Return the path over the step gauge of a job.

    Raises `AccessError` if a file cannot be read; `InputError` if the job says too little, the gauge cannot
    be located, or the path is not free.
    """
    place = job.place_of("step_gauge")
    missing = {
        "initial_points": "where the gauge lies is not stated; state step_gauge.initial_points",
        "tip_radius": "the tip is not stated; state step_gauge.tip_radius",
    }
    problems = [Problem(place, text) for name, text in missing.items() if getattr(keys, name) is None]
    if problems or keys.initial_points is None or keys.tip_radius is None:
        raise InputError(problems)
    gauge = read_calibration(keys.calibration).gauge
    part = cut_section(gauge, keys.first_block, keys.last_block, place)
    radius = MILLIMETRE.to_si(keys.tip_radius)
    located = locate(
        read_initial_points(keys.initial_points),
        part,
        0.0 if keys.radius_correction else radius,
        MICROMETRE.to_si(keys.initial_points_uncertainty),
    )
    touched = (located.begin, located.end)
    return plan_path(
        gauge,
        part,
        located.location,
        _make_settings(keys, keys.path, radius),
        size=(
            gauge.block_width or max(float(block.width) for block in touched),
            gauge.block_height or max(float(block.height) for block in touched),
        ),
        number=job.keys.certificate.number,
        place=job.place_of("step_gauge.path"),
    )


def _make_settings(keys: StepGaugeKeys, path: ProbingPathKeys, radius: float) -> PathSettings:
    metres = MILLIMETRE.to_si
    safe, volume = path.safe_position, path.working_volume
    return PathSettings(
        kind=PathKind(path.kind),
        clearance=metres(path.clearance),
        approach=metres(path.approach),
        search=metres(path.search),
        retract=metres(path.retract),
        depth=None if path.depth is None else metres(path.depth),
        lead_in=metres(path.lead_in or 0.0),
        cycles=path.cycles,
        tip_radius=radius,
        stylus_allowance=metres(path.stylus_allowance),
        speed=metres(path.speed),
        measuring_speed=metres(path.measuring_speed),
        radius_correction=keys.radius_correction,
        safe_position=None if safe is None else (metres(safe[0]), metres(safe[1]), metres(safe[2])),
        working_volume=None
        if volume is None
        else (
            (metres(volume[0][0]), metres(volume[0][1])),
            (metres(volume[1][0]), metres(volume[1][1])),
            (metres(volume[2][0]), metres(volume[2][1])),
        ),
    )
