"""From a header to columns that have a meaning and a unit."""

from __future__ import annotations

import datetime as dt
import difflib
import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

from zlmreport.plugin import (
    CONDITIONS,
    SECOND,
    TIME_UNITS,
    Approach,
    Axis,
    DecimalSign,
    InputError,
    Place,
    Problem,
    ReadingScale,
    SourceContext,
    Unit,
    did_you_mean,
    is_run_number,
    no_run_number,
    parse_number,
    position_units,
    quoted,
    unit_named,
)
from zlmreport_plugins.sources.laser_csv.options import (
    COLUMN_NAMES,
    LaserCsvOptions,
    direction,
    folded,
    names_direction,
)
from zlmreport_plugins.sources.laser_csv.table import Row, Table

_ONE_SIGN = re.compile(r"[+\-−]?([0-9]*)([.,])([0-9]*)([eE][+-]?[0-9]+)?")


#: Reads the time of a row; None if it noted why it cannot.
ReadTime = Callable[[Row], float | None]

_BRACKETED = re.compile(r"(.*?)\s*[(\[]\s*([^()\[\]]+?)\s*[)\]]")
_NUMBER = re.compile(r"[+-]?[0-9]*[.,]?[0-9]+")
#: Columns of a file that a message lists.
_MOST_NAMED = 20
#: What the header of every long table names.
_EXAMPLE = "target,direction,run,deviation"


def decimal_sign(table: Table, indices: Sequence[int]) -> DecimalSign:
    """Return the decimal sign in which the cells of some columns are written.

    ``12,5`` has a decimal comma; ``1,234`` may as well have a thousands separator. A point is taken for a
    decimal point wherever nothing speaks against it; a comma only where a cell proves it. Cells that are no
    numbers tell nothing.

    Raises `InputError` if the cells leave it open, or speak for both: the job must say it.
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
    """Reads the cells of a table."""

    table: Table
    sign: DecimalSign  #: Its decimal sign.
    #: What was found wrong so far. A method that returns None has noted why.
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


@dataclass(frozen=True, slots=True)
class Heading:
    """A name in the header."""

    index: int  #: Of the column, from 0.
    text: str  #: As the file writes it.
    name: str  #: Without a unit in brackets.
    bracket: str | None  #: What stands in brackets at its end; None without.

    def is_called(self, name: str) -> bool:
        """Whether a name, with or without the unit, means this heading."""
        return folded(name) in {folded(self.text), folded(self.name)}


@dataclass(frozen=True, slots=True)
class Column:
    """A column that is read."""

    index: int  #: Of the column, from 0.
    text: str  #: Its heading in the file.
    name: str  #: What it is: one of `COLUMN_NAMES`, or its own heading for any other condition.
    #: Of its numbers; None for what has none, and for conditions that are kept as found.
    unit: Unit | ReadingScale | None


def headings(header: Row) -> tuple[Heading, ...]:
    """Return the names in a header, their units taken off."""
    return tuple(heading_of(text, index) for index, text in enumerate(header.cells))


def heading_of(text: str, index: int = 0) -> Heading:
    """Return a name in a header, its unit taken off."""
    match = _BRACKETED.fullmatch(text)
    if match is None:
        return Heading(index, text, text, None)
    if names_direction(match[2]):
        return Heading(index, text, f"{match[1]} {match[2]}", None)
    return Heading(index, text, match[1], match[2])


def read_headings(table: Table, options: LaserCsvOptions) -> tuple[Heading, ...]:
    """Return the headings of the columns that are to be read.

    Raises `InputError` if the header holds numbers, a name twice, or none where there are readings, or if the
    job speaks of columns that there are not.
    """
    found = headings(table.header)
    if any(_NUMBER.fullmatch(heading.text) for heading in found) and not any(
        folded(heading.name) in COLUMN_NAMES for heading in found
    ):
        raise InputError.at(
            table.place(table.header, 0),
            f"the table begins with numbers; its first row names the columns, as in {_EXAMPLE}",
        )
    problems = [*_unnamed(table, found), *_not_there(table, found, options)]
    if problems:
        raise InputError(problems)
    return tuple(
        heading
        for heading in found
        if heading.text and not any(heading.is_called(name) for name in options.ignore)
    )


def find(name: str, among: Sequence[Heading], table: Table, options: LaserCsvOptions) -> Heading | None:
    """Return the heading of a known column: the one that the job maps to it, or the one of its name.

    Raises `InputError` if there are several.
    """
    mapped = [file_name for key, file_name in options.columns.items() if folded(key) == name]
    candidates = [
        heading
        for heading in among
        if folded(heading.name) == name or any(heading.is_called(file_name) for file_name in mapped)
    ]
    if len(candidates) > 1:
        first, second = candidates[:2]
        raise InputError.at(
            table.place(table.header, second.index),
            f"both {quoted(first.text)} and {quoted(second.text)} are the column {name!r}; "
            "name one of them in the job under 'ignore'",
        )
    return candidates[0] if candidates else None


def missing_column(name: str, among: Sequence[Heading], table: Table) -> Problem:
    """Return the problem that a column is not there, with the nearest name of those that mean nothing yet."""
    free = {folded(heading.name): heading for heading in among if folded(heading.name) not in COLUMN_NAMES}
    nearest = difflib.get_close_matches(name, free, n=1)
    guess = free[nearest[0]].text if nearest else None
    return Problem(
        table.place(table.header, 0),
        f"there is no column {name!r}{f', but {quoted(guess)}' if guess else ''}; name it in the job, as in "
        f"'columns: {{{name}: {guess or '…'}}}' "
        f"(the file has {', '.join(map(quoted, _names(among)))})",
    )


def column_of(
    name: str, heading: Heading, options: LaserCsvOptions, context: SourceContext, table: Table
) -> Column:
    """Return a known column with its unit: the job's, else the one in brackets, else the usual one.

    Raises `InputError` if the unit is none of the column's quantity.
    """
    stated = options.units.get(name)
    spelling = stated if stated is not None else heading.bracket
    place = context.place if stated is not None else table.place(table.header, heading.index)
    try:
        return Column(heading.index, heading.text, name, _unit(name, spelling, context.axis))
    except ValueError as error:
        raise InputError.at(place, f"column {quoted(heading.text)}: {error}") from error


def _unit(name: str, spelling: str | None, axis: Axis) -> Unit | ReadingScale | None:
    if name in {"target", "position"}:
        return unit_named(spelling, position_units(axis.kind)) if spelling else axis.position_unit
    if name == "deviation":
        return unit_named(spelling, position_units(axis.kind)) if spelling else axis.deviation_unit
    if name == "time":
        return unit_named(spelling, TIME_UNITS) if spelling else SECOND
    if name in CONDITIONS:
        kind = CONDITIONS[name]
        return unit_named(spelling, kind.units) if spelling else kind.unit
    return None


def _names(among: Sequence[Heading]) -> list[str]:
    """Return the names that there are, as many as a message can hold."""
    return [heading.text for heading in among if heading.text][:_MOST_NAMED]


def _unnamed(table: Table, found: Sequence[Heading]) -> Iterator[Problem]:
    """Yield the columns that have cells and no name, or the name of another."""
    first: dict[str, Heading] = {}
    for heading in found:
        same = first.setdefault(folded(heading.text), heading)
        if heading.text and same is not heading:
            yield Problem(
                table.place(table.header, heading.index),
                f"column {heading.index + 1} is called {quoted(heading.text)}, as is column {same.index + 1}",
            )
        elif not heading.text:
            filled = (
                row for row in table.rows if heading.index < len(row.cells) and row.cells[heading.index]
            )
            row = next(filled, None)
            if row is not None:
                yield Problem(
                    table.place(row, heading.index), f"column {heading.index + 1} has no name in the header"
                )


def _not_there(table: Table, found: Sequence[Heading], options: LaserCsvOptions) -> Iterator[Problem]:
    """Yield the names that the job speaks of and the file does not have."""
    spoken = {**{name: f"columns: {{{key}: …}}" for key, name in options.columns.items()}}
    spoken |= dict.fromkeys(options.ignore, "ignore")
    for name, key in spoken.items():
        if not any(heading.is_called(name) for heading in found):
            yield Problem(
                table.place(table.header, 0),
                f"the job names a column {quoted(name)} ('{key}'), and there is none; "
                f"{did_you_mean(name, _names(found))}",
            )
