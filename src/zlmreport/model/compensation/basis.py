"""What a table may take away of the deviations of a test: means or model, with their uncertainty.

From the means alone a table takes what they show, scatter included. With a fitted error model it takes the
effects that position and direction decide, and what the means show beyond the model as far as that exceeds
their own scatter: so it is as smooth as the readings are uncertain. A wave is taken only if the rows of the
table can follow it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.compensation.curve import ErrorCurve, Function
from zlmreport.model.diagnosis.study import BY_TABLE, correct_by_model
from zlmreport.model.effects.design import place_at_positions
from zlmreport.model.fitting.curve import find_waves_along
from zlmreport.model.fitting.fit import Fit
from zlmreport.model.fitting.observations import Observations

#: Rows of a table that a wave needs in each of its periods.
ROWS_A_PERIOD = 4
_ROUNDING = 1e-9


@dataclass(frozen=True, slots=True)
class ReadingScatter:
    """How readings scatter about what the axis does."""

    #: single and run: Standard deviations of a single reading, and of what a run has in common, m or rad.
    single: float
    run: float
    degrees: int  #: Of freedom of `single`.


@dataclass(frozen=True, slots=True)
class DeviationPart:
    """What the readings say of one part of the deviations: what both directions share, or what parts them.

    These are (e↑ ± e↓)/√2 at each target, and scatter alike. What a model does not describe may be large in
    one and nothing in the other: geometry belongs to a position, whichever way it is approached.
    """

    #: (m, p): Orthonormal: what the model can imitate; the readings decide it, scatter included.
    directions: FloatArray
    trust: float  #: How far the means are believed beyond that, from 0 to 1.


@dataclass(frozen=True, slots=True)
class TableBasis:
    """What a table is made from, and what it is held against."""

    curve: ErrorCurve  #: The means of the test.
    known: Function  #: What the axis does anywhere, all its waves included.
    #: (2, m): What another test of this plan would show at the targets without a table, m or rad.
    estimate: FloatArray
    #: What is behind the estimate: what both directions share, and if both were measured what parts them.
    parts: tuple[DeviationPart, ...]
    scatter: ReadingScatter | None  #: Of the readings; None where the test cannot tell.
    #: What a table can take away that leaves out the waves of these names.
    without: Callable[[frozenset[str]], Function]
    #: The periodic effects of the model, each with the length of its shortest wave, m or rad.
    waves: Mapping[str, float] = field(default_factory=dict)
    #: Whether a model says what is between the targets; else lines are drawn from one to the next.
    is_known_between: bool = True

    def list_left_out(self, rows: FloatArray) -> dict[str, float]:
        """Return the waves that a table with these rows cannot carry, by name with their lengths."""
        return find_too_fine(self.waves, rows)

    def make_wanted(self, rows: FloatArray) -> Function:
        """Return what a table with these rows is to take away."""
        return self.without(frozenset(self.list_left_out(rows)))

    @property
    def expanded_uncertainty(self) -> float:
        """Of a mean deviation by the scatter of the readings, k = 2, m or rad; 0 if the test cannot tell."""
        return 2 * self.scatter.single / math.sqrt(self.curve.runs) if self.scatter else 0.0


@dataclass(frozen=True, slots=True)
class FittedModel:
    """A model with the readings that it was fitted to, and those as they were read."""

    measurements: MeasurementSet
    observed: Observations
    fit: Fit

    @property
    def sign(self) -> float:
        """Turns what was read into e = actual − nominal."""
        return -1.0 if self.measurements.is_indication else 1.0

    def make_carried(self, left_out: frozenset[str] = frozenset()) -> Function:
        """Return what effects of position and direction do, but for those that are left out."""
        solution = self.fit.solution
        parts = [
            (term.effect, theta, gamma)
            for term, theta, gamma in zip(
                self.fit.model.terms, solution.thetas, solution.coefficients, strict=True
            )
            if term.effect.shape in BY_TABLE and term.effect.identifier not in left_out
        ]

        def sum_up(positions: FloatArray, approach: Approach) -> FloatArray:
            design = place_at_positions(self.fit.design, positions, approach)
            total = np.zeros(len(positions))
            for effect, theta, gamma in parts:
                total += effect.columns(design, theta) @ gamma
            return self.sign * total

        def sum_up_both(positions: FloatArray) -> FloatArray:
            measured = self.measurements.approaches
            return np.stack(
                [sum_up(positions, each if each in measured else measured[0]) for each in Approach]
            )

        return sum_up_both


def find_waves_of(fit: Fit) -> dict[str, float]:
    """Return the effects of a model that repeat along the axis, each with its shortest wave, m or rad."""
    by_table = {term.effect.identifier for term in fit.model.terms if term.effect.shape in BY_TABLE}
    waves = find_waves_along(fit)
    return {name: wave for name, wave in waves.items() if name in by_table and np.isfinite(wave)}


def find_too_fine(waves: Mapping[str, float], rows: FloatArray) -> dict[str, float]:
    """Return those waves that a table cannot follow with rows at these positions, m or rad."""
    step = float(np.diff(rows).max(initial=0.0)) * (1 - _ROUNDING)
    return {name: wave for name, wave in waves.items() if step * ROWS_A_PERIOD > wave}


def compensate_readings(fitted: FittedModel) -> MeasurementSet:
    """Return the readings as they would be with a table of the model, its rows at the targets.

    What time decides stays in them, and so does a wave that such rows cannot follow.
    """
    measurements, targets = fitted.measurements, fitted.measurements.target_positions
    table = fitted.make_carried(frozenset(find_too_fine(find_waves_of(fitted.fit), targets)))(targets)
    return apply_table(measurements, table)


def apply_table(measurements: MeasurementSet, taken: FloatArray) -> MeasurementSet:
    """Return readings less what a table takes away at the targets, e = actual − nominal, shape (2, m)."""
    row = np.where(measurements.approach == Approach.POSITIVE, 0, 1)
    sign = -1.0 if measurements.is_indication else 1.0
    left = measurements.deviation - sign * taken[row, measurements.target]
    return replace(measurements, deviation=read_only_floats(left))


def make_basis_of_means(
    curve: ErrorCurve, measurements: MeasurementSet, fitted: FittedModel | None = None
) -> TableBasis:
    """Return the means of a test as they are; a model, if there is one, says what is between them."""
    means = np.stack([curve.forward, curve.reverse])
    known = alone = _interpolate(curve.positions, means)
    if fitted is not None:
        model = fitted.make_carried()
        known = _sum(model, _interpolate(curve.positions, means - model(curve.positions)))
    targets = len(curve.positions)
    part = DeviationPart(np.eye(targets), 1.0)
    scatter = _estimate_scatter(measurements.deviations())
    parts = (part,) * (1 + curve.is_bidirectional)
    return TableBasis(
        curve, known, means, parts, scatter, lambda _: alone, is_known_between=fitted is not None
    )


def make_basis_of_model(curve: ErrorCurve, fitted: FittedModel) -> TableBasis:
    """Return what a model says, and beyond it the means as far as they can be believed."""
    measurements = fitted.measurements
    left = correct_by_model(measurements, fitted.observed, fitted.fit).deviations()
    scatter = _estimate_scatter(left) or ReadingScatter(fitted.fit.rms, 0.0, fitted.fit.degrees)
    beyond, imitated = (
        _part_directions(values, is_bidirectional=curve.is_bidirectional)
        for values in (fitted.sign * _fill_in_both(_compute_means(left)), _compute_imitated(fitted))
    )
    own = scatter.single**2 / curve.runs
    parts = tuple(
        _make_part(rest, columns, own)
        for rest, columns in zip(beyond, np.moveaxis(imitated, -2, 0), strict=True)
    )
    explained = _fill_in_both(_compute_means(measurements.deviations())) - _fill_in_both(_compute_means(left))
    rest = join_directions(np.stack([part.trust * each for part, each in zip(parts, beyond, strict=True)]))
    kept = _interpolate(curve.positions, rest)
    return TableBasis(
        curve,
        _sum(fitted.make_carried(), kept),
        fitted.sign * explained + rest,
        parts,
        scatter,
        lambda left_out: _sum(fitted.make_carried(left_out), kept),
        find_waves_of(fitted.fit),
    )


def _interpolate(positions: FloatArray, values: FloatArray) -> Function:
    return lambda at: np.stack([np.interp(at, positions, each) for each in values])


def _sum(one: Function, other: Function) -> Function:
    return lambda at: one(at) + other(at)


def _compute_means(deviations: FloatArray) -> FloatArray:
    """Return the means over runs, NaN where there is no reading, shape (2, m)."""
    count = np.isfinite(deviations).sum(axis=-1)
    total = np.nansum(deviations, axis=-1)
    return np.where(count > 0, total / np.maximum(count, 1), np.nan)


def _fill_in_both(means: FloatArray) -> FloatArray:
    """Return means with those of the other direction where one was not measured."""
    return np.where(np.isfinite(means), means, means[::-1])


def _estimate_scatter(deviations: FloatArray) -> ReadingScatter | None:
    """Return the scatter of readings about their means, what a run has in common told apart."""
    off = deviations - _compute_means(deviations)[..., np.newaxis]
    runs = off.shape[-1]
    if runs < 2:
        return None
    common = np.nanmean(off, axis=(0, 1))
    single = off - common
    degrees = int(np.isfinite(off).sum() - np.isfinite(_compute_means(deviations)).sum() - (runs - 1))
    if degrees < 1:
        return None
    return ReadingScatter(
        float(np.sqrt(np.nansum(single**2) / degrees)),
        float(np.sqrt(np.sum(common**2) / (runs - 1))),
        degrees,
    )


def _part_directions(values: FloatArray, *, is_bidirectional: bool) -> FloatArray:
    """Return values of shape (…, 2, m) as what both directions share and what parts them, (e↑ ± e↓)/√2.

    A test of one direction has the first part only, and that is the values themselves.
    """
    if not is_bidirectional:
        return values[..., :1, :]
    forward, reverse = values[..., 0, :], values[..., 1, :]
    return np.asarray(np.stack([forward + reverse, forward - reverse], axis=-2) / np.sqrt(2))


def join_directions(parts: FloatArray) -> FloatArray:
    """Return parts of shape (…, 1 or 2, m) as values of both directions, shape (…, 2, m)."""
    if parts.shape[-2] == 1:
        return np.repeat(parts, 2, axis=-2)
    return _part_directions(parts, is_bidirectional=True)  # its own inverse


def _make_part(rest: FloatArray, columns: FloatArray, own: float) -> DeviationPart:
    """Return one part of the deviations, and how far its residuals are believed.

    What they vary beyond their own scatter is real: var(r) = τ² + u², and r is worth τ²/(τ² + u²) of itself
    (James and Stein). The model has taken some of their degrees of freedom.
    """
    left, singular, _ = np.linalg.svd(columns.T, full_matrices=False)
    directions = left[:, singular > _ROUNDING * max(singular.max(initial=0.0), 1e-300)]
    total = float(np.sum(rest**2)) / max(1, len(rest) - directions.shape[1])
    return DeviationPart(directions, max(0.0, 1.0 - own / total) if total else 0.0)


def _compute_imitated(fitted: FittedModel) -> FloatArray:
    """Return what each parameter of the model does to the means at the targets, shape (p, 2, m)."""
    measurements = fitted.measurements
    columns = []
    for column in fitted.fit.compute_base(fitted.observed.design).T:
        every = np.full(len(measurements.deviation), np.nan)
        every[fitted.observed.reading] = column
        columns.append(np.nan_to_num(_fill_in_both(_compute_means(measurements.arranged(every)))))
    return np.array(columns).reshape(-1, 2, len(measurements.target_positions))
