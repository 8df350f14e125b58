"""Splits lines into a table: delimiter, quotation marks, header, units, a table on its side."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from zlmreport.errors import InputError, Place, Problem, count_in_words, quoted
from zlmreport.measurement.text_file import TextFile, find_long_lines
from zlmreport.measurement.units import POSITION_UNITS, TIME_UNITS

#: As a delimiter: columns are parted by one blank or many.
BLANKS = "blanks"
#: What parts groups of three digits, by its name.
THOUSANDS = {"point": ".", "comma": ",", "blank": " \u00a0\u202f", "apostrophe": "'’"}
#: As a delimiter: columns are parted by vertical bars, as in Markdown, which may stand around a row, too.
BAR = "|"
#: In order of precedence: a comma may stand in a name or a number of a table that semicolons part.
DELIMITERS = {"\t": "tab", ";": "semicolon", BAR: "bar", ",": "comma"}
_BLANKS = " \u00a0\t"
_QUOTE = '"'
#: Characters of a name in a header.
_LONGEST_NAME = 200
#: Lines above a header that are looked through for it.
_LONGEST_PREAMBLE = 100
#: Lines that a cell in quotation marks may have.
_MOST_LINES_OF_CELL = 5
#: A cell in quotation marks that does not end in its line.
_OPENED = re.compile(r'(?:^|[;,\t])[ ]*"(?:[^"]|"")*$')
_NUMBER = re.compile(r"[0-9]+([.,][0-9]+)?")
#: What may be the number of a run, where it stands in a header.
_RUNS = frozenset(map(str, range(1, 51)))
#: How spreadsheets say on a first line what parts the columns.
_SEPARATOR = re.compile(r"sep=(.),*;*")
#: What has digits is no unit.
_DIGIT = re.compile(r"[0-9]")
_LONGEST_UNIT = 12
#: What may stand around a unit in a row of its own.
AROUND_UNITS = "()[]（）【】 "
#: Units that stand in a row of their own, in lower case.
UNITS = frozenset({each.casefold() for units in (POSITION_UNITS, TIME_UNITS) for each in units}) | {
    *("°c", "c", "k", "°f", "hpa", "pa", "kpa", "mbar", "%", "% rh")
}


class FileTableLayout(Protocol):
    """How a table stands in its file, as a job says; `zlmreport.job.table_keys` has the keys."""

    @property
    def lines(self) -> tuple[int, int] | None:
        """First and last line, from 1; None without."""

    @property
    def skip_rows(self) -> int | None:
        """Rows above the header; None without."""

    @property
    def ends_before(self) -> str | None:
        """The beginning of the row below the table; None without."""

    @property
    def transposed(self) -> bool:
        """Whether the table lies on its side."""

    @property
    def header(self) -> tuple[str, ...]:
        """Names of columns of a file that has none."""

    @property
    def header_rows(self) -> int:
        """Rows of names."""

    @property
    def stated_delimiter(self) -> str | None:
        """What parts the columns; None to tell it by the header."""


@dataclass(frozen=True, slots=True)
class TextRow:
    """A row of a table: a line of its file, or a column of it, where the table lies on its side."""

    line: int  #: In the file, from 1; of a row that is no line, that of its first cell.
    text: str  #: The line.
    delimiter: str  #: What parts its cells.
    cells: tuple[str, ...]  #: Without quotation marks and the blanks around.
    lying: tuple[tuple[TextRow, int], ...] = ()  #: Of a column: the line of each cell, and its index in it.

    def locate(self, index: int) -> tuple[int, int]:
        """Return the line and the character, both from 1, at which a cell begins."""
        if self.lying:
            row, column = self.lying[index]
            return row.locate(min(column, len(row.cells) - 1))
        if self.delimiter in {BLANKS, BAR} or _QUOTE in self.text:
            starts = [start for start, _ in _split_line(self.text, self.delimiter, len(self.cells))]
            return self.line, starts[index] + 1 if index < len(starts) else len(self.text) + 1
        return self.line, sum(map(len, self.text.split(self.delimiter, index)[:index])) + index + 1


@dataclass(frozen=True, slots=True)
class TextTable:
    """A table: a header and rows that have as many cells."""

    source: TextFile  #: The file.
    header: TextRow  #: The row of names.
    units: TextRow | None  #: The row of units below it; None without.
    rows: tuple[TextRow, ...]  #: The rows that are sound.
    problems: tuple[Problem, ...]  #: What is wrong with the others.

    def place(self, row: TextRow, index: int) -> Place:
        """Return the place of a cell; of a name that the file does not have, that of the file."""
        return self.source.place(*row.locate(index)) if row.line else self.source.place()


def read_table(text: TextFile, options: FileTableLayout, names_column: Callable[[str], bool]) -> TextTable:
    """Return the cells of a table, laid out as a job says.

    `names_column`: Whether a header names a column that is known: decides between delimiters.

    Raises `InputError` if there is no header, or the table is laid out in another way.
    """
    problems = [*find_long_lines(text)]
    content, parted_by = _split_content(text, options, problems)
    delimiter = "\t" if text.of_cells else options.stated_delimiter or parted_by
    is_plain = not (options.transposed or options.header or options.header_rows > 1)
    if is_plain:
        _refuse_preamble(content, delimiter, names_column, text)
    delimiter = delimiter or _find_delimiter(content, options, names_column)
    number, line = content[0]
    if delimiter is None:
        raise InputError.at(text.place(number, 1), _say_single_column(line.strip(), options))
    rows = list(_list_rows(content, delimiter, text, problems))
    if options.transposed:
        rows = _turn_rows(rows)
    header, below = _find_header(rows, options, text)
    for index, name in enumerate(header.cells):
        if len(name) > _LONGEST_NAME:
            message = f"{quoted(name)} is too long to be the name of a column; does the table begin here?"
            raise InputError.at(text.place(*header.locate(index)), message)
    units = below.pop(0) if below and is_units(below[0].cells) else None
    if options.ends_before is not None:
        below = _find_rows_before(below, options.ends_before, header, text)
    sound = []
    for row in below:
        padded = _pad_row(row, len(header.cells)) if text.of_cells or options.transposed else row
        wrong = _find_ragged(padded, header, text)
        problems += wrong
        if not wrong:
            sound.append(padded)
    table = TextTable(
        text, header, units and _pad_row(units, len(header.cells)), tuple(sound), tuple(problems)
    )
    if is_plain:
        _refuse_lying(table, names_column)
    return table


def _say_single_column(line: str, options: FileTableLayout) -> str:
    """Return what is wrong with a first row that no delimiter parts as it should."""
    if options.header:
        return (
            f"'header' names {count_in_words(len(options.header), 'column')}, and no delimiter parts "
            f"{quoted(line)} into so many cells; name every column, or say what parts them, "
            "as in 'delimiter: blanks'"
        )
    return (
        f"the header {quoted(line)} has a single column; columns are parted by commas, semicolons or tabs, "
        "or by blanks if the job says 'delimiter: blanks'"
    )


def _split_content(
    text: TextFile, options: FileTableLayout, too_long: Sequence[Problem]
) -> tuple[list[tuple[int, str]], str | None]:
    """Return the lines of the table with their numbers, and the delimiter that the first one states."""
    first, last = options.lines or ((options.skip_rows or 0) + 1, None)
    numbered, left_out = text.numbered(first, last), {each.place.line for each in too_long}
    if numbered and numbered[0][0] in left_out:
        raise InputError(too_long)  # without its header nothing tells what the others are
    content = join_whole_lines([each for each in numbered if each[0] not in left_out])
    states = states_delimiter(content[0][1]) if content else None
    if states:
        content = content[1:]
    if not content:
        where = "every line is blank or a comment" if first == 1 else "nothing stands there"
        raise InputError.at(text.place(), f"holds no table: {where}")
    return content, states if states in DELIMITERS else None


def states_delimiter(line: str) -> str | None:
    """Return what a line says parts the columns, as spreadsheets begin a file; None of any other line.

    >>> states_delimiter("sep=;"), states_delimiter("target;run")
    (';', None)
    """
    match = _SEPARATOR.fullmatch(line.strip().strip('"'))
    return match[1] if match else None


def join_whole_lines(content: Sequence[tuple[int, str]]) -> list[tuple[int, str]]:
    """Return lines, those joined that a cell in quotation marks goes over; each with its first number."""
    joined: list[tuple[int, str]] = []
    index = 0
    while index < len(content):
        number, line = content[index]
        index += 1
        if _QUOTE in line and _OPENED.search(line):
            for last in range(index, min(index + _MOST_LINES_OF_CELL, len(content))):
                line = f"{line} {content[last][1].lstrip()}"
                if not _OPENED.search(line):
                    index = last + 1
                    break
            else:
                line = content[index - 1][1]
        joined.append((number, line))
    return joined


def _find_header(
    rows: Sequence[TextRow], options: FileTableLayout, text: TextFile
) -> tuple[TextRow, list[TextRow]]:
    """Return the row of names, and the rows below it."""
    if options.header:
        return TextRow(0, "", "", options.header), list(rows)
    count = options.header_rows
    if len(rows) < count:
        raise InputError.at(text.place(), f"holds no table: there are {count} rows of names to read")
    return join_header(rows[:count]), list(rows[count:])


def join_header(rows: Sequence[TextRow]) -> TextRow:
    """Return the row of names; of two, each name made of the upper and the lower cell.

    An upper cell holds for those to its right that are empty, but the first, which names the rows.
    """
    if len(rows) == 1:
        return rows[0]
    upper, lower = rows
    width = max(len(upper.cells), len(lower.cells))
    above, below = _pad_row(upper, width).cells, _pad_row(lower, width).cells
    names, spanning = [], ""
    for index, (over, name) in enumerate(zip(above, below, strict=True)):
        if over:
            spanning = over if index else ""
        names.append(" ".join(filter(None, (over or (spanning if name else ""), name))))
    return replace(lower, cells=tuple(names))


def is_units(cells: Sequence[str]) -> bool:
    """Return whether a row below a header holds units: nothing else, and one at least that is known."""
    filled = [cell.strip(AROUND_UNITS) for cell in cells if cell]
    are_short = all(len(cell) <= _LONGEST_UNIT and not _DIGIT.search(cell) for cell in filled)
    return are_short and any(cell.casefold() in UNITS for cell in filled)


def _find_rows_before(rows: list[TextRow], beginning: str, header: TextRow, text: TextFile) -> list[TextRow]:
    """Return the rows above the one that begins so."""
    for index, row in enumerate(rows):
        if find_first_cell(row.cells).casefold().startswith(beginning.casefold()):
            return rows[:index]
    raise InputError.at(
        text.place(header.line), f"no row below begins with {quoted(beginning)}, as 'ends_before' says"
    )


def find_first_cell(cells: Sequence[str]) -> str:
    """Return the first cell of a row that holds something."""
    return next(filter(None, cells), "")


def _refuse_preamble(
    content: Sequence[tuple[int, str]],
    delimiter: str | None,
    names_column: Callable[[str], bool],
    text: TextFile,
) -> None:
    """Refuse a table whose header stands below other text, with the rows to be skipped."""
    first, line = content[0]
    for row, (number, below) in enumerate(content[:_LONGEST_PREAMBLE]):
        parted_by = delimiter or _find_delimiter_by_names([below], names_column)
        known = sum(map(names_column, _split_header(below, parted_by))) if parted_by else 0
        if row == 0 and known:
            return
        if known > 1:
            raise InputError.at(
                text.place(first, 1),
                f"{quoted(line.strip())} is no header, and line {number} names columns: say "
                f"'skip_rows: {number - 1}' in the job",
            )


def _refuse_lying(table: TextTable, names_column: Callable[[str], bool]) -> None:
    """Refuse a table that lies on its side: names down its first column, or targets along its header."""
    first = [row.cells[0] for row in table.rows]
    down = [cell for cell in first if names_column(cell) and not _NUMBER.fullmatch(cell.lstrip("+-−"))]
    along = [name for name in table.header.cells[1:] if _NUMBER.fullmatch(name)]
    are_all = len(along) > 1 and len(along) == len(table.header.cells) - 1
    if len(down) > 1 or (are_all and not set(along) <= _RUNS):
        raise InputError.at(
            table.source.place(table.header.line, 1),
            "this table lies on its side: a row is one reading or one target position, and a column is what "
            "its header names; say 'transposed: true' in the job",
        )


def _find_delimiter(
    content: Sequence[tuple[int, str]], options: FileTableLayout, names_column: Callable[[str], bool]
) -> str | None:
    """Return the delimiter by which a table is parted, as its header or its rows tell."""
    if options.header:
        width = len(options.header)
        fits = (each for each in DELIMITERS if content[0][1].count(each) + 1 == width)
        return next(fits, None)
    if options.transposed:
        return next((each for each in DELIMITERS if all(each in line for _, line in content[:2])), None)
    return _find_delimiter_by_names([line for _, line in content[: options.header_rows]], names_column)


def _find_delimiter_by_names(header: Sequence[str], names_column: Callable[[str], bool]) -> str | None:
    """Return the delimiter by which a header names most known columns; of equals the first."""

    def known(delimiter: str) -> int:
        rows = [TextRow(1, line, delimiter, tuple(_split_header(line, delimiter))) for line in header]
        return sum(map(names_column, join_header(rows).cells))

    present = [delimiter for delimiter in DELIMITERS if all(delimiter in line for line in header)]
    return max(present, key=known, default=None)


def _split_header(header: str, delimiter: str) -> Sequence[str]:
    try:
        return part_line(1, header, delimiter).cells
    except EnclosureError:
        return ()


def _list_rows(
    content: Sequence[tuple[int, str]], delimiter: str, text: TextFile, problems: list[Problem]
) -> Iterator[TextRow]:
    """Yield the rows that hold something; what is wrong with another is noted, of the first one raised."""
    width = 0
    for number, line in content:
        try:
            row = part_line(number, line, delimiter, width)
        except EnclosureError as error:
            problem = Problem(text.place(number, error.column), str(error))
            if number == content[0][0]:
                raise InputError([problem]) from error
            problems.append(problem)
            continue
        width = width or len(row.cells)
        if any(row.cells):
            yield row


def _turn_rows(rows: Sequence[TextRow]) -> list[TextRow]:
    """Return the columns of rows as rows; what is short is filled with empty cells."""
    width = max((len(row.cells) for row in rows), default=0)
    turned = []
    for index in range(width):
        cells = tuple(row.cells[index] if index < len(row.cells) else "" for row in rows)
        lying = tuple((row, index) for row in rows)
        if any(cells):
            turned.append(TextRow(rows[0].line, "", "", cells, lying))
    return turned


def _pad_row(row: TextRow, width: int) -> TextRow:
    short = width - len(row.cells)
    return replace(row, cells=(*row.cells, *[""] * short)) if short > 0 and not row.lying else row


def _find_ragged(row: TextRow, header: TextRow, text: TextFile) -> list[Problem]:
    """Return what is wrong with the number of cells; empty cells at the end are nobody's mistake."""
    expected, found = len(header.cells), len(row.cells)
    surplus = next((index for index in range(expected, found) if row.cells[index]), None)
    if surplus is not None:
        hint = "; is there a decimal comma? Then semicolons part columns" if row.delimiter == "," else ""
        return [
            Problem(
                text.place(*row.locate(surplus)),
                f"the row has {count_in_words(found, 'cell')}, and the header names "
                f"{count_in_words(expected, 'column')}{hint}",
            )
        ]
    if found < expected and any(header.cells[found:]):
        return [
            Problem(
                text.place(*row.locate(found - 1)),
                f"the row ends after {found} of {count_in_words(expected, 'cell')}; a missing reading is an "
                f"empty cell, with its {DELIMITERS.get(row.delimiter, 'delimiter')}",
            )
        ]
    return []


class EnclosureError(ValueError):
    """A quotation mark that does not enclose its cell."""

    def __init__(self, column: int) -> None:
        super().__init__("a quotation mark stands at the beginning of this cell, and not at its end")
        self.column = column


def part_line(number: int, line: str, delimiter: str, width: int = 0) -> TextRow:
    """Return the cells of a line; `width` is how many the first one of a table has that blanks part.

    Raises `EnclosureError` if a quotation mark does not enclose its cell.
    """
    if delimiter in {BLANKS, BAR} or _QUOTE in line:
        parts = [part for _, part in _split_line(line, delimiter, width)]
    else:
        parts = line.split(delimiter)
    return TextRow(number, line, delimiter, tuple(part.strip(_BLANKS) for part in parts))


def _split_line(line: str, delimiter: str, width: int) -> Iterator[tuple[int, str]]:
    """Yield the cells of a line that is not simply parted, each with the index at which it begins."""
    if delimiter == BAR:
        return _split_barred_line(line)
    if delimiter != BLANKS:
        return _split_quoted_line(line, delimiter)
    by_two = [(match.start(), match[0]) for match in re.finditer(r"\S+(?: \S+)*", line)]
    is_by_two = len(by_two) == width if width else len(by_two) > 1
    return iter(by_two if is_by_two else [(match.start(), match[0]) for match in re.finditer(r"\S+", line)])


def _split_barred_line(line: str) -> Iterator[tuple[int, str]]:
    """Yield the cells of a line that bars part; where it begins with a bar, bars stand around it."""
    start, end = len(line) - len(line.lstrip(_BLANKS)), len(line.rstrip(_BLANKS))
    if line.startswith(BAR, start):
        start, end = start + 1, end - line.endswith(BAR, start + 1, end)
    for part in line[start:end].split(BAR):
        yield start + len(part) - len(part.lstrip(_BLANKS)), part
        start += len(part) + 1


def _split_quoted_line(line: str, delimiter: str) -> Iterator[tuple[int, str]]:
    """Yield the cells of a line with quotation marks."""
    part = re.escape(delimiter)
    cell = re.compile(rf'[ ]*"((?:[^"]|"")*)"[ ]*(?={part}|$)|([^{part}]*)')
    position = 0
    while position <= len(line) and (match := cell.match(line, position)):
        if match[1] is not None:
            yield position, match[1].replace('""', _QUOTE)
        elif match[2].lstrip().startswith(_QUOTE):
            raise EnclosureError(position + 1)
        else:
            yield position, match[2]
        position = match.end() + 1
