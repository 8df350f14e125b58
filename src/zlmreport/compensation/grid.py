"""Where a table has its rows, and why there.

Without a stated step the rule is: no more rows than the targets support, no fewer than keep what the lines
between them miss below the uncertainty of a mean, and never more than the control takes. Targets show waves
that are two of their distances long or longer (the sampling theorem), and a wave needs `ROWS_A_PERIOD` rows:
so a grid has at most twice as many intervals as the targets. Rows at the targets themselves come first, where
a control takes rows that are unequally far apart.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from zlmreport.compensation.basis import Basis
from zlmreport.errors import InputError, Place
from zlmreport.quantities.arrays import FloatArray, read_only_floats

#: Places between two rows of the finest grid at which a grid is looked at, and grids that are.
_BETWEEN, _MOST_GRIDS = 8, 20
#: What the lines between rows miss by rounding alone, m or rad.
_NOTHING = 1e-12


class GridReason(StrEnum):
    """Why a table has the rows that it has."""

    STATED = "stated"
    TARGETS = "targets"
    UNCERTAINTY = "uncertainty"
    CONTROL = "control"
    SUPPORT = "support"


@dataclass(frozen=True, slots=True)
class Grid:
    """The rows of a table.

    Attributes
    ----------
    rows : (g,) array
        Rising, m or rad.
    reason
        Why these: as stated; the targets; the fewest that keep within the uncertainty; or fewer than that
        needs, for the control takes no more or the targets support no more.
    added
        What the lines between the rows miss at most of what the table is to take away, m or rad.
    allowed
        U of a mean deviation by the scatter of the readings (k = 2), m or rad; 0 if the test cannot tell.
    """

    rows: FloatArray
    reason: GridReason
    added: float
    allowed: float


def grid_of(
    basis: Basis,
    place: Place,
    *,
    step: float | None = None,
    is_equidistant: bool = False,
    most_rows: int | None = None,
) -> Grid:
    """Return the grid of a table.

    Parameters
    ----------
    basis
        What the table is made from.
    place
        Where the table is asked for.
    step
        Distance of the rows, m or rad; None for the rule.
    is_equidistant
        Whether the control takes no other grid.
    most_rows
        What the control takes; None for any number.

    Raises
    ------
    InputError
        If the step does not divide the measured length into at least one interval.
    """
    targets = basis.curve.positions
    first, last, count = float(targets[0]), float(targets[-1]), len(targets)
    places = np.union1d(np.linspace(first, last, 2 * _BETWEEN * count), targets)
    allowed = basis.expanded_uncertainty

    def judged(rows: FloatArray, reason: GridReason) -> Grid:
        wanted = basis.wanted(rows)
        lines = np.stack([np.interp(places, rows, each) for each in wanted(rows)])
        inside = places <= rows[-1] + _NOTHING
        missed = float(np.abs(wanted(places) - lines)[:, inside].max())
        return Grid(read_only_floats(rows), reason, missed if missed > _NOTHING else 0.0, allowed)

    if step is not None:
        intervals = (last - first) / step
        if intervals < 1:
            raise InputError.at(place, "the step is longer than the measured length; state a shorter one")
        return judged(first + step * np.arange(int(intervals + 1e-9) + 1), GridReason.STATED)
    most = most_rows or 2 * count
    grids = [judged(targets, GridReason.TARGETS)] if not is_equidistant and count <= most else []
    numbers = np.unique(np.linspace(min(count, most), min(2 * count - 1, most), _MOST_GRIDS).astype(int))
    grids += [
        judged(read_only_floats(np.linspace(first, last, number)), GridReason.UNCERTAINTY)
        for number in numbers.tolist()
    ]
    best = min(grids, key=lambda grid: (len(basis.left_out(grid.rows)), max(grid.added, allowed)))
    if best.added > max(allowed, _NOTHING):
        reason = GridReason.CONTROL if most < 2 * count - 1 else GridReason.SUPPORT
        return Grid(best.rows, reason, best.added, allowed)
    return best
