"""The visits of a plan, numbered for good: what the readings are held against."""

from __future__ import annotations

from dataclasses import dataclass

from zlmreport.measurement.approach import Approach
from zlmreport.planning.methods import Method, path, visits
from zlmreport.planning.plan import Plan

#: Methods that go over the whole axis in each run: there a run with a datum of its own adds scatter only.
_RUN_BY_RUN = frozenset({Method.LINEAR, Method.UNIDIRECTIONAL})


@dataclass(frozen=True, slots=True)
class ListedVisit:
    """A reading that is to be taken.

    Attributes
    ----------
    number
        In the order of the test, from 1.
    target
        Number of the target, from 1.
    position
        Of the target, m or rad.
    approach
        The direction in which the axis must come there.
    run
        Number of the run, from 1.
    part
        The part of the test that shares one datum, from 1: the run; the whole test for methods that read a
        target in all runs before the next, where a new datum would be a step along the axis.
    travelled
        The way of the axis since the visit before, m or rad.
    """

    number: int
    target: int
    position: float
    approach: Approach
    run: int
    part: int
    travelled: float


def visit_list(plan: Plan) -> tuple[ListedVisit, ...]:
    """Return the visits of a plan in their order."""
    stops = path(plan.method, plan.targets.tolist(), plan.runs, plan.overrun)
    return tuple(
        ListedVisit(
            number=number,
            target=visit.target + 1,
            position=float(plan.targets[visit.target]),
            approach=visit.approach,
            run=visit.run,
            part=visit.run if plan.method in _RUN_BY_RUN else 1,
            travelled=visit.travelled,
        )
        for number, visit in enumerate(visits(stops), start=1)
    )


def start_of(plan: Plan) -> float:
    """Return where the axis stands before the test: the start of the path, m or rad."""
    return path(plan.method, plan.targets.tolist(), plan.runs, plan.overrun)[0].position
