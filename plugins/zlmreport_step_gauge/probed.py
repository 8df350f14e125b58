"""Arranges probed points by face and cycle; finds the face of points without numbers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from zlmreport.plugin import (
    MILLIMETRE,
    FloatArray,
    InputError,
    Place,
    Problem,
    counted,
    did_you_mean,
    read_only_floats,
)
from zlmreport.plugin.source import SourceFile, cap_problems
from zlmreport_step_gauge.gauge import Face, Side, StepGauge

#: Digits of the number of a face: no gauge has more faces.
_LONGEST_NUMBER = 9


@dataclass(frozen=True, slots=True)
class ProbedPoint:
    """A face that was touched once."""

    place: Place  #: Where it stands in its file.
    face: int  #: Number of the face on the gauge.
    cycle: int  #: From 1.
    #: x, y, z of the tip's centre or of the surface, m; of a file that gives distances from the reference
    #: face only, the distance alone; NaN where the point is named and missing.
    coordinates: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Probed:
    """All points of a test."""

    faces: tuple[Face, ...]  #: Of the section, those that were probed, in their order.
    cycles: tuple[int, ...]  #: Their numbers, rising.
    #: (face, cycle, dimension): m; NaN where a point is missing. One dimension for distances, three for
    #: points.
    coordinates: FloatArray
    points: tuple[ProbedPoint, ...]  #: As they were taken.

    @property
    def sides(self) -> FloatArray:
        """The outward normals along the gauge, −1 in front and +1 at the back, shape (face,)."""
        return np.array([float(face.side) for face in self.faces])


def arrange_on_grid(
    points: Sequence[ProbedPoint],
    gauge: StepGauge,
    sides: Sequence[Side],
    *,
    place: Place,
    problems: Iterable[Problem] = (),
) -> Probed:
    """Return the points of a test by face and cycle.

    `sides`: The faces that are evaluated; points on others are left out.

    Raises `InputError` with every face that the section lacks, that was touched twice in a cycle, or was
    missed in all.
    """
    found = list(problems)
    known = {face.number: face for face in gauge.faces}
    taken: dict[tuple[int, int], ProbedPoint] = {}
    for point in points:
        if point.face not in known:
            found.append(Problem(point.place, _say_off_the_section(point, gauge)))
        elif (earlier := taken.setdefault((point.face, point.cycle), point)) is not point:
            found.append(
                Problem(
                    point.place,
                    f"face {point.face}, cycle {point.cycle}, stands in line {earlier.place.line} already; a "
                    "repeated cycle has a number of its own",
                )
            )
    if not points and not found:
        found.append(Problem(place, "holds no probed point"))
    faces = tuple(face for face in gauge.faces if face.side in sides)
    if not found:
        found.extend(_find_missed(faces, taken, place))
    if found:
        raise InputError(cap_problems(found))
    cycles = tuple(sorted({cycle for _, cycle in taken}))
    dimension = len(points[0].coordinates)
    coordinates = np.full((len(faces), len(cycles), dimension), np.nan)
    for index, face in enumerate(faces):
        for column, cycle in enumerate(cycles):
            if (face.number, cycle) in taken:
                coordinates[index, column] = taken[face.number, cycle].coordinates
    numbers = {face.number for face in faces}
    kept = tuple(point for point in points if point.face in numbers)
    return Probed(faces, cycles, read_only_floats(coordinates), kept)


def _say_off_the_section(point: ProbedPoint, gauge: StepGauge) -> str:
    first, last = gauge.faces[0].number, gauge.faces[-1].number
    return (
        f"face {point.face} is not on the section, which has the faces {first} to {last} (blocks "
        f"{gauge.blocks[0]} to {gauge.blocks[-1]}); is step_gauge.first_block or last_block right?"
    )


def _find_missed(
    faces: Sequence[Face], taken: dict[tuple[int, int], ProbedPoint], place: Place
) -> Iterator[Problem]:
    """Yield the faces of which there is no point at all."""
    touched = {number for (number, _), point in taken.items() if not np.isnan(point.coordinates[0])}
    for face in faces:
        if face.number not in touched:
            side = face.side.name.lower()
            yield Problem(
                place,
                f"face {face.number} (block {face.block}, {side}) was missed: it has no point in any cycle; "
                "probe it, or choose a section without its block (step_gauge.first_block, last_block)",
            )


def find_face_of(name: str, mapping: dict[str, int], place: Place) -> int:
    """Return the number of the face that a file calls by a name; a mapping of the job comes first.

    Without it, the digits at the end of the name are the number: ``F01``, ``Face 12``.

    Raises `InputError` if the name tells no face.
    """
    if name in mapping:
        return mapping[name]
    digits = name[len(name.rstrip("0123456789")) :]
    if mapping or not digits.strip("0") or len(digits) > _LONGEST_NUMBER:
        near = did_you_mean(name[:40], list(mapping)) if mapping else "state measurement.source.faces"
        raise InputError.at(place, f"{name[:40]!r} names no face of the gauge; {near}")
    return int(digits)


Direction: TypeAlias = tuple[float, float, float]

#: Of the smallest distance between faces of one side: a point that is farther off lies on none of them.
_OF_A_STEP = 0.25


@dataclass(frozen=True, slots=True)
class Points:
    """What a layout's reader hands on."""

    points: tuple[ProbedPoint, ...]  #: As they were taken.
    source: SourceFile  #: The file.
    place: Place  #: Its name, for messages.
    problems: tuple[Problem, ...] = ()  #: What is wrong with it.
    is_corrected: bool = False  #: Whether the layout has points of the surface in any case.


@dataclass(frozen=True, slots=True)
class Unnumbered:
    """A point of which the file does not tell the face; the normal is None where it is not told either."""

    place: Place
    coordinates: tuple[float, float, float]
    normal: tuple[float, float, float] | None = None


def say_wrong_side(normal: Sequence[float], face: Face | None, direction: Direction | None) -> str | None:
    """Return what is wrong with an outward normal for a face; None if nothing is, or nothing is known."""
    if face is None or direction is None:
        return None
    against = float(np.dot(normal, direction))
    if against * face.side > 0:
        return None
    side = face.side.name.lower()
    return (
        f"face {face.number} is a {side} face, and the normal of this point looks the other way; are the "
        "faces numbered from the beginning of the gauge, and are beginning and end of the initial points "
        "right?"
    )


def number_points(
    points: Sequence[Unnumbered],
    gauge: StepGauge,
    origin: Sequence[float],
    direction: Direction,
    radius: float,
) -> list[ProbedPoint]:
    """Return points with the faces that they lie on, and with cycles in the order of their coming back.

    `points`: In the order in which they were taken.
    `origin`, `direction`: C1, and the unit vector to C2.
    `radius`: Of the tip, m; 0 for points of the surface.

    Raises `InputError` for every point that lies on no face.
    """
    first = [face.nominal for face in gauge.faces if face.block == gauge.blocks[0]]
    middle = sum(first) / len(first)
    along = np.array([point.coordinates for point in points]) @ np.array(direction)
    position = along - float(np.dot(origin, direction)) + middle
    problems: list[Problem] = []
    visits: dict[int, int] = {}
    found = []
    for point, at in zip(points, position.tolist(), strict=True):
        face = _find_nearest(at, point, gauge, direction, radius)
        if face is None:
            shown = MILLIMETRE.from_si(at - middle)
            problems.append(
                Problem(
                    point.place, f"the point lies {shown:.3f} mm from C1 along the gauge, on no face of it"
                )
            )
            continue
        visits[face.number] = visits.get(face.number, 0) + 1
        found.append(ProbedPoint(point.place, face.number, visits[face.number], point.coordinates))
    if problems:
        raise InputError(problems)
    return found


def _find_nearest(
    position: float, point: Unnumbered, gauge: StepGauge, direction: Direction, radius: float
) -> Face | None:
    """Return the face that the tip touched; None if it is near none."""
    sides: tuple[Side, ...] = tuple(Side)
    if point.normal is not None:
        sides = (Side.BACK,) if float(np.dot(point.normal, direction)) > 0 else (Side.FRONT,)
    faces = [face for face in gauge.faces if face.side in sides]
    distances: FloatArray = np.array([position - face.side * radius - face.nominal for face in faces])
    best = int(np.argmin(np.abs(distances)))
    of_side = [face.nominal for face in gauge.faces if face.side is faces[best].side]
    step = float(np.min(np.diff(of_side)))
    return faces[best] if abs(float(distances[best])) <= _OF_A_STEP * step else None


def number_by_order(points: Sequence[Unnumbered], faces: Sequence[Face], place: Place) -> list[ProbedPoint]:
    """Return points with faces by where they lie in their cycle, the beginning being where it began.

    Raises `InputError` if they do not come to whole cycles.
    """
    size = len(faces)
    if not points or len(points) % size:
        raise InputError.at(
            place,
            f"holds {counted(len(points), 'point')}, and a cycle over this section has {size}: a face was "
            "missed, or the section is another one (step_gauge.first_block, last_block)",
        )
    found = []
    for cycle in range(len(points) // size):
        of_cycle = points[cycle * size : (cycle + 1) * size]
        ranks = _rank_points(np.array([point.coordinates for point in of_cycle]))
        found += [
            ProbedPoint(point.place, faces[rank].number, cycle + 1, point.coordinates)
            for point, rank in zip(of_cycle, ranks, strict=True)
        ]
    return found


def _rank_points(coordinates: FloatArray) -> list[int]:
    """Return the place of each point in the order along their line, counted from the first one's end."""
    centred = coordinates - coordinates.mean(axis=0)
    along = centred @ np.linalg.svd(centred)[2][0]
    order = np.argsort(along if along[0] < 0 else -along)
    ranks = np.empty(len(order), dtype=np.int64)
    ranks[order] = np.arange(len(order))
    return [int(rank) for rank in ranks]
