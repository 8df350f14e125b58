"""What the readers of the layouts share: points without numbers, and the faces that they lie on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from zlmreport.plugin import (
    MILLIMETRE,
    FloatArray,
    InputError,
    Place,
    Problem,
    SourceFile,
)
from zlmreport_step_gauge.gauge import Face, Side, StepGauge
from zlmreport_step_gauge.probed import ProbedPoint

Direction: TypeAlias = tuple[float, float, float]

#: Of the smallest distance between faces of one side: a point that is farther off lies on none of them.
_OF_A_STEP = 0.25


@dataclass(frozen=True, slots=True)
class Points:
    """What a layout's reader hands on.

    Attributes
    ----------
    points
        As they were taken.
    source
        The file.
    place
        Its name, for messages.
    problems
        What is wrong with it.
    is_corrected
        Whether the layout has points of the surface in any case.
    """

    points: tuple[ProbedPoint, ...]
    source: SourceFile
    place: Place
    problems: tuple[Problem, ...] = ()
    is_corrected: bool = False


@dataclass(frozen=True, slots=True)
class Unnumbered:
    """A point of which the file does not tell the face; the normal is None where it is not told either."""

    place: Place
    coordinates: tuple[float, float, float]
    normal: tuple[float, float, float] | None = None


def wrong_side(normal: Sequence[float], face: Face | None, direction: Direction | None) -> str | None:
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


def numbered(
    points: Sequence[Unnumbered],
    gauge: StepGauge,
    origin: Sequence[float],
    direction: Direction,
    radius: float,
) -> list[ProbedPoint]:
    """Return points with the faces that they lie on, and with cycles in the order of their coming back.

    Parameters
    ----------
    points
        In the order in which they were taken.
    gauge
        The section.
    origin, direction
        C1, and the unit vector to C2.
    radius
        Of the tip, m; 0 for points of the surface.

    Raises
    ------
    InputError
        For every point that lies on no face.
    """
    first = [face.nominal for face in gauge.faces if face.block == gauge.blocks[0]]
    middle = sum(first) / len(first)
    along = np.array([point.coordinates for point in points]) @ np.array(direction)
    position = along - float(np.dot(origin, direction)) + middle
    problems: list[Problem] = []
    visits: dict[int, int] = {}
    found = []
    for point, at in zip(points, position.tolist(), strict=True):
        face = _nearest(at, point, gauge, direction, radius)
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


def _nearest(
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


def by_order(points: Sequence[Unnumbered], faces: Sequence[Face], place: Place) -> list[ProbedPoint]:
    """Return points with faces by where they lie in their cycle, the beginning being where it began.

    Raises
    ------
    InputError
        If they do not come to whole cycles.
    """
    size = len(faces)
    if not points or len(points) % size:
        raise InputError.at(
            place,
            f"holds {len(points)} points, and a cycle over this section has {size}: a face was missed, or "
            "the section is another one (step_gauge.first_block, last_block)",
        )
    found = []
    for cycle in range(len(points) // size):
        of_cycle = points[cycle * size : (cycle + 1) * size]
        ranks = _ranks(np.array([point.coordinates for point in of_cycle]))
        found += [
            ProbedPoint(point.place, faces[rank].number, cycle + 1, point.coordinates)
            for point, rank in zip(of_cycle, ranks, strict=True)
        ]
    return found


def _ranks(coordinates: FloatArray) -> list[int]:
    """Return the place of each point in the order along their line, counted from the first one's end."""
    centred = coordinates - coordinates.mean(axis=0)
    along = centred @ np.linalg.svd(centred)[2][0]
    order = np.argsort(along if along[0] < 0 else -along)
    ranks = np.empty(len(order), dtype=np.int64)
    ranks[order] = np.arange(len(order))
    return [int(rank) for rank in ranks]
