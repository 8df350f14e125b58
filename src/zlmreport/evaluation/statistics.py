"""Means, standard deviations and reversal values by position: where every standard begins.

A position at which a value is not defined (NaN) takes no part; where no position has one, the result is
NaN. Batch dimensions lead.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import BoolArray, FloatArray, IntArray
from zlmreport.measurement.measurement_set import MeasurementSet


@dataclass(frozen=True, slots=True)
class PositionStatistics:
    """The statistics of one test, or of a stack of tests at once.

    Batch dimensions lead: ``...`` is () for one test and (100000,) for a stack of simulated ones. The
    approach axis is `Approach.index`; what cannot be had (no reading; one reading for a standard
    deviation) is NaN.

    Attributes
    ----------
    deviations : (..., approach, position, run) array
        x_ij, m or rad; NaN where missing.
    count : (..., approach, position) integer array
        n, the readings there are.
    mean : (..., approach, position) array
        x̄_i↑ and x̄_i↓.
    standard_deviation : (..., approach, position) array
        s_i↑ and s_i↓ with n − 1.
    positions : (position,) array
        P_i, m or rad (s in time), alike in all tests of a stack; NaN where nobody stated them.
    tests
        Of several measured lines that are evaluated together: the statistics of each, by its name. The
        arrays above then have no position.
    """

    deviations: FloatArray
    count: IntArray
    mean: FloatArray
    standard_deviation: FloatArray
    positions: FloatArray
    tests: Mapping[str, PositionStatistics] = field(default_factory=dict)

    @property
    def mean_positive(self) -> FloatArray:
        """x̄_i↑, shape (..., position)."""
        return self.mean[..., Approach.POSITIVE.index, :]

    @property
    def mean_negative(self) -> FloatArray:
        """x̄_i↓, shape (..., position)."""
        return self.mean[..., Approach.NEGATIVE.index, :]

    @property
    def s_positive(self) -> FloatArray:
        """s_i↑, shape (..., position)."""
        return self.standard_deviation[..., Approach.POSITIVE.index, :]

    @property
    def s_negative(self) -> FloatArray:
        """s_i↓, shape (..., position)."""
        return self.standard_deviation[..., Approach.NEGATIVE.index, :]

    @property
    def mean_bidirectional(self) -> FloatArray:
        """x̄_i = (x̄_i↑ + x̄_i↓) / 2, shape (..., position); NaN where a direction is missing."""
        return (self.mean_positive + self.mean_negative) / 2

    @property
    def reversal_value(self) -> FloatArray:
        """B_i = x̄_i↑ − x̄_i↓, signed, shape (..., position); NaN where a direction is missing."""
        return self.mean_positive - self.mean_negative

    @property
    def is_measured(self) -> BoolArray:
        """Whether there is a reading at all in each direction, shape (..., approach)."""
        measured: BoolArray = np.any(self.count > 0, axis=-1)
        return measured

    @property
    def is_bidirectional(self) -> BoolArray:
        """Whether both directions were measured, shape (...)."""
        both: BoolArray = np.all(self.is_measured, axis=-1)
        return both

    @property
    def mean_of_all_runs(self) -> FloatArray:
        """The mean of both directions, or that of the only one that was measured, shape (..., position)."""
        return self.of_both_or_single(self.mean_bidirectional, self.mean)

    def of_both_or_single(self, of_both: FloatArray, by_approach: FloatArray) -> FloatArray:
        """Return values of both directions together, or those of the single direction that was measured.

        Parameters
        ----------
        of_both : (..., position) array
            Taken for the tests in which both directions were measured.
        by_approach : (..., approach, position) array
            Values formed in each direction by itself: taken for the tests in one direction.

        Returns
        -------
        (..., position) array
        """
        both = self.is_bidirectional
        if np.all(both):
            return of_both
        positive = self.is_measured[..., Approach.POSITIVE.index]
        single = np.where(
            positive[..., np.newaxis],
            by_approach[..., Approach.POSITIVE.index, :],
            by_approach[..., Approach.NEGATIVE.index, :],
        )
        return np.where(both[..., np.newaxis], of_both, single)


def position_statistics(deviations: FloatArray, positions: FloatArray | None = None) -> PositionStatistics:
    """Return the statistics by position.

    Parameters
    ----------
    deviations : (..., approach, position, run) array
        x_ij, m or rad; NaN where missing. A missing reading lowers n at its position and approach only.
    positions : (position,) array
        P_i; without them, what needs them is not defined.

    Notes
    -----
    Means first, squares of the residuals about them second: nothing cancels. The runs, which are few, are
    taken one by one, so that a large stack of tests needs no copy of itself. The tests of a stack lie next to
    each other in memory, for what is asked next are extremes over the positions, which are few.
    """
    readings = deviations.view()
    readings.setflags(write=False)
    runs = [readings[..., run] for run in range(readings.shape[-1])]
    by_position = readings.shape[:-1]
    count = np.zeros(by_position, dtype=np.int64, order="F")
    total = np.zeros(by_position, order="F")
    squares = np.zeros(by_position, order="F")
    # Of one test in a notebook the masks alone would cost more than the sums.
    complete = _is_complete(readings)
    for run in runs:
        count += _add_defined(total, np.asfortranarray(run), complete=complete)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = total / count
        for run in runs:
            residual = np.subtract(run, mean, order="F")
            residual *= residual
            _add_defined(squares, residual, complete=complete)
        standard_deviation = np.sqrt(squares / (count - 1))
    standard_deviation[count < 2] = np.nan
    places = np.full(readings.shape[-2], np.nan) if positions is None else positions.view()
    for array in (count, mean, standard_deviation, places):
        array.setflags(write=False)
    return PositionStatistics(readings, count, mean, standard_deviation, places)


def compute_statistics_of(measurements: MeasurementSet) -> PositionStatistics:
    """Return the statistics of a test, or of several measured lines together."""
    if measurements.tests:
        return join_statistics(
            {name: compute_statistics_of(each) for name, each in measurements.tests.items()}
        )
    return position_statistics(measurements.deviations(), measurements.target_positions)


def join_statistics(tests: Mapping[str, PositionStatistics]) -> PositionStatistics:
    """Return the statistics of several measured lines together, which have the same batch dimensions."""
    batch = next(iter(tests.values())).mean.shape[:-2]
    none = position_statistics(np.empty((*batch, len(Approach), 0, 0)), np.empty(0))
    return replace(none, tests=dict(tests))


def _add_defined(total: FloatArray, values: FloatArray, *, complete: bool) -> BoolArray | bool:
    """Add to a sum the values that are not NaN, and return which they are."""
    if complete or not (missing := np.isnan(values)).any():  # nearly always, and then three times as fast
        total += values
        return True
    present: BoolArray = ~missing
    np.add(total, values, out=total, where=present)
    return present


def largest(values: FloatArray) -> FloatArray:
    """Return the largest value over the positions: (..., position) to (...)."""
    extreme: FloatArray = np.fmax.reduce(values, axis=-1)
    return extreme


def smallest(values: FloatArray) -> FloatArray:
    """Return the smallest value over the positions: (..., position) to (...)."""
    extreme: FloatArray = np.fmin.reduce(values, axis=-1)
    return extreme


def width(upper: FloatArray, lower: FloatArray) -> FloatArray:
    """Return the full range from the smallest lower to the largest upper value: (..., position) to (...)."""
    return largest(upper) - smallest(lower)


def span(values: FloatArray) -> FloatArray:
    """Return the full range of values over the positions: (..., position) to (...).

    NaN where fewer than two positions have one: a single value has no range, which is not to say that it
    has one of zero.
    """
    if values.shape[-1] > 1 and _is_complete(values):
        return width(values, values)
    several = np.count_nonzero(~np.isnan(values), axis=-1) > 1
    return np.where(several, width(values, values), np.nan)


def average(values: FloatArray) -> FloatArray:
    """Return the mean over the positions: (..., position) to (...)."""
    mean: FloatArray
    if values.shape[-1] and _is_complete(values):
        mean = np.add.reduce(values, axis=-1) / values.shape[-1]
        return mean
    present = ~np.isnan(values)
    total = np.add.reduce(values, axis=-1, where=present)
    with np.errstate(invalid="ignore"):
        mean = total / np.count_nonzero(present, axis=-1)
    return mean


def _is_complete(values: FloatArray) -> bool:
    """Return whether every value is there: a sum is a number only then, and a sum is quick."""
    return math.isfinite(np.add.reduce(values, None))
