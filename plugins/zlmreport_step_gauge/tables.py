"""Reads small CSV tables with fixed names of columns: faces, initial points, probed points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from zlmreport.plugin import InputError, Place, Problem, did_you_mean, quoted
from zlmreport.plugin.source import SourceFile, TextCell, TextFile, parse_number, read_text

#: In any unit of length: no machine is as long.
_LARGEST = 1e9


def read_measured(text: str) -> float:
    """Return a number as a machine writes it; raise ValueError for what is none, or beyond all machines."""
    value = parse_number(text)
    if abs(value) > _LARGEST:
        raise ValueError(f"{quoted(text)} is too large for any machine")
    return value


@dataclass(frozen=True, slots=True)
class NamedRow:
    """A row: its cells by the names of their columns; a column that the table lacks has no cell."""

    place: Place
    cells: dict[str, TextCell]

    def read_text(self, column: str) -> str:
        """Return what a cell holds; nothing where the table lacks the column."""
        return self.cells[column].text if column in self.cells else ""

    def read_number(self, column: str, problems: list[Problem]) -> float | None:
        """Return the number in a cell; None, and a problem, where it holds none."""
        cell = self.cells[column]
        try:
            return read_measured(cell.text)
        except ValueError as error:
            message = str(error) if cell.text else "a number is missing"
            problems.append(Problem(cell.place, f"column {column}: {message}"))
            return None

    def read_integer(self, column: str, problems: list[Problem]) -> int | None:
        """Return the positive whole number in a cell; None, and a problem, where it holds none."""
        value = self.read_number(column, problems)
        if value is not None and not (value >= 1 and value.is_integer()):
            cell = self.cells[column]
            problems.append(
                Problem(cell.place, f"column {column}: {quoted(cell.text)} is no number that counts from 1")
            )
            return None
        return None if value is None else int(value)


@dataclass(frozen=True, slots=True)
class NamedTable:
    """A table that was read."""

    text: TextFile  #: The file.
    rows: tuple[NamedRow, ...]  #: Those with as many cells as the header.
    problems: list[Problem] = field(default_factory=list)  #: What is wrong with the others.

    @property
    def source(self) -> SourceFile:
        """The file's name, digest and bytes."""
        return self.text.source


def read_named_columns(path: Path, needed: Sequence[str], optional: Sequence[str] = ()) -> NamedTable:
    """Read a table: a header that names the columns, then one row a line, in any order of columns.

    Tab, semicolon or comma parts the columns; lines that begin with ``#`` and empty lines are left out.

    Raises `AccessError` if the file cannot be read; `InputError` if the header lacks a column that is needed,
    or names one that is unknown.
    """
    text = read_text(path)
    header, *lines = text.rows() or [[]]
    example = ",".join((*needed, *optional))
    if not header:
        raise InputError.at(text.place(), f"holds no table; its first row names the columns: {example}")
    names = [cell.text.casefold() for cell in header]
    _refuse_other_columns(header, names, needed, optional)
    canonical = {name.casefold(): name for name in (*needed, *optional)}
    table = NamedTable(text, ())
    rows = []
    for cells in lines:
        if len(cells) != len(header):
            table.problems.append(
                Problem(cells[0].place, f"a row has {len(header)} cells, and this one {len(cells)}")
            )
            continue
        by_name = {canonical[name]: cell for name, cell in zip(names, cells, strict=True)}
        rows.append(NamedRow(text.place(cells[0].place.line, 1), by_name))
    return NamedTable(text, tuple(rows), table.problems)


def _refuse_other_columns(
    header: Sequence[TextCell], names: Sequence[str], needed: Sequence[str], optional: Sequence[str]
) -> None:
    known = {name.casefold(): name for name in (*needed, *optional)}
    problems = [
        Problem(cell.place, f"{quoted(cell.text)} is no column of this table; {_find_nearest(cell, known)}")
        for cell, name in zip(header, names, strict=True)
        if name not in known
    ]
    problems += [
        Problem(cell.place, f"column {quoted(cell.text)} is there twice")
        for index, cell in enumerate(header)
        if names[index] in names[:index]
    ]
    missing = [name for name in needed if name.casefold() not in names]
    if missing:
        problems.append(
            Problem(header[0].place, f"the header lacks {', '.join(missing)}; it names {','.join(needed)}")
        )
    if problems:
        raise InputError(problems)


def _find_nearest(cell: TextCell, known: dict[str, str]) -> str:
    return did_you_mean(cell.text[:40], list(known.values()))
