"""Which way the axis moves: told from its motion, and not from noise or a damaged reading."""

from __future__ import annotations

from zlmreport.measurement.approach import Approach


class Track:
    """Follows the axis by medians of three readings: one that its neighbours do not confirm is no motion.

    The direction is that of the last motion that went further than a threshold; a smaller one back, such as
    an overshoot, does not turn it.

    Attributes
    ----------
    position
        The median of the last three readings, m or rad; None as long as there are fewer.
    before
        The one before.
    direction
        None as long as no motion has been seen.

    Parameters
    ----------
    motion
        What counts as motion, m or rad.
    """

    def __init__(self, motion: float) -> None:
        self.position: float | None = None
        self.before: float | None = None
        self.direction: Approach | None = None
        self._motion = motion
        self._last: list[float] = []
        self._lowest = self._highest = 0.0

    def forget(self) -> None:
        """Begin anew: what the axis did in the meantime nobody saw."""
        self.position = self.before = self.direction = None
        self._last.clear()

    def add(self, value: float) -> None:
        """Take the next reading in, m or rad."""
        self._last.append(value)
        if len(self._last) < 3:
            return
        del self._last[:-3]
        position = sorted(self._last)[1]
        self.before, self.position = self.position, position
        if self.before is None:
            self._lowest = self._highest = position
        self._lowest = min(self._lowest, position)
        self._highest = max(self._highest, position)
        if self.direction is not Approach.POSITIVE and position > self._lowest + self._motion:
            self.direction = Approach.POSITIVE
        elif self.direction is not Approach.NEGATIVE and position < self._highest - self._motion:
            self.direction = Approach.NEGATIVE
        if self.direction is Approach.POSITIVE:
            self._lowest = self._highest
        elif self.direction is Approach.NEGATIVE:
            self._highest = self._lowest
