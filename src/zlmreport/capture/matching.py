"""Which visit of the list a standstill is."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from zlmreport.capture.visit_list import ListedVisit
from zlmreport.measurement.approach import Approach


def matching(
    visits: Sequence[ListedVisit], taken: int, passed: int, target: int, approach: Approach
) -> int | None:
    """Return the index of the visit that a standstill is; None if it is none that may be next.

    The visit that is neither taken nor passed comes first, then those that the axis passed without standing
    still, for it may have come back, and at last the one after. That is not taken for granted where the axis
    may as well have come back to the visit that was read last; and no visit further on is: who skips two has
    left the program. Before the first reading the list is taken in its order, for what the axis passes then
    is the way to its start.

    Parameters
    ----------
    visits
        The list.
    taken
        How many are taken or missed for good.
    passed
        How many of those that follow the axis has passed.
    target
        Number of the target at which the axis stands.
    approach
        How it came there.
    """
    ahead = taken + passed
    order: Iterable[int] = (ahead, *range(taken, ahead), ahead + 1) if taken else range(ahead + 2)
    for index in order:
        if index < len(visits) and _is(visits[index], target, approach):
            may_be_the_last = 0 < taken < index and not passed and _is(visits[taken - 1], target, approach)
            return None if may_be_the_last else index
    return None


def _is(visit: ListedVisit, target: int, approach: Approach) -> bool:
    return (visit.target, visit.approach) == (target, approach)
