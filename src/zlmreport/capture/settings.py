"""When a reading is taken: the limits that a stop at a target must keep."""

from __future__ import annotations

from dataclasses import dataclass

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
    """The limits that a stop at a target must keep.

    Attributes
    ----------
    tolerance
        How far from a target a reading may be, m or rad.
    stability
        The range, largest − smallest reading, within which the axis stands still, m or rad.
    dwell
        How long it must stand still, s; the reading that is taken is the mean over the later half of it.
    turn
        The shortest time in which the axis can go over a target, turn round at the overrun and come back, s:
        readings that are further apart may have missed it.
    stay
        How long the axis rests at a target, s: in a shorter silence no visit can have gone unseen.
    feed
        Of the program, m/s or rad/s; 0 if it is not known.
    """

    tolerance: float
    stability: float
    dwell: float
    turn: float
    stay: float
    feed: float = 0.0

    @property
    def motion(self) -> float:
        """What counts as motion of the axis, m or rad."""
        return _MOTION * self.stability

    @property
    def largest_gap(self) -> float:
        """How far apart readings may be that count as without a gap, s."""
        return min(_LARGEST_GAP * self.dwell, self.turn)
