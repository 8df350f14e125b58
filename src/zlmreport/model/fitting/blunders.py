"""Finds outliers (blunders): single readings that stand off, which are set aside and never altered.

A chip under the probe, a broken beam, a key pressed too early. A reading is judged by the scatter at its own
place, and last of all: what a model explains is none, and what has a pattern, in a run, at a target, from
reading to reading of one block, is evidence of something that the model lacks.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from zlmreport.measurement.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
    estimate_robust_deviation,
    read_only_integers,
)
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.distributions import normal_tail
from zlmreport.model.fitting.repeats import number_cells

#: Of the robust standard deviation.
_LIMIT = 4.5
#: Neighbours in time whose median tells drift from a single reading.
_WINDOW = 15
#: By 1.35/n the median of n readings draws their median absolute deviation from it towards zero: of an odd
#: number one reading is the median itself.
_SHARE_OF_MEDIAN = 1.35
#: More readings in a row are no blunder but something that the model lacks. A pattern of those flagged: so
#: many at least, and such a share of them in one run, or at one target.
_MOST_IN_A_ROW, _FEWEST_ALIKE, _MOST_ALIKE = 2, 3, 0.6
#: A cell of fewer readings has no median that an outlier would not move.
_FEWEST_REPEATS = 3
#: Standard deviation of ln|x| of a normal x, and by how many of them scatter must be seen to grow.
_OF_LOGARITHM, _GROWS = 1.11, 4.0
#: Share of the usual size below which a logarithm is no longer taken.
_LEAST = 1e-2


@dataclass(frozen=True, slots=True)
class Outliers:
    """Readings that stand off."""

    readings: IntArray  #: (k,) integer: Their places, in the order of time.
    p_value: float  #: Chance that any of so many normal readings stands off so far; 1 if none does.


def find_outliers(design: Design, deviation: FloatArray) -> Outliers:
    """Return the readings that stand off from their repeats and from their neighbours in time.

    `deviation`, (N,): x, or what a model leaves of it, m or rad.
    """
    none = Outliers(read_only_integers([]), 1.0)
    cell = number_cells(design)
    count = np.bincount(cell)
    if count.max() < _FEWEST_REPEATS or len(deviation) < _WINDOW:
        return none
    medians = np.array([np.median(deviation[cell == index]) for index in range(len(count))])
    left = deviation - medians[cell]
    half = _WINDOW // 2
    padded = np.pad(left, half, mode="reflect")
    left = left - np.median(np.lib.stride_tricks.sliding_window_view(padded, _WINDOW), axis=1)
    judged = count[cell] >= _FEWEST_REPEATS
    typical = float(np.median(count[cell][judged]))
    left = left / _estimate_growth(design.position, left, judged)
    spread = estimate_robust_deviation(left[judged]) / (1.0 - _SHARE_OF_MEDIAN / typical)
    if spread == 0:
        return none
    sizes = np.where(judged, np.abs(left) / spread, 0.0)
    flagged = sizes > _LIMIT
    for pattern in _find_patterns(design, flagged, left):
        sizes[pattern] = np.minimum(sizes[pattern], _LIMIT)
    p_value = min(1.0, 2.0 * len(sizes) * normal_tail(float(sizes.max())))
    return Outliers(read_only_integers(np.flatnonzero(sizes > _LIMIT)), p_value)


def _estimate_growth(position: FloatArray, left: FloatArray, judged: BoolArray) -> FloatArray:
    """Return how readings scatter at their positions over the mean, where that plainly grows along the axis.

    Logarithms of sizes are taken: single readings that stand off hardly move their line.
    """
    sizes = np.abs(left)
    usual = float(np.median(sizes[judged]))
    if usual == 0 or np.ptp(position[judged]) == 0:
        return np.ones(len(left))
    logarithms = np.log(np.maximum(sizes, _LEAST * usual))
    away = position - position[judged].mean()
    slope = float(away[judged] @ logarithms[judged]) / float(away[judged] @ away[judged])
    if abs(slope) * float(np.linalg.norm(away[judged])) < _GROWS * _OF_LOGARITHM:
        return np.ones(len(left))
    # Two positions have no bend.
    order = min(2, len(np.unique(away[judged])) - 1)
    bend = np.polynomial.Polynomial.fit(away[judged], logarithms[judged], order)
    grown = np.exp(bend(away))
    return np.asarray(grown / grown[judged].mean(), dtype=np.float64)


def _find_patterns(design: Design, flagged: BoolArray, left: FloatArray) -> Iterator[IntArray]:
    """Yield flagged readings that have a pattern: they are evidence, and no blunders."""
    places = np.flatnonzero(flagged)
    off = np.concatenate([[False], flagged, [False]])
    for first, end in np.flatnonzero(off[1:] != off[:-1]).reshape(-1, 2).tolist():
        row = np.arange(first, end)
        # Two of one block that go the same way: before or after something happened.
        is_block = len(row) > 1 and len(set(design.target[row].tolist())) == 1
        if end - first > _MOST_IN_A_ROW or (is_block and abs(np.sign(left[row]).sum()) == len(row)):
            yield row
    if len(places) < _FEWEST_ALIKE:
        return
    for labels in (design.cycle, design.target):
        names, count = np.unique(labels[places], return_counts=True)
        if count.max() >= max(_FEWEST_ALIKE, _MOST_ALIKE * len(places)):
            yield places[labels[places] == names[int(np.argmax(count))]]
