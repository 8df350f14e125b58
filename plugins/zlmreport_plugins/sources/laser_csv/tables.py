"""Finds tables of readings in a file that nobody described: sheet, delimiter, header, last row."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from zlmreport.plugin import InputError
from zlmreport.plugin.source import TextFile, likely_encodings, read_text, sheets_of
from zlmreport.plugin.table import (
    DELIMITERS,
    PARTED_BY_BLANKS,
    EnclosureError,
    TextRow,
    first_cell,
    holds_units,
    joined_header,
    parted_line,
    states_delimiter,
    whole_lines,
)
from zlmreport_plugins.sources.laser_csv.meanings import (
    NUMBER,
    PLACE,
    READING,
    VALUE,
    Notation,
    find_meaning,
    find_meanings,
    find_reading_of,
    read_number,
    resolve_meanings,
)
from zlmreport_plugins.sources.laser_csv.options import names_direction, read_direction

#: Lines that are looked through for a header; and those of a table that may lie on its side.
_DEEPEST, _WIDEST = 60, 400
_MOST_TABLES = 12
#: Rows whose numbers tell how numbers are written.
_ENOUGH = 2000
#: Columns that every table of readings has.
_TARGET = ("target", PLACE)
#: How the rows of means, scatters and spans below a table begin.
_SUMMARIES = (
    *("mean", "average", "avg", "std", "stdev", "standard", "sigma", "range", "span", "max", "min", "median"),
    *("sum", "count", "mittel", "durchschnitt", "spannweite", "streu", "summe", "anzahl"),
    *("umkehr", "reversal", "repeat", "wiederhol"),
    *("平均", "均值", "标准", "標準", "最大", "最小", "极差", "重复"),
)
_DECIMALS = re.compile(r"[.,][0-9]")
_VALUES = frozenset({"deviation", "position", VALUE, READING, PLACE})


@dataclass(frozen=True, slots=True)
class FoundText:
    """A file, or a sheet of it, that can be read as lines."""

    text: TextFile
    keys: Mapping[str, Any]  #: By which: an encoding, a sheet.
    lines: Sequence[tuple[int, str]]  #: Those that are neither empty nor comments, with their numbers.


@dataclass(frozen=True)
class FoundLayout:
    """Where a table stands in a text, and how it is laid out."""

    found: FoundText
    delimiter: str
    header_rows: int  #: Of how many rows the names are made; 0 of a table without names.
    skipped: int  #: Lines of the file above it.
    is_transposed: bool = False


@dataclass(frozen=True)
class FoundTable:
    """A table: its rows, and what its columns are."""

    layout: FoundLayout
    header: TextRow  #: The row of names; of a table without names one of empty ones.
    units: TextRow | None  #: The row of units below it.
    rows: Sequence[TextRow]  #: Those with a target.
    below: Sequence[TextRow]  #: Those after them.
    meanings: Sequence[str | None]  #: What its columns are (`meanings.resolve_meanings`).
    notation: Notation  #: How its numbers are written.

    @property
    def found(self) -> FoundText:
        """The text in which it stands."""
        return self.layout.found

    @property
    def is_wide(self) -> bool:
        """Whether it has a column for each run and direction."""
        readings = sum(each == READING for each in self.meanings)
        return readings > 1 or (readings == 1 and not {"deviation", "position"} & {*self.meanings})

    @property
    def score(self) -> tuple[float, ...]:
        """By which of several ways to read a file the likeliest is known."""
        known = sum(each is not None for each in self.meanings)
        is_named = any(find_meaning(name) in _TARGET for name in self.header.cells)
        return (
            is_named,
            known / len(self.meanings) + min(known, 8),
            len(self.rows),
            -self.layout.header_rows,
        )

    def list_cells(self, index: int) -> list[str]:
        """Return the cells of a column."""
        return [row.cells[index] if index < len(row.cells) else "" for row in self.rows]

    def list_numbers(self, index: int) -> list[float | None]:
        """Return the numbers of a column; None for a cell that holds none."""
        return [read_number(cell, self.notation) for cell in self.list_cells(index)]


def list_texts(file: Path) -> Iterator[FoundText]:
    """Yield what can be read as lines: every sheet of a workbook, or the text in the encoding that fits."""
    try:
        sheets = sheets_of(file)
    except InputError:
        return
    if sheets:
        for sheet in sheets:
            try:
                text = read_text(file, sheet=sheet)
            except InputError:
                continue
            yield _find_text(text, {"sheet": sheet} if len(sheets) > 1 else {})
        return
    for encoding in likely_encodings(file):
        try:
            text = read_text(file, encoding)
        except InputError:
            continue
        yield _find_text(text, {"encoding": encoding} if encoding else {})
        return


def _find_text(text: TextFile, keys: Mapping[str, Any]) -> FoundText:
    lines = whole_lines(text.numbered())
    return FoundText(text, keys, lines[1:] if lines and states_delimiter(lines[0][1]) else lines)


def find_tables(found: FoundText) -> list[FoundTable]:
    """Return the tables of readings that a text may hold, the likeliest first."""
    candidates = [
        *(each for delimiter in _list_delimiters(found) for each in _find_upright(found, delimiter)),
        *(each for delimiter in _list_delimiters(found) for each in _find_lying(found, delimiter)),
    ]
    if not candidates:
        candidates = [
            each for delimiter in _list_delimiters(found) for each in _find_nameless(found, delimiter)
        ]
    return sorted(candidates, key=lambda each: each.score, reverse=True)[:_MOST_TABLES]


def _list_delimiters(found: FoundText) -> Sequence[str]:
    if found.text.of_cells:
        return ("\t",)
    return [each for each in DELIMITERS if any(each in line for _, line in found.lines)] + [PARTED_BY_BLANKS]


def _find_upright(found: FoundText, delimiter: str) -> Iterator[FoundTable]:
    """Yield the tables whose header is a row of the text, or two."""
    rows = _list_rows(found.lines, delimiter)
    for index in range(min(len(rows), _DEEPEST)):
        for count in (1, 2):
            if not rows[index] or len(rows) <= index + count or not all(rows[index : index + count]):
                continue
            above = [row for row in rows[index : index + count] if row]
            header = joined_header(above)
            if _is_perhaps_header(header.cells) and not any(_holds_units(row.cells) for row in above):
                skipped = found.lines[index][0] - 1 if index else 0
                layout = FoundLayout(found, delimiter, count, skipped)
                yield from _find_below(layout, header, [row for row in rows[index + count :] if row])


def _holds_units(cells: Sequence[str]) -> bool:
    """Return whether a row holds units: beside one of them, "up" and "down" are the lower row of names."""
    return holds_units(cells) and not any(len(cell) > 1 and names_direction(cell) for cell in cells)


def is_summary(cells: Sequence[str]) -> bool:
    """Return whether a row holds means or the like: by the word at its beginning."""
    words = re.findall(r"[^\W\d_]+", first_cell(cells).casefold())
    return bool(words) and words[0].startswith(_SUMMARIES)


def _find_lying(found: FoundText, delimiter: str) -> Iterator[FoundTable]:
    """Yield the tables that lie on their side: a row of targets, and readings below it."""
    if len(found.lines) > _WIDEST:
        return
    rows = _list_rows(found.lines, delimiter)
    for index, row in enumerate(rows[:_DEEPEST]):
        lines = [each for each in rows[index:] if each]
        if row is not None and _are_labelled_twice(lines):
            yield from _find_turned(found, delimiter, index, lines, labels=2)
        if row is None or not (find_meaning(row.cells[0]) in _TARGET or _are_runs_below_targets(lines)):
            continue
        names = [each.cells[0] for each in lines if find_meaning(each.cells[0])]
        if sum(map(_is_number, row.cells[1:])) < 2 or len(set(names)) < len(names):
            continue
        if _are_counted(row.cells[1:]) and not _are_counted([each.cells[0] for each in lines[1:]]):
            continue  # the numbers of runs above their readings: it stands upright
        yield from _find_turned(found, delimiter, index, lines, labels=1)


def _find_turned(
    found: FoundText, delimiter: str, index: int, lines: Sequence[TextRow], labels: int
) -> Iterator[FoundTable]:
    """Yield the table whose columns are lines; so many cells at the beginning of each name it."""
    width = max(len(each.cells) for each in lines)
    turned = [
        TextRow(1, "", "", tuple(each.cells[place] if place < len(each.cells) else "" for each in lines))
        for place in range(width)
    ]
    skipped = found.lines[index][0] - 1 if index else 0
    below = [each for each in turned[labels:] if any(each.cells)]
    layout = FoundLayout(found, delimiter, labels, skipped, is_transposed=True)
    yield from _find_below(layout, joined_header(turned[:labels]), below)


def _are_runs_below_targets(lines: Sequence[TextRow]) -> bool:
    """Return whether a row of numbers that rise stands above rows of readings, under any name but none."""
    first, *others = (each.cells for each in lines)
    targets = [read_number(cell, Notation.of([cell])) for cell in first[1:] if cell]
    known = [target for target in targets if target is not None]
    rises = len(known) == len(targets) > 2 and all(low < high for low, high in itertools.pairwise(known))
    return bool(first[0]) and rises and len(others) > 1 and all(find_reading_of(each[0]) for each in others)


def _are_labelled_twice(lines: Sequence[TextRow]) -> bool:
    """Return whether a row of targets stands above rows that run and direction begin, each in a cell."""
    first, *others = (each.cells for each in lines)
    targets = [read_number(cell, Notation.of([cell])) for cell in first[2:] if cell]
    known = [target for target in targets if target is not None]
    rises = len(known) == len(targets) > 1 and all(low < high for low, high in itertools.pairwise(known))
    if not rises or not any(first[:2]) or any(map(_is_number, first[:2])):
        return False
    names = joined_header([TextRow(1, "", "", tuple(each[at] for each in (first, *others))) for at in (0, 1)])
    return find_meanings(names.cells[1:]).count(READING) > 1


def _are_counted(cells: Sequence[str]) -> bool:
    """Return whether cells, as far as they are numbers, count from 1, as runs do and targets hardly ever."""
    numbers = [cell for cell in cells if _is_number(cell)]
    return numbers == [str(count + 1) for count in range(len(numbers))]


def _find_nameless(found: FoundText, delimiter: str) -> Iterator[FoundTable]:
    """Yield a table of two columns of numbers without names, but those that a comment may give."""
    rows = _list_rows(found.lines, delimiter)
    first = next((row for row in rows if row and all(map(_is_number, row.cells))), None)
    if first is None or len(first.cells) < 2:
        return
    names = _find_commented(found.text, first, delimiter) or ("",) * len(first.cells)
    if not any(names) and len(first.cells) != 2:
        return
    header = TextRow(0, "", "", names)
    skipped = first.line - 1 if any(line < first.line for line, _ in found.lines) else 0
    below = [row for row in rows if row and row.line >= first.line]
    yield from _find_below(FoundLayout(found, delimiter, 0, skipped), header, below)


def _is_number(cell: str) -> bool:
    return read_number(cell, Notation.of([cell])) is not None


def _find_commented(text: TextFile, first: TextRow, delimiter: str) -> tuple[str, ...]:
    """Return the names that the last comment above a table gives, if it gives one for each column."""
    for line in reversed(text.lines[: first.line - 1]):
        if line.lstrip().startswith("#"):
            try:
                cells = parted_line(1, line.lstrip().lstrip("#").strip(), delimiter).cells
            except EnclosureError:
                return ()
            return cells if len(cells) == len(first.cells) and _is_perhaps_header(cells) else ()
    return ()


def _list_rows(lines: Sequence[tuple[int, str]], delimiter: str) -> list[TextRow | None]:
    """Return the rows of lines; None for one whose quotation marks enclose nothing."""
    found: list[TextRow | None] = []
    width = 0
    for line_number, line in lines:
        try:
            row = parted_line(line_number, line, delimiter, width)
        except EnclosureError:
            found.append(None)
            continue
        if delimiter == PARTED_BY_BLANKS and find_meaning(row.cells[0]) in _TARGET:
            width = len(row.cells)
        found.append(row)
    return found


def _is_perhaps_header(cells: Sequence[str]) -> bool:
    """Return whether names are those of a table of readings, or its columns are readings under no name.

    A row of readings has signs and numbers that could name columns of runs, but it begins with its target, or
    has decimals.
    """
    if _is_number(cells[0]) or any(_is_number(cell) and _DECIMALS.search(cell) for cell in cells):
        return False
    found = find_meanings(cells)
    known = sum(each is not None and each != NUMBER for each in found)
    has_target = any(each in _TARGET for each in found)
    readings = found.count(READING)
    return known > 1 and any(each in _VALUES for each in found) and (has_target or readings > 1)


def _settle_direction(meanings: list[str | None], rows: Sequence[TextRow]) -> None:
    """Say which column is the direction where no name says it: the one that has both, and nothing else."""
    if "direction" in meanings:
        return
    for index, meaning in enumerate(meanings):
        cells = [row.cells[index] if index < len(row.cells) else "" for row in rows]
        if meaning is None and all(map(names_direction, cells)) and len({*map(read_direction, cells)}) > 1:
            meanings[index] = "direction"
            return


def _find_below(layout: FoundLayout, header: TextRow, rows: Sequence[TextRow]) -> Iterator[FoundTable]:
    """Yield the table below a header: to the first row that has no target."""
    is_workbook = layout.found.text.of_cells
    units = rows[0] if rows and _holds_units(rows[0].cells) else None
    rows = rows[1:] if units else rows
    width = len(header.cells)
    notation = Notation.of((cell for row in rows[:_ENOUGH] for cell in row.cells), is_workbook=is_workbook)
    columns = [
        [read_number(row.cells[index], notation) if index < len(row.cells) else None for row in rows]
        for index in range(width)
    ]
    meanings = resolve_meanings(header.cells, columns)
    if not any(header.cells):
        meanings = ["target", *[None] * (width - 1)]
    elif layout.is_transposed:
        meanings[0] = "target"
    if "target" not in meanings:
        return
    ends = (
        index
        for index, (row, target) in enumerate(zip(rows, columns[meanings.index("target")], strict=True))
        if target is None or is_summary(row.cells)
    )
    last = next(ends, len(rows))
    is_even = is_workbook or layout.is_transposed or len(rows[0].cells if rows else ()) >= width
    if last and is_even:
        _settle_direction(meanings, rows[:last])
        yield FoundTable(layout, header, units, rows[:last], rows[last:], meanings, notation)
