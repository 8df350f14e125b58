"""Coordinates alone, cycle after cycle: x, y and z on a line, as raw data files of machines have them."""

from __future__ import annotations

import re
from pathlib import Path

from zlmreport.errors import InputError, Problem
from zlmreport.measurement.text_file import TextFile, parse_number, quoted, read_text
from zlmreport.quantities.units import MILLIMETRE
from zlmreport_plugins.sources.step_gauge.points import Unnumbered

_PARTED = re.compile(r"[\s,;]+")


def read(path: Path) -> tuple[TextFile, list[Unnumbered]]:
    """Read the points; blanks, commas or semicolons part the numbers."""
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
