"""From lines to cells: delimiter, quotation marks, comment lines, ragged rows; no cell is interpreted."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from zlmreport.plugin import POSITION_UNITS, TIME_UNITS, InputError, Place, Problem, TextFile, quoted

#: In order of precedence: a comma may stand in a name or a number of a table that semicolons part.
_DELIMITERS = {"\t": "tab", ";": "semicolon", ",": "comma"}
_BLANKS = " \u00a0\t"
_QUOTE = '"'
#: Characters of a name in a header.
_LONGEST_NAME = 200
#: Lines above a header that are looked through for it.
_LONGEST_PREAMBLE = 100
_NUMBER = re.compile(r"[0-9]+([.,][0-9]+)?")
#: What may be the number of a run, where it stands in a header.
_RUNS = frozenset(map(str, range(1, 51)))
#: Units that stand in a row of their own, in lower case.
_UNITS = frozenset({each.casefold() for units in (POSITION_UNITS, TIME_UNITS) for each in units}) | {
    *("°c", "c", "k", "°f", "hpa", "pa", "kpa", "mbar", "%", "% rh")
}


@dataclass(frozen=True, slots=True)
class Row:
    """A row of a table."""

    line: int  #: In the file, from 1.
    text: str  #: The line.
    delimiter: str  #: What parts its cells.
    cells: tuple[str, ...]  #: Without quotation marks and the blanks around.

    def column(self, index: int) -> int:
        """Return in which character of the line a cell begins, from 1."""
        if _QUOTE in self.text:
            starts = [start for start, _ in _quoted_parts(self.text, self.delimiter)]
            return starts[index] + 1
        return sum(map(len, self.text.split(self.delimiter, index)[:index])) + index + 1


@dataclass(frozen=True, slots=True)
class Table:
    """A table: a header and rows that have as many cells."""

    file: str  #: Name of the file, for places.
    header: Row  #: The row of names.
    rows: tuple[Row, ...]  #: The rows that are sound.
    problems: tuple[Problem, ...]  #: What is wrong with the others.

    def place(self, row: Row, index: int) -> Place:
        """Return the place of a cell."""
        return Place(self.file, row.line, row.column(index))


def read_table(
    text: TextFile,
    *,
    delimiter: str | None,
    lines: tuple[int, int] | None,
    names_column: Callable[[str], bool],
) -> Table:
    """Return the cells of a table.

    `delimiter`: As stated; None to tell it by the header.
    `lines`: First and last line of the table, from 1; None for the whole file.
    `names_column`: Whether a header names a column that is known: decides between delimiters.

    Raises `InputError` if there is no header.
    """
    content = text.numbered(*lines or ())
    if not content:
        raise InputError.at(text.place(), "holds no table: every line is blank or a comment")
    number, line = content[0]
    _refuse_preamble(content, delimiter, names_column, text)
    delimiter = delimiter or _delimiter(line, names_column)
    if delimiter is None:
        raise InputError.at(
            text.place(number, 1),
            f"the header {quoted(line.strip())} has a single column; columns are parted by commas, "
            "semicolons or tabs",
        )
    try:
        header = _row(number, line, delimiter)
    except _EnclosureError as error:
        raise InputError.at(text.place(number, error.column), str(error)) from error
    for index, name in enumerate(header.cells):
        if len(name) > _LONGEST_NAME:
            message = f"{quoted(name)} is too long to be the name of a column; does the table begin here?"
            raise InputError.at(text.place(number, header.column(index)), message)
    rows: list[Row] = []
    problems: list[Problem] = []
    for number, line in content[1:]:
        try:
            row = _row(number, line, delimiter)
        except _EnclosureError as error:
            problems.append(Problem(text.place(number, error.column), str(error)))
            continue
        if any(row.cells):
            _refuse_units(row, header, text, is_first=not rows)
            wrong = _ragged(row, header, delimiter, text)
            problems.extend(wrong)
            if not wrong:
                rows.append(row)
    table = Table(text.name, header, tuple(rows), tuple(problems))
    _refuse_transposed(table, names_column)
    return table


def _refuse_preamble(
    content: Sequence[tuple[int, str]],
    delimiter: str | None,
    names_column: Callable[[str], bool],
    text: TextFile,
) -> None:
    """Refuse a table whose header stands below other text, with the lines of the table."""
    first, line = content[0]
    for row, (number, below) in enumerate(content[:_LONGEST_PREAMBLE]):
        parted_by = delimiter or _delimiter(below, names_column)
        known = sum(map(names_column, _header_cells(below, parted_by))) if parted_by else 0
        if row == 0 and known:
            return
        if known > 1:
            raise InputError.at(
                text.place(first, 1),
                f"{quoted(line.strip())} is no header, and line {number} names columns: say "
                f"'lines: [{number}, {content[-1][0]}]' in the job, or begin the lines above it with #",
            )


def _refuse_units(row: Row, header: Row, text: TextFile, *, is_first: bool) -> None:
    """Refuse a row of units below the header: a table has them in its header, or the job states them."""
    filled = [cell.strip("()[]") for cell in row.cells if cell]
    if not is_first or not filled or not all(cell.casefold() in _UNITS for cell in filled):
        return
    named = [
        f"{name} ({cell.strip('()[]')})" for name, cell in zip(header.cells, row.cells, strict=False) if cell
    ]
    raise InputError.at(
        text.place(row.line, 1),
        f"this row holds units; write them in the header, as in '{', '.join(named)}', or under 'units' in "
        "the job, and begin this line with #",
    )


def _refuse_transposed(table: Table, names_column: Callable[[str], bool]) -> None:
    """Refuse a table that lies on its side: names down its first column, or targets along its header."""
    first = [row.cells[0] for row in table.rows]
    down = [cell for cell in first if names_column(cell) and not _NUMBER.fullmatch(cell.lstrip("+-−"))]
    along = [name for name in table.header.cells[1:] if _NUMBER.fullmatch(name)]
    are_all = len(along) > 1 and len(along) == len(table.header.cells) - 1
    if len(down) > 1 or (are_all and not set(along) <= _RUNS):
        raise InputError.at(
            Place(table.file, table.header.line, 1),
            "this table lies on its side: a row is one reading or one target position, and a column is what "
            "its header names; exchange rows and columns (in a spreadsheet: paste special, transpose)",
        )


def _delimiter(header: str, names_column: Callable[[str], bool]) -> str | None:
    """Return the delimiter by which the header names most known columns; of equals the first."""

    def known(delimiter: str) -> int:
        return sum(map(names_column, _header_cells(header, delimiter)))

    present = [delimiter for delimiter in _DELIMITERS if delimiter in header]
    return max(present, key=known, default=None)


def _header_cells(header: str, delimiter: str) -> Sequence[str]:
    try:
        return _row(1, header, delimiter).cells
    except _EnclosureError:
        return ()


def _ragged(row: Row, header: Row, delimiter: str, text: TextFile) -> list[Problem]:
    """Return what is wrong with the number of cells; empty cells at the end are nobody's mistake."""
    expected, found = len(header.cells), len(row.cells)
    surplus = next((index for index in range(expected, found) if row.cells[index]), None)
    if surplus is not None:
        hint = "; is there a decimal comma? Then semicolons part columns" if delimiter == "," else ""
        return [
            Problem(
                text.place(row.line, row.column(surplus)),
                f"the row has {found} cells, and the header names {expected} columns{hint}",
            )
        ]
    if found < expected and any(header.cells[found:]):
        return [
            Problem(
                text.place(row.line, row.column(found - 1)),
                f"the row ends after {found} of {expected} cells; a missing reading is an empty cell, "
                f"with its {_DELIMITERS.get(delimiter, 'delimiter')}",
            )
        ]
    return []


class _EnclosureError(ValueError):
    """A quotation mark that does not enclose its cell."""

    def __init__(self, column: int) -> None:
        super().__init__("a quotation mark stands at the beginning of this cell, and not at its end")
        self.column = column


def _row(number: int, line: str, delimiter: str) -> Row:
    parts = [part for _, part in _quoted_parts(line, delimiter)] if _QUOTE in line else line.split(delimiter)
    return Row(number, line, delimiter, tuple(part.strip(_BLANKS) for part in parts))


def _quoted_parts(line: str, delimiter: str) -> Iterator[tuple[int, str]]:
    """Yield the cells of a line with quotation marks, each with the index at which it begins."""
    part = re.escape(delimiter)
    cell = re.compile(rf'[ ]*"((?:[^"]|"")*)"[ ]*(?={part}|$)|([^{part}]*)')
    position = 0
    while position <= len(line) and (match := cell.match(line, position)):
        if match[1] is not None:
            yield position, match[1].replace('""', _QUOTE)
        elif match[2].lstrip().startswith(_QUOTE):
            raise _EnclosureError(position + 1)
        else:
            yield position, match[2]
        position = match.end() + 1
