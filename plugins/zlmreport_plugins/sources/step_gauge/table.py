"""The table of points: face, cycle, x, y, z, and the outward normal i, j, k if there is one."""

from __future__ import annotations

import math
from pathlib import Path

from zlmreport.errors import Problem
from zlmreport.quantities.units import MILLIMETRE
from zlmreport.step_gauge.gauge import StepGauge
from zlmreport.step_gauge.named_columns import Row, read_named_columns
from zlmreport.step_gauge.probed import ProbedPoint
from zlmreport_plugins.sources.step_gauge.points import Direction, Points, wrong_side

COLUMNS = ("face", "cycle", "x", "y", "z")
_NORMAL = ("i", "j", "k")


def read(path: Path, gauge: StepGauge, direction: Direction | None) -> Points:
    """Read the points; a point that was missed has its row, with empty cells for x, y and z."""
    table = read_named_columns(path, COLUMNS, _NORMAL)
    problems = table.problems
    points = [found for row in table.rows if (found := _point(row, gauge, direction, problems)) is not None]
    return Points(tuple(points), table.source, table.text.place(), tuple(problems))


def _point(
    row: Row, gauge: StepGauge, direction: Direction | None, problems: list[Problem]
) -> ProbedPoint | None:
    face, cycle = row.integer("face", problems), row.integer("cycle", problems)
    if any(row.text(column) for column in COLUMNS[2:]):
        coordinates = [row.number(column, problems) for column in COLUMNS[2:]]
    else:
        coordinates = [math.nan] * 3
    if face is None or cycle is None or None in coordinates:
        return None
    if all(row.text(column) for column in _NORMAL):
        normal = [row.number(column, problems) for column in _NORMAL]
        if None not in normal:
            message = wrong_side([each or 0.0 for each in normal], gauge.face(face), direction)
            if message:
                problems.append(Problem(row.place, message))
    x, y, z = (MILLIMETRE.to_si(each) for each in coordinates if each is not None)
    return ProbedPoint(row.place, face, cycle, (x, y, z))
