"""From cells to numbers, directions and runs; what is wrong is noted with its place."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from zlmreport.plugin import Approach, DecimalSign, Problem, is_run_number, no_run_number, parse_number
from zlmreport_plugins.sources.laser_csv.columns import Column
from zlmreport_plugins.sources.laser_csv.names import direction
from zlmreport_plugins.sources.laser_csv.table import Row, Table


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
