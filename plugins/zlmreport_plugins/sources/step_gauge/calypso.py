"""The table of characteristics that ZEISS Calypso writes, ``*_chr.txt``: one row a characteristic and part.

The layout is known from two independent readers. Only the columns ``partnb``, ``id``, ``actual`` and ``unit``
are used; a closing line ``END`` may be there or not. Distances are those of the surface.
"""

from __future__ import annotations

from pathlib import Path

from zlmreport.errors import InputError, Problem
from zlmreport.measurement.text_file import TextFile, parse_number, read_text
from zlmreport.quantities.units import LENGTH_UNITS, unit_named
from zlmreport.step_gauge.probed import ProbedPoint, face_of
from zlmreport_plugins.sources.step_gauge.points import Points

_COLUMNS = ("partnb", "id", "actual", "unit")
_END = "END"


def is_calypso(header: str) -> bool:
    """Whether a header is that of such a table."""
    return set(_COLUMNS) <= set(header.split("\t"))


def read(path: Path, mapping: dict[str, int]) -> Points:
    """Read the distances: each part is a cycle, in the order in which the parts come."""
    text = read_text(path)
    header = text.lines[0].split("\t")
    missing = [name for name in _COLUMNS if name not in header]
    if missing:
        raise InputError.at(text.place(1, 1), f"the header lacks {', '.join(missing)}; columns are tabbed")
    indices = {name: header.index(name) for name in _COLUMNS}
    problems: list[Problem] = []
    cycles: dict[str, int] = {}
    points = []
    for number, line in enumerate(text.lines[1:], 2):
        if line.strip() and line.strip() != _END:
            point = _point(text, number, line.split("\t"), indices, mapping, cycles, problems)
            if point:
                points.append(point)
    return Points(tuple(points), text.source, text.place(), tuple(problems), is_corrected=True)


def _point(  # noqa: PLR0913, PLR0917 - a row with what it is read by
    text: TextFile,
    line: int,
    cells: list[str],
    indices: dict[str, int],
    mapping: dict[str, int],
    cycles: dict[str, int],
    problems: list[Problem],
) -> ProbedPoint | None:
    def column(name: str) -> int:
        return sum(len(cell) + 1 for cell in cells[: indices[name]]) + 1

    if len(cells) <= max(indices.values()):
        problems.append(Problem(text.place(line, 1), "the row ends before its column unit"))
        return None
    part, name, actual, unit = (cells[indices[each]].strip() for each in _COLUMNS)
    try:
        face = face_of(name, mapping, text.place(line, column("id")))
        value = unit_named(unit, LENGTH_UNITS).to_si(parse_number(actual))
    except InputError as error:
        problems.extend(error.problems)
        return None
    except ValueError as error:
        problems.append(Problem(text.place(line, column("actual")), str(error)))
        return None
    cycle = cycles.setdefault(part, len(cycles) + 1)
    return ProbedPoint(text.place(line, 1), face, cycle, (value,))
