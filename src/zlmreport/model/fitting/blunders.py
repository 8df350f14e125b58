"""Finds outliers (blunders): single readings that stand off, which are set aside and never altered.

A chip under the probe, a broken beam, a key pressed too early. A reading is judged by the scatter at its own
place, and last of all: what a model explains is none, and what has a pattern, in a run, at a target, from
reading to reading of one block, is evidence of something that the model lacks.
"""

from __future__ import annotations

import math
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
#: More readings in a row are no blunder but something that the model lacks. A pattern of those flagged: so
#: many at least, and such a share of them in one run, or at one target.
_MOST_IN_A_ROW, _FEWEST_ALIKE, _MOST_ALIKE = 2, 3, 0.6
#: A cell of fewer readings has no median that an outlier would not move.
_FEWEST_REPEATS = 3
#: Standard deviation of ln|x| of a normal x, and by how many of them scatter must be seen to grow.
_OF_LOGARITHM, _GROWS = 1.11, 4.0
#: Times the scatter of all by which that of few targets is no chance.
_PLAINLY_MORE = 1.5
#: Share of the usual size below which a logarithm is no longer taken.
_LEAST = 1e-2


@dataclass(frozen=True, slots=True)
class Outliers:
    """Readings that stand off."""

    readings: IntArray  #: (k,) integer: Their places, in the order of time.
    p_value: float  #: Chance that any of so many normal readings stands off so far; 1 if none does.


def find_outliers(design: Design, deviation: FloatArray) -> Outliers:
    """Return the readings that stand off from their repeats and from their neighbours in time.

    At each place the one that stands off most goes first: it draws the others of few after it.

    `deviation`, (N,): x, or what a model leaves of it, m or rad.
    """
    cell = number_cells(design)
    sizes, aside = np.zeros(len(cell)), np.zeros(len(cell), dtype=np.bool_)
    if np.bincount(cell).max() < _FEWEST_REPEATS or len(deviation) < _WINDOW:
        return Outliers(read_only_integers([]), 1.0)
    while True:
        left = _leave_beside_others(design, deviation, cell, aside)
        sizes = np.where(aside, sizes, np.abs(left))
        largest = np.zeros(cell.max() + 1)
        np.maximum.at(largest, cell[~aside], sizes[~aside])
        worst = ~aside & (sizes > _LIMIT) & (sizes == largest[cell])
        if not worst.any():
            break
        aside |= worst
    for pattern in _find_patterns(design, aside, left):
        sizes[pattern] = np.minimum(sizes[pattern], _LIMIT)
    p_value = min(1.0, 2.0 * len(sizes) * normal_tail(float(sizes.max())))
    return Outliers(read_only_integers(np.flatnonzero(sizes > _LIMIT)), p_value)


def _leave_beside_others(
    design: Design, deviation: FloatArray, cell: IntArray, aside: BoolArray
) -> FloatArray:
    """Return how far each reading is from the median of the others at its place, in standard deviations.

    The others know nothing of it: what is between them is normal as the readings are, be they as few as
    three; from a median of three that it is one of, one of three is no way off at all. What its neighbours in
    time have in common is taken out likewise. 0 of readings beside which there are too few.

    `aside`, (N,): Those that are none of the others.
    """
    left, judged = np.zeros(len(cell)), np.zeros(len(cell), dtype=np.bool_)
    for number in np.unique(cell):
        own = np.flatnonzero(cell == number)
        kept = own[~aside[own]]
        for each in own:
            others = deviation[kept[kept != each]]
            if len(others) >= _FEWEST_REPEATS - 1:
                judged[each] = True
                left[each] = (deviation[each] - np.median(others)) / _find_spread_beside(len(others))
    counted = judged & ~aside
    if not counted.any():
        return np.zeros(len(left))
    half = _WINDOW // 2
    windows = np.lib.stride_tricks.sliding_window_view(np.pad(left, half, mode="reflect"), _WINDOW)
    # A reading may be the median of its window, which is then no way off: the scatter is that without it.
    # But beside a jump it is its own that says on which side it is.
    without = (left - np.median(np.delete(windows, half, axis=1), axis=1))[counted]
    left = left - np.median(windows, axis=1)
    growth = _estimate_growth(design.position, left, judged)
    spread = estimate_robust_deviation(without / growth[counted])
    if spread == 0:
        return np.zeros(len(left))
    left = np.where(judged, left / growth / spread, 0.0)
    return left / _estimate_local_scatter(design.target, left, judged)


def _estimate_local_scatter(target: IntArray, left: FloatArray, judged: BoolArray) -> FloatArray:
    """Return how readings scatter at each target and its neighbours, over all; 1 unless it is plainly more.

    Where many stand off none is a blunder: something moves there.
    """
    near = {each: left[judged & (np.abs(target - each) <= 1)] for each in np.unique(target[judged]).tolist()}
    scatter = {each: estimate_robust_deviation(values) for each, values in near.items()}
    local = {each: value if value > _PLAINLY_MORE else 1.0 for each, value in scatter.items()}
    return np.array([local.get(each, 1.0) for each in target.tolist()])


def _find_spread_beside(others: int) -> float:
    """Return the standard deviation, in σ, of a normal reading less the median of so many others.

    That of the median of n is near √(π/2)/√(n + ½) where n is odd, √(π/2)/√(n + 1.14) where it is even.
    """
    return math.sqrt(1.0 + math.pi / 2.0 / (others + (0.5 if others % 2 else 1.14)))


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
