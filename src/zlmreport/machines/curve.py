"""A component error as a curve over its axis, with its covariance.

A curve is known at its nodes and linear between them; where both directions of travel were measured, each
has its own. Nothing is extrapolated: beyond the nodes the end value stands and `find_outside` says so. All
that is read from a curve is a linear function of its nodes, so that the covariance of these is carried
through exactly.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from zlmreport.machines.kinematics import SQUARENESS, TRANSLATIONS, ErrorLine
from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.fitting.estimate import InstrumentError

#: A position is outside of a curve only beyond what a typed position may be off, m.
_TOUCHING = 1e-9
#: Of the largest value, what the rounding of doubles may leave of nothing.
_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True)
class AxisErrorCurve:
    """One of the 21 errors as it is known."""

    name: str  #: ``EXX`` … or a squareness error, which has one node at 0.
    nodes: FloatArray  #: Positions of its axis, rising, shape (m,), m.
    #: Of the nodes, shape (m,) or (2·m,): the positive direction of travel, then the negative, m or rad.
    values: FloatArray
    #: Columns whose random combination is the error of the values, shape (len(values), r): their covariance
    #: is factor·factorᵀ.
    factor: FloatArray
    line: ErrorLine  #: Where it was measured.
    source: str  #: What it was taken from, as pages name it; empty of a value that is stated and no more.
    #: Columns that it has from other errors, by their names: these were taken off it, with what is not known
    #: of them. Each is combined with the same random numbers as that column of the other's own factor.
    borrowed: Mapping[str, FloatArray] = field(default_factory=dict)

    @property
    def axis(self) -> str:
        """The axis that moves."""
        return self.name[2]

    @property
    def is_single(self) -> bool:
        """Whether it is one number: a squareness error."""
        return self.name in SQUARENESS

    @property
    def has_directions(self) -> bool:
        """Whether the two directions of travel have values of their own."""
        return len(self.values) == 2 * len(self.nodes)

    @property
    def span(self) -> float:
        """The largest minus the smallest value; of a squareness error its absolute value.

        Of positions over both directions, of straightness and angles of the mean of both: as their standards
        have it.
        """
        if self.is_single:
            return float(abs(self.values[0]))
        is_position = self.name[1] == self.axis
        values = self.values if is_position else self.values.reshape(-1, len(self.nodes)).mean(axis=0)
        return float(np.ptp(values))

    @property
    def columns(self) -> Mapping[str, FloatArray]:
        """All columns of its error, by the name of the error whose they are."""
        return {self.name: self.factor, **self.borrowed}

    @property
    def largest_uncertainty(self) -> float:
        """The largest expanded uncertainty of a value, k = 2, m or rad."""
        squares = sum(np.sum(each**2, axis=1) for each in self.columns.values())
        return float(2.0 * np.sqrt(squares).max(initial=0.0))

    def weigh_nodes(self, position: FloatArray, direction: FloatArray) -> FloatArray:
        """Return how the value at some positions is made of those of the nodes, shape (N, len(values)).

        `direction`, (N,): of travel, +1 or −1; 0 takes the mean of both.
        """
        if self.is_single:
            return np.ones((len(position), 1))
        count = len(self.nodes)
        held = np.clip(position, self.nodes[0], self.nodes[-1])
        right = np.clip(np.searchsorted(self.nodes, held), 1, count - 1)
        share = (held - self.nodes[right - 1]) / (self.nodes[right] - self.nodes[right - 1])
        rows, plain = np.arange(len(position)), np.zeros((len(position), count))
        plain[rows, right - 1] = 1.0 - share
        plain[rows, right] += share
        if not self.has_directions:
            return plain
        forward = (1.0 + np.sign(direction))[:, np.newaxis] / 2.0
        return np.concatenate([forward * plain, (1.0 - forward) * plain], axis=1)

    def find_outside(self, position: FloatArray) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        """Return which positions lie beyond what was measured, shape (N,)."""
        if self.is_single:
            return np.zeros(len(position), dtype=np.bool_)
        return np.asarray(
            (position < self.nodes[0] - _TOUCHING) | (position > self.nodes[-1] + _TOUCHING), dtype=np.bool_
        )


def make_measured_curve(
    name: str, readings: MeasurementSet, instrument: InstrumentError, line: ErrorLine, source: str
) -> AxisErrorCurve:
    """Return the mean deviations of a test as a curve; its covariance is as in `make_curve_of_means`."""
    found = readings.deviations()
    count = np.sum(np.isfinite(found), axis=2)
    usable = [each.index for each in readings.approaches]
    kept = np.all(count[usable] > 0, axis=0)
    nodes, found, count = readings.target_positions[kept], found[usable][:, kept], count[usable][:, kept]
    means = np.nanmean(found, axis=2)
    squares = np.nansum((found - means[:, :, np.newaxis]) ** 2, axis=2)
    return make_curve_of_means(Means(nodes, means, count, squares), name, instrument, line, source)


@dataclass(frozen=True, slots=True)
class Means:
    """What the repeats of a test say of a deviation: (m,) positions, (1 or 2, m) means by direction."""

    nodes: FloatArray
    values: FloatArray
    count: IntArray  #: Readings of each mean.
    squares: FloatArray  #: Sum of their squared distances from it.


def make_curve_of_means(
    means: Means, name: str, instrument: InstrumentError, line: ErrorLine, source: str
) -> AxisErrorCurve:
    """Return means as a curve.

    Their covariance holds the scatter of the repeats, pooled, and what of the instrument's uncertainty is
    shared: by all readings of a target, along the length, or by all.
    """
    sides, nodes = len(means.values), means.nodes
    freedom = int(np.sum(means.count - 1))
    scatter = float(means.squares.sum()) / freedom if freedom else 0.0
    own = np.diag(np.sqrt(scatter / means.count.ravel()))
    both = np.tile(np.eye(len(nodes)), (sides, 1)) * instrument.at_each_position
    along = np.tile(nodes - nodes.mean(), sides)[:, np.newaxis] * instrument.proportional
    parted = np.repeat([1.0, -1.0][:sides], len(nodes))[:, np.newaxis]
    parts = [own, both, along, parted * instrument.between_directions / 2.0]
    factor = np.concatenate([each[:, np.any(each, axis=0)] for each in parts], axis=1)
    return AxisErrorCurve(name, nodes, means.values.ravel(), factor, line, source)


def with_scale_error(curve: AxisErrorCurve, uncertainty: float) -> AxisErrorCurve:
    """Return a curve of which all values share the error of the scale in which they were read.

    `uncertainty`: The standard uncertainty of what the instrument shows for 1.
    """
    if not uncertainty:
        return curve
    return replace(curve, factor=np.column_stack([curve.factor, uncertainty * curve.values]))


def remove_alignment(curve: AxisErrorCurve, zero_at: float | None = None) -> AxisErrorCurve:
    """Return a curve without what only says how it was set up.

    Of a straightness error the least-squares line: its slope is the artefact's alignment, and what the axes
    do to each other is the squareness error's. Of an angle its value where that squareness error was
    measured, for the two turn the same: counted from elsewhere, the prediction would be out of square by
    their difference at the very place where it is known. Else of an angle the mean. Of a position nothing.

    `zero_at`: Where the squareness error was measured, m; None where nobody says it.
    """
    if curve.is_single or (curve.name in TRANSLATIONS and curve.name[1] == curve.axis):
        return curve
    count = len(curve.nodes)
    repeats = len(curve.values) // count
    columns = [np.ones(count)]
    if curve.name in TRANSLATIONS:
        columns.append(curve.nodes - curve.nodes.mean())
    elif zero_at is not None and curve.nodes[0] <= zero_at <= curve.nodes[-1]:
        there = [np.interp(zero_at, curve.nodes, node) for node in np.eye(count)]
        left = np.eye(len(curve.values)) - np.tile(there, repeats) / repeats
        return replace(curve, values=left @ curve.values, factor=left @ curve.factor)
    base, _ = np.linalg.qr(np.tile(np.column_stack(columns), (repeats, 1)))
    left = np.eye(len(curve.values)) - base @ base.T
    return replace(
        curve, values=_drop_rounding(left, curve.values), factor=_drop_rounding(left, curve.factor)
    )


def _drop_rounding(left: FloatArray, values: FloatArray) -> FloatArray:
    """Return what is left of values: nothing of those that a line describes, no rounding of doubles."""
    found = left @ values
    return np.asarray(np.where(np.abs(found) > _ROUNDING * np.abs(values).max(initial=0.0), found, 0.0))
