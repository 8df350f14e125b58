"""Blocks on a terminal: titles, sentences that wrap, tables whose columns line up, bars."""

from __future__ import annotations

import sys
import textwrap
from collections.abc import Iterable, Iterator, Sequence

from zlmreport.cli.terminal import (
    Colour,
    fill,
    hold_values,
    lay_out_table,
    measure_line,
    measure_width,
    say,
    wrap,
)
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
#: Letters of the name of a row at most, and of one that is shortened at least.
_LONGEST_NAME, _SHORTEST_NAME = 61, 21
_BAR_WIDTH, _SHORTEST_BAR = 20, 8
_GAP = 2
_EIGHTHS = " ▏▎▍▌▋▊▉█"


def lay_out_sections(sections: Iterable[Section]) -> Iterator[str]:
    """Yield sections, each after an empty line."""
    for section in sections:
        yield from ("", Colour.BOLD.set(section.title))
        for block in section.blocks:
            yield from lay_out_blocks(block, section.title)


def lay_out_blocks(block: Block, title: str) -> Iterator[str]:
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
            held = (_hold_fact(f"{name} {say(value)}") for name, value in pairs)
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


def _hold_fact(text: str) -> str:
    """Return a name with its value held together, as far as a line has room for both."""
    has_room = measure_width(text) <= measure_line() - len(_FURTHER_IN)
    return text.replace(" ", HELD) if has_room else hold_values(text)


def write_in_a_line(facts: Facts) -> str:
    """Return names and values one after the other, each held together where lines are made of it."""
    return "   ".join(_hold_fact(f"{name} {say(value)}") for name, value in facts.pairs)


def _lay_out_table(block: Table) -> Iterator[str]:
    """Yield the columns that hold anything; sentences stand below the row that they belong to."""
    whole = [[say(write_cell_text(cell)) for cell in row] for group in block.groups for row in group.rows]
    indent = _FURTHER_IN if any(group.heading for group in block.groups) else _INDENT
    shown, sentences = _part_columns(block.columns, whole, measure_line() - len(indent))
    columns = [block.columns[number] for number in shown]
    kept = [[row[number] for number in shown] for row in whole]
    heads, spare = _break_heads(columns, kept, measure_line() - len(indent))
    rows = _draw_rows(columns, kept, spare)
    right = [number for number, column in enumerate(columns) if column.align is Align.RIGHT]
    lines = list(lay_out_table([*heads, *rows], right, indent))
    yield from (line for line in lines[: len(heads)] if line.strip())
    below = iter(zip(whole, lines[len(heads) :], strict=True))
    for group in block.groups:
        yield from wrap(say(group.heading)) if group.heading else ()
        for _ in group.rows:
            row, line = next(below)
            yield line
            yield from _list_sentences(row, [(number, block.columns[number]) for number in sentences])


def _part_columns(
    columns: Sequence[Column], rows: Sequence[Sequence[str]], room: int
) -> tuple[list[int], list[int]]:
    """Return the numbers of columns that stand in lines of so many letters, and of those below a row.

    Below it stand sentences, and the longest texts where a line has no room for them.
    """
    shown: list[int] = []
    sentences: list[int] = []
    for number, column in enumerate(columns):
        if any(row[number] not in {"", NOTHING} for row in rows):
            (sentences if column.kind is ColumnKind.SENTENCES else shown).append(number)

    def measure(number: int) -> int:
        return max(measure_width(row[number]) for row in rows)

    texts = [
        number
        for number in shown[1:]
        if columns[number].kind is ColumnKind.VALUES and columns[number].align is not Align.RIGHT
    ]
    while texts:
        kept = [[row[number] for number in shown] for row in rows]
        _, spare = _break_heads([columns[number] for number in shown], kept, room)
        name = measure(shown[0])
        if name + spare >= min(name, _SHORTEST_NAME):
            break
        longest = max(texts, key=measure)
        texts.remove(longest)
        shown.remove(longest)
        sentences.append(longest)
    return shown, sentences


def _draw_rows(columns: Sequence[Column], rows: Sequence[Sequence[str]], spare: int) -> Iterator[list[str]]:
    """Yield rows with bars and names for the room that is left: letters beside the shortest bars."""
    bar = min(_BAR_WIDTH, max(_SHORTEST_BAR, _SHORTEST_BAR + spare))
    longest = max((measure_width(row[0]) for row in rows if row), default=0)
    name = min(_LONGEST_NAME, max(_SHORTEST_NAME, longest + min(0, spare)))
    for row in rows:
        drawn = [
            _draw_bar(float(text) / 100, bar) if column.kind is ColumnKind.BARS else text
            for column, text in zip(columns, row, strict=True)
        ]
        yield [*(_shorten_name(each, name) for each in drawn[:1]), *drawn[1:]]


def _break_heads(
    columns: Sequence[Column], rows: Sequence[Sequence[str]], room: int
) -> tuple[list[list[str]], int]:
    """Return headings in a line, or in two where a line of so many letters has no room for that.

    With them the room that is left beside the shortest bars; less than none where it is lacking.
    """
    bars = sum(column.kind is ColumnKind.BARS for column in columns)
    for lines in (1, 2):
        heads, widths = [], []
        for number, column in enumerate(columns):
            is_bar = column.kind is ColumnKind.BARS
            widest = _SHORTEST_BAR if is_bar else max((measure_width(row[number]) for row in rows), default=0)
            head = " ".join(filter(None, (say(write_cell_text(column.heading)), column.unit)))
            heads.append([""] if is_bar else _break_head(head, widest, lines))
            widths.append(max(widest, *map(measure_width, heads[-1])))
        spare = room - sum(widths) - _GAP * (len(widths) - 1)
        if spare >= bars * (_BAR_WIDTH - _SHORTEST_BAR):
            break
    height = max(map(len, heads), default=1)
    return [
        list(line) for line in zip(*([""] * (height - len(each)) + each for each in heads), strict=True)
    ], spare


def _break_head(head: str, widest: int, lines: int) -> list[str]:
    """Return a heading in up to so many lines, as narrow as these and the cells below allow."""
    for width in range(max(widest, 1), len(head)):
        broken = textwrap.wrap(head, width, break_long_words=False)
        if len(broken) <= lines and max(map(len, broken)) <= width:
            return broken
    return [head]


def _list_sentences(row: Sequence[str], columns: Iterable[tuple[int, Column]]) -> Iterator[str]:
    for number, column in columns:
        heading = write_cell_text(column.heading)
        if row[number] not in {"", NOTHING}:
            yield from wrap(f"{heading}: {row[number]}" if heading else row[number], _FURTHER_IN)


def _shorten_name(text: str, longest: int) -> str:
    """Return the name of a row; of one for which a terminal has no room both ends."""
    if len(text) <= longest:
        return text
    kept = (longest - 1) // 2
    return f"{text[:kept]}…{text[-kept:]}"


def _draw_bar(share: float, width: int) -> str:
    """Return a bar of a length between 0 and 1; `width`: letters of the longest."""
    eighths = round(share * 8 * width)
    if not _can_print(_EIGHTHS):
        return "#" * max(1, round(eighths / 8)) if eighths else ""
    return (_EIGHTHS[-1] * (eighths // 8) + _EIGHTHS[eighths % 8]).rstrip()


def _can_print(text: str) -> bool:
    try:
        text.encode(sys.stdout.encoding or "ascii")
    except UnicodeEncodeError:
        return False
    return True
