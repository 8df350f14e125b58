"""The mean deviations that a table is to take away, and the table itself on its grid; tables across axes.

One sign for all: e = actual − nominal. A controller turns it where it has to, and nowhere else.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from zlmreport.errors import InputError, Place
from zlmreport.evaluation.statistics import position_statistics
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.axis import Axis, AxisKind, refuse_other_than_positions
from zlmreport.measurement.measurement_set import MeasurementSet

#: Of a rotary axis, rad.
TURN = 2 * math.pi
#: By how much two angles differ that are one, rad.
_ALIKE = 1e-6
#: m or rad anywhere, shape (2, …): forward, reverse.
Function = Callable[[FloatArray], FloatArray]


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
    is_closed
        Whether the table goes round a rotary axis: its last row is the first one, a turn on.
    """

    axis: Axis
    number: str
    positions: FloatArray
    forward: FloatArray
    reverse: FloatArray
    place: Place
    is_closed: bool = False

    def at(self, positions: FloatArray) -> FloatArray:
        """Return what the control takes away, shape (2, …).

        Linear between rows; outside the end value, but that of a table that is closed repeats every turn.
        """
        values = np.stack([self.forward, self.reverse])
        return interpolate_rows(positions, self.positions, values, is_closed=self.is_closed)


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


def interpolate_rows(
    positions: FloatArray, rows: FloatArray, values: FloatArray, *, is_closed: bool
) -> FloatArray:
    """Return values of shape (…, g) between their rows; outside the end value, or that of a turn before."""
    if is_closed:
        return np.stack([np.interp(positions, rows[:-1], each[:-1], period=TURN) for each in values])
    return np.stack([np.interp(positions, rows, each) for each in values])


def has_whole_turn(axis: Axis) -> bool:
    """Return whether an axis turns round and round, as far as the job states its travel."""
    travel = axis.travel
    return axis.kind is AxisKind.ROTARY and (travel is None or travel[1] - travel[0] >= TURN - _ALIKE)


def find_open_part(axis: Axis, targets: FloatArray) -> float | None:
    """Return how much of a turn lies beyond the targets, rad; None for an axis that does not turn round.

    Nothing is open, and None is returned, where the targets go further than a turn.
    """
    left = TURN - float(targets[-1] - targets[0])
    return max(0.0, left) if has_whole_turn(axis) and left > -_ALIKE else None


def can_go_round(axis: Axis, targets: FloatArray) -> bool:
    """Return whether a table of these targets can go round: no more is open than between two of them."""
    left = find_open_part(axis, targets)
    return left is not None and left <= float(np.diff(targets).max()) + _ALIKE


def wrap(positions: FloatArray, first: float) -> FloatArray:
    """Return positions within the turn that begins at the first, rad."""
    return np.asarray(first + np.mod(positions - first, TURN))


def reach_beyond(known: Function, targets: FloatArray, *, is_closed: bool) -> Function:
    """Return a function of what was measured for positions beyond the targets, too.

    Its end values are held there. Of one that is closed a straight line leads over the open part of the turn
    to the first target; where first and last target are one place, it has the mean of both there.
    """
    first, last = float(targets[0]), float(targets[-1])
    if not is_closed:
        return lambda at: known(np.clip(at, first, last))
    ends = known(np.array([first, last]))
    apart = ends[:, :1] - ends[:, 1:]
    left = max(0.0, TURN - (last - first))

    def interpolate_round(at: FloatArray) -> FloatArray:
        within = wrap(at, first)
        values = known(np.minimum(within, last))
        if left > _ALIKE:
            return values + apart * np.clip((within - last) / left, 0.0, 1.0)
        return values + apart * np.interp(within, targets[[0, 1, -2, -1]], [-0.5, 0.0, 0.0, 0.5])

    return interpolate_round


def make_table_of(  # noqa: PLR0913, PLR0917 - what it holds, where, and of what
    deviations: FloatArray,
    rows: FloatArray,
    axis: Axis,
    number: str,
    place: Place,
    turn_from: float | None = None,
) -> CompensationTable:
    """Return the table of deviations, with that of a table that was active during the test added.

    `deviations`, (2, g): What is left at the rows, forward and reverse, m or rad.
    `rows`, (g,): m or rad.
    `axis`, `number`, `place`: As of `CompensationTable`; the axis has the table that was active.
    `turn_from`: Where the turn begins in which the axis was measured, of a table that is closed, rad.
    """
    old = axis.compensation_table
    at = rows if turn_from is None else wrap(rows, turn_from)
    forward, reverse = (
        each + (old.at(at, direction) if old else 0.0)
        for each, direction in zip(deviations, (1.0, -1.0), strict=True)
    )
    if turn_from is not None:
        forward[-1], reverse[-1] = forward[0], reverse[0]
    return CompensationTable(
        axis,
        number,
        read_only_floats(rows),
        read_only_floats(forward),
        read_only_floats(reverse),
        place,
        is_closed=turn_from is not None,
    )


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
