"""What initial points must hold to be on the first and the last block of a section."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from zlmreport.errors import Problem
from zlmreport.quantities.arrays import FloatArray
from zlmreport.quantities.units import DEGREE, MILLIMETRE
from zlmreport.step_gauge.block import Block, altitude
from zlmreport.step_gauge.gauge import Face, StepGauge
from zlmreport.step_gauge.initial_points import BLOCKS, InitialPoints

#: Smallest height of the triangle of P1, P2, P3, m.
_LEAST_ALTITUDE = 0.3e-3
#: What the size of a block may differ from the stated one, relative and m: blocks are finished roughly
#: beside their faces, and a tip of the wrong radius shows.
_SIZE = (0.05, 0.5e-3)
#: Between the direction and what should be parallel or at right angles to it.
_MOST_ASKEW = math.radians(10)


def angle_between(a: FloatArray, b: FloatArray) -> float:
    """Return the angle between two unit vectors, rad."""
    return float(np.arctan2(np.linalg.norm(np.cross(a, b)), np.dot(a, b)))


def no_blocks(
    points: InitialPoints, coordinates: FloatArray, blocks: tuple[Block, Block], gauge: StepGauge
) -> Iterator[Problem]:
    """Yield why points do not lie on a block of the gauge: on a line, not on its sides, of another size."""
    for name, of_block, block, altitude_of in zip(
        BLOCKS, coordinates, blocks, altitude(coordinates), strict=True
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
            yield from _another_size(points, name, block, gauge)


def _is_askew(vector: FloatArray, direction: FloatArray) -> bool:
    """Whether a vector departs by more than 45° from a direction, or is none."""
    length = float(np.linalg.norm(vector))
    return not abs(float(vector @ direction)) > length * math.sqrt(0.5) > 0


def _another_size(points: InitialPoints, name: str, block: Block, gauge: StepGauge) -> Iterator[Problem]:
    expected = gauge.faces[0:2] if name == BLOCKS[0] else gauge.faces[-2:]
    for what, found, stated, hint in (
        ("length", float(block.length), _distance(*expected), "P1 to P3 belong on the front, P8 on the back"),
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


def _distance(front: Face, back: Face) -> float:
    return back.nominal - front.nominal


def askew(points: InitialPoints, blocks: tuple[Block, Block], direction: FloatArray) -> Iterator[Problem]:
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
        angle = angle_between(-block.normal, direction)
        if angle > _MOST_ASKEW:
            yield Problem(
                points.place,
                f"block {name}: the plane of P1, P2 and P3 is turned by {DEGREE.from_si(angle):.1f}° from "
                "the line between the two blocks; these points are not on its front face",
            )


def another_section(
    points: InitialPoints, blocks: tuple[Block, Block], gauge: StepGauge
) -> Iterator[Problem]:
    """Yield that the two blocks are not as far apart as the section's first and last block."""
    found = float(np.linalg.norm(blocks[1].centre - blocks[0].centre))
    centres = {block: _centre(gauge, block) for block in gauge.blocks}
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


def _centre(gauge: StepGauge, block: int) -> float:
    faces = [face.nominal for face in gauge.faces if face.block == block]
    return sum(faces) / len(faces)
