"""What is left after a table: that very table, decoded as the control reads it, taken from the means."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.compensation.curve import CompensationTable, ErrorCurve
from zlmreport.quantities.arrays import FloatArray

#: Places between two rows at which the table is looked at.
_BETWEEN = 16


@dataclass(frozen=True, slots=True)
class Figures:
    """E, M, B and A of ISO 230-2 by their formulas, m or rad; None where the test does not define them."""

    systematic: float
    mean_range: float
    reversal: float | None
    accuracy: float | None

    def in_unit(self, factor: float) -> dict[str, float]:
        """Return them by their symbols, times a factor."""
        values = {"E": self.systematic, "M": self.mean_range, "B": self.reversal, "A": self.accuracy}
        return {symbol: value * factor for symbol, value in values.items() if value is not None}


@dataclass(frozen=True, slots=True)
class Forecast:
    """What a table is expected to leave.

    Attributes
    ----------
    before, after
        Of the means as they are, and with the table taken away.
    left : (2, m) array
        The mean deviations after, by direction and target, m or rad.
    between, between_at
        Largest deviation between the rows of the table and the straight lines between the measured means, and
        where it is, m or rad.
    rounding
        Largest difference between the table as it is written and as it was meant, m or rad.
    """

    before: Figures
    after: Figures
    left: FloatArray
    between: float
    between_at: float
    rounding: float


def forecast(
    curve: ErrorCurve, meant: CompensationTable, decoded: CompensationTable, active: CompensationTable | None
) -> Forecast:
    """Return the forecast of a table.

    Parameters
    ----------
    curve
        The means of the test.
    meant, decoded
        The table, and what the control makes of its files.
    active
        What was active during the test and is replaced; None for nothing.
    """
    means = np.stack([curve.forward, curve.reverse])

    def left_at(positions: FloatArray) -> FloatArray:
        measured = np.stack([np.interp(positions, curve.positions, each) for each in means])
        gone = active.at(positions) if active else 0.0
        return measured + gone - decoded.at(positions)

    left = left_at(curve.positions)
    fine = np.unique(
        np.concatenate(
            [np.linspace(a, b, _BETWEEN) for a, b in zip(meant.positions, meant.positions[1:], strict=False)]
        )
    )
    inside = fine[(fine >= curve.positions[0]) & (fine <= curve.positions[-1])]
    between = np.abs(left_at(inside)).max(axis=0)
    worst = int(np.argmax(between))
    return Forecast(
        figures(means, curve),
        figures(left, curve),
        left,
        float(between[worst]),
        float(inside[worst]),
        float(np.abs(decoded.at(meant.positions) - meant.at(meant.positions)).max()),
    )


def figures(means: FloatArray, curve: ErrorCurve) -> Figures:
    """Return E, M, B and A of means of shape (2, m) with the spread of a curve."""
    spread = curve.spread if curve.is_bidirectional else np.nanmax(curve.spread, axis=0)[np.newaxis]
    shown = means if curve.is_bidirectional else means[:1]
    has_spread = bool(np.isfinite(spread).all())
    return Figures(
        float(shown.max() - shown.min()),
        float(np.ptp(shown.mean(axis=0))),
        float(np.abs(means[0] - means[1]).max()) if curve.is_bidirectional else None,
        float((shown + 2 * spread).max() - (shown - 2 * spread).min()) if has_spread else None,
    )
