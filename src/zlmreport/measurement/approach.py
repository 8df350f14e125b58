"""Direction of approach: positive or negative, with its sign and its arrow."""

from __future__ import annotations

from enum import IntEnum


class Approach(IntEnum):
    """The direction in which a target position is approached.

    The value is the sign of the motion. `index` is the approach's place on the approach axis of every
    array in this program: the positive approach first.
    """

    POSITIVE = 1
    NEGATIVE = -1

    @property
    def index(self) -> int:
        """Place on the approach axis: 0 for the positive, 1 for the negative approach."""
        return 0 if self is Approach.POSITIVE else 1

    @property
    def sign(self) -> str:
        """As jobs and files write it."""
        return "+" if self is Approach.POSITIVE else "-"

    @property
    def arrow(self) -> str:
        """The arrow that the standards print."""
        return "↑" if self is Approach.POSITIVE else "↓"
