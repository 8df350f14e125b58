"""Blocks on a terminal: titles, sentences that wrap, tables whose columns line up, bars."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence

from zlmreport.cli.terminal import Colour, fill, lay_out_table, say, wrap
from zlmreport.document.blocks import (
    Align,
    Block,
    Column,
    ColumnKind,
    Facts,
    Formulas,
    Graph,
    Mark,
    Notice,
    Paragraph,
    Section,
    Table,
    write_cell_text,
)
from zlmreport.document.writer import NOTHING
from zlmreport.language.formatting import HELD, write_plain

_COLOURS = {Mark.MET: Colour.GREEN, Mark.OPEN: Colour.YELLOW, Mark.NOT_MET: Colour.RED}
_INDENT, _FURTHER_IN = "  ", "    "
#: Letters of the name of a row.
_LONGEST_NAME = 61
_BAR_WIDTH = 20
_EIGHTHS = " ▏▎▍▌▋▊▉█"


def lay_out_sections(sections: Iterable[Section]) -> Iterator[str]:
    """Yield sections, each after an empty line."""
    for section in sections:
        yield from ("", Colour.BOLD.set(section.title))
        for block in section.blocks:
            yield from lay_out_blocks(block, section.title)


def lay_out_blocks(block: Block, title: str = "") -> Iterator[str]:
    """Yield what stands in a section of this title; a heading that repeats it is left out."""
    match block:
        case Paragraph(text, mark):
            lines = wrap(say(text))
            yield from (_COLOURS[mark].set(line) for line in lines) if mark else lines
        case Notice(heading, items):
            is_titled = heading == title
            yield from () if is_titled else wrap(f"{say(heading)}:")
            indent = _INDENT if is_titled else _FURTHER_IN
            yield from (line for item in items for line in wrap(say(item), indent))
        case Facts(pairs):
            held = (f"{name} {say(value)}".replace(" ", HELD) for name, value in pairs)
            yield from (line.replace(HELD, " ") for line in fill("   ".join(held)))
        case Table():
            yield from _lay_out_table(block)
        case Formulas(rows=rows):
            cells = [
                (write_plain(symbol.notation), write_plain(formula.notation), name)
                for symbol, formula, name in rows
            ]
            yield from lay_out_table(cells, indent=_INDENT)
        case Graph():
            pass


def write_in_a_line(facts: Facts) -> str:
    """Return names and values one after the other."""
    return "   ".join(f"{name} {say(value)}" for name, value in facts.pairs)


def _lay_out_table(block: Table) -> Iterator[str]:
    """Yield the columns that hold anything; sentences stand below the row that they belong to."""
    whole = [[say(write_cell_text(cell)) for cell in row] for group in block.groups for row in group.rows]
    shown: list[int] = []
    sentences: list[int] = []
    for number, column in enumerate(block.columns):
        if any(row[number] not in {"", NOTHING} for row in whole):
            (sentences if column.kind is ColumnKind.SENTENCES else shown).append(number)
    columns = [block.columns[number] for number in shown]
    rows = [[_write_cell(row[number], block.columns[number]) for number in shown] for row in whole]
    rows = [[*map(_shorten_name, row[:1]), *row[1:]] for row in rows]
    right = [number for number, column in enumerate(columns) if column.align is Align.RIGHT]
    is_grouped = any(group.heading for group in block.groups)
    head, *lines = lay_out_table([_write_head(columns), *rows], right, _FURTHER_IN if is_grouped else _INDENT)
    if head.strip():
        yield head
    below = iter(zip(whole, lines, strict=True))
    for group in block.groups:
        yield from wrap(say(group.heading)) if group.heading else ()
        for _ in group.rows:
            row, line = next(below)
            yield line
            yield from _list_sentences(row, [(number, block.columns[number]) for number in sentences])


def _list_sentences(row: Sequence[str], columns: Iterable[tuple[int, Column]]) -> Iterator[str]:
    for number, column in columns:
        heading = write_cell_text(column.heading)
        if row[number] not in {"", NOTHING}:
            yield from wrap(f"{heading}: {row[number]}" if heading else row[number], _FURTHER_IN)


def _write_head(columns: Iterable[Column]) -> list[str]:
    return [
        ""
        if column.kind is ColumnKind.BARS
        else " ".join(filter(None, (say(write_cell_text(column.heading)), column.unit)))
        for column in columns
    ]


def _write_cell(text: str, column: Column) -> str:
    return _draw_bar(float(text) / 100) if column.kind is ColumnKind.BARS else text


def _shorten_name(text: str) -> str:
    """Return the name of a row; of one for which a terminal has no room both ends."""
    if len(text) <= _LONGEST_NAME:
        return text
    kept = (_LONGEST_NAME - 1) // 2
    return f"{text[:kept]}…{text[-kept:]}"


def _draw_bar(share: float) -> str:
    """Return a bar of a length between 0 and 1."""
    eighths = round(share * 8 * _BAR_WIDTH)
    if not _can_print(_EIGHTHS):
        return "#" * max(1, round(eighths / 8)) if eighths else ""
    return (_EIGHTHS[-1] * (eighths // 8) + _EIGHTHS[eighths % 8]).rstrip()


def _can_print(text: str) -> bool:
    try:
        text.encode(sys.stdout.encoding or "ascii")
    except UnicodeEncodeError:
        return False
    return True
