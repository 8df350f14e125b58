"""Plans the path of a probe over a step gauge: over the top of its blocks, or round their side.

Each cycle probes the front faces on the way forward and the back faces on the way back, so that the machine
comes to each side of the blocks in one direction of travel; after Pahk and Kim, *Development of computer
aided calibration module for CMMs and machine tools using a compensated step gauge*.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace

from zlmreport.errors import Place
from zlmreport.step_gauge.gauge import Face, Location, Side, StepGauge
from zlmreport.step_gauge.path import Move, Point, Probing, ProbingPath, Travel
from zlmreport.step_gauge.path_ends import with_ends
from zlmreport.step_gauge.path_frame import GaugeFrame
from zlmreport.step_gauge.path_obstacles import Obstacles, block_ends, obstacles
from zlmreport.step_gauge.path_safety import Room, refuse_collisions
from zlmreport.step_gauge.path_settings import PathKind, PathSettings


@dataclass(frozen=True, slots=True)
class PlannedPath:
    """A path that is free, with what it leads round.

    Attributes
    ----------
    path
        The path.
    settings
        How it was planned.
    frame
        The gauge's own coordinates.
    room
        The room that the tip has between its blocks and its base.
    """

    path: ProbingPath
    settings: PathSettings
    frame: GaugeFrame
    room: Room

    @property
    def obstacles(self) -> Obstacles:
        """The blocks and the base of the gauge."""
        return self.room.obstacles


@dataclass(frozen=True, slots=True)
class _Stations:
    """Where the tip's centre goes for a face; in the gauge's own coordinates, m.

    Attributes
    ----------
    frame
        These coordinates.
    level
        Height at which faces are probed.
    aside
        Across and upward: where the tip passes the blocks.
    reach
        Distance of the tip's centre from the face at the start of a measuring move.
    """

    frame: GaugeFrame
    level: float
    aside: tuple[float, float]
    reach: float

    def before(self, face: Face, origin: float) -> float:
        """Return where along the gauge the measuring move to a face begins."""
        return face.nominal - origin + face.side * self.reach

    def in_line(self, along: float) -> Point:
        """Return a point in the line of the faces' centres."""
        return self.frame.to_machine(along, 0.0, self.level)

    def passing(self, along: float) -> Point:
        """Return the point beside or above it where the tip passes the blocks."""
        return self.frame.to_machine(along, *self.aside)


def plan_path(  # noqa: PLR0913 - a gauge, where it lies, and how, for whom
    gauge: StepGauge,
    section: StepGauge,
    location: Location,
    settings: PathSettings,
    *,
    size: tuple[float, float],
    number: str,
    place: Place,
) -> PlannedPath:
    """Return the path over the faces of a section, every move of it free.

    Parameters
    ----------
    gauge
        The whole gauge.
    section
        The part of it that is probed.
    location
        Where the section lies.
    settings
        How it is probed.
    size
        Width and height of the blocks, m.
    number
        Of the job.
    place
        Where the path is asked for.

    Raises
    ------
    InputError
        If the tip would touch what it does not measure, or leave the working volume: with the moves.
    """
    frame = GaugeFrame.of(location)
    width, height = size
    first = section.blocks[0]
    boxes = obstacles(gauge, first, width, height)
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
    inner = list(_inner(section, settings, stations, sum(block_ends(gauge, first)) / 2))
    path = ProbingPath(
        number=number,
        gauge=" ".join(part for part in (gauge.name, gauge.serial) if part),
        moves=with_ends(inner, settings, room),
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


def _inner(section: StepGauge, settings: PathSettings, stations: _Stations, origin: float) -> Iterator[Move]:
    """Yield the moves from the first face to the last one that is probed."""
    fronts = [face for face in section.faces if face.side is Side.FRONT]
    backs = [face for face in reversed(section.faces) if face.side is Side.BACK]
    if settings.lead_in and settings.kind is PathKind.HORIZONTAL:
        start = stations.before(fronts[0], origin) - settings.lead_in
        yield Travel(stations.in_line(start))
        yield Travel(stations.passing(start))
    for cycle in range(1, settings.cycles + 1):
        for face in (*fronts, *backs):
            before = stations.before(face, origin)
            normal = stations.frame.turned(float(face.side))
            yield Travel(stations.passing(before), face.number, cycle)
            yield Travel(stations.in_line(before), face.number, cycle)
            yield Probing(face.number, cycle, stations.in_line(face.nominal - origin), normal)
            yield Travel(stations.in_line(before), face.number, cycle)
            yield Travel(stations.passing(before), face.number, cycle)


def remaining(planned: PlannedPath, done: Collection[tuple[int, int]]) -> ProbingPath:
    """Return a path without the faces of the cycles that are done.

    All moves to a face and away from it begin and end where the tip passes the blocks, so that those of
    others can be left out; what then follows upon each other is held against the gauge again.

    Parameters
    ----------
    planned
        The whole path.
    done
        Numbers of face and cycle.

    Raises
    ------
    InputError
        If a move of what is left is not free.
    """
    left = [move for move in planned.path.moves if move.cycle and (move.face, move.cycle) not in done]
    if not left:
        return replace(planned.path, moves=())
    path = replace(planned.path, moves=with_ends(left, planned.settings, planned.room))
    refuse_collisions(path, planned.room)
    return path
