"""Tables over the position of an axis that belong to the machine: its compensation, its angular errors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from zlmreport.errors import InputError, Problem, count_in_words, quoted
from zlmreport.language.formatting import DecimalSign
from zlmreport.measurement.axis import PositionTable
from zlmreport.measurement.collect import cap_problems
from zlmreport.measurement.columns import read_heading
from zlmreport.measurement.text_file import TextCell, TextFile, parse_number, read_text
from zlmreport.measurement.units import Unit, find_unit_named


@dataclass(frozen=True, slots=True)
class TableColumn:
    """A column that such a table has."""

    name: str  #: As the header names it; a unit may follow in brackets.
    unit: Unit  #: Of its numbers where the header names none.
    units: Mapping[str, Unit]  #: That the header may name, by their spellings.


def read_position_table(
    path: Path, position: TableColumn, value: TableColumn, directions: tuple[str, str] | None = None
) -> PositionTable:
    """Read a table of two columns: a header that names them, then one position a row, rising.

    With names of `directions`, two columns of these may stand in place of the value: forward and back.

    Tab, semicolon or comma parts the columns; a decimal comma is taken where no comma parts columns; lines
    that begin with ``#`` and empty lines are left out.

    Raises `AccessError` if the file cannot be read; `InputError` with every defect and its place.
    """
    text = read_text(path)
    header, *rows = text.rows() or [[]]
    columns: tuple[TableColumn, ...] = (position, value)
    names = {_name_cell(cell) for cell in header}
    if directions and names & set(directions) and value.name not in names:
        columns = (position, *(replace(value, name=name) for name in directions))
    order = _find_order(text, header, columns)
    units = [_read_unit(column, header[index]) for column, index in zip(columns, order, strict=True)]
    problems: list[Problem] = []
    sign = _find_decimal_sign(rows)
    found = [list(_read_numbers(row, order, len(header), sign, problems)) for row in rows]
    if not problems:
        problems.extend(_find_not_rising([row[order[0]] for row in rows], [numbers[0] for numbers in found]))
    if len(rows) < 2 and not problems:
        problems.append(Problem(text.place(), "has less than two rows of numbers; a table has two at least"))
    if problems:
        raise InputError(cap_problems(problems))
    positions, values, *reverse = (
        tuple(unit.to_si(number) for number in column)
        for unit, column in zip(units, zip(*found, strict=True), strict=True)
    )
    return PositionTable(positions, values, text.source, *reverse)


def _find_order(text: TextFile, header: Sequence[TextCell], columns: Sequence[TableColumn]) -> list[int]:
    """Return the index of each column; the header has these and no others."""
    names = [_name_cell(cell) for cell in header]
    wanted = [column.name for column in columns]
    if sorted(names) != sorted(wanted):
        example = ",".join(f"{column.name} ({column.unit.symbol})" for column in columns)
        found = quoted(", ".join(cell.text for cell in header)) if header else "none"
        raise InputError.at(
            header[0].place if header else text.place(),
            f"the first row names the columns, as in {example}; found {found}",
        )
    return [names.index(name) for name in wanted]


def _name_cell(cell: TextCell) -> str:
    return read_heading(cell.text).name.casefold()


def _read_unit(column: TableColumn, cell: TextCell) -> Unit:
    spelling = read_heading(cell.text).bracket
    try:
        return find_unit_named(spelling, column.units) if spelling else column.unit
    except ValueError as error:
        raise InputError.at(cell.place, f"column {quoted(cell.text)}: {error}") from error


def _find_decimal_sign(rows: Sequence[Sequence[TextCell]]) -> DecimalSign:
    """Return the comma if there is one in a cell: then it parts no cells."""
    has_comma = any("," in cell.text for row in rows for cell in row)
    return DecimalSign.COMMA if has_comma else DecimalSign.POINT


def _read_numbers(
    row: Sequence[TextCell], order: Sequence[int], width: int, sign: DecimalSign, problems: list[Problem]
) -> Iterator[float]:
    """Yield the numbers of a row; what is wrong with it is noted."""
    if len(row) != width:
        problems.append(
            Problem(row[0].place, f"a row has {count_in_words(width, 'cell')}, and this one {len(row)}")
        )
        return
    for index in order:
        try:
            yield parse_number(row[index].text, sign)
        except ValueError as error:
            problems.append(
                Problem(row[index].place, str(error) if row[index].text else "a number is missing")
            )


def _find_not_rising(cells: Sequence[TextCell], positions: Sequence[float]) -> Iterator[Problem]:
    for later in (np.flatnonzero(np.diff(positions) <= 0) + 1).tolist():
        cell = cells[later]
        yield Problem(
            cell.place,
            f"position {quoted(cell.text)} does not lie above the one before it, {cells[later - 1].text}; "
            "positions rise from row to row",
        )
