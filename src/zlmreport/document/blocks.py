"""The blocks of which all that is said consists: paragraph, notice, facts, table, graph, formulas, section.

Every text here is data: whoever lays it out sets it as it stands and interprets nothing in it. Symbols are
kept apart as `Symbol`, because they are set in italics and subscripts.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from typing import TYPE_CHECKING, TypeAlias

from zlmreport.language.formatting import write_plain

if TYPE_CHECKING:
    from zlmreport.document.figures.figure import Figure


@dataclass(frozen=True, slots=True)
class Symbol:
    """A standard's symbol or formula, in the notation of `zlmreport.language.formatting`."""

    notation: str


class Mark(Enum):
    """A sign that stands for a statement; a renderer gives it a shape and a word."""

    MET = "met"
    NOT_MET = "not met"
    OPEN = "open"


@dataclass(frozen=True, slots=True)
class Verdict:
    """A mark with its word in the document's language: ``conforms``, ``not met``, ``not stated``."""

    mark: Mark
    word: str


@dataclass(frozen=True, slots=True)
class Explained:
    """A name, and below it in small type what it means."""

    name: str
    meaning: str


#: Whatever stands in a cell of a table.
Cell: TypeAlias = str | Symbol | Verdict | Explained


def write_cell_text(cell: Cell, symbol: Callable[[str], str] = write_plain) -> str:
    """Return what a cell shows in its first line; `symbol` writes the notation of a symbol."""
    match cell:
        case Symbol(notation):
            return symbol(notation)
        case Verdict(word=word):
            return word
        case Explained(name=name):
            return name
        case _:
            return cell


def split_at_symbols(text: str, notations: Iterable[str]) -> Iterator[str | Symbol]:
    """Yield the stretches of a text in which symbols stand as a plain line, each of these as a symbol.

    >>> list(split_at_symbols("Umax: largest, Umaximum", ["U_{max}"]))
    [Symbol(notation='U_{max}'), ': largest, Umaximum']
    """
    by_name = {write_plain(each): each for each in notations}
    if not by_name:
        yield text
        return
    names = "|".join(map(re.escape, sorted(by_name, key=len, reverse=True)))
    for number, stretch in enumerate(re.split(rf"(?<!\w)({names})(?![\w\u0300-\u036f])", text)):
        if stretch:
            yield Symbol(by_name[stretch]) if number % 2 else stretch


class Align(Enum):
    """How a column stands: words to the left, numbers on their last digit to the right."""

    LEFT = "left"
    RIGHT = "right"
    CENTRE = "centre"


class ColumnKind(Enum):
    """What a column holds: values; sentences, which a narrow medium sets below the row; shares, as bars."""

    VALUES = "values"
    SENTENCES = "sentences"
    BARS = "bars"


@dataclass(frozen=True, slots=True)
class Column:
    """A column of a table: its heading, unit below it, and alignment.

    `key` names it in every language, for media that show some of the columns.
    """

    heading: Cell
    unit: str = ""
    align: Align = Align.LEFT
    key: str = ""
    kind: ColumnKind = ColumnKind.VALUES


@dataclass(frozen=True, slots=True)
class RowGroup:
    """Rows under a heading of their own; no heading for a plain table.

    `note` stands under the heading: what the group means. `section` is the key of the section that says
    more; empty without one.
    """

    rows: tuple[tuple[Cell, ...], ...]
    heading: str = ""
    note: str = ""
    section: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """A table; `dense` asks for small type, for many columns, `symbols` are those its words speak of."""

    caption: str
    columns: tuple[Column, ...]
    groups: tuple[RowGroup, ...]
    dense: bool = False
    symbols: tuple[str, ...] = ()

    def without(self, *keys: str) -> Table:
        """Return the table without some of its columns."""
        kept = [number for number, column in enumerate(self.columns) if column.key not in keys]
        groups = (
            replace(group, rows=tuple(tuple(row[number] for number in kept) for row in group.rows))
            for group in self.groups
        )
        return replace(self, columns=tuple(self.columns[number] for number in kept), groups=tuple(groups))


@dataclass(frozen=True, slots=True)
class Facts:
    """Pairs of a name and a value: who, what, where, when."""

    pairs: tuple[tuple[str, str], ...]
    heading: str = ""


@dataclass(frozen=True, slots=True)
class Paragraph:
    """A paragraph of running text, in small type where the law wants it and nobody looks for it.

    One that begins with a verdict says of what it is one.
    """

    text: str
    mark: Mark | None = None  #: What it says of its subject, for media with colours.
    fine: bool = False
    verdict: Verdict | None = None
    symbols: tuple[str, ...] = ()  #: Notations of those that it speaks of.


@dataclass(frozen=True, slots=True)
class Notice:
    """A statement that nobody may overlook: a deviation from the standard, missing readings.

    One that is quoted has words of somebody else, in a frame of their own: they are no results. `symbols` are
    those that its items speak of.
    """

    heading: str
    items: tuple[str, ...]
    is_quoted: bool = False
    symbols: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Graph:
    """A figure in its place."""

    figure: Figure


@dataclass(frozen=True, slots=True)
class Formulas:
    """Definitions of symbols: (symbol, formula, name)."""

    caption: str
    rows: tuple[tuple[Symbol, Symbol, str], ...]


#: Whatever stands in a section of the document.
Block: TypeAlias = Table | Facts | Paragraph | Notice | Graph | Formulas


@dataclass(frozen=True, slots=True)
class Section:
    """A section: its key (an anchor, stable over languages), title, and blocks.

    `new_page` asks to begin a page.
    """

    key: str
    title: str
    blocks: tuple[Block, ...]
    new_page: bool = False
