"""How groups of facts share two columns of a page."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import accumulate
from math import ceil
from typing import TypeAlias

from zlmreport.certificate.document import Block, Facts, Formulas, Graph, Notice, Paragraph, Table

#: A block, or facts that follow each other.
GatheredBlock: TypeAlias = Table | Formulas | Graph | Paragraph | Notice | tuple[Facts, ...]

#: Characters of a value that stand on one line of a column, and of its name; counted low.
_VALUE_LINE = 26
_NAME_LINE = 20
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


def side_by_side(groups: tuple[Facts, ...]) -> tuple[tuple[Facts, ...], ...]:
    """Part groups of facts into two columns of nearly one height; a single group keeps the page's width."""
    if len(groups) == 1:
        return (groups,)
    *ends, total = accumulate(map(_lines, groups))
    heights = [max(end, total - end) for end in ends]
    first = heights.index(min(heights)) + 1
    return groups[:first], groups[first:]


def _lines(group: Facts) -> int:
    """Estimate the lines that a group takes in a column."""
    return _HEADING_LINES + sum(
        max(
            ceil(len(name) / _NAME_LINE),
            sum(ceil(len(line) / _VALUE_LINE) or 1 for line in value.split("\n")),
        )
        for name, value in group.pairs
    )
