"""The visits of a plan in order; settings of a stop: standstill, motion, gaps."""

from __future__ import annotations

from dataclasses import dataclass

from zlmreport.measurement.approach import Approach
from zlmreport.model.planning.methods import RUN_BY_RUN
from zlmreport.model.planning.plan import AxisPlan


@dataclass(frozen=True, slots=True)
class ListedVisit:
    """A reading that is to be taken."""

    number: int  #: In the order of the test, from 1.
    target: int  #: Number of the target, from 1.
    position: float  #: Of the target, m or rad.
    approach: Approach  #: The direction in which the axis must come there.
    run: int  #: Number of the run, from 1.
    #: The part of the test that shares one datum, from 1: the run; the whole test for methods that read a
    #: target in all runs before the next, where a new datum would be a step along the axis.
    part: int
    travelled: float  #: The way of the axis since the visit before, m or rad.


def number_visits(plan: AxisPlan) -> tuple[ListedVisit, ...]:
    """Return the visits of a plan in their order, numbered from 1."""
    return tuple(
        ListedVisit(
            number=number,
            target=visit.target + 1,
            position=float(plan.targets[visit.target]),
            approach=visit.approach,
            run=visit.run,
            part=visit.run if plan.method in RUN_BY_RUN else 1,
            travelled=visit.travelled,
        )
        for number, visit in enumerate(plan.visits, start=1)
    )


#: What an operator may make of the feed, by the override of the control.
FASTEST = 1.5
#: After a reading the axis must move by so many times the stability range before the next one is taken; by
#: less, no motion is told from noise, and no datum from another.
_MOTION = 10
#: In a window no two neighbouring readings are further apart than this share of it: so it has four at least.
_LARGEST_GAP = 1 / 3
#: The largest tolerance as a share of the smallest interval between targets, and of the overrun: beyond it
#: a stop would belong to two targets, or the place where the axis turns round to one.
SHARE_OF_INTERVAL, SHARE_OF_OVERRUN = 0.4, 1 / 3


@dataclass(frozen=True, slots=True)
class Settings:
    """The limits that a stop at a target must keep."""

    tolerance: float  #: How far from a target a reading may be, m or rad.
    stability: float  #: The range, largest − smallest reading, within which the axis stands still, m or rad.
    #: How long the readings take that make a reading, s: it is their mean over the later half.
    dwell: float
    #: The shortest time in which the axis can go over a target, turn round at the overrun and come back, s:
    #: readings that are further apart may have missed it.
    turn: float
    #: How long the axis rests at a target, s: in a shorter silence no visit can have gone unseen.
    stay: float
    feed: float = 0.0  #: Of the program, m/s or rad/s; 0 if it is not known.
    settle: float = 0.0  #: How long a standstill lasts at least, s; 0 where that is the dwell.

    @property
    def still(self) -> float:
        """How long a standstill lasts at least, s."""
        return self.settle or self.dwell

    @property
    def averaged(self) -> float:
        """Over how long the readings of a standstill are averaged, at its end, s."""
        return min(self.dwell, self.still) / 2

    @property
    def motion(self) -> float:
        """What counts as motion of the axis, m or rad."""
        return _MOTION * self.stability

    @property
    def largest_gap(self) -> float:
        """How far apart readings may always be, s: they show a standstill, and one at least the axis turn."""
        return min(self.largest_pause, self.beyond)

    @property
    def largest_pause(self) -> float:
        """How far apart two neighbouring readings of a standstill may be, s."""
        return _LARGEST_GAP * min(self.dwell, self.still)

    @property
    def overrun(self) -> float:
        """How far beyond a target the axis turns round, m or rad; 0 if its feed is not known."""
        return FASTEST * self.feed * self.turn / 2

    @property
    def beyond(self) -> float:
        """How long the axis is beyond the tolerance where it turns round, at least, s.

        Inside it the axis is still at its target.
        """
        inside = 2 * self.tolerance / (FASTEST * self.feed) if self.feed else SHARE_OF_OVERRUN * self.turn
        return self.turn - inside
