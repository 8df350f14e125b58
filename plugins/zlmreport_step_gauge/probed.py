"""The faces as a machine has probed them, in a grid of face and cycle."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.plugin import (
    BoolArray,
    FloatArray,
    InputError,
    Place,
    Problem,
    did_you_mean,
    read_only_floats,
)
from zlmreport_step_gauge.gauge import Face, Side, StepGauge

#: Problems of one file that are named one by one.
_MOST_NAMED = 20


@dataclass(frozen=True, slots=True)
class ProbedPoint:
    """A face that was touched once.

    Attributes
    ----------
    place
        Where it stands in its file.
    face
        Number of the face on the gauge.
    cycle
        From 1.
    coordinates
        x, y, z of the tip's centre or of the surface, m; of a file that gives distances from the reference
        face only, the distance alone; NaN where the point is named and missing.
    """

    place: Place
    face: int
    cycle: int
    coordinates: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Probed:
    """All points of a test.

    Attributes
    ----------
    faces
        Of the section, those that were probed, in their order.
    cycles
        Their numbers, rising.
    coordinates : (face, cycle, dimension) array
        m; NaN where a point is missing. One dimension for distances, three for points.
    points
        As they were taken.
    """

    faces: tuple[Face, ...]
    cycles: tuple[int, ...]
    coordinates: FloatArray
    points: tuple[ProbedPoint, ...]

    @property
    def is_front(self) -> BoolArray:
        """Whether a face is a front face, shape (face,)."""
        return np.array([face.side is Side.FRONT for face in self.faces])

    @property
    def sides(self) -> FloatArray:
        """The outward normals along the gauge, −1 in front and +1 at the back, shape (face,)."""
        return np.array([float(face.side) for face in self.faces])


def gridded(
    points: Sequence[ProbedPoint],
    gauge: StepGauge,
    sides: Sequence[Side],
    *,
    place: Place,
    problems: Iterable[Problem] = (),
) -> Probed:
    """Return the points of a test by face and cycle.

    Parameters
    ----------
    points
        As they were taken.
    gauge
        The section that is used.
    sides
        The faces that are evaluated; points on others are left out.
    place
        The file.
    problems
        What its reader found wrong.

    Raises
    ------
    InputError
        With every face that the section lacks, that was touched twice in a cycle, or was missed in all.
    """
    found = list(problems)
    known = {face.number: face for face in gauge.faces}
    taken: dict[tuple[int, int], ProbedPoint] = {}
    for point in points:
        if point.face not in known:
            found.append(Problem(point.place, _off_the_section(point, gauge)))
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
        found.extend(_missed(faces, taken, place))
    if found:
        ordered = sorted(set(found))
        raise InputError(
            [
                *ordered[:_MOST_NAMED],
                *(
                    [Problem(place, f"and {len(ordered) - _MOST_NAMED} more")]
                    if len(ordered) > _MOST_NAMED
                    else []
                ),
            ]
        )
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


def _off_the_section(point: ProbedPoint, gauge: StepGauge) -> str:
    first, last = gauge.faces[0].number, gauge.faces[-1].number
    return (
        f"face {point.face} is not on the section, which has the faces {first} to {last} (blocks "
        f"{gauge.blocks[0]} to {gauge.blocks[-1]}); is step_gauge.first_block or last_block right?"
    )


def _missed(
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


def face_of(name: str, mapping: dict[str, int], place: Place) -> int:
    """Return the number of the face that a file calls by a name; a mapping of the job comes first.

    Without it, the digits at the end of the name are the number: ``F01``, ``Face 12``.

    Raises
    ------
    InputError
        If the name tells no face.
    """
    if name in mapping:
        return mapping[name]
    digits = name[len(name.rstrip("0123456789")) :]
    if mapping or not digits or not int(digits):
        near = did_you_mean(name[:40], list(mapping)) if mapping else "state measurement.source.faces"
        raise InputError.at(place, f"{name[:40]!r} names no face of the gauge; {near}")
    return int(digits)
