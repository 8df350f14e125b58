"""The log of an I++ DME run: the data lines of the measured points, ``00120 # X(…), Y(…), Z(…), IJK(…)``."""

from __future__ import annotations

import re
from pathlib import Path

from zlmreport.errors import InputError, Place, Problem
from zlmreport.measurement.text_file import TextFile, parse_number, read_text
from zlmreport.quantities.units import MILLIMETRE
from zlmreport_plugins.sources.step_gauge.points import Unnumbered

_DATA = re.compile(r"\s*(?P<tag>[E\d]\d{4})\s+#\s*(?P<data>.*)")
_ERROR = re.compile(r"\s*(?P<tag>[E\d]\d{4})\s+!\s*Error\((?P<text>.*)\)\s*")
_COORDINATE = re.compile(r"\b(X|Y|Z)\(\s*([^()]*?)\s*\)")
_NORMAL = re.compile(r"\bIJK\(\s*([^(),]*?)\s*,\s*([^(),]*?)\s*,\s*([^(),]*?)\s*\)")


def read(path: Path) -> tuple[TextFile, list[Unnumbered]]:
    """Read the points in the order of the log; an error answer of the machine is a defect."""
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
            point = _point(data["data"], place, problems)
            if point:
                points.append(point)
    if problems:
        raise InputError(problems)
    return text, points


def _point(data: str, place: Place, problems: list[Problem]) -> Unnumbered | None:
    written = dict(_COORDINATE.findall(data))
    normal = _NORMAL.search(data)
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
