"""Where a table has its rows, and why there (a control's limits, periods); the files by the control.

Without a stated step the rule is: no more rows than the targets support, no fewer than keep what the lines
between them miss below the uncertainty of a mean, and never more than the control takes. Targets show waves
that are two of their distances long or longer (the sampling theorem), and a wave needs `ROWS_A_PERIOD` rows:
so a grid has at most twice as many intervals as the targets. Rows at the targets themselves come first, where
a control takes rows that are unequally far apart.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Any

import numpy as np

from zlmreport.errors import InputError, Place
from zlmreport.evaluation.uncertainty.budget import Budget
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.axis import Axis
from zlmreport.model.compensation.basis import TableBasis
from zlmreport.model.compensation.curve import CompensationTable, make_table_of
from zlmreport.model.compensation.forecast import TableForecast, forecast

if TYPE_CHECKING:
    from zlmreport.plugin.protocols import Controller

#: Places between two rows of the finest grid at which a grid is looked at, and grids that are.
_BETWEEN, _MOST_GRIDS = 8, 20
#: What the lines between rows miss by rounding alone, m or rad.
_NOTHING = 1e-12
#: More rows than any control takes; and what a double makes of a whole number of steps.
_MOST_STEPS, _ROUNDING = 10_000, 1e-9


class GridReason(StrEnum):
    """Why a table has the rows that it has."""

    STATED = "stated"
    TARGETS = "targets"
    UNCERTAINTY = "uncertainty"
    CONTROL = "control"
    SUPPORT = "support"


@dataclass(frozen=True, slots=True)
class Grid:
    """The rows of a table."""

    rows: FloatArray  #: (g,): Rising, m or rad.
    #: Why these: as stated; the targets; the fewest that keep within the uncertainty; or fewer than that
    #: needs, for the control takes no more or the targets support no more.
    reason: GridReason
    added: float  #: What the lines between the rows miss at most of what the table is to take away, m or rad.
    #: U of a mean deviation by the scatter of the readings (k = 2), m or rad; 0 if the test cannot tell.
    allowed: float


def count_steps(length: float, step: float, place: Place) -> int:
    """Return how many steps between rows a measured length has room for, both m or rad.

    Raises `InputError` if the step is none, longer than that, or so short that no control takes the rows.
    """
    if not step > 0:
        raise InputError.at(place, "the step is not more than 0: rows stand apart; state a larger one")
    count = length / step + _ROUNDING
    if count < 1:
        raise InputError.at(place, "the step is longer than the measured length; state a shorter one")
    if count > _MOST_STEPS:
        raise InputError.at(place, f"the step makes more than {_MOST_STEPS} rows; state a larger one")
    return int(count)


def make_grid_of(
    basis: TableBasis,
    place: Place,
    *,
    step: float | None = None,
    is_equidistant: bool = False,
    most_rows: int | None = None,
) -> Grid:
    """Return the grid of a table.

    `step`: Distance of the rows, m or rad; None for the rule.

    Raises `InputError` if the step is refused by `count_steps`.
    """
    targets = basis.curve.positions
    first, last, count = float(targets[0]), float(targets[-1]), len(targets)
    places = np.union1d(np.linspace(first, last, 2 * _BETWEEN * count), targets)
    allowed = basis.expanded_uncertainty

    def judged(rows: FloatArray, reason: GridReason) -> Grid:
        wanted = basis.make_wanted(rows)
        lines = np.stack([np.interp(places, rows, each) for each in wanted(rows)])
        inside = places <= rows[-1] + _NOTHING
        missed = float(np.abs(wanted(places) - lines)[:, inside].max())
        return Grid(read_only_floats(rows), reason, missed if missed > _NOTHING else 0.0, allowed)

    if step is not None:
        stated = first + step * np.arange(count_steps(last - first, step, place) + 1)
        return judged(read_only_floats(stated), GridReason.STATED)
    most = most_rows or 2 * count
    grids = [judged(targets, GridReason.TARGETS)] if not is_equidistant and count <= most else []
    numbers = np.unique(np.linspace(min(count, most), min(2 * count - 1, most), _MOST_GRIDS).astype(int))
    grids += [
        judged(read_only_floats(np.linspace(first, last, number)), GridReason.UNCERTAINTY)
        for number in numbers.tolist()
    ]
    best = min(grids, key=lambda grid: (len(basis.list_left_out(grid.rows)), max(grid.added, allowed)))
    if best.added > max(allowed, _NOTHING):
        reason = GridReason.CONTROL if most < 2 * count - 1 else GridReason.SUPPORT
        return Grid(best.rows, reason, best.added, allowed)
    return best


@dataclass(frozen=True, slots=True)
class Made:
    """A table, with all that it was made from and into."""

    controller: Controller  #: The control.
    basis: TableBasis  #: What is known of the axis.
    grid: Grid  #: Where the table has its rows, and why.
    #: Periodic effects that no row carries, each with the length of its shortest wave, m or rad.
    left_out: tuple[tuple[str, float], ...]
    #: meant and decoded: The table, and what the control makes of its files.
    meant: CompensationTable
    decoded: CompensationTable
    #: The table that was active during the test, and is replaced; None for none.
    active: CompensationTable | None
    files: Mapping[str, str]  #: Texts by the ends of their names.
    forecast: TableForecast  #: What the table leaves.


def make(  # noqa: PLR0913, PLR0917 - of what, on which grid, for whom
    basis: TableBasis,
    axis: Axis,
    number: str,
    place: Place,
    controller: Controller,
    own: Any,
    *,
    step: float | None = None,
    budget: Budget | None = None,
) -> Made:
    """Make a table.

    `axis`, `number`, `place`: The axis with the table that was active; the name of the job; where the table
        is asked for.
    `step`: Distance of the rows, m or rad; None for the grid that `make_grid_of` chooses.
    `budget`: Of the measuring set-up; None where nothing is known of it.

    Raises `InputError` if the control would refuse the table, or cut it off.
    """
    most = getattr(controller, "most_rows", None)
    grid = make_grid_of(basis, place, step=step, is_equidistant=controller.is_equidistant, most_rows=most)
    rows, left_out = grid.rows, basis.list_left_out(grid.rows)
    meant = make_table_of(basis.make_wanted(rows)(rows), rows, axis, number, place)
    files = controller.files(meant, own)
    decoded = controller.read(files, meant, own)
    old = axis.compensation_table
    active = None
    if old is not None:
        active = replace(
            meant,
            positions=read_only_floats(old.positions),
            forward=read_only_floats(old.values),
            reverse=read_only_floats(old.reverse or old.values),
        )
    return Made(
        controller,
        basis,
        grid,
        tuple(left_out.items()),
        meant,
        decoded,
        active,
        files,
        forecast(basis, meant, decoded, active, budget),
    )
