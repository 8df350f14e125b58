"""Where a table has its rows, and why there (a control's limits, periods); the files by the control.

Without a stated step the rule is: no more rows than the targets support, no fewer than keep what the lines
between them miss below the uncertainty of a mean, and never more than the control takes. Targets show waves
that are two of their distances long or longer (the sampling theorem), and a wave needs `ROWS_A_PERIOD` rows:
so a grid has at most twice as many intervals as the targets. Rows at the targets themselves come first, where
a control takes rows that are unequally far apart.

A control that counts its rows from the reference point of the axis gets them in whole steps from there, to
beyond both ends of what was measured. A table that goes round a rotary axis has one turn of rows, the last at
the place of the first.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Any

import numpy as np

from zlmreport.errors import InputError, Place
from zlmreport.evaluation.uncertainty.budget import Budget
from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.axis import Axis
from zlmreport.model.compensation.basis import TableBasis
from zlmreport.model.compensation.curve import (
    TURN,
    CompensationTable,
    can_go_round,
    interpolate_rows,
    make_table_of,
    reach_beyond,
)
from zlmreport.model.compensation.forecast import TableForecast, forecast

if TYPE_CHECKING:
    from zlmreport.plugin.protocols import Controller

#: Places between two rows of the finest grid at which a grid is looked at, and grids that are.
_BETWEEN, _MOST_GRIDS = 8, 20
#: What the lines between rows miss by rounding alone, m or rad.
_NOTHING = 1e-12
#: More rows than any control takes; and what a double makes of a whole number of steps.
_MOST_STEPS, _ROUNDING = 10_000, 1e-9
#: What two places differ by that are one, rad; and the part of a finest step that counts for nothing.
_SAME = 1e-6
#: The finest step in which positions are entered at a control that does not say otherwise, mm or °.
_FINEST = 0.001


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


@dataclass(frozen=True, slots=True)
class GridRules:
    """Where a control takes rows."""

    is_equidistant: bool = False  #: Whether they must be equally far apart.
    most_rows: int | None = None  #: None for any number.
    #: From where it counts them, m or rad; None where each has its position.
    reference: float | None = None
    #: The least difference of two steps, m or rad; 0 for any.
    finest_step: float = 0.0
    is_closed: bool = False  #: Whether they go round a rotary axis.


def make_grid_of(basis: TableBasis, place: Place, *, step: float | None, rules: GridRules) -> Grid:
    """Return the grid of a table.

    `step`: Distance of the rows, m or rad; None for the rule.

    Raises `InputError` if the step is refused by `count_steps`, or does not go into a turn.
    """
    targets = basis.curve.positions
    first, last, count = float(targets[0]), float(targets[-1]), len(targets)
    places = np.union1d(np.linspace(first, last, 2 * _BETWEEN * count), targets)
    allowed = basis.expanded_uncertainty

    def judge_rows(rows: FloatArray, reason: GridReason) -> Grid:
        wanted = reach_beyond(basis.make_wanted(rows), targets, is_closed=rules.is_closed)
        lines = interpolate_rows(places, rows, wanted(rows), is_closed=rules.is_closed)
        inside = places <= (last if rules.is_closed else rows[-1]) + _NOTHING
        missed = float(np.abs(wanted(places) - lines)[:, inside].max())
        return Grid(read_only_floats(rows), reason, missed if missed > _NOTHING else 0.0, allowed)

    if step is not None:
        return judge_rows(_lay_stated_rows(first, last, step, rules, place), GridReason.STATED)
    most = rules.most_rows or 2 * count
    grids = []
    if not rules.is_equidistant and count + rules.is_closed <= most:
        at_targets = targets
        if rules.is_closed:
            at_targets = np.append(targets[targets < first + TURN - _SAME], first + TURN)
        grids.append(judge_rows(at_targets, GridReason.TARGETS))
    grids += [judge_rows(rows, GridReason.UNCERTAINTY) for rows in _list_even_rows(targets, most, rules)]
    best = min(grids, key=lambda grid: (len(basis.list_left_out(grid.rows)), max(grid.added, allowed)))
    if best.added > max(allowed, _NOTHING):
        reason = GridReason.CONTROL if most < 2 * count - 1 else GridReason.SUPPORT
        return Grid(best.rows, reason, best.added, allowed)
    return best


def _list_even_rows(targets: FloatArray, most: int, rules: GridRules) -> list[FloatArray]:
    """Return rows that are equally far apart: no fewer than targets, and at most twice as many intervals."""
    first, last, count = float(targets[0]), float(targets[-1]), len(targets)
    if rules.is_closed:
        around = round(TURN / rules.finest_step) if rules.finest_step else 0
        whole = [each for each in range(1, 2 * count + 1) if each < most and around % each == 0]
        fewest = count - (targets[-1] > first + TURN - _SAME)
        begin = first if rules.reference is None else rules.reference
        return [_step_from(begin, TURN / each, each) for each in whole if each >= min(fewest, whole[-1])]
    numbers = np.unique(np.linspace(min(count, most), min(2 * count - 1, most), _MOST_GRIDS).astype(int))
    if rules.reference is None:
        return [read_only_floats(np.linspace(first, last, number)) for number in numbers.tolist()]
    reach = max(last, rules.reference) - min(first, rules.reference)
    steps = {
        _round_up(max((last - first) / (number - 1), reach / max(most - 2, 1)), rules.finest_step)
        for number in numbers.tolist()
    }
    return [_step_over(first, last, step, rules.reference) for step in sorted(steps, reverse=True)]


def _lay_stated_rows(first: float, last: float, step: float, rules: GridRules, place: Place) -> FloatArray:
    """Return rows a stated step apart."""
    if not rules.is_closed:
        count = count_steps(last - first, step, place)
        if rules.reference is None:
            return _step_from(first, step, count)
        return _step_over(first, last, step, rules.reference)
    count = count_steps(TURN, step, place)
    begin = first if rules.reference is None else rules.reference
    if abs(count * step - TURN) <= _SAME:
        return _step_from(begin, TURN / count, count)
    if rules.is_equidistant:
        raise InputError.at(
            place, "the table goes round a whole turn, which is no whole number of such steps; state another"
        )
    return read_only_floats(np.append(_step_from(begin, step, count), begin + TURN))


def _step_from(begin: float, step: float, count: int) -> FloatArray:
    return read_only_floats(begin + step * np.arange(count + 1))


def _step_over(first: float, last: float, step: float, reference: float) -> FloatArray:
    """Return rows in whole steps from the reference point, which is one, over all that was measured."""
    low = min(0, math.floor((first - reference) / step + _ROUNDING))
    high = max(0, math.ceil((last - reference) / step - _ROUNDING))
    return read_only_floats(reference + step * np.arange(low, high + 1))


def _round_up(step: float, finest: float) -> float:
    return finest * math.ceil(step / finest - _SAME) if finest else step


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
    #: What is taken for granted of the control and the axis, for nobody stated it.
    assumed: tuple[Words, ...] = ()
    reference: float | None = None  #: From where the control counts rows, m or rad.


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
    targets, find_reference = basis.curve.positions, getattr(controller, "find_reference", None)
    rules = GridRules(
        controller.is_equidistant,
        getattr(controller, "most_rows", None),
        find_reference(axis, own) if find_reference else None,
        axis.position_unit.to_si(_FINEST),
        can_go_round(axis, targets),
    )
    grid = make_grid_of(basis, place, step=step, rules=rules)
    rows, left_out = grid.rows, basis.list_left_out(grid.rows)
    wanted = reach_beyond(basis.make_wanted(rows), targets, is_closed=rules.is_closed)
    turn_from = float(targets[0]) if rules.is_closed else None
    meant = make_table_of(wanted(rows), rows, axis, number, place, turn_from)
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
            is_closed=False,
        )
    find_assumed = getattr(controller, "list_assumed", None)
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
        tuple(find_assumed(meant, own)) if find_assumed else (),
        rules.reference,
    )
