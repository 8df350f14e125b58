"""Times of readings: seconds, or ISO 8601."""

from __future__ import annotations

import datetime as dt
import math

from zlmreport.plugin import parse_number, quoted
from zlmreport_plugins.sources.laser_csv.cells import Cells, ReadTime
from zlmreport_plugins.sources.laser_csv.columns import Column
from zlmreport_plugins.sources.laser_csv.table import Row


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
