"""How far apart readings are in time, those that did not come among them."""

from __future__ import annotations

#: From so many gaps it is told how far apart the readings of an instrument are.
_GAPS = 10


class Pace:
    """Measures gaps between readings.

    A reading is stamped when it arrives. Where a computer was busy, what had been waiting arrives at once,
    and what had no room was dropped; so readings that are missing count for the time that they should have
    taken.

    Attributes
    ----------
    shortest
        How far apart the first readings were at least, s; 0 before it is known.
    """

    def __init__(self) -> None:
        self.shortest = 0.0
        self._first: list[float] = []
        self._elapsed = 0.0
        self._count = 0

    def gap(self, before: float, now: float, lost: int) -> float:
        """Return how long no reading came, s.

        Parameters
        ----------
        before, now
            When the last reading arrived, and this one, s.
        lost
            How many between them did not arrive or were not understood.
        """
        elapsed = now - before
        expected = (lost + 1) * self._elapsed / self._count if self._count and lost else 0.0
        self._elapsed += elapsed
        self._count += lost + 1
        if len(self._first) < _GAPS:
            self._first.append(elapsed)
            self.shortest = min(self._first) if len(self._first) == _GAPS else 0.0
        return max(elapsed, expected)
