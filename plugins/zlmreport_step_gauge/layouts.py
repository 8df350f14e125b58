"""The layouts of files of points: a table, bare coordinates, a Calypso table, a log of I++ DME."""

from __future__ import annotations

import math
import re
from pathlib import Path

from zlmreport.plugin import (
    LENGTH_UNITS,
    MILLIMETRE,
    InputError,
    Place,
    Problem,
    TextFile,
    parse_number,
    quoted,
    read_text,
    unit_named,
)
from zlmreport_step_gauge.gauge import StepGauge
from zlmreport_step_gauge.points import Direction, Points, Unnumbered, wrong_side
from zlmreport_step_gauge.probed import ProbedPoint, face_of
from zlmreport_step_gauge.tables import Row, read_named_columns

_TABLE = ("face", "cycle", "x", "y", "z")
_NORMAL = ("i", "j", "k")


def read_table(path: Path, gauge: StepGauge, direction: Direction | None) -> Points:
    """Read face, cycle, x, y, z and, if there is one, the outward normal i, j, k.

    A point that was missed has its row, with empty cells for x, y and z.
    """
    table = read_named_columns(path, _TABLE, _NORMAL)
    problems = table.problems
    points = [found for row in table.rows if (found := _row(row, gauge, direction, problems)) is not None]
    return Points(tuple(points), table.source, table.text.place(), tuple(problems))


def _row(
    row: Row, gauge: StepGauge, direction: Direction | None, problems: list[Problem]
) -> ProbedPoint | None:
    face, cycle = row.integer("face", problems), row.integer("cycle", problems)
    if any(row.text(column) for column in _TABLE[2:]):
        coordinates = [row.number(column, problems) for column in _TABLE[2:]]
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


_PARTED = re.compile(r"[\s,;]+")


def read_sequence(path: Path) -> tuple[TextFile, list[Unnumbered]]:
    """Read coordinates alone, x y z on a line, cycle after cycle; blanks, commas or semicolons part them."""
    text = read_text(path)
    problems: list[Problem] = []
    points = []
    for number, line in enumerate(text.lines, 1):
        written = line.partition("#")[0].strip(" \t,;")
        if not written:
            continue
        place = text.place(number, 1)
        cells = _PARTED.split(written)
        if len(cells) != 3:
            problems.append(Problem(place, f"three numbers are expected, x y z: {quoted(written)}"))
            continue
        try:
            x, y, z = (MILLIMETRE.to_si(parse_number(cell)) for cell in cells)
        except ValueError as error:
            problems.append(Problem(place, str(error)))
            continue
        points.append(Unnumbered(place, (x, y, z)))
    if problems:
        raise InputError(problems)
    return text, points


_CALYPSO = ("partnb", "id", "actual", "unit")
_END = "END"


def is_calypso(header: str) -> bool:
    """Whether a header is that of such a table."""
    return set(_CALYPSO) <= set(header.split("\t"))


def read_calypso(path: Path, mapping: dict[str, int]) -> Points:
    """Read the distances in the table of characteristics of ZEISS Calypso, ``*_chr.txt``.

    Each part is a cycle, in the order in which the parts come. The layout is known from two independent
    readers. Only the columns ``partnb``, ``id``, ``actual`` and ``unit`` are used; a closing line ``END`` may
    be there or not. Distances are those of the surface.
    """
    text = read_text(path)
    header = text.lines[0].split("\t")
    missing = [name for name in _CALYPSO if name not in header]
    if missing:
        raise InputError.at(text.place(1, 1), f"the header lacks {', '.join(missing)}; columns are tabbed")
    indices = {name: header.index(name) for name in _CALYPSO}
    problems: list[Problem] = []
    cycles: dict[str, int] = {}
    points = []
    for number, line in enumerate(text.lines[1:], 2):
        if line.strip() and line.strip() != _END:
            point = _characteristic(text, number, line.split("\t"), indices, mapping, cycles, problems)
            if point:
                points.append(point)
    return Points(tuple(points), text.source, text.place(), tuple(problems), is_corrected=True)


def _characteristic(  # noqa: PLR0913, PLR0917 - a row with what it is read by
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
    part, name, actual, unit = (cells[indices[each]].strip() for each in _CALYPSO)
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


_DATA = re.compile(r"\s*(?P<tag>[E\d]\d{4})\s+#\s*(?P<data>.*)")
_ERROR = re.compile(r"\s*(?P<tag>[E\d]\d{4})\s+!\s*Error\((?P<text>.*)\)\s*")
_COORDINATE = re.compile(r"\b(X|Y|Z)\(\s*([^()]*?)\s*\)")
_IJK = re.compile(r"\bIJK\(\s*([^(),]*?)\s*,\s*([^(),]*?)\s*,\s*([^(),]*?)\s*\)")


def read_log(path: Path) -> tuple[TextFile, list[Unnumbered]]:
    """Read the measured points in the log of an I++ DME run, ``00120 # X(…), Y(…), Z(…), IJK(…)``.

    They come in the order of the log; an error that the machine answered is a defect.
    """
    text = read_text(path)
    problems: list[Problem] = []
    points = []
    for number, line in enumerate(text.lines, 1):
        place = text.place(number, 1)
        error = _ERROR.fullmatch(line)
        if error:
            problems.append(
                Problem(
                    place, f"the machine answered with an error: {error['text'][:80]}; probe this face again"
                )
            )
        data = _DATA.fullmatch(line)
        if data and _COORDINATE.search(data["data"]):
            point = _measured(data["data"], place, problems)
            if point:
                points.append(point)
    if problems:
        raise InputError(problems)
    return text, points


def _measured(data: str, place: Place, problems: list[Problem]) -> Unnumbered | None:
    written = dict(_COORDINATE.findall(data))
    normal = _IJK.search(data)
    if set(written) != {"X", "Y", "Z"}:
        problems.append(Problem(place, "a measured point has X, Y and Z; ask for them by OnPtMeasReport"))
        return None
    try:
        x, y, z = (MILLIMETRE.to_si(parse_number(written[name])) for name in "XYZ")
        if normal is None:
            return Unnumbered(place, (x, y, z))
        i, j, k = (parse_number(each) for each in normal.groups())
    except ValueError as error:
        problems.append(Problem(place, str(error)))
        return None
    return Unnumbered(place, (x, y, z), (i, j, k))
