"""Page breaks: how much of the last blocks before a new page stays together, so that no page is near empty.

Otherwise such a page has as little on it as happens to be left over: a small table, or the last rows of one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise, takewhile
from typing import TYPE_CHECKING

from zlmreport.document.blocks import Formulas, Paragraph, Section, Table
from zlmreport.document.certificate import columns

if TYPE_CHECKING:
    from zlmreport.document.certificate.columns import GatheredBlock
    from zlmreport.document.certificate.document import Certificate

#: Parts of a page: that stay together at least, and at most, for what is higher must be parted.
_LEAST, _MOST = 0.28, 0.5


@dataclass(frozen=True, slots=True)
class Ending:
    """How many blocks of a section, facts that follow each other counted as one, stay together at its end.

    Where these are all, its heading stays with them; where it is `joined`, they stay with the end of the
    section before it, too.
    """

    kept: int = 0
    is_joined: bool = False


def find_endings(certificate: Certificate) -> tuple[Ending, ...]:
    """Return the ending of each section."""
    sections, page = certificate.sections, columns.PAGES[certificate.paper]
    if not sections:
        return ()
    found = [Ending()] * len(sections)
    ends = [*(after.new_page for _, after in pairwise(sections)), True]
    for last in (number for number, is_end in enumerate(ends) if is_end):
        taken = 0.0
        for number in range(last, -1, -1):
            section = sections[number]
            blocks = tuple(columns.gather_facts(section.blocks))
            kept, taken = _count_kept(blocks, taken, page, is_compact=certificate.is_compact)
            is_joined = kept == len(blocks) and taken < _LEAST * page and number > 0 and not section.new_page
            found[number] = Ending(kept, is_joined)
            if not is_joined:
                break
            taken += columns.estimate_heading_height(section.title)
    return tuple(found)


def _count_kept(
    blocks: Sequence[GatheredBlock], taken: float, page: float, *, is_compact: bool
) -> tuple[int, float]:
    """Return how many blocks stay together before what is taken of a page, and what then is."""
    kept = 0
    for block in reversed(blocks):
        height = columns.estimate_height(block if isinstance(block, tuple) else (block,))
        is_enough = taken >= _LEAST * page and not (kept and _is_note(blocks[-kept]))
        if is_enough or taken + height > _MOST * page:
            break
        if isinstance(block, Table | Formulas):
            layout = columns.lay_out_table(block, is_compact=is_compact)
            if not layout.is_whole:  # pages may part it
                break
        kept, taken = kept + 1, taken + height
    # Notes of a table for which there is no room stay with it.
    notes = sum(1 for _ in takewhile(_is_note, blocks[len(blocks) - kept :]))
    return kept - notes if notes < kept < len(blocks) else kept, taken


def _is_note(block: GatheredBlock) -> bool:
    return isinstance(block, Paragraph) and block.fine


def is_all_of(section: Section, ending: Ending) -> bool:
    """Return whether a section stays together with its heading."""
    return bool(ending.kept) and ending.kept == sum(1 for _ in columns.gather_facts(section.blocks))
