"""The 16 initial points that tell where a step gauge lies.

Each of the two blocks at the ends of the section is touched eight times:

====== ===========================================================================
point  where
====== ===========================================================================
P1-P3  on the front face, not on one line, as far apart as the face allows
P4, P5 on the two sides of the block, one each, about opposite each other
P6     on the top of the block
P7     from above on the body of the gauge, in the gap in front of the block: its foot
P8     on the back face
====== ===========================================================================

Pahk and Kim use eight points and do not say which lies where beyond the plane of P1, P2, P3; this is a
convention of this program. P1 to P3 may stand in any order, and so may P4 and P5; P6 and P7 may where the top
of the gauge looks up in the machine.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from zlmreport.plugin import MILLIMETRE, FloatArray, InputError, Place, Problem, read_only_floats
from zlmreport.plugin.source import SourceFile
from zlmreport_step_gauge.tables import NamedRow, read_named_columns

#: The names of the two blocks in files, in the order of the arrays.
BLOCKS = ("begin", "end")
POINTS = 8
_COLUMNS = ("block", "point", "x", "y", "z")


@dataclass(frozen=True, slots=True)
class InitialPoints:
    """The initial points."""

    #: (block, point, 3): Centres of the tip, or points of the surface where the machine corrects the radius,
    #: m; the beginning first, P1 to P8.
    coordinates: FloatArray
    place: Place  #: The file.
    source: SourceFile | None = None  #: Its name, digest and bytes; None for points made in memory.


def read_initial_points(path: Path) -> InitialPoints:
    """Read the initial points: columns block (begin, end), point (1 to 8), x, y, z, mm.

    Raises `AccessError` if the file cannot be read; `InputError` with every point that is missing, there
    twice, or no point.
    """
    table = read_named_columns(path, _COLUMNS)
    problems = table.problems
    coordinates = np.full((len(BLOCKS), POINTS, 3), np.nan)
    for row in table.rows:
        found = _read_point(row, problems)
        if found is None:
            continue
        block, point, place, values = found
        if np.isfinite(coordinates[block, point]).any():
            problems.append(Problem(place, f"point {point + 1} of block {BLOCKS[block]} is there twice"))
        coordinates[block, point] = values
    if not problems:
        problems.extend(
            Problem(table.text.place(), f"point {point + 1} of block {BLOCKS[block]} is missing")
            for block, point in np.argwhere(np.isnan(coordinates[..., 0])).tolist()
        )
    if problems:
        raise InputError(sorted(problems))
    return InitialPoints(read_only_floats(coordinates), table.text.place(), table.source)


def _read_point(row: NamedRow, problems: list[Problem]) -> tuple[int, int, Place, list[float]] | None:
    name = row.read_text("block").casefold()
    if name not in BLOCKS:
        problems.append(Problem(row.cells["block"].place, "column block: begin or end is expected"))
    point = row.read_integer("point", problems)
    if point is not None and point > POINTS:
        problems.append(Problem(row.cells["point"].place, f"a block has the points 1 to {POINTS}"))
    values = [row.read_number(column, problems) for column in ("x", "y", "z")]
    known = [MILLIMETRE.to_si(value) for value in values if value is not None]
    if name not in BLOCKS or point is None or point > POINTS or len(known) < len(values):
        return None
    return BLOCKS.index(name), point - 1, row.cells["point"].place, known
