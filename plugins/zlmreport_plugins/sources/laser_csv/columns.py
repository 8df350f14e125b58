"""From a header to columns that have a meaning and a unit."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from zlmreport.plugin import (
    CONDITIONS,
    SECOND,
    TIME_UNITS,
    Axis,
    InputError,
    Problem,
    ReadingScale,
    SourceContext,
    Unit,
    did_you_mean,
    position_units,
    quoted,
    unit_named,
)
from zlmreport_plugins.sources.laser_csv.options import COLUMN_NAMES, LaserCsvOptions, folded, names_direction
from zlmreport_plugins.sources.laser_csv.table import Row, Table

_BRACKETED = re.compile(r"(.*?)\s*[(\[]\s*([^()\[\]]+?)\s*[)\]]")
_NUMBER = re.compile(r"[+-]?[0-9]*[.,]?[0-9]+")
#: Columns of a file that a message lists.
_MOST_NAMED = 20
#: What the header of every long table names.
_EXAMPLE = "target,direction,run,deviation"


@dataclass(frozen=True, slots=True)
class Heading:
    """A name in the header.

    Attributes
    ----------
    index
        Of the column, from 0.
    text
        As the file writes it.
    name
        Without a unit in brackets.
    bracket
        What stands in brackets at its end; None without.
    """

    index: int
    text: str
    name: str
    bracket: str | None

    def is_called(self, name: str) -> bool:
        """Whether a name, with or without the unit, means this heading."""
        return folded(name) in {folded(self.text), folded(self.name)}


@dataclass(frozen=True, slots=True)
class Column:
    """A column that is read.

    Attributes
    ----------
    index
        Of the column, from 0.
    text
        Its heading in the file.
    name
        What it is: one of `COLUMN_NAMES`, or its own heading for any other condition.
    unit
        Of its numbers; None for what has none, and for conditions that are kept as found.
    """

    index: int
    text: str
    name: str
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

    Raises
    ------
    InputError
        If the header holds numbers, a name twice, or none where there are readings, or if the job speaks
        of columns that there are not.
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

    Raises
    ------
    InputError
        If there are several.
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

    Raises
    ------
    InputError
        If the unit is none of the column's quantity.
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
