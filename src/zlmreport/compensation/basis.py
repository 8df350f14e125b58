"""What is known of an axis from a test, and what of it a table may take away.

From the means alone a table takes what they show, scatter included. With a fitted error model it takes the
effects that position and direction decide, and what the means show beyond the model as far as that exceeds
their own scatter: so it is as smooth as the readings are uncertain. A wave is taken only if the rows of the
table can follow it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from zlmreport.compensation.curve import ErrorCurve
from zlmreport.errors import InputError, Place
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.curve import shortest_wave
from zlmreport.model.design import at_positions
from zlmreport.model.fit import Fit
from zlmreport.model.observations import Observations
from zlmreport.model.study import BY_TABLE, corrected
from zlmreport.quantities.arrays import FloatArray, read_only_floats

#: Rows of a table that a wave needs in each of its periods.
ROWS_A_PERIOD = 4
_ROUNDING = 1e-9
#: m or rad anywhere, shape (2, …): forward, reverse.
Function = Callable[[FloatArray], FloatArray]


class Periodic(StrEnum):
    """What becomes of the periodic effects of a model."""

    FITTING = "fitting"
    IN = "in"
    OUT = "out"


@dataclass(frozen=True, slots=True)
class Scatter:
    """How readings scatter about what the axis does.

    Attributes
    ----------
    single, run
        Standard deviations of a single reading, and of what a run has in common, m or rad.
    degrees
        Of freedom of `single`.
    """

    single: float
    run: float
    degrees: int


@dataclass(frozen=True, slots=True)
class Basis:
    """What a table is made from, and what it is held against.

    Attributes
    ----------
    curve
        The means of the test.
    wanted
        What the table is to take away.
    known
        What the axis does anywhere, waves that are left out included.
    estimate : (2, m) array
        What another test of this plan would show at the targets without a table, m or rad.
    trust
        How far the means are believed beyond the model: 1 for means without one.
    directions : (2·m, p) array
        Orthonormal: along these the model's own uncertainty moves the estimate.
    scatter
        Of the readings; None where the test cannot tell.
    left_out
        Periodic effects that no row carries, each with the length of its shortest wave, m or rad.
    """

    curve: ErrorCurve
    wanted: Function
    known: Function
    estimate: FloatArray
    trust: float
    directions: FloatArray
    scatter: Scatter | None
    left_out: tuple[tuple[str, float], ...] = ()


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

    def carried(self, left_out: frozenset[str] = frozenset()) -> Function:
        """Return what effects of position and direction do, but for those that are left out."""
        solution = self.fit.solution
        parts = [
            (term.effect, theta, gamma)
            for term, theta, gamma in zip(
                self.fit.model.terms, solution.thetas, solution.coefficients, strict=True
            )
            if term.effect.shape in BY_TABLE and term.effect.identifier not in left_out
        ]

        def one(positions: FloatArray, approach: Approach) -> FloatArray:
            design = at_positions(self.fit.design, positions, approach)
            total = np.zeros(len(positions))
            for effect, theta, gamma in parts:
                total += effect.columns(design, theta) @ gamma
            return self.sign * total

        def both(positions: FloatArray) -> FloatArray:
            measured = self.measurements.approaches
            return np.stack([one(positions, each if each in measured else measured[0]) for each in Approach])

        return both


def waves_of(fit: Fit) -> dict[str, float]:
    """Return the effects of a model that repeat along the axis, each with its shortest wave, m or rad."""
    pairs = zip(fit.model.terms, fit.solution.thetas, strict=True)
    found = {
        term.effect.identifier: shortest_wave(term, theta)
        for term, theta in pairs
        if term.effect.shape in BY_TABLE
    }
    return {name: wave for name, wave in found.items() if np.isfinite(wave)}


def waves_too_fine(fit: Fit, rows: FloatArray) -> dict[str, float]:
    """Return those whose waves a table cannot follow with rows at these positions, m or rad."""
    step = float(np.diff(rows).max(initial=0.0)) * (1 - _ROUNDING)
    return {name: wave for name, wave in waves_of(fit).items() if step * ROWS_A_PERIOD > wave}


def compensated(fitted: FittedModel) -> MeasurementSet:
    """Return the readings as they would be with a table of the model, its rows at the targets.

    What time decides stays in them, and so does a wave that such rows cannot follow.
    """
    measurements, targets = fitted.measurements, fitted.measurements.target_positions
    table = fitted.sign * fitted.carried(frozenset(waves_too_fine(fitted.fit, targets)))(targets)
    row = np.where(measurements.approach == Approach.POSITIVE, 0, 1)
    left = measurements.deviation - table[row, measurements.target]
    return replace(measurements, deviation=read_only_floats(left))


def basis_of_means(
    curve: ErrorCurve, measurements: MeasurementSet, fitted: FittedModel | None = None
) -> Basis:
    """Return the means of a test as they are; a model, if there is one, says what is between them."""
    means = np.stack([curve.forward, curve.reverse])
    wanted = _interpolated(curve.positions, means)
    known = wanted
    if fitted is not None:
        model = fitted.carried()
        known = _sum(model, _interpolated(curve.positions, means - model(curve.positions)))
    scatter = _scatter(measurements.deviations())
    return Basis(curve, wanted, known, means, 1.0, np.empty((means.size, 0)), scatter)


def basis_of_model(
    curve: ErrorCurve, fitted: FittedModel, place: Place, rows: FloatArray, periodic: Periodic
) -> Basis:
    """Return what a model says, and beyond it the means as far as they can be believed.

    Parameters
    ----------
    curve, fitted
        The means, and the model.
    place
        Where the table is asked for.
    rows : (g,) array
        Where the table will have its rows, m or rad.
    periodic
        What becomes of periodic effects.

    Raises
    ------
    InputError
        If a wave is wanted that the rows cannot follow.
    """
    measurements = fitted.measurements
    fine = waves_too_fine(fitted.fit, rows)
    if periodic is Periodic.IN and fine:
        unit = measurements.axis.position_unit
        wave = unit.from_si(min(fine.values()))
        raise InputError.at(
            place,
            f"{', '.join(fine)}: a wave of {wave:g} {unit.symbol} needs {ROWS_A_PERIOD} rows in each of its "
            f"periods; state --step {wave / ROWS_A_PERIOD:g} or less, or leave it out",
        )
    out = waves_of(fitted.fit) if periodic is Periodic.OUT else fine
    left = corrected(measurements, fitted.observed, fitted.fit).deviations()
    scatter = _scatter(left) or Scatter(fitted.fit.rms, 0.0, fitted.fit.degrees)
    directions = _directions(fitted)
    trust, rest = _believed(_both(_means(left)), scatter, curve.runs, directions.shape[1])
    explained = _both(_means(measurements.deviations())) - _both(_means(left))
    beyond = _interpolated(curve.positions, fitted.sign * rest)
    return Basis(
        curve,
        _sum(fitted.carried(frozenset(out)), beyond),
        _sum(fitted.carried(), beyond),
        fitted.sign * (explained + rest),
        trust,
        directions,
        scatter,
        tuple(out.items()),
    )


def _interpolated(positions: FloatArray, values: FloatArray) -> Function:
    return lambda at: np.stack([np.interp(at, positions, each) for each in values])


def _sum(one: Function, other: Function) -> Function:
    return lambda at: one(at) + other(at)


def _means(deviations: FloatArray) -> FloatArray:
    """Return the means over runs, NaN where there is no reading, shape (2, m)."""
    count = np.isfinite(deviations).sum(axis=-1)
    total = np.nansum(deviations, axis=-1)
    return np.where(count > 0, total / np.maximum(count, 1), np.nan)


def _both(means: FloatArray) -> FloatArray:
    """Return means with those of the other direction where one was not measured."""
    return np.where(np.isfinite(means), means, means[::-1])


def _scatter(deviations: FloatArray) -> Scatter | None:
    """Return the scatter of readings about their means, what a run has in common told apart."""
    off = deviations - _means(deviations)[..., np.newaxis]
    runs = off.shape[-1]
    if runs < 2:
        return None
    common = np.nanmean(off, axis=(0, 1))
    single = off - common
    degrees = int(np.isfinite(off).sum() - np.isfinite(_means(deviations)).sum() - (runs - 1))
    if degrees < 1:
        return None
    return Scatter(
        float(np.sqrt(np.nansum(single**2) / degrees)),
        float(np.sqrt(np.sum(common**2) / (runs - 1))),
        degrees,
    )


def _believed(means: FloatArray, scatter: Scatter, runs: int, taken: int) -> tuple[float, FloatArray]:
    """Return how far means of residuals are believed, 0 to 1, and what is then left of them.

    What the means vary beyond their own scatter is real: var(r) = τ² + u², and r is worth τ²/(τ² + u²) of
    itself (James and Stein). The model has taken some of their degrees of freedom.
    """
    own = scatter.single**2 / runs
    total = float(np.sum(means**2)) / max(1, means.size - taken)
    trust = max(0.0, 1.0 - own / total) if total else 0.0
    return trust, trust * means


def _directions(fitted: FittedModel) -> FloatArray:
    """Return an orthonormal basis of what the model can imitate at the targets, shape (2·m, p)."""
    measurements = fitted.measurements
    columns = []
    for column in fitted.fit.base(fitted.observed.design).T:
        every = np.full(len(measurements.deviation), np.nan)
        every[fitted.observed.reading] = column
        columns.append(_both(_means(measurements.arranged(every))).ravel())
    if not columns:
        return np.empty((2 * len(measurements.target_positions), 0))
    left, singular, _ = np.linalg.svd(np.nan_to_num(np.array(columns)).T, full_matrices=False)
    return np.asarray(left[:, singular > _ROUNDING * singular.max()])
