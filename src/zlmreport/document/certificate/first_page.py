"""The first page of a compact document: which conditions find room there, and which stand behind.

Who and what, the results in brief, the decision rule and the statements stand together, whatever a job
states. What is long stands behind, and the page says where: first conditions of the measurement, group by
group, then what U means. Where even that leaves too little room, it is the results that go on on the next
page.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from zlmreport.document.blocks import Block, Facts
from zlmreport.document.certificate import columns, conditions, cover
from zlmreport.document.certificate.cover import Behind

if TYPE_CHECKING:
    from zlmreport.document.certificate.material import Material
    from zlmreport.document.certificate.results import Evaluated

#: Groups of conditions by their job keys, in the order in which they leave the page; an extension's has none.
_LEAST_LOOKED_FOR = ("", "environment", "instrument", "measurement", "axis", "circle", "machine")


def lay_out_first_page(
    of: Material, pages: Sequence[tuple[Evaluated, ...]], room: float
) -> tuple[tuple[Block, ...], tuple[Facts, ...]]:
    """Return the blocks under the title, and the groups of conditions that stand behind.

    `pages`: Evaluations that share their results in brief. `room`: What the page has below its title, points.
    """
    groups = list(
        conditions.list_groups_beside_identification(of.job, of.measurements, of.described, of.writer)
    )
    for behind in _list_ways(of, [key for key, _ in groups]):
        blocks = cover.lay_out_cover(of, pages, behind)
        if columns.estimate_height(blocks) <= room:
            break
    left = [group for key, group in groups if key in behind.conditions]
    return blocks, tuple(left)


def _list_ways(of: Material, groups: Collection[str]) -> Iterator[Behind]:
    """Yield what stands behind, from nothing to all that can; a section that a job leaves out takes none.

    `groups`: The job keys of the conditions that the first page has where there is room.
    """
    wanted = of.job.keys.certificate.sections
    behind = Behind()
    yield behind
    if wanted is None or "conditions" in wanted:
        for key in _LEAST_LOOKED_FOR:
            if key in groups:
                behind = replace(behind, conditions=behind.conditions | {key})
                yield behind
    if wanted is None or "uncertainty" in wanted:
        behind = replace(behind, explains_uncertainty=True)
        yield behind
    yield replace(behind, results=True)
