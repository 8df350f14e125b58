"""Tables across the axes of a machine: from its errors to rows, and what circles and diagonals are with them.

Straightness and squareness depend on the position of one axis and put another aside: these a control can take
away. What an angle does over an arm depends on two positions, and is left. An error within its own
uncertainty is left, too: who corrects it may make it larger.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import permutations

import numpy as np

from zlmreport.errors import InputError, Place
from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.machines.curve import AxisErrorCurve
from zlmreport.machines.kinematics import SQUARENESS, ErrorLine, find_square_slope
from zlmreport.machines.machine import MachineModel, predict
from zlmreport.machines.measured_tests import MeasuredCircle
from zlmreport.machines.residual import centre, compute_root_mean_square
from zlmreport.machines.volume import (
    Space,
    find_measured_range,
    find_measured_space,
    is_parted,
    map_volume,
    predict_diagonals,
)
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.compensation.curve import CrossTable
from zlmreport.model.compensation.making import count_steps
from zlmreport.model.effects.circle_design import AXES
from zlmreport.plugin.registry import Registry

#: Fewest rows of a table.
_ROWS = 11
_STEP_DIGITS = 9
#: What a double makes of a straight line by rounding, m.
_NOTHING = 1e-12


@dataclass(frozen=True, slots=True)
class CrossPlan:
    """The tables that are worth it, and the errors that are left."""

    tables: tuple[CrossTable, ...]
    taken: tuple[str, ...]  #: The errors that the tables hold.
    within_uncertainty: tuple[str, ...]  #: Errors that are no larger than their U.


def plan_tables(machine: MachineModel, place: Place, step: float | None = None) -> CrossPlan:
    """Return the tables of a machine, one for each pair of axes that has an error worth it.

    `step`: Between rows, m; without it that of the measured positions.

    Raises `InputError` at `place` if no error is known that a table could hold, or the step is none for it.
    """
    tables: list[CrossTable] = []
    taken: list[str] = []
    small: list[str] = []
    for moving, off in permutations(AXES, 2):
        known = [each for each in machine.curves if _is_acting_across(each.name, moving, off)]
        worth = [each for each in known if each.span > each.largest_uncertainty + _NOTHING]
        small += [each.name for each in known if each not in worth]
        if worth:
            taken += [each.name for each in worth]
            stretch = _find_stretch(machine, moving, worth, place)
            tables.append(_make_table((moving, off), worth, _make_rows(stretch, step, place)))
    if not tables:
        raise InputError.at(
            place,
            "no straightness or squareness is known that is larger than its uncertainty; there is nothing "
            "for a table across axes" + (f" ({', '.join(sorted(small))} lie within theirs)" if small else ""),
        )
    return CrossPlan(tuple(tables), tuple(taken), tuple(sorted(small)))


def plan_worthwhile(machine: MachineModel) -> CrossPlan | None:
    """Return the tables of a machine; None if no error is known that is worth one."""
    try:
        return plan_tables(machine, Place("machine"))
    except InputError:
        return None


def _is_acting_across(error: str, moving: str, off: str) -> bool:
    """Return whether an error puts one axis aside while the other moves."""
    if error in SQUARENESS:
        return find_square_slope(error)[:2] == (off, moving)
    return error == f"E{off}{moving}"


def is_held(error: str, table: CrossTable) -> bool:
    """Return whether a table holds an error; one that is a straight line holds squareness alone."""
    if not _is_acting_across(error, table.input, table.output):
        return False
    line = table.slope * (table.positions - table.positions[0])
    return bool(table.slope) if error in SQUARENESS else not np.allclose(table.values, line, 0.0, _NOTHING)


def _make_rows(stretch: tuple[float, float, float], step: float | None, place: Place) -> FloatArray:
    """Return rows over a stretch, equally far apart: as stated, or at measured places and between them."""
    low, high, spacing = stretch
    if step is None:
        count = max(round((high - low) / spacing), 1)
        count *= max(1, -(-(_ROWS - 1) // count))
        step = (high - low) / count
    else:
        count = count_steps(high - low, step, place)
    return np.asarray(np.round(low + step * np.arange(count + 1), _STEP_DIGITS), dtype=np.float64)


def _make_table(axes: tuple[str, str], curves: Sequence[AxisErrorCurve], positions: FloatArray) -> CrossTable:
    """Return the table of two axes, the one that moves and the one that is off, at some positions."""
    values, slope = np.zeros(len(positions)), 0.0
    for each in curves:
        if each.is_single:
            slope = find_square_slope(each.name)[2] * float(each.values[0])
            values = values + slope * positions
        else:
            values = values + each.weigh_nodes(positions, np.zeros(len(positions))) @ each.values
    return CrossTable(*axes, positions, values - values[0], slope)


def _find_stretch(
    machine: MachineModel, moving: str, curves: Iterable[AxisErrorCurve], place: Place
) -> tuple[float, float, float]:
    """Return over which positions a table goes, m: those that were measured; and how far these are apart."""
    for each in curves:
        if not each.is_single:
            return float(each.nodes[0]), float(each.nodes[-1]), float(np.diff(each.nodes).min())
    low, high = find_measured_range(machine, moving)
    if not high > low:
        why = (
            f"the ranges over which the errors of {moving} were measured do not overlap"
            if is_parted(machine, moving)
            else f"no error of {moving} was measured over a range"
        )
        raise InputError.at(place, f"{why}, so no table over {moving} has an end")
    return low, high, (high - low) / (_ROWS - 1)


def compensate_machine(machine: MachineModel, tables: Iterable[CrossTable]) -> MachineModel:
    """Return a machine whose control takes tables away; what is uncertain stays so."""
    curves = {each.name: each for each in machine.curves}
    for table in tables:
        name = f"E{table.output}{table.input}"
        own = curves.get(name)
        nodes = np.union1d(own.nodes if own else table.positions, table.positions)
        nothing = np.zeros(len(nodes))
        held = own.weigh_nodes(nodes, nothing) if own else np.zeros((len(nodes), 0))
        values, factor = -table.at(nodes), np.zeros((len(nodes), 0))
        if own:
            values, factor = values + held @ own.values, held @ own.factor
        # Of an error that nobody measured the angles of its axis count from where they were.
        angles = (each for each in machine.curves if each.axis == table.input and each.name[1] in "ABC")
        line = next((each.line for each in (own, *angles) if each), ErrorLine({}))
        curves[name] = AxisErrorCurve(name, nodes, values, factor, line, "table")
    return replace(machine, curves=tuple(curves.values()))


@dataclass(frozen=True, slots=True)
class CircleForecast:
    """A circle as it was measured, and as it would be with the tables."""

    name: str
    before: float  #: RMS about the centre, m.
    after: float
    numbers: tuple[tuple[str, float, float], ...]  #: Symbol, before and after, m.


@dataclass(frozen=True, slots=True)
class CrossForecast:
    """What tables will leave; lengths in m."""

    circles: tuple[CircleForecast, ...]
    diagonals: tuple[tuple[str, float, float], ...]  #: Name, E before and after.
    largest: tuple[float, float] | None  #: Largest error of the work space, before and after.


def forecast(
    machine: MachineModel, tables: Sequence[CrossTable], circles: Sequence[MeasuredCircle], registry: Registry
) -> CrossForecast:
    """Return what tables, as the control reads them, make of circles, diagonals and the work space."""
    after = compensate_machine(machine, tables)
    space = find_measured_space(machine)
    found: list[tuple[str, float, float]] = []
    largest = None
    if space:
        both = zip(predict_diagonals(machine, space), predict_diagonals(after, space), strict=True)
        found = [(one.name, one.span, other.span) for one, other in both]
        largest = _find_largest(machine, space), _find_largest(after, space)
    return CrossForecast(
        tuple(_forecast_circle(machine, after, each, registry) for each in circles), tuple(found), largest
    )


def _find_largest(machine: MachineModel, space: Space) -> float:
    return float(map_volume(machine, space).length.max())


def _forecast_circle(
    machine: MachineModel, after: MachineModel, measured: MeasuredCircle, registry: Registry
) -> CircleForecast:
    circle = measured.circle
    taken = predict(machine, circle.make_course()).values - predict(after, circle.make_course()).values
    sides: list[FloatArray] = [circle.deviation, circle.deviation - taken]
    before, now = (_collect_numbers(measured.evaluate(each, registry)) for each in sides)
    sizes = [compute_root_mean_square(centre(circle, each)) for each in sides]
    return CircleForecast(
        circle.name, sizes[0], sizes[1], tuple((name, before[name], now[name]) for name in before)
    )


def _collect_numbers(evaluations: Iterable[Evaluation]) -> Mapping[str, float]:
    return {own.quantity.notation: own.value for each in evaluations for own in each.parameters}
