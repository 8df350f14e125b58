"""From cells to numbers, times, directions and runs; what is wrong is noted with its place."""

from __future__ import annotations

import datetime as dt
import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from zlmreport.plugin import (
    Approach,
    DecimalSign,
    InputError,
    Place,
    Problem,
    is_run_number,
    no_run_number,
    parse_number,
    quoted,
)
from zlmreport_plugins.sources.laser_csv.columns import Column
from zlmreport_plugins.sources.laser_csv.options import direction
from zlmreport_plugins.sources.laser_csv.table import Row, Table

_ONE_SIGN = re.compile(r"[+\-−]?([0-9]*)([.,])([0-9]*)([eE][+-]?[0-9]+)?")


def decimal_sign(table: Table, indices: Sequence[int]) -> DecimalSign:
    """Return the decimal sign in which the cells of some columns are written.

    ``12,5`` has a decimal comma; ``1,234`` may as well have a thousands separator. A point is taken for a
    decimal point wherever nothing speaks against it; a comma only where a cell proves it. Cells that are no
    numbers tell nothing.

    Raises
    ------
    InputError
        If the cells leave it open, or speak for both: the job must say it.
    """
    proof: dict[str, tuple[str, Place]] = {}
    doubt: dict[str, tuple[str, Place]] = {}
    for row in table.rows:
        for index in indices:
            match = _ONE_SIGN.fullmatch(row.cells[index])
            if match:
                whole, sign, decimals, exponent = match.groups()
                groups = 1 <= len(whole) <= 3 and whole[0] != "0" and len(decimals) == 3 and not exponent
                told = doubt if groups else proof
                if sign not in told:
                    told[sign] = (match[0], table.place(row, index))
    if len(proof) == 2:
        (point, point_place), (comma, comma_place) = proof["."], proof[","]
        later, earlier = sorted([point_place, comma_place], reverse=True)
        raise InputError.at(
            later,
            f"both decimal signs occur, {quoted(point)} and {quoted(comma)}, one here and one in line "
            f"{earlier.line}; correct the file, or say 'decimal: point' or 'decimal: comma' in the job",
        )
    if proof:
        return DecimalSign(next(iter(proof)))
    if DecimalSign.COMMA in doubt:
        text, place = doubt[DecimalSign.COMMA]
        raise InputError.at(
            place,
            f"{quoted(text)} may have a decimal comma or a thousands separator, and no other number tells; "
            "say 'decimal: comma' or 'decimal: point' in the job",
        )
    return DecimalSign.POINT


@dataclass(frozen=True, slots=True)
class Cells:
    """Reads the cells of a table.

    Attributes
    ----------
    table
        The table.
    sign
        Its decimal sign.
    problems
        What was found wrong so far. A method that returns None has noted why.
    """

    table: Table
    sign: DecimalSign
    problems: list[Problem] = field(default_factory=list)

    def number(self, row: Row, column: Column) -> float | None:
        """Return a number, in SI if the column has a unit; NaN for an empty cell."""
        text = row.cells[column.index]
        if not text:
            return math.nan
        try:
            value = parse_number(text, self.sign)
        except ValueError as error:
            self.note(row, column, str(error))
            return None
        return column.unit.to_si(value) if column.unit else value

    def demanded_number(self, row: Row, column: Column) -> float | None:
        """Return a number that must be there."""
        return None if self._is_left_out(row, column) else self.number(row, column)

    def run(self, row: Row, column: Column) -> float | None:
        """Return the number of a run."""
        run = self.demanded_number(row, column)
        if run is None or is_run_number(run):
            return run
        self.note(row, column, no_run_number(run))
        return None

    def approach(self, row: Row, column: Column) -> Approach | None:
        """Return a direction of approach."""
        if self._is_left_out(row, column):
            return None
        try:
            return direction(row.cells[column.index])
        except ValueError as error:
            self.note(row, column, str(error))
            return None

    def _is_left_out(self, row: Row, column: Column) -> bool:
        if row.cells[column.index]:
            return False
        self.note(row, column, f"there is no {column.name}; only a reading may be missing")
        return True

    def note(self, row: Row, column: Column, message: str) -> None:
        """Note what is wrong with a cell."""
        self.problems.append(Problem(self.table.place(row, column.index), message))


#: Reads the time of a row; None if it noted why it cannot.
ReadTime = Callable[[Row], float | None]


def time_reader(cells: Cells, column: Column | None) -> ReadTime:
    """Return what reads the time of a row, NaN for an empty cell; the first time tells the kind of all."""
    if column is None:
        return lambda _row: math.nan
    index = column.index
    first = next((row.cells[index] for row in cells.table.rows if row.cells[index]), "")
    beginning = _moment(first)
    if beginning is None or _is_number(first, cells):
        return lambda row: cells.number(row, column)

    def seconds(row: Row) -> float | None:
        text = row.cells[index]
        if not text:
            return math.nan
        moment = _moment(text)
        if moment is None or (moment.tzinfo is None) != (beginning.tzinfo is None):
            like = quoted(first)
            cells.note(
                row, column, f"{quoted(text)} is no time (ISO 8601) written like the first one, {like}"
            )
            return None
        return (moment - beginning).total_seconds()

    return seconds


def _moment(text: str) -> dt.datetime | None:
    try:
        return dt.datetime.fromisoformat(text)
    except ValueError:
        return None


def _is_number(text: str, cells: Cells) -> bool:
    try:
        parse_number(text, cells.sign)
    except ValueError:
        return False
    return True
