"""Fits a block of a gauge to the eight points on it: planes, size, centre; refuses one that is askew.

All functions take points of shape (..., 8, 3), batch dimensions first; so the uncertainty is propagated, and
a thousand calibrations are simulated, by one call.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from zlmreport.plugin import DEGREE, MILLIMETRE, FloatArray, Problem
from zlmreport_step_gauge.gauge import Face, StepGauge
from zlmreport_step_gauge.initial_points import BLOCKS, InitialPoints


@dataclass(frozen=True, slots=True)
class Block:
    """A block in the coordinates of the machine, or a stack of blocks."""

    #: (..., 3): N, the outward normal of the front face: P1P2 x P1P3, pointing away from P8.
    normal: FloatArray
    #: sideward and upward: (..., 3): Unit vectors from one side to the other and out of the top; with the
    #: normal a frame.
    sideward: FloatArray
    upward: FloatArray
    centre: FloatArray  #: (..., 3): C, m.
    #: length, width and height: (...): Between front and back, between the sides, from the foot to the top,
    #: m.
    length: FloatArray
    width: FloatArray
    height: FloatArray


def fit_block(points: FloatArray, radius: float) -> Block:
    """Return the block that eight points lie on; of points that define none, values are NaN or nonsense.

    `points`, (..., 8, 3): P1 to P8, centres of the tip, m.
    `radius`: Of the tip, m; 0 where the points are those of the surface.
    """
    p1, p2, p3, *_, p8 = np.moveaxis(points, -2, 0)
    normal = _normalise(np.cross(p2 - p1, p3 - p1))
    front = (p1 + p2 + p3) / 3
    return fit_block_along(points, radius, normal * _sign(_dot(front - p8, normal)))


def fit_block_along(points: FloatArray, radius: float, normal: FloatArray) -> Block:
    """Return the block that eight points lie on, its front face square to a direction that is known.

    `points`, `radius`: As of `fit_block`.
    `normal`, (..., 3): Outward normal of the front face.

    The centre lies midway between front and back and between the sides, where the radius cancels. P6 and P7
    are both touched from above, so that it cancels in the height, and the centre lies below their middle by
    the radius.
    """
    p1, p2, p3, p4, p5, p6, p7, p8 = np.moveaxis(points, -2, 0)
    front = (p1 + p2 + p3) / 3
    across = p4 - p5
    sideward = _normalise(across - _dot(across, normal) * normal)
    upward = np.cross(normal, sideward)
    upward = upward * _sign(_dot(p6 - p7, upward))
    along = _dot(front + p8, normal) / 2
    aside = _dot(p4 + p5, sideward) / 2
    above = _dot(p6 + p7, upward) / 2 - radius
    return Block(
        normal=normal,
        sideward=sideward,
        upward=upward,
        centre=along * normal + aside * sideward + above * upward,
        length=(_dot(front - p8, normal) - 2 * radius)[..., 0],
        width=(_dot(across, sideward) - 2 * radius)[..., 0],
        height=_dot(p6 - p7, upward)[..., 0],
    )


def compute_altitude(points: FloatArray) -> FloatArray:
    """Return the smallest height of the triangle P1, P2, P3, m, shape (...): 0 where they lie on a line."""
    p1, p2, p3 = np.moveaxis(points[..., :3, :], -2, 0)
    doubled_area = np.linalg.norm(np.cross(p2 - p1, p3 - p1), axis=-1)
    longest = np.max([np.linalg.norm(a - b, axis=-1) for a, b in ((p1, p2), (p2, p3), (p3, p1))], axis=0)
    with np.errstate(invalid="ignore"):
        height: FloatArray = np.where(longest > 0, doubled_area / np.where(longest > 0, longest, 1.0), 0.0)
    return height


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the scalar product, its axis kept."""
    product: FloatArray = np.sum(a * b, axis=-1, keepdims=True)
    return product


def _normalise(vector: FloatArray) -> FloatArray:
    with np.errstate(invalid="ignore", divide="ignore"):
        unit: FloatArray = vector / np.linalg.norm(vector, axis=-1, keepdims=True)
    return unit


def _sign(value: FloatArray) -> FloatArray:
    """Return 1 or −1, and 1 of zero."""
    return np.where(value < 0, -1.0, 1.0)


#: Smallest height of the triangle of P1, P2, P3, m.
_LEAST_ALTITUDE = 0.3e-3
#: What the size of a block may differ from the stated one, relative and m: blocks are finished roughly
#: beside their faces, and a tip of the wrong radius shows.
_SIZE = (0.05, 0.5e-3)
#: Between the direction and what should be parallel or at right angles to it.
_MOST_ASKEW = math.radians(10)


def compute_angle_between(a: FloatArray, b: FloatArray) -> float:
    """Return the angle between two unit vectors, rad."""
    return float(np.arctan2(np.linalg.norm(np.cross(a, b)), np.dot(a, b)))


def find_no_blocks(
    points: InitialPoints, coordinates: FloatArray, blocks: tuple[Block, Block], gauge: StepGauge
) -> Iterator[Problem]:
    """Yield why points do not lie on a block of the gauge: on a line, not on its sides, of another size."""
    for name, of_block, block, altitude_of in zip(
        BLOCKS, coordinates, blocks, compute_altitude(coordinates), strict=True
    ):
        if altitude_of < _LEAST_ALTITUDE:
            yield Problem(
                points.place,
                f"block {name}: P1, P2 and P3 lie on a line and define no plane; they belong far apart on "
                "the front face",
            )
            continue
        across, rise = of_block[3] - of_block[4], of_block[5] - of_block[6]
        if _is_askew(across, block.sideward):
            yield Problem(
                points.place,
                f"block {name}: P4 and P5 do not lie on opposite sides of the block whose front face P1, P2 "
                "and P3 define",
            )
        elif abs(float(rise @ block.sideward)) > abs(float(rise @ block.upward)):
            yield Problem(
                points.place,
                f"block {name}: P6 and P7 do not lie above each other; P4 and P5 are the sides, P6 the top, "
                "P7 the foot",
            )
        else:
            yield from _find_another_size(points, name, block, gauge)


def _is_askew(vector: FloatArray, direction: FloatArray) -> bool:
    """Whether a vector departs by more than 45° from a direction, or is none."""
    length = float(np.linalg.norm(vector))
    return not abs(float(vector @ direction)) > length * math.sqrt(0.5) > 0


def _find_another_size(points: InitialPoints, name: str, block: Block, gauge: StepGauge) -> Iterator[Problem]:
    expected = gauge.faces[0:2] if name == BLOCKS[0] else gauge.faces[-2:]
    for what, found, stated, hint in (
        (
            "length",
            float(block.length),
            _measure_distance(*expected),
            "P1 to P3 belong on the front, P8 on the back",
        ),
        ("width", float(block.width), gauge.block_width, "P4 and P5 belong on its sides"),
        ("height", float(block.height), gauge.block_height, "P6 belongs on its top, P7 at its foot"),
    ):
        shown = MILLIMETRE.from_si(found)
        if found <= 0:
            yield Problem(points.place, f"block {name} would have a {what} of {shown:.3f} mm; {hint}")
        elif stated is not None and abs(found - stated) > max(_SIZE[0] * stated, _SIZE[1]):
            yield Problem(
                points.place,
                f"block {name} has a {what} of {shown:.3f} mm by these points, and the gauge one of "
                f"{MILLIMETRE.from_si(stated):.3f} mm; {hint}. Is step_gauge.tip_radius right?",
            )


def _measure_distance(front: Face, back: Face) -> float:
    return back.nominal - front.nominal


def find_askew(
    points: InitialPoints, blocks: tuple[Block, Block], direction: FloatArray
) -> Iterator[Problem]:
    """Yield that front faces do not look away from the other end: ends exchanged, or another face touched."""
    against = [float(block.normal @ direction) for block in blocks]
    if all(each > 0 for each in against):
        yield Problem(
            points.place,
            "the front faces (P1 to P3) look towards the other end of the gauge: beginning and end are "
            "exchanged, or the points were taken on the back faces",
        )
        return
    for name, block in zip(BLOCKS, blocks, strict=True):
        angle = compute_angle_between(-block.normal, direction)
        if angle > _MOST_ASKEW:
            yield Problem(
                points.place,
                f"block {name}: the plane of P1, P2 and P3 is turned by {DEGREE.from_si(angle):.1f}° from "
                "the line between the two blocks; these points are not on its front face",
            )


def find_another_section(
    points: InitialPoints, blocks: tuple[Block, Block], gauge: StepGauge
) -> Iterator[Problem]:
    """Yield that the two blocks are not as far apart as the section's first and last block."""
    found = float(np.linalg.norm(blocks[1].centre - blocks[0].centre))
    centres = {block: _find_centre(gauge, block) for block in gauge.blocks}
    first, *later = centres
    pitch = min(centres[b] - centres[a] for a, b in zip(centres, later, strict=False))
    distance = centres[later[-1]] - centres[first]
    if abs(found - distance) <= pitch / 4:
        return
    fitting = [each for each in later if abs(found - (centres[each] - centres[first])) <= pitch / 4]
    hint = f"they fit the blocks {first} to {fitting[0]}" if fitting else "count the blocks between them"
    yield Problem(
        points.place,
        f"the two blocks are {MILLIMETRE.from_si(found):.3f} mm apart by these points, and the blocks "
        f"{first} and {later[-1]} of the section {MILLIMETRE.from_si(distance):.3f} mm; {hint} (step_gauge."
        "first_block, last_block)",
    )


def _find_centre(gauge: StepGauge, block: int) -> float:
    faces = [face.nominal for face in gauge.faces if face.block == block]
    return sum(faces) / len(faces)
