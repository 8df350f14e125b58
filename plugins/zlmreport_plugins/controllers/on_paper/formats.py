"""What tables share whose formats were never tried on a control: notes, names of axes, numbers.

ISG, Siemens and Mitsubishi document format and sign; of the others the sign or the file is not confirmed. All
are written with ``--unconfirmed`` only, and each says so on the sheet.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from decimal import Decimal
from itertools import pairwise
from typing import Any

from pydantic import Field

from zlmreport.plugin import FloatArray, InputError, Options, Words, read_only_floats
from zlmreport.plugin.controller import CompensationTable

NUMBER = r"([-+]?\d+(?:\.\d+)?)"
AXIS = r"^[A-Z][A-Z0-9]{0,7}$"
#: What is said of each.
NO_TRIAL = Words(
    "This format was never tried on the control. Load it with the axis clear, and check one point first."
)
MEAN_ONLY = Words("The table has the mean of both directions; the play is left to the backlash parameter.")


class OnPaper:
    """What these controls share: a file, read back as it is documented."""

    confidence = "unconfirmed"
    is_directional = False
    is_equidistant = False
    notes: tuple[Words, ...] = (NO_TRIAL, MEAN_ONLY)
    options: type[Options] = Options


def join_lines(lines: Iterable[str]) -> str:
    """Return lines as a file has them."""
    return "".join(f"{line}\n" for line in lines)


def refuse_more_than(rows: int, table: CompensationTable) -> None:
    """Refuse a table with more rows than the control takes."""
    if len(table.positions) > rows:
        raise InputError.at(table.place, f"the control takes {rows} rows; state a longer step")


def make_columns(table: CompensationTable) -> tuple[list[float], FloatArray, FloatArray]:
    """Return positions, mm or °, and the deviations forward and reverse in the same unit; refuse a fall."""
    unit = table.axis.position_unit
    positions = [round(unit.from_si(each), 6) for each in table.positions.tolist()]
    if len(positions) < 2 or any(b <= a for a, b in pairwise(positions)):
        raise InputError.at(table.place, "the rows of a table rise, and it has two at least")
    return positions, unit.from_si(table.forward), unit.from_si(table.reverse)


def name_axis(table: CompensationTable, options: Any, end: str = "") -> str:
    """Return how the file calls the axis; refuse what no control takes."""
    name: str = options.axis or f"{table.axis.name.strip().upper()}{end}"
    if not re.match(AXIS, name):
        raise InputError.at(
            table.place,
            f"{name[:32]!r} is no name of an axis on this control; state its key axis, such as X{end}",
        )
    return name


def write_grid(positions: Sequence[float]) -> tuple[str, str, str]:
    """Return distance, first and last of rows equally far apart, as they are written.

    The last is as many written distances from the first as there are intervals: a distance that was rounded
    up would leave room for one row less before a last row that was not.
    """
    count = len(positions) - 1
    step = Decimal(f"{(positions[-1] - positions[0]) / count:.6f}")
    first = Decimal(f"{positions[0]:.6f}")
    return f"{step}", f"{first}", f"{first + count * step}"


def write_short(value: float) -> str:
    """Return a number with six decimals at most, without zeros at its end."""
    return f"{value + 0.0:.6f}".rstrip("0").rstrip(".")


def decode(
    table: CompensationTable, positions: Iterable[float], forward: Iterable[float], reverse: Iterable[float]
) -> CompensationTable:
    """Return what a file says in the place of a table: positions and deviations, mm or °."""
    to_si = table.axis.position_unit.to_si
    grid, up, down = (
        read_only_floats([to_si(float(each)) for each in column]) for column in (positions, forward, reverse)
    )
    return replace(table, positions=grid, forward=up, reverse=down)


class NamedAxisOptions(Options):
    """The key of controls whose files name the axis."""

    axis: str | None = Field(
        None, pattern=AXIS, description="Name of the axis on the control; without it the axis's name."
    )
