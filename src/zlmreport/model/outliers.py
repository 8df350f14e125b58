"""Single readings that stand off: a chip under the probe, a broken beam, a key pressed too early.

They are flagged and set aside, never altered, and everything is fitted with and without them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.model.design import Design
from zlmreport.model.distributions import normal_tail
from zlmreport.model.repeats import cells
from zlmreport.quantities.arrays import FloatArray, IntArray, read_only_integers

#: Of the robust standard deviation.
_LIMIT = 4.5
#: Neighbours in time whose median tells drift from a single reading.
_WINDOW = 15
#: Standard deviation of a normal variable over its median absolute deviation.
_NORMAL = 1.4826
#: By 1.35/n the median of n readings draws their median absolute deviation from it towards zero: of an odd
#: number one reading is the median itself.
_SHARE_OF_MEDIAN = 1.35
#: More readings in a row are no blunder but something that the model lacks.
_MOST_IN_A_ROW = 2
#: A cell of fewer readings has no median that an outlier would not move.
_FEWEST_REPEATS = 3


@dataclass(frozen=True, slots=True)
class Outliers:
    """Readings that stand off.

    Attributes
    ----------
    readings : (k,) integer array
        Their places, in the order of time.
    p_value
        Chance that any of so many normal readings stands off so far; 1 if none does.
    """

    readings: IntArray
    p_value: float


def outliers(design: Design, deviation: FloatArray) -> Outliers:
    """Return the readings that stand off from their repeats and from their neighbours in time.

    Parameters
    ----------
    design
        The test.
    deviation : (N,) array
        x, m or rad.
    """
    cell = cells(design)
    count = np.bincount(cell)
    if count.max() < _FEWEST_REPEATS or len(deviation) < _WINDOW:
        return Outliers(read_only_integers([]), 1.0)
    medians = np.array([np.median(deviation[cell == index]) for index in range(len(count))])
    left = deviation - medians[cell]
    half = _WINDOW // 2
    padded = np.pad(left, half, mode="reflect")
    left = left - np.median(np.lib.stride_tricks.sliding_window_view(padded, _WINDOW), axis=1)
    judged = count[cell] >= _FEWEST_REPEATS
    typical = float(np.median(count[cell][judged]))
    spread = _NORMAL * float(np.median(np.abs(left[judged]))) / (1.0 - _SHARE_OF_MEDIAN / typical)
    if spread == 0:
        return Outliers(read_only_integers([]), 1.0)
    sizes = _single(np.where(judged, np.abs(left) / spread, 0.0))
    p_value = min(1.0, 2.0 * len(sizes) * normal_tail(float(sizes.max())))
    return Outliers(read_only_integers(np.flatnonzero(sizes > _LIMIT)), p_value)


def _single(sizes: FloatArray) -> FloatArray:
    """Return how far readings stand off, those of which too many follow one another brought to the limit."""
    off = np.concatenate([[False], sizes > _LIMIT, [False]])
    changes = np.flatnonzero(off[1:] != off[:-1])
    for first, end in changes.reshape(-1, 2):
        if end - first > _MOST_IN_A_ROW:
            sizes[first:end] = np.minimum(sizes[first:end], _LIMIT)
    return sizes
