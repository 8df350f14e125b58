"""Reads the header and the cells of a table: meaning and unit of a column, decimal sign, thousands."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar, Protocol, TypeVar

from zlmreport.errors import InputError, Place, Problem, did_you_mean, quoted
from zlmreport.language.formatting import DecimalSign
from zlmreport.measurement.collect import cap_problems, is_run, say_no_run
from zlmreport.measurement.table import AROUND_UNITS, THOUSANDS, UNITS, TextRow, TextTable
from zlmreport.measurement.text_file import parse_number
from zlmreport.measurement.units import DEGREE, Scale, Unit, find_unit_named

_ONE_SIGN = re.compile(r"[+\-−]?([0-9]*)([.,])([0-9]*)([eE][+-]?[0-9]+)?")
#: A number, and what may be its unit.
_MEASURED = re.compile(r"([+\-−]?[0-9.,][0-9.,'’ \u00a0\u202f]*(?:[eE][+-]?[0-9]+)?)\s*([^0-9.,\s].*)")
_GROUPS = re.compile(r"([+\-−]?[0-9]{1,3})((?:([.,'’ \u00a0\u202f])[0-9]{3})(?:\3[0-9]{3})*)([.,][0-9]*)?")
_SEXAGESIMAL = re.compile(r"([+\-−]?)([0-9]+)\s*°\s*([0-9]+)\s*['′’]\s*(?:([0-9.,]+)\s*(?:\"|″|''|′′|”))?")


#: Brackets are those of a Chinese keyboard, too.
_BRACKETED = re.compile(r"(.*?)\s*[(\[（【]\s*([^()\[\]（）【】]+?)\s*[)\]）】]")
#: A unit that stands behind the name in other ways: ``Soll / mm``, ``Soll in mm``, ``Soll, mm``, ``soll_mm``.
_BEHIND = re.compile(r"(.*?\w[.]?)(?:\s*/\s*|\s+in\s+|,\s*|[\s_]+)([^\s_,/]+(?:/m)?)")
_NUMBER = re.compile(r"[+-]?[0-9]*[.,]?[0-9]+")
#: Columns of a file that a message lists.
_MOST_NAMED = 20
_NO_READING = (
    "{shown} is far from all others of its column, and a number by which instruments say that they have no "
    "reading; if the reading is missing, say 'missing: [\"{text}\"]' in the job"
)
_T = TypeVar("_T")


class NamedColumns(Protocol):
    """What a job says of the columns of a table, and which of them the data source knows."""

    column_names: ClassVar[tuple[str, ...]]  #: The columns that have a meaning, folded.
    header_example: ClassVar[str]  #: What the header of a table may be, for messages.

    @property
    def columns(self) -> Mapping[str, str]:
        """The file's own names by those of the data source."""

    @property
    def ignore(self) -> Sequence[str]:
        """Columns of the file that are not read, by name."""

    @property
    def units(self) -> Mapping[str, str]:
        """Spellings of units, by column."""


def fold(name: str) -> str:
    """Return a name without what people do not mind: case, and blanks, hyphens or underscores.

    >>> fold(" Air Temperature ")
    'air_temperature'
    """
    return re.sub(r"[\s_-]+", "_", name.strip().casefold())


def find_decimal_sign(table: TextTable, indices: Sequence[int], thousands: str = "") -> DecimalSign:
    """Return the decimal sign in which the cells of some columns are written.

    ``12,5`` has a decimal comma; ``1,234`` may as well have a thousands separator. A point is taken for a
    decimal point wherever nothing speaks against it; a comma only where a cell proves it. Cells that are no
    numbers tell nothing, nor do those that are numbers in a workbook: they have a point.

    `thousands`: What parts groups of three digits, as the job states it.

    Raises `InputError` if the cells leave it open, or speak for both: the job must say it.
    """
    proof: dict[str, tuple[str, Place]] = {}
    doubt: dict[str, tuple[str, Place]] = {}
    for row in table.rows:
        for index in indices:
            match = _ONE_SIGN.fullmatch(_take_unit_off(row.cells[index], thousands))
            if match and not (table.source.of_cells and match[2] == DecimalSign.POINT):
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


def _take_unit_off(cell: str, thousands: str) -> str:
    match = _MEASURED.fullmatch(cell) if cell and not cell[-1].isdecimal() else None
    number = match[1].rstrip() if match else cell
    return take_thousands_off(number, thousands) if thousands else number


def take_thousands_off(number: str, signs: str) -> str:
    """Return a number without what parts its groups of three digits; as it is if that is none of the signs.

    >>> take_thousands_off("1 250,5", " "), take_thousands_off("1.250", "'")
    ('1250,5', '1.250')
    """
    match = _GROUPS.fullmatch(number)
    if match is None or match[3] not in signs or (match[4] and match[4][0] == match[3]):
        return number
    return f"{match[1]}{match[2].replace(match[3], '')}{match[4] or ''}"


@dataclass(frozen=True, slots=True)
class Cells:
    """Reads the cells of a table."""

    table: TextTable
    sign: DecimalSign  #: Its decimal sign.
    thousands: str = ""  #: What parts groups of three digits.
    missing: frozenset[str] = frozenset()  #: What stands for a missing reading, in lower case.
    #: By column: numbers that stand for no reading (`sentinels.find_sentinels`).
    sentinels: Mapping[int, frozenset[str]] = field(default_factory=dict)
    #: What was found wrong so far. A method that returns None has noted why.
    problems: list[Problem] = field(default_factory=list)

    def number(self, row: TextRow, column: TextColumn, advice: str = "") -> float | None:
        """Return a number, in SI if the column has a unit; NaN for an empty cell.

        `advice`: What to say behind a complaint, with what parts the two.
        """
        text = row.cells[column.index]
        if self.is_missing(text):
            return math.nan
        if text in self.sentinels.get(column.index, ()):
            self.note(row, column, _NO_READING.format(shown=quoted(text), text=text))
            return None
        try:
            value = parse_number(text, self._sign_of(text))
        except ValueError as error:
            return self._read_otherwise(row, column, str(error), advice)
        return column.unit.to_si(value) if column.unit else value

    def is_missing(self, text: str) -> bool:
        """Whether a cell holds nothing, or what the job says stands for nothing."""
        return not text or (bool(self.missing) and text.casefold() in self.missing)

    def _sign_of(self, text: str) -> DecimalSign:
        """Return the decimal sign of a number: in a workbook, what is stored as a number has a point."""
        return DecimalSign.POINT if self.table.source.of_cells and "," not in text else self.sign

    def _read_otherwise(self, row: TextRow, column: TextColumn, complaint: str, advice: str) -> float | None:
        """Return a number with its unit, with thousands, or in degrees, minutes and seconds."""
        text = row.cells[column.index]
        if DEGREE.symbol in column.units and (angle := self._read_sexagesimal(text)) is not None:
            return DEGREE.to_si(angle)
        match = _MEASURED.fullmatch(text)
        unit = column.units.get(match[2].strip().casefold()) if match else None
        number = match[1].rstrip() if match and unit else text
        try:
            value = parse_number(take_thousands_off(number, self.thousands), self._sign_of(number))
        except ValueError:
            groups = _GROUPS.fullmatch(number)
            is_sure = groups and (groups[4] or groups[3] not in ".," or len(groups[2]) > len(".000"))
            if groups and is_sure and not self.thousands:
                named = next(name for name, signs in THOUSANDS.items() if groups[3] in signs)
                complaint = f"{quoted(text)} has thousands separators; say 'thousands: {named}' in the job"
            self.note(row, column, f"{complaint}{advice}")
            return None
        unit = unit or column.unit
        return unit.to_si(value) if unit else value

    def _read_sexagesimal(self, text: str) -> float | None:
        """Return degrees, minutes and seconds as degrees; None if the text is none."""
        match = _SEXAGESIMAL.fullmatch(text)
        if match is None:
            return None
        negative, degrees, minutes, seconds = match.groups()
        try:
            size = float(degrees) + float(minutes) / 60 + parse_number(seconds or "0", self.sign) / 3600
        except ValueError:
            return None
        return -size if negative in {"-", "−"} else size

    def demanded_number(self, row: TextRow, column: TextColumn) -> float | None:
        """Return a number that must be there."""
        return None if self._is_left_out(row, column) else self.number(row, column)

    def run(self, row: TextRow, column: TextColumn) -> float | None:
        """Return the number of a run."""
        run = self.demanded_number(row, column)
        if run is None or is_run(run):
            return run
        self.note(row, column, say_no_run(run))
        return None

    def word(self, row: TextRow, column: TextColumn, read: Callable[[str], _T]) -> _T | None:
        """Return what a word stands for, that must be there; `read` raises `ValueError` for another one."""
        if self._is_left_out(row, column):
            return None
        try:
            return read(row.cells[column.index])
        except ValueError as error:
            self.note(row, column, str(error))
            return None

    def _is_left_out(self, row: TextRow, column: TextColumn) -> bool:
        if not self.is_missing(row.cells[column.index]):
            return False
        self.note(row, column, f"there is no {column.name}; only a reading may be missing")
        return True

    def note(self, row: TextRow, column: TextColumn, message: str) -> None:
        """Note what is wrong with a cell."""
        self.problems.append(Problem(self.table.place(row, column.index), message))


@dataclass(frozen=True, slots=True)
class Heading:
    """A name in the header."""

    index: int  #: Of the column, from 0.
    text: str  #: As the file writes it.
    name: str  #: Without a unit in brackets.
    bracket: str | None  #: What stands in brackets at its end; None without.

    def is_called(self, name: str) -> bool:
        """Whether a name, with or without the unit, means this heading."""
        return fold(name) in {fold(self.text), fold(self.name)}


@dataclass(frozen=True, slots=True)
class TextColumn:
    """A column that is read."""

    index: int  #: Of the column, from 0.
    text: str  #: Its heading in the file.
    name: str  #: What it is: one that the data source knows, or its own heading for any other condition.
    #: Of its numbers; None for what has none, and for conditions that are kept as found.
    unit: Unit | Scale | None
    #: Those that may stand behind its numbers, by their spellings.
    units: Mapping[str, Unit | Scale] = field(default_factory=dict, compare=False)


def _is_never(_text: str) -> bool:
    return False


def read_heading(text: str, index: int = 0, is_no_unit: Callable[[str], bool] = _is_never) -> Heading:
    """Return a name in a header, its unit taken off.

    `is_no_unit`: Whether what stands in brackets is no unit, but belongs to the name.

    >>> [read_heading(text).bracket for text in ("Soll [mm]", "Soll / mm", "Soll in mm", "soll_mm", "Run")]
    ['mm', 'mm', 'mm', 'mm', None]
    """
    match = _BRACKETED.fullmatch(text)
    if match is not None:
        if is_no_unit(match[2]):
            return Heading(index, text, f"{match[1]} {match[2]}", None)
        return Heading(index, text, match[1], match[2])
    match = _BEHIND.fullmatch(text)
    if match is not None and len(match[2]) > 1 and match[2].casefold() in UNITS:
        return Heading(index, text, match[1], match[2])
    return Heading(index, text, text, None)


def _add_unit_below(heading: Heading, unit: str) -> Heading:
    """Return a heading with the unit that stands below it, if it has none itself."""
    unit = unit.strip(AROUND_UNITS)
    has_own = heading.bracket is not None and heading.bracket.casefold() in UNITS
    return heading if has_own or unit in {"", "-", "–", "—"} else replace(heading, bracket=unit)


def read_headings(
    table: TextTable, options: NamedColumns, is_no_unit: Callable[[str], bool] = _is_never
) -> tuple[Heading, ...]:
    """Return the headings of the columns that are to be read; `is_no_unit` as of `read_heading`.

    Raises `InputError` if the header holds numbers, a name twice, or none where there are readings, or if the
    job speaks of columns that there are not.
    """
    found = [read_heading(text, index, is_no_unit) for index, text in enumerate(table.header.cells)]
    for heading, unit in zip(found, table.units.cells if table.units else (), strict=False):
        found[heading.index] = _add_unit_below(heading, unit)
    if any(_NUMBER.fullmatch(heading.text) for heading in found) and not any(
        fold(heading.name) in options.column_names for heading in found
    ):
        raise InputError.at(
            table.place(table.header, 0),
            "the table begins with numbers; its first row names the columns, as in "
            f"{options.header_example}, or the job does: 'header: [target, …]'",
        )
    problems = [*_find_unnamed(table, found), *_find_not_there(table, found, options)]
    if problems:
        raise InputError(cap_problems(problems))
    return tuple(
        heading
        for heading in found
        if heading.text and not any(heading.is_called(name) for name in options.ignore)
    )


def find_heading(
    name: str, among: Sequence[Heading], table: TextTable, options: NamedColumns
) -> Heading | None:
    """Return the heading of a known column: the one that the job maps to it, or the one of its name.

    Raises `InputError` if there are several.
    """
    mapped = [file_name for key, file_name in options.columns.items() if fold(key) == name]
    others = [file_name for key, file_name in options.columns.items() if fold(key) != name]
    candidates = [
        heading
        for heading in among
        if any(heading.is_called(file_name) for file_name in mapped)
        or (fold(heading.name) == name and not any(heading.is_called(other) for other in others))
    ]
    if len(candidates) > 1:
        first, second = candidates[:2]
        raise InputError.at(
            table.place(table.header, second.index),
            f"both {quoted(first.text)} and {quoted(second.text)} are the column {name!r}; "
            "name one of them in the job under 'ignore'",
        )
    return candidates[0] if candidates else None


def report_missing_column(
    name: str, among: Sequence[Heading], table: TextTable, options: NamedColumns
) -> Problem:
    """Return the problem that a column is not there, with the nearest name of those that mean nothing yet."""
    known = options.column_names
    free = {fold(heading.name): heading for heading in among if fold(heading.name) not in known}
    nearest = difflib.get_close_matches(name, free, n=1)
    guess = free[nearest[0]].text if nearest else None
    return Problem(
        table.place(table.header, 0),
        f"there is no column {name!r}{f', but {quoted(guess)}' if guess else ''}; name it in the job, as in "
        f"'columns: {{{name}: {guess or '…'}}}' "
        f"(the file has {', '.join(map(quoted, _list_names(among)))})",
    )


def find_column_with_unit(  # noqa: PLR0913, PLR0917 - what a unit may follow from
    name: str,
    heading: Heading,
    options: NamedColumns,
    units: tuple[Mapping[str, Unit | Scale], Unit | Scale] | None,
    stated_at: Place,
    table: TextTable,
) -> TextColumn:
    """Return a known column with its unit: the job's, else the one in brackets, else the usual one.

    `units`: Those that it may have by their spellings, and the usual one; None for what has none.
    `stated_at`: Where the job states units.

    Raises `InputError` if the unit is none of the column's quantity.
    """
    if units is None:
        return TextColumn(heading.index, heading.text, name, None)
    stated = options.units.get(name)
    spelling = stated if stated is not None else heading.bracket
    known, usual = units
    try:
        unit = find_unit_named(spelling, known) if spelling else usual
    except ValueError as error:
        if stated is not None:
            raise InputError.at(stated_at, f"column {quoted(heading.text)}: {error}") from error
        said = f"if it is another, the job says so, as in 'units: {{{name}: {usual.symbol}}}'"
        place = _place_of_unit(heading, table)
        raise InputError.at(place, f"column {quoted(heading.text)}: {error}; {said}") from error
    return TextColumn(heading.index, heading.text, name, unit, known)


def _place_of_unit(heading: Heading, table: TextTable) -> Place:
    is_above = table.units is None or not heading.bracket or heading.bracket in heading.text
    return table.place(table.header if is_above or table.units is None else table.units, heading.index)


def _list_names(among: Sequence[Heading]) -> list[str]:
    """Return the names that there are, as many as a message can hold."""
    return [heading.text for heading in among if heading.text][:_MOST_NAMED]


def _find_unnamed(table: TextTable, found: Sequence[Heading]) -> Iterator[Problem]:
    """Yield the columns that have cells and no name, or the name of another."""
    first: dict[str, Heading] = {}
    for heading in found:
        same = first.setdefault(fold(heading.text), heading)
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


def _find_not_there(table: TextTable, found: Sequence[Heading], options: NamedColumns) -> Iterator[Problem]:
    """Yield the names that the job speaks of and the file does not have."""
    spoken = {**{name: f"columns: {{{key}: …}}" for key, name in options.columns.items()}}
    spoken |= dict.fromkeys(options.ignore, "ignore")
    for name, key in spoken.items():
        if not any(heading.is_called(name) for heading in found):
            yield Problem(
                table.place(table.header, 0),
                f"the job names a column {quoted(name)} ('{key}'), and there is none; "
                f"{did_you_mean(name, _list_names(found))}",
            )
