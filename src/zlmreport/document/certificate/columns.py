"""Widths of the columns of tables and facts, sizes of type in them, and how many lines blocks take.

The tables have a fixed layout, which a page takes in a fraction of the time of one that measures every
cell; so the widths are reckoned here, from the letters in the cells.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, count
from math import ceil
from typing import TypeAlias

from zlmreport.document.blocks import (
    Align,
    Block,
    Cell,
    Column,
    Explained,
    Facts,
    Formulas,
    Graph,
    Notice,
    Paragraph,
    RowGroup,
    Symbol,
    Table,
    Verdict,
    write_cell_text,
)
from zlmreport.document.certificate.document import Certificate, Head, Letterhead, shorten_letterhead
from zlmreport.document.figures.canvas import TypeFace
from zlmreport.document.figures.metrics import measure_advance
from zlmreport.language import Language
from zlmreport.language.formatting import WORD_JOINER, hold_together

#: Number, with its decimals apart; a dash stands for a value that does not exist.
_NUMBER = re.compile(r"(?:[−+-]?\d+(?:[.,](?P<decimals>\d+))?|–)")

#: A character that no bundled face has, as those of East Asia, is as wide as it is high.
_FULL = 1.0
_FIRST_FULL_WIDTH_CHARACTER = "\u2e80"
#: Headings are set in semi-bold, which is wider.
_SEMIBOLD = 1.04
#: Size of the small type below a name, as the style sheet has it.
_SMALL = 0.9

#: Space at both sides of a cell, and the mark before a verdict's word, in em of the cell.
_PADDING_EM = 0.9
_VERDICT_EM = 1.9
#: Further space before words that follow a number.
_APART_EM = 1.15
#: A column as wide as its widest cell holds it in one line, whatever rounding leaves.
_ROUNDED = 1e-6
#: A longer word is broken rather than given the page.
_LONGEST_WORD_EM = 16.0
#: The same of a formula: what is left of the page is enough for its symbol and its name.
_LONGEST_FORMULA_EM = 32.0


@dataclass(frozen=True, slots=True)
class Size:
    """A type size: its class name, and how many em of it a page is wide (A4 and Letter alike)."""

    name: str
    page_em: float


#: From large to small, as the style sheet has them.
SIZES = (Size("regular", 56.0), Size("dense", 66.0), Size("finest", 78.0))
#: How many more em a page is wide in a compact document, whose type is smaller.
_IN_COMPACT = 9.0 / 8.1


@dataclass(frozen=True, slots=True)
class Measure:
    """What a column needs, in em: to stay on one line, and at least, when its words part."""

    natural: float
    least: float


#: A table of no more lines is not parted by the end of a page.
_WHOLE_LINES = 16


@dataclass(frozen=True, slots=True)
class TableLayout:
    """How a table stands on a page, for every renderer."""

    size: str  #: Its type size: ``regular``, ``dense`` or ``finest``.
    widths: tuple[float, ...]  #: Of the columns, in per cent of the page's.
    rooms: tuple[float, ...]  #: The same in em of the type.
    lines: int  #: That its body takes, estimated.
    #: Which columns are words that follow a column of numbers: the two need a gap between them.
    apart: tuple[bool, ...]
    is_whole: bool  #: Whether it is short enough to stay on one page.
    #: Whether its rows are read in fives, as in a book of tables, and pages break between the fives.
    in_fives: bool


def lay_out_table(block: Table | Formulas, *, is_compact: bool = False) -> TableLayout:
    """Return how a table stands on a page, or definitions, which are a table without headings.

    The type of a compact document is smaller, and its page so many more em wide.
    """
    table = block if isinstance(block, Table) else Table("", (Column(""),) * 3, (RowGroup(block.rows),))
    needs = measure_columns(table)
    chosen = choose_size(table, needs)
    page_em = chosen.page_em * (_IN_COMPACT if is_compact else 1.0)
    shares = share_widths(needs, page_em)
    rooms = tuple(page_em * share / 100 for share in shares)
    body = count_table_lines(table, rooms)
    return TableLayout(
        size=chosen.name,
        widths=shares,
        rooms=rooms,
        lines=body,
        apart=find_apart(table.columns),
        is_whole=(body if isinstance(block, Table) else len(block.rows)) <= _WHOLE_LINES,
        in_fives=chosen.name != SIZES[0].name and table.columns[0].align is Align.RIGHT,
    )


def measure_columns(table: Table) -> tuple[Measure, ...]:
    """Return what each column of a table needs."""
    rows = [row for group in table.groups for row in group.rows]
    gaps = [_APART_EM if apart else 0.0 for apart in find_apart(table.columns)]
    return tuple(
        _measure(column, [row[index] for row in rows], gaps[index])
        for index, column in enumerate(table.columns)
    )


def find_apart(columns: Sequence[Column]) -> tuple[bool, ...]:
    """Return which columns are words that follow a column of numbers: the two need a gap between them."""
    alignments = [column.align for column in columns]
    return tuple(
        align is Align.LEFT and before is Align.RIGHT
        for before, align in zip([Align.LEFT, *alignments], alignments, strict=False)
    )


def choose_size(table: Table, needs: Sequence[Measure]) -> Size:
    """Return the largest size in which the table's words need not be broken; the smallest if none is."""
    sizes = SIZES[1:] if table.dense else SIZES
    needed = sum(need.least for need in needs)
    return next((each for each in sizes if needed <= each.page_em), sizes[-1])


def share_widths(needs: Sequence[Measure], available: float) -> tuple[float, ...]:
    """Share the available width (em) among columns; the result is in per cent and adds up to 100.

    Columns with room for their lines share what is left over in proportion; columns without it get what
    they need at least, and share the rest in proportion to what they lack.
    """
    natural = sum(need.natural for need in needs)
    least = sum(need.least for need in needs)
    if natural <= available:
        shares = [need.natural for need in needs]
    elif least < available:
        part = (available - least) / (natural - least)
        shares = [need.least + part * (need.natural - need.least) for need in needs]
    else:
        shares = [need.least for need in needs]
    return tuple(100 * share / sum(shares) for share in shares)


def count_table_lines(table: Table, available: Sequence[float]) -> int:
    """Estimate how many lines a table's body takes, its columns being so wide (em)."""
    headings = sum(bool(group.heading) for group in table.groups)
    rows = (row for group in table.groups for row in group.rows)
    return headings + sum(max(map(_count_lines, row, available)) for row in rows)


def pad_decimals(table: Table) -> tuple[tuple[str, ...], ...]:
    """Return for each row the class names that bring the decimal signs of a column under each other.

    Figures are all of one width, so a number that lacks ``n`` decimals is moved left by as many figures
    (``short-n``), and by a decimal sign too if it has none (``whole-n``).
    """
    rows = [row for group in table.groups for row in group.rows]
    by_column = [
        _list_padding([row[index] for row in rows]) if column.align is Align.RIGHT else ("",) * len(rows)
        for index, column in enumerate(table.columns)
    ]
    return tuple(zip(*by_column, strict=True))


def _list_padding(cells: Sequence[Cell]) -> tuple[str, ...]:
    numbers = [_NUMBER.fullmatch(write_cell_text(cell)) for cell in cells]
    decimals = [len(number["decimals"] or "") if number else None for number in numbers]
    most = max((count for count in decimals if count is not None), default=0)
    return tuple(
        "" if count is None or count == most else f"{'short' if count else 'whole'}-{most - count}"
        for count in decimals
    )


def _measure(column: Column, cells: Sequence[Cell], gap: float) -> Measure:
    is_words = column.align is Align.LEFT
    heading = _SEMIBOLD * measure_width(write_cell_text(column.heading))
    least = max(
        _SEMIBOLD * _measure_longest_word(write_cell_text(column.heading)), measure_width(column.unit)
    )
    natural = heading if is_words else least
    for cell in cells:
        text = write_cell_text(cell)
        width = measure_width(text)
        match cell:
            case Explained(meaning=meaning):
                width = max(width, _SMALL * measure_width(meaning))
                unbroken = max(_measure_longest_word(text), _SMALL * _measure_longest_word(meaning))
            case Verdict():
                width = unbroken = _SEMIBOLD * width + _VERDICT_EM
            case Symbol():
                unbroken = min(width, _LONGEST_FORMULA_EM)
            case _:
                unbroken = _measure_longest_word(text) if is_words else width
        natural = max(natural, width)
        least = max(least, unbroken)
    return Measure(natural + _PADDING_EM + gap, least + _PADDING_EM + gap)


def _count_lines(cell: Cell, available: float) -> int:
    room = max(available - _PADDING_EM, _FULL)
    note = ceil(_SMALL * measure_width(cell.meaning) / room - _ROUNDED) if isinstance(cell, Explained) else 0
    return max(1, ceil(measure_width(write_cell_text(cell)) / room - _ROUNDED)) + note


def _measure_longest_word(text: str) -> float:
    return min(max(map(measure_width, text.split()), default=0.0), _LONGEST_WORD_EM)


@lru_cache(maxsize=4096)
def measure_width(text: str) -> float:
    """Return how wide a text is in the regular face, in em."""
    ours = "".join(each for each in text if each < _FIRST_FULL_WIDTH_CHARACTER)
    return measure_advance(ours, TypeFace.REGULAR) + _FULL * (len(text) - len(ours))


#: A block, or facts that follow each other.
GatheredBlock: TypeAlias = Table | Formulas | Graph | Paragraph | Notice | tuple[Facts, ...]

#: Characters of a value that stand on one line of a column, and of its name; counted low.
_VALUE_LINE = 26
_NAME_LINE = 20
#: Lines that it must save for a group to stand out of its order, and groups of which every way is tried.
_OUT_OF_ORDER, _MOST_PARTED = 3, 9
#: Lines of a heading with the space around it.
_HEADING_LINES = 2


def gather_facts(blocks: Iterable[Block]) -> Iterator[GatheredBlock]:
    """Yield the blocks in order, groups of facts that follow each other as one."""
    facts: tuple[Facts, ...] = ()
    for block in blocks:
        if isinstance(block, Facts):
            facts = (*facts, block)
            continue
        if facts:
            yield facts
            facts = ()
        yield block
    if facts:
        yield facts


@dataclass(frozen=True, slots=True)
class NumberedBlock:
    """A block; of a table or a graph its number, from 1, and its label, such as ``Table 2``."""

    block: GatheredBlock
    number: int = 0
    label: str = ""


def number_blocks(certificate: Certificate) -> Iterator[tuple[NumberedBlock, ...]]:
    """Yield the blocks of the first page, then those of each section; tables and graphs are counted."""
    words = certificate.page_words
    of_tables, of_graphs = (words.table, count(1)), (words.figure, count(1))
    counted = {Table: of_tables, Formulas: of_tables, Graph: of_graphs}

    def number(block: GatheredBlock) -> NumberedBlock:
        if isinstance(block, Table | Formulas | Graph):
            word, numbers = counted[type(block)]
            number = next(numbers)
            return NumberedBlock(block, number, f"{word} {number}".strip())
        return NumberedBlock(block)

    for blocks in (certificate.cover, *(each.blocks for each in certificate.sections)):
        yield tuple(map(number, gather_facts(blocks)))


def balance_facts(groups: tuple[Facts, ...]) -> tuple[tuple[Facts, ...], ...]:
    """Part groups of facts into two columns of nearly one height; a single group keeps the page's width.

    The first group stands first. Groups go over to the other column out of their order where that saves
    lines.
    """
    if len(groups) == 1:
        return (groups,)
    lines = dict(enumerate(map(_count_fact_lines, groups)))

    def height(left: tuple[int, ...]) -> int:
        beside = sum(lines.values()) - sum(lines[each] for each in left)
        is_in_order = left == tuple(range(len(left)))
        return max(sum(lines[each] for each in left), beside) + (0 if is_in_order else _OUT_OF_ORDER)

    numbers = range(1, len(groups) if len(groups) <= _MOST_PARTED else 1)
    ways = [tuple(range(end)) for end in range(1, len(groups))]
    ways += [(0, *others) for size in numbers for others in combinations(numbers, size - 1)]
    left = min(ways, key=height)
    right = (each for each in lines if each not in left)
    return tuple(groups[each] for each in left), tuple(groups[each] for each in right)


def _count_fact_lines(group: Facts) -> int:
    """Estimate the lines that a group takes in a column."""
    return _HEADING_LINES + sum(
        max(
            ceil(len(name) / _NAME_LINE),
            sum(ceil(len(line) / _VALUE_LINE) or 1 for line in value.split("\n")),
        )
        for name, value in group.pairs
    )


# How much of a page blocks take in a compact document, so that it is decided before it is set. The estimate
# follows the style sheets (``.compact``) and the widths of the typeface, and is on the high side.

#: In points, as all heights here.
MILLIMETRE = 72 / 25.4
#: The mark at the end of a document.
END_MARK = 22.0
#: What stands between the margins of a page of each paper, but for that mark.
PAGES = {
    paper: (height - 21 - 19) * MILLIMETRE - END_MARK for paper, height in (("A4", 297.0), ("Letter", 279.4))
}
#: What the first page has besides, for it has no running head.
_OF_FIRST = 6 * MILLIMETRE
#: Of the type and its lines, and of smaller types in parts of it.
_TYPE = 8.1
_LINE = 1.3 * _TYPE
_SMALL_TYPE = 0.944
_DENSE = 0.811
#: Of what the law wants, in small type, and of a verdict that stands alone.
_FINE, _OUTCOME = 0.765, 1.235
_FINE_LINE, _OUTCOME_LINE = 1.25 * _FINE * _TYPE, 1.35 * _OUTCOME * _TYPE
#: Em of a page, with some words too long to end a line.
_PAGE_EM = 57.0
#: Lines of the head or the foot of a page, and em of one.
MARGIN_LINES, _MARGIN_EM = 3, 55.0
_NOTICE_EM = 52.0
#: What the mark of a verdict adds to its row.
_MARK = 1.3
#: What parts five rows from the next, in dense tables and in the finest.
_FIVE, _FIVE_FINEST = 1.0, 4.6
_SECTION_HEADING = 14.0 + 2.5 + 5.0
_LOGO = 31.0
#: Em of a page of the type of the line below the title, and of a laboratory's name without and with a logo.
_SUBJECT_EM, _LABORATORY_EM = 50.0, (46.0, 30.0)
_SUBJECT_LINE = 12.9
#: A name and a title in small type, in parts of their usual sizes.
_SMALL_NAME, _SMALL_TITLE = 0.765 / 1.167, 1 / 1.8
#: What a section has above its heading that begins below the title, and no page.
BELOW_TITLE = 5.5
#: Em of the names and values of facts in one of two columns, and where a single group has the page's width.
_NAME_EM, _VALUE_EM = 10.4, 16.3
_WIDE_NAME_EM, _WIDE_VALUE_EM = 16.0, 38.5
_FACTS_MARGIN = 4.0
_USUAL_GRAPH = 60 * MILLIMETRE


def estimate_height(blocks: Iterable[Block]) -> float:
    """Return how high blocks stand, one below the other, facts that follow each other in two columns."""
    return sum(map(_estimate_height, gather_facts(blocks)))


def estimate_head_height(
    letterhead: Letterhead | None, title: str, subject: str, number: str, head: Head = Head.WHOLE
) -> float:
    """Return how high the letterhead and the title stand, with what the first page has besides.

    The number stands behind the subject, or below it where it would be parted.
    """
    below_title = _count_lines_of_words(f"{subject} {number.replace('-', '_')}", _SUBJECT_EM)
    smaller, small_title = (_SMALL_NAME, _SMALL_TITLE) if head is Head.SMALL else (1.0, 1.0)
    room = _count_lines_in_room(title, 26.0 / small_title) * 17.5 * small_title
    room += _SUBJECT_LINE * below_title + 7.0
    letterhead = shorten_letterhead(letterhead, head)
    if letterhead:
        beside = ", ".join((*letterhead.laboratory.lines, letterhead.accreditation))
        name_em = _LABORATORY_EM[bool(letterhead.logo)] / smaller
        name = _count_lines_of_words(letterhead.laboratory.name, name_em)
        text = 1.0 + 12.8 * smaller * name + (9.8 * _count_lines_in_room(beside, 40.0) if beside else 0.0)
        room += max(text, _LOGO if letterhead.logo else 0.0) + 10.2
    return room - _OF_FIRST


def estimate_heading_height(title: str) -> float:
    """Return how high the heading of a section stands that begins a page."""
    return _SECTION_HEADING + (_count_lines_in_room(title, 38.0) - 1) * 14.0


def _estimate_height(block: GatheredBlock) -> float:
    match block:
        case Table():
            return _estimate_table(block)
        case Formulas(rows=rows):
            return 25.0 + len(rows) * (_DENSE * _LINE + 3.4)
        case Graph(figure):
            drawing = figure.height * MILLIMETRE if figure.height else _USUAL_GRAPH * len(figure.panels)
            title = figure.title.in_language(Language.ENGLISH)  # long where a name in it is
            return drawing + 10.0 + _count_lines_in_room(title, _PAGE_EM / _SMALL_TYPE) * _SMALL_TYPE * _LINE
        case Paragraph():
            return _estimate_paragraph(block)
        case Notice(title, items):
            lines = sum(map(notice_lines, (title, *items)))
            return lines * _LINE + 1.5 * len(items) + 19.0
        case facts:
            return _FACTS_MARGIN + max(
                _estimate_facts(each, is_wide=len(facts) == 1) for each in balance_facts(facts)
            )


def notice_lines(text: str) -> int:
    """Return how many lines a heading or an item of a notice takes."""
    return _count_lines_in_room(text, _NOTICE_EM)


def _estimate_paragraph(paragraph: Paragraph) -> float:
    if paragraph.verdict:
        said = f"{paragraph.verdict.word} {paragraph.text}"
        return _count_lines_of_words(said, _PAGE_EM / _OUTCOME - _VERDICT_EM) * _OUTCOME_LINE + 4.0
    if paragraph.fine:
        return _count_lines_of_words(paragraph.text, _PAGE_EM / _FINE) * _FINE_LINE + 2.0
    return _count_lines_of_words(paragraph.text, _PAGE_EM) * _LINE + 3.0


def _estimate_table(table: Table) -> float:
    layout = lay_out_table(table, is_compact=True)
    rows = [row for group in table.groups for row in group.rows]
    em = (_SMALL_TYPE if layout.size == "regular" else _DENSE) * _TYPE
    head_lines = 2 if any(column.unit for column in table.columns) else 1
    head = (
        _count_lines_in_room(table.caption, _PAGE_EM) * _SMALL_TYPE * _LINE
        + 3.0
        + head_lines * 1.25 * em
        + 5.0
    )
    between = len(rows) * (3.0 if layout.size == "regular" else 1.4)
    between += len(rows) // 5 * (_FIVE_FINEST if layout.size == "finest" else _FIVE) * layout.in_fives
    between += _MARK * sum(any(isinstance(cell, Verdict) for cell in row) for row in rows)
    return head + layout.lines * 1.3 * em + between + 8.0


def _estimate_facts(groups: tuple[Facts, ...], *, is_wide: bool) -> float:
    room = 0.0
    for group in groups:
        room += _LINE + 2.0 if group.heading else 0.0
        room += sum(count_fact_lines(*pair, is_wide=is_wide) * _LINE + 1.6 for pair in group.pairs)
    return room


def count_fact_lines(name: str, value: str, *, is_wide: bool = False) -> int:
    """Return how many lines a fact takes in one of two columns, or where it has the page's width."""
    of_name, of_value = (_WIDE_NAME_EM, _WIDE_VALUE_EM) if is_wide else (_NAME_EM, _VALUE_EM)
    lines = sum(_count_lines_of_words(line, of_value, 1.0) for line in value.split("\n"))
    return max(_count_lines_of_words(name, of_name, 1.0), lines)


#: Where a line can end: after a blank, and after a hyphen or a slash before a letter; not where it is held.
_LINE_ENDS = re.compile(rf"(?<=[^{WORD_JOINER}] )(?! )|(?<=[-–/])(?=[^\W\d])")
#: Running text is narrower than its letters are estimated.
_RUNNING = 1.04


def _count_lines_of_words(text: str, room: float, running: float = _RUNNING) -> int:
    """Return how many lines a paragraph takes, whose words go over to the next line where they do not fit.

    A line ends after a hyphen or a slash within a word, too, and what is left of it stays empty; a part that
    is wider than a line is parted anywhere.
    """
    room *= running
    lines, taken = 1, 0.0
    for part in _LINE_ENDS.split(hold_together(text)):
        width = measure_width(part.replace(WORD_JOINER, "").rstrip(" "))
        if taken and taken + width > room:
            lines, taken = lines + 1, 0.0
        if width > room:
            lines, width = lines + int(width / room), width % room
        taken += width + (measure_width(" ") if part.endswith(" ") else 0.0)
    return lines


def count_margin_lines(text: str) -> int:
    """Return how many lines a text takes at the head or the foot of a page."""
    return _count_lines_of_words(text, _MARGIN_EM, running=1.0)


def _count_lines_in_room(text: str, room: float) -> int:
    return max(1, ceil(measure_width(text) / room))
