"""What is left after a table: that very table, decoded as the control reads it, taken from what is known."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from zlmreport.compensation.basis import Basis
from zlmreport.compensation.curve import CompensationTable, ErrorCurve
from zlmreport.evaluation.statistics import position_statistics
from zlmreport.quantities.arrays import FloatArray, read_only_floats

#: Places between two rows at which the table is looked at.
_BETWEEN = 16
#: Second tests that are drawn, and the quantiles between which 95 % of them lie.
_DRAWS, _SEED = 2000, 230
_LOW, _HIGH = 0.025, 0.975


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
class Expected:
    """What a second test of the same plan will show of a figure, m or rad: 95 % lie from low to high."""

    value: float
    low: float
    high: float

    def in_unit(self, factor: float) -> dict[str, float]:
        """Return it times a factor."""
        return {"value": self.value * factor, "low": self.low * factor, "high": self.high * factor}


@dataclass(frozen=True, slots=True)
class Forecast:
    """What a table is expected to leave.

    Attributes
    ----------
    before, after
        Of the means as they are, and with the table taken away.
    second_test
        By symbol, what a second test will show: what the table leaves, the uncertainty of the first test,
        and the scatter of both. Empty where the first cannot tell its scatter.
    left : (2, m) array
        The mean deviations after, by direction and target, m or rad.
    between, between_at
        Largest deviation that is left anywhere between the rows, and where it is, m or rad.
    left_out
        Largest deviation of the waves that no row carries, m or rad.
    rounding
        Largest difference between the table as it is written and as it was meant, m or rad.
    constant
        By how much the control's table is meant to be off all over: some begin at zero, m or rad.
    play
        The mean lost motion that a table without directions leaves to another parameter, m or rad.
    """

    before: Figures
    after: Figures
    second_test: dict[str, Expected]
    left: FloatArray
    between: float
    between_at: float
    left_out: float
    rounding: float
    constant: float
    play: float


def forecast(
    basis: Basis, meant: CompensationTable, decoded: CompensationTable, active: CompensationTable | None
) -> Forecast:
    """Return the forecast of a table.

    Parameters
    ----------
    basis
        What is known of the axis.
    meant, decoded
        The table, and what the control makes of its files.
    active
        What was active during the test and is replaced; None for nothing.
    """
    curve = basis.curve
    means = np.stack([curve.forward, curve.reverse])
    change = decoded.at(curve.positions) - (active.at(curve.positions) if active else 0.0)
    fine = _fine(meant.positions, curve.positions)
    known, gone = basis.known(fine), active.at(fine) if active else 0.0
    worst_at = np.abs(known + gone - decoded.at(fine)).max(axis=0)
    worst = int(np.argmax(worst_at))
    is_directional = bool(np.any(decoded.forward != decoded.reverse))
    rows = meant.at(meant.positions)
    target = rows if is_directional else rows.mean(axis=0)
    off = decoded.at(meant.positions) - target
    constant = float(off.mean())
    return Forecast(
        figures(means, curve),
        figures(means - change, curve),
        _second_test(basis, basis.estimate - change) if basis.scatter else {},
        read_only_floats(means - change),
        float(worst_at[worst]),
        float(fine[worst]),
        float(np.abs(known - basis.wanted(fine)).max()) if basis.left_out else 0.0,
        float(np.abs(off - constant).max()),
        constant,
        0.0 if is_directional else float(np.mean(rows[0] - rows[1])),
    )


def _fine(rows: FloatArray, targets: FloatArray) -> FloatArray:
    """Return places between the rows, within what was measured."""
    stretches = [np.linspace(a, b, _BETWEEN) for a, b in pairwise(rows.tolist())]
    fine: FloatArray = np.unique(np.concatenate(stretches))
    inside: FloatArray = fine[(fine >= targets[0]) & (fine <= targets[-1])]
    return inside


def _second_test(basis: Basis, left: FloatArray) -> dict[str, Expected]:
    """Draw second tests of the same plan, and return what they show.

    Each has the axis as one of those that the first test may have seen, and scatter of its own.
    """
    scatter, curve = basis.scatter, basis.curve
    assert scatter is not None  # noqa: S101  # its caller asked
    random = np.random.default_rng(_SEED)
    single = _deviation(scatter.single, scatter.degrees, random)
    own = single / np.sqrt(curve.runs)
    model = random.standard_normal((_DRAWS, basis.directions.shape[1])) @ basis.directions.T
    beyond = np.sqrt(basis.trust) * random.standard_normal((_DRAWS, left.size))
    axes = left + (own * (model + beyond)).reshape(_DRAWS, *left.shape)
    shown = axes if curve.is_bidirectional else axes[:, :1]
    common = _deviation(scatter.run, curve.runs - 1, random)[..., np.newaxis, np.newaxis]
    common = common * random.standard_normal((_DRAWS, 1, 1, curve.runs))
    noise = random.standard_normal((*shown.shape, curve.runs)) * single[..., np.newaxis, np.newaxis]
    tests = shown[..., np.newaxis] + common + noise
    drawn = drawn_figures(tests)
    return {
        symbol: Expected(float(values.mean()), *map(float, np.quantile(values, [_LOW, _HIGH])))
        for symbol, values in drawn.items()
    }


def _deviation(estimate: float, degrees: int, random: np.random.Generator) -> FloatArray:
    """Draw standard deviations, shape (N, 1), from which an estimate of so many degrees of freedom comes."""
    drawn = random.chisquare(max(1, degrees), (_DRAWS, 1))
    return np.asarray(estimate * np.sqrt(max(1, degrees) / drawn))


def drawn_figures(tests: FloatArray) -> dict[str, FloatArray]:
    """Return E, M, B and A of a stack of tests, shape (N, directions, targets, runs), m or rad."""
    statistics = position_statistics(tests)
    means, spread = statistics.mean, statistics.standard_deviation
    places = (-2, -1)
    found = {
        "E": means.max(axis=places) - means.min(axis=places),
        "M": np.ptp(means.mean(axis=-2), axis=-1),
    }
    if means.shape[-2] == 2:
        found["B"] = np.abs(means[..., 0, :] - means[..., 1, :]).max(axis=-1)
    if tests.shape[-1] > 1:
        found["A"] = (means + 2 * spread).max(axis=places) - (means - 2 * spread).min(axis=places)
    return found


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
