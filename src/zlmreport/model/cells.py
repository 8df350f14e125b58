"""Repeats: what the readings of one cell, a target approached from one direction, say about the scatter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.model.design import Design
from zlmreport.quantities.arrays import FloatArray, IntArray


@dataclass(frozen=True, slots=True)
class Repeats:
    """The deviations within their cells.

    Attributes
    ----------
    cell : (N,) integer array
        Index of the cell of each reading.
    count : (cells,) integer array
        Readings in each cell.
    centred : (N,) array
        Each deviation less the mean of its cell, m or rad.
    """

    cell: IntArray
    count: IntArray
    centred: FloatArray

    @property
    def degrees(self) -> int:
        """Degrees of freedom of the pure error: readings less cells."""
        return len(self.cell) - len(self.count)

    @property
    def squares(self) -> float:
        """Sum of squares of the pure error."""
        return float(np.sum(self.centred**2))


def cells(design: Design) -> IntArray:
    """Return for each reading the index of its cell, shape (N,)."""
    _, index = np.unique(2 * design.target + (design.direction > 0), return_inverse=True)
    return np.asarray(index, dtype=np.int64)


def repeats(design: Design, deviation: FloatArray) -> Repeats:
    """Return the deviations of a test within their cells."""
    cell = cells(design)
    count = np.bincount(cell)
    means = np.bincount(cell, weights=deviation) / count
    return Repeats(cell, count.astype(np.int64), deviation - means[cell])


def apart_in_time(design: Design) -> bool:
    """Whether the readings of a cell lie apart in time, as in the linear method.

    Then slow drift is within the cells, and neighbours in time are in different ones. In pendulum and
    quasi-pilgrim tests a cell is measured within a short time, and drift is between the cells.
    """
    cell = cells(design)
    order = np.lexsort((np.arange(len(cell)), cell))
    gaps = np.diff(order)[np.diff(cell[order]) == 0]
    return bool(gaps.size and np.median(gaps) > 0.5 * len(np.unique(cell)))
