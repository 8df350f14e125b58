"""The mean deviations that a table is to take away, and the table itself on its grid; tables across axes.

One sign for all: e = actual − nominal. A controller turns it where it has to, and nowhere else.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.errors import InputError, Place
from zlmreport.evaluation.statistics import position_statistics
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.axis import Axis, refuse_other_than_positions
from zlmreport.measurement.measurement_set import MeasurementSet


@dataclass(frozen=True, slots=True)
class ErrorCurve:
    """The deviations of an axis at its targets."""

    positions: FloatArray  #: (m,): Targets, rising, m or rad.
    #: forward and reverse: (m,): Mean deviations e by direction of approach, m or rad; alike where one
    #: direction was measured.
    forward: FloatArray
    reverse: FloatArray
    spread: FloatArray  #: (2, m): Standard deviations by direction, m or rad; NaN where there are none.
    runs: int  #: Number of readings behind each mean.
    approaches: tuple[Approach, ...]  #: The directions that were measured.

    @property
    def is_bidirectional(self) -> bool:
        """Whether both directions were measured."""
        return len(self.approaches) > 1


@dataclass(frozen=True, slots=True)
class CompensationTable:
    """A compensation table before a control has its own words for it.

    Attributes
    ----------
    axis
        The axis.
    number
        Of the job; it names the files.
    positions : (g,) array
        The grid, rising, m or rad.
    forward, reverse : (g,) arrays
        The deviations e that the control is to take away, m or rad.
    place
        Where the table is asked for: for messages about what a control cannot take.
    """

    axis: Axis
    number: str
    positions: FloatArray
    forward: FloatArray
    reverse: FloatArray
    place: Place

    def at(self, positions: FloatArray) -> FloatArray:
        """Return what the control takes away, shape (2, …): linear between rows, the end value outside."""
        return np.stack([np.interp(positions, self.positions, each) for each in (self.forward, self.reverse)])


def make_error_curve(measurements: MeasurementSet, place: Place) -> ErrorCurve:
    """Return the curve of a test.

    Raises `InputError` at the place, if a target lacks a mean in a direction that was measured.
    """
    refuse_other_than_positions(
        measurements.axis, place, "a control's table moves the axis along itself, and takes away nothing else"
    )
    statistics = position_statistics(measurements.deviations(), measurements.target_positions)
    sign = -1.0 if measurements.is_indication else 1.0
    forward, reverse = sign * statistics.mean_positive, sign * statistics.mean_negative
    has = [bool(np.isfinite(each).any()) for each in (forward, reverse)]
    if not all(has):
        forward = reverse = forward if has[0] else reverse
    if not (np.isfinite(forward).all() and np.isfinite(reverse).all()):
        raise InputError.at(
            place,
            "a table needs the mean deviation of every target in each direction that was measured; some "
            "targets lack readings",
        )
    return ErrorCurve(
        read_only_floats(measurements.target_positions),
        read_only_floats(forward),
        read_only_floats(reverse),
        read_only_floats(statistics.standard_deviation),
        len(set(measurements.run.tolist())),
        tuple(each for each in Approach if has[each.index]),
    )


def make_table_of(
    deviations: FloatArray, rows: FloatArray, axis: Axis, number: str, place: Place
) -> CompensationTable:
    """Return the table of deviations, with that of a table that was active during the test added.

    `deviations`, (2, g): What is left at the rows, forward and reverse, m or rad.
    `rows`, (g,): m or rad.
    `axis`, `number`, `place`: As of `CompensationTable`; the axis has the table that was active.
    """
    old = axis.compensation_table
    forward, reverse = (
        read_only_floats(each + (old.at(rows, direction) if old else 0.0))
        for each, direction in zip(deviations, (1.0, -1.0), strict=True)
    )
    return CompensationTable(axis, number, read_only_floats(rows), forward, reverse, place)


@dataclass(frozen=True, slots=True)
class CrossTable:
    """What an axis is off, over the position of another.

    Attributes
    ----------
    input, output
        The axis that moves, and the one that is off and is moved aside.
    positions : (g,) array
        Of the input axis, equally far apart, rising, m.
    values : (g,) array
        The deviation e = actual − nominal of the output axis there, m: zero at the first row.
    slope
        What of it is squareness: e grows so much along the input axis, rad.
    """

    input: str
    output: str
    positions: FloatArray
    values: FloatArray
    slope: float

    def at(self, positions: FloatArray) -> FloatArray:
        """Return what is taken away at some positions, m: linear between rows, the end value outside."""
        return np.asarray(np.interp(positions, self.positions, self.values), dtype=np.float64)


def halve_play(play: float) -> FloatArray:
    """Return what a mean lost motion (forward − reverse) does to each direction, shape (2, 1), m or rad."""
    return np.array([[play / 2], [-play / 2]])
