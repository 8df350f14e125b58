"""Shares with their intervals."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

#: Two-sided 95 % of the normal distribution.
_Z = 1.959964


@dataclass(frozen=True, slots=True)
class Share:
    """How many of how many.

    Attributes
    ----------
    count, total
        The numbers.
    """

    count: int
    total: int

    @classmethod
    def of(cls, judgements: Iterable[bool]) -> Share:
        """Count the true ones."""
        listed = [bool(each) for each in judgements]
        return cls(sum(listed), len(listed))

    @property
    def value(self) -> float:
        """The share, 0 to 1; NaN of none."""
        return self.count / self.total if self.total else math.nan

    @property
    def interval(self) -> tuple[float, float]:
        """The 95 % interval of E. B. Wilson, J. American Statistical Association 22 (1927) 209."""
        if not self.total:
            return 0.0, 1.0
        squared = _Z**2 / self.total
        middle = (self.value + squared / 2) / (1 + squared)
        spread = math.sqrt(self.value * (1 - self.value) / self.total + squared / (4 * self.total))
        half = _Z / (1 + squared) * spread
        return max(0.0, middle - half), min(1.0, middle + half)

    def __str__(self) -> str:
        """Write it in per cent with its interval: ``93.1 (91.0-94.8)``; a dash for none."""
        if not self.total:
            return "–"
        low, high = self.interval
        return f"{100 * self.value:.1f} ({100 * low:.1f}–{100 * high:.1f})"

    @property
    def short(self) -> str:
        """The share in whole per cent; a dash for none."""
        return f"{100 * self.value:.0f}" if self.total else "–"
