"""What is left after a table: that very table, decoded as the control reads it, taken from what is known."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from zlmreport.evaluation.statistics import position_statistics
from zlmreport.evaluation.uncertainty.budget import Acts, Budget, compute_effect_along
from zlmreport.evaluation.uncertainty.sampling import sample_singly
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.model.compensation.basis import TableBasis, join_directions
from zlmreport.model.compensation.curve import CompensationTable, ErrorCurve, halve_play, wrap

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
class ExpectedFigure:
    """What a second test of the same plan will show of a figure, m or rad: 95 % lie from low to high."""

    value: float
    low: float
    high: float

    def in_unit(self, factor: float) -> dict[str, float]:
        """Return it times a factor."""
        return {"value": self.value * factor, "low": self.low * factor, "high": self.high * factor}


@dataclass(frozen=True, slots=True)
class TableForecast:
    """What a table is expected to leave."""

    #: before and after: Of the means as they are, and with the table taken away.
    before: Figures
    after: Figures
    #: By symbol, what a second test will show: what the table leaves, the uncertainty of the first test, and
    #: the scatter of both. Empty where the first cannot tell its scatter.
    second_test: dict[str, ExpectedFigure]
    left: FloatArray  #: (2, m): The mean deviations after, by direction and target, m or rad.
    #: between and between_at: Largest deviation that is left anywhere between the rows, beside the constant,
    #: and where it is, m or rad.
    between: float
    between_at: float
    left_out: float  #: Largest deviation of the waves that no row carries, m or rad.
    rounding: float  #: Largest difference between the table as it is written and as it was meant, m or rad.
    #: By how much the control's table is meant to be off all over: some begin at zero, m or rad.
    constant: float
    has_set_up: bool  #: Whether the second test has errors of a set-up: where the job gives a budget.
    #: The mean lost motion that a table without directions leaves to the backlash parameter, m or rad.
    play: float
    #: `after` and `second_test` where that parameter takes it.
    after_with_backlash: Figures
    second_test_with_backlash: dict[str, ExpectedFigure]

    def choose_second_test(self, *, has_backlash: bool) -> dict[str, ExpectedFigure]:
        """Return what a second test will show with the control's backlash parameter, or without it."""
        return self.second_test_with_backlash if has_backlash else self.second_test


def forecast(
    basis: TableBasis,
    meant: CompensationTable,
    decoded: CompensationTable,
    active: CompensationTable | None,
    budget: Budget | None = None,
) -> TableForecast:
    """Return the forecast of a table.

    `budget`: Of the set-up with which both tests are done; None where nothing is known of it.
    """
    curve = basis.curve
    means = np.stack([curve.forward, curve.reverse])
    change = decoded.at(curve.positions) - (active.at(curve.positions) if active else 0.0)
    is_directional = bool(np.any(decoded.forward != decoded.reverse))
    rows = meant.at(meant.positions)
    target = rows if is_directional else rows.mean(axis=0)
    off = decoded.at(meant.positions) - target
    constant = float(off.mean())
    play = 0.0 if is_directional else float(np.mean(rows[0] - rows[1]))
    fine = _lay_fine_places(meant, curve.positions)
    known, gone = basis.known(fine), active.at(fine) if active else 0.0
    worst_at = np.abs(known + gone - decoded.at(fine) + constant).max(axis=0)
    worst = int(np.argmax(worst_at))
    after, second_test = _foretell(basis, change, budget)
    with_backlash = _foretell(basis, change + halve_play(play), budget) if play else (after, second_test)
    return TableForecast(
        compute_figures(means, curve),
        after,
        second_test,
        read_only_floats(means - change),
        float(worst_at[worst]),
        float(fine[worst]),
        float(np.abs(known - basis.make_wanted(meant.positions)(fine)).max())
        if basis.list_left_out(meant.positions)
        else 0.0,
        float(np.abs(off - constant).max()),
        constant,
        budget is not None,
        play,
        *with_backlash,
    )


def _foretell(
    basis: TableBasis, change: FloatArray, budget: Budget | None
) -> tuple[Figures, dict[str, ExpectedFigure]]:
    """Return what is left of the means, and what a second test will show, where so much more is taken away.

    `change`, (2, m): m or rad.
    """
    curve = basis.curve
    shown = _simulate_second_tests(basis, basis.estimate - change, budget) if basis.scatter else {}
    return compute_figures(np.stack([curve.forward, curve.reverse]) - change, curve), shown


def _lay_fine_places(table: CompensationTable, targets: FloatArray) -> FloatArray:
    """Return places between the rows, within what was measured."""
    stretches = [np.linspace(a, b, _BETWEEN) for a, b in pairwise(table.positions.tolist())]
    fine: FloatArray = np.unique(np.concatenate(stretches))
    if table.is_closed:
        fine = np.unique(wrap(fine, float(targets[0])))
    inside: FloatArray = fine[(fine >= targets[0]) & (fine <= targets[-1])]
    return inside


def _simulate_second_tests(
    basis: TableBasis, left: FloatArray, budget: Budget | None
) -> dict[str, ExpectedFigure]:
    """Draw second tests of the same plan, and return what they show.

    Each has the axis as one of those that the first test may have seen, and scatter of its own. Both tests
    have the errors of a set-up, each its own.
    """
    scatter, curve = basis.scatter, basis.curve
    assert scatter is not None  # noqa: S101  # its caller asked
    generator = np.random.default_rng(_SEED)
    single = _sample_deviation(scatter.single, scatter.degrees, generator)
    axes = left + _sample_unknown(basis, single / np.sqrt(curve.runs), generator)
    if budget is not None:
        axes += _sample_set_up(budget, curve, generator) - _sample_set_up(budget, curve, generator)
    shown = axes if curve.is_bidirectional else axes[:, :1]
    common = _sample_deviation(scatter.run, curve.runs - 1, generator)[..., np.newaxis, np.newaxis]
    common = common * generator.standard_normal((_DRAWS, 1, 1, curve.runs))
    noise = generator.standard_normal((*shown.shape, curve.runs)) * single[..., np.newaxis, np.newaxis]
    tests = shown[..., np.newaxis] + common + noise
    drawn = _compute_drawn_figures(tests)
    return {
        symbol: ExpectedFigure(float(values.mean()), *map(float, np.quantile(values, [_LOW, _HIGH])))
        for symbol, values in drawn.items()
    }


def _sample_unknown(basis: TableBasis, own: FloatArray, generator: np.random.Generator) -> FloatArray:
    """Draw by how much the axis differs from the estimate, shape (N, 2, m), m or rad.

    With means of variance u² the posterior of each part is that of universal kriging: along the model's
    directions the axis is as uncertain as the means, N(0, u²); across them N(0, t·u²) about t times what the
    means show there, t being the trust of the part. Nothing is drawn twice: what lies along the model's
    directions cannot be told from the model.

    `own`, (N, 1): u, m or rad.
    """
    drawn = []
    for part in basis.parts:
        unit = own * generator.standard_normal((_DRAWS, len(part.directions)))
        along = unit @ part.directions @ part.directions.T
        drawn.append(along + np.sqrt(part.trust) * (unit - along))
    return join_directions(np.stack(drawn, axis=-2))


def _sample_set_up(budget: Budget, curve: ErrorCurve, generator: np.random.Generator) -> FloatArray:
    """Draw the errors of a set-up in the mean deviations, shape (N, 2, m), m or rad.

    What differs from reading to reading or drifts is left out: it is in the scatter of the readings.
    """

    def sample(acts: Acts, *shape: int) -> FloatArray:
        return sample_singly(budget.acting(acts), (_DRAWS, *shape), generator)

    targets = len(curve.positions)
    errors = sample(Acts.ALONG_THE_LENGTH, 1, 1) * compute_effect_along(curve.positions)
    errors = errors + sample(Acts.AT_EACH_POSITION, 1, targets) + sample(Acts.AT_EACH_APPROACH, 2, targets)
    errors[:, 1:] += sample(Acts.BETWEEN_DIRECTIONS, 1, 1)
    return errors


def _sample_deviation(estimate: float, degrees: int, generator: np.random.Generator) -> FloatArray:
    """Draw standard deviations, shape (N, 1), from which an estimate of so many degrees of freedom comes."""
    drawn = generator.chisquare(max(1, degrees), (_DRAWS, 1))
    return np.asarray(estimate * np.sqrt(max(1, degrees) / drawn))


def _compute_drawn_figures(tests: FloatArray) -> dict[str, FloatArray]:
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


def compute_figures(means: FloatArray, curve: ErrorCurve) -> Figures:
    """Return E, M, B and A of means of shape (2, m) with the spread of a curve."""
    spread = curve.spread if curve.is_bidirectional else np.fmax(*curve.spread)[np.newaxis]
    shown = means if curve.is_bidirectional else means[:1]
    has_spread = bool(np.isfinite(spread).all())
    return Figures(
        float(shown.max() - shown.min()),
        float(np.ptp(shown.mean(axis=0))),
        float(np.abs(means[0] - means[1]).max()) if curve.is_bidirectional else None,
        float((shown + 2 * spread).max() - (shown - 2 * spread).min()) if has_spread else None,
    )
