"""Sample tests for the kit: printed, simulated, good ones, and as poor as they come."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats, read_only_integers
from zlmreport.measurement.axis import Axis, AxisKind, PositionTable
from zlmreport.measurement.circle import NominalCircle
from zlmreport.measurement.measurand import CIRCLE, DISPLACEMENT, Coordinate, Measurand, list_measurands_of
from zlmreport.measurement.measurement_set import MeasurementSet, join_lines
from zlmreport.measurement.provenance import Provenance
from zlmreport.measurement.units import HOUR, REFERENCE_TEMPERATURE
from zlmreport.model.effects.design import Design
from zlmreport.model.planning.methods import Method, list_visits, make_planned_design, plan_path
from zlmreport.model.planning.targets import compute_target_positions
from zlmreport.plugin.protocols import Standard

_NOISE = {AxisKind.LINEAR: 0.8, AxisKind.ROTARY: 0.5}  # µm, ″
_BACKLASH = 4.0
_RISE = 12.0

_BETWEEN = np.linspace(0.0, 1.0, 11)
_ROWS = tuple(_BETWEEN.tolist())
_LINEAR = Axis(
    "X",
    AxisKind.LINEAR,
    (0.0, 1.0),
    screw_pitch=10e-3,
    signal_period=20e-6,
    scale_element=0.25,
    pole_pitch=24e-3,
    compensation_table=PositionTable(_ROWS, tuple((8e-6 * np.sin(4.0 * _BETWEEN) * _BETWEEN).tolist())),
    angular_errors=PositionTable(_ROWS, tuple((30e-6 * np.cos(5.0 * _BETWEEN)).tolist())),
    abbe_offset=0.2,
)
_CIRCLE = Axis("XY", quantity=CIRCLE, circle=NominalCircle("XY", 0.15, 1 / 60))
_ROTARY = Axis(
    "C",
    AxisKind.ROTARY,
    (0.0, 2 * math.pi),
    screw_pitch=math.radians(3.0),
    signal_period=math.radians(0.02),
    compensation_table=PositionTable(
        tuple((2 * math.pi * _BETWEEN).tolist()), tuple((20e-6 * np.sin(9.0 * _BETWEEN)).tolist())
    ),
)


def bidirectional_test(
    target_positions: ArrayLike,
    positive: ArrayLike,
    negative: ArrayLike,
    *,
    axis: Axis | None = None,
) -> MeasurementSet:
    """Return the test that a printed table shows, run by run: upwards, then downwards.

    Parameters
    ----------
    target_positions : (m,) array
        P_i, rising, mm (° on a rotary axis).
    positive, negative : (m, n) arrays
        The deviations x_ij of each approach, a row for each target and a column for each run,
        µm (″ on a rotary axis); NaN where the table has none.
    axis
        The axis under test; a linear one, X, if it is not given.
    """
    axis = axis or Axis("X")
    deviations = np.stack([np.asarray(positive, dtype=float), np.asarray(negative, dtype=float)])
    return _order_in_linear_cycles(
        axis,
        axis.position_unit.to_si(np.asarray(target_positions, dtype=float)),
        axis.deviation_unit.to_si(deviations),
        tuple(Approach),
    )


def simulated_test(
    targets: int = 9,
    runs: int = 5,
    *,
    axis: Axis | None = None,
    length: float = 400.0,
    approaches: Sequence[Approach] = tuple(Approach),
) -> MeasurementSet:
    """Return a test of an axis with a scale error, a periodic error, lost motion and scatter.

    The same arguments give the same test.

    Parameters
    ----------
    targets, runs
        m and n.
    axis
        The axis under test; a linear one, X, if it is not given.
    length
        From the first target to the last, mm (°).
    approaches
        The directions that are measured.
    """
    axis = axis or Axis("X")
    positions = np.linspace(0.0, length, targets)
    share = positions / length
    means = _RISE * share + 3.0 * np.sin(7.0 * share + 0.4)
    scatter = np.random.default_rng(1).normal(0.0, _NOISE[axis.kind], (len(Approach), targets, runs))
    deviations = means[:, np.newaxis] + scatter
    deviations[Approach.POSITIVE.index] += _BACKLASH / 2
    deviations[Approach.NEGATIVE.index] -= _BACKLASH / 2
    return _order_in_linear_cycles(
        axis, axis.position_unit.to_si(positions), axis.deviation_unit.to_si(deviations), approaches
    )


def good_tests(standard: Standard | None = None) -> Mapping[str, MeasurementSet]:
    """Return complete tests of what a standard evaluates, by what they are; of positioning without one.

    They are along a length; where that is closed, round a circle; and on several lines where the standard
    evaluates nothing but lines that have names: along lengths, or over time.
    """
    if standard and is_of_circles(standard):
        return {"a complete circle": _simulate_circle(), "an arc of a circle": _simulate_circle(length=200.0)}
    if standard and (of := _find_joining(standard)):
        return {"all lines": _simulate_on_lines(of, of.test_names, _simulate_lines(of)())}
    return {
        "a complete linear test": simulated_test(),
        "a complete rotary test": simulated_test(13, axis=Axis("C", AxisKind.ROTARY), length=360.0),
        "a complete test of described travel": simulated_test(
            11, axis=Axis("Y", travel=(0.0, 0.4), screw_pitch=0.01, signal_period=20e-6, scale_element=0.2)
        ),
    }


def is_of_circles(standard: Standard) -> bool:
    """Return whether a standard evaluates what is measured round a circle."""
    return any(each.is_closed for each in list_measurands_of(standard))


def names_of_lines(standard: Standard) -> tuple[str, ...]:
    """Return the names of the lines of which alone a standard makes anything; empty where it needs none."""
    of = _find_joining(standard)
    return of.test_names if of else ()


def _find_joining(standard: Standard) -> Measurand | None:
    """Return what a standard evaluates from named lines, where it evaluates nothing else."""
    found = list_measurands_of(standard)
    return found[0] if all(each.joins_tests and each.test_names for each in found) else None


def _simulate_lines(of: Measurand) -> Callable[..., MeasurementSet]:
    """Return what simulates one of the lines that are evaluated together."""
    is_over_time = of.of_lines is not None and of.of_lines.coordinate is Coordinate.TIME
    return _simulate_over_time if is_over_time else simulated_test


def _simulate_over_time(
    targets: int = 49,
    runs: int = 1,
    *,
    length: float = 24.0,
    approaches: Sequence[Approach] = (Approach.POSITIVE,),
) -> MeasurementSet:
    """Return readings of one sensor over time, with temperatures beside them; `length` in hours."""
    axis = Axis("X", quantity=DISPLACEMENT)
    measurements = simulated_test(targets, runs, axis=axis, length=length, approaches=approaches)
    time = measurements.target_positions[measurements.target]
    warmth = np.sin(2 * np.pi * time / HOUR.to_si(24.0))
    conditions = {
        "air_temperature": REFERENCE_TEMPERATURE + 1.2 * warmth,
        "axis_temperature": REFERENCE_TEMPERATURE + 0.5 + 0.4 * warmth,
    }
    return replace(
        measurements,
        time=read_only_floats(time),
        conditions={name: read_only_floats(values) for name, values in conditions.items()},
    )


def _simulate_on_lines(of: Measurand, names: Sequence[str], line: MeasurementSet) -> MeasurementSet:
    """Return lines that were measured alike and differ in their readings, together."""
    lines = {
        name: replace(
            line,
            axis=replace(line.axis, name=name, quantity=of.of_lines),
            deviation=read_only_floats(line.deviation * (1 + of.test_names.index(name) / 10)),
        )
        for name in names
    }
    return join_lines(Axis(" ".join(names), quantity=of), lines)


def _simulate_circle(
    targets: int = 36,
    runs: int = 2,
    *,
    length: float = 350.0,
    approaches: Sequence[Approach] = tuple(Approach),
) -> MeasurementSet:
    """Return a simulated test of a circle; `length` is its arc, °."""
    return simulated_test(targets, runs, axis=_CIRCLE, length=length, approaches=approaches)


def poor_tests(standard: Standard | None = None) -> Mapping[str, MeasurementSet]:
    """Return tests that fall short in one way each, by what is wrong; a standard refuses none of them.

    `standard`: What they are tests for, as of `good_tests`.
    """
    if standard and (of := _find_joining(standard)):
        first, line = of.test_names[0], _simulate_lines(of)
        everywhere = _simulate_poor_lines(line, is_along_a_length=line is simulated_test)
        one = {f"{first} alone": _simulate_on_lines(of, (first,), line())}
        return {
            **one,
            **{kind: _simulate_on_lines(of, of.test_names, test) for kind, test in everywhere.items()},
        }
    closed = standard is not None and is_of_circles(standard)
    return _simulate_poor_lines(_simulate_circle if closed else simulated_test, is_along_a_length=not closed)


def _simulate_poor_lines(
    simulated: Callable[..., MeasurementSet], *, is_along_a_length: bool
) -> Mapping[str, MeasurementSet]:
    """Return tests of one line that fall short in one way each; `simulated` makes complete ones."""
    full = simulated(approaches=tuple(Approach))
    grid = full.deviations()
    half = grid.copy()
    half[Approach.POSITIVE.index, ::2] = np.nan
    half[Approach.NEGATIVE.index, 1::2] = np.nan
    gap = grid.copy()
    gap[Approach.NEGATIVE.index, 2, -1] = np.nan
    hole = grid.copy()
    hole[Approach.POSITIVE.index, 0] = np.nan
    rotary = Axis("C", AxisKind.ROTARY, travel=(0.0, 4 * np.pi))
    of_lengths = {
        "a long axis with a single run": simulated_test(13, 1, length=3000.0),
        "two turns with a single run": simulated_test(17, 1, axis=rotary, length=720.0),
    }
    return {
        "a single reading": simulated(1, 1, approaches=[Approach.POSITIVE]),
        "a single target": simulated(1),
        "two targets": simulated(2),
        "a single run": simulated(runs=1),
        "the positive direction only": simulated(approaches=[Approach.POSITIVE]),
        "the negative direction only": simulated(approaches=[Approach.NEGATIVE]),
        "a single run in one direction": simulated(runs=1, approaches=[Approach.POSITIVE]),
        "a missing reading": _replace_deviations(full, gap),
        "a target without positive approach": _replace_deviations(full, hole),
        "no target approached from both sides": _replace_deviations(full, half),
        "no reading at all": _replace_deviations(full, np.full_like(grid, np.nan)),
        "no deviation anywhere": _replace_deviations(full, np.zeros_like(grid)),
        **(of_lengths if is_along_a_length else {}),
    }


def _replace_deviations(measurements: MeasurementSet, grid: FloatArray) -> MeasurementSet:
    return _order_in_linear_cycles(
        measurements.axis, measurements.target_positions, grid, measurements.approaches
    )


def _order_in_linear_cycles(
    axis: Axis, target_positions: FloatArray, grid: FloatArray, approaches: Sequence[Approach]
) -> MeasurementSet:
    """Return readings in the order of the linear method: in each run all targets upwards, then downwards."""
    _, targets, runs = grid.shape
    order = [
        (approach, target, run)
        for run in range(runs)
        for approach in approaches
        for target in (range(targets) if approach is Approach.POSITIVE else reversed(range(targets)))
    ]
    approach, target, run = (np.array(column) for column in zip(*order, strict=True))
    return MeasurementSet(
        axis=axis,
        target_positions=read_only_floats(target_positions),
        target=read_only_integers(target),
        approach=read_only_integers(approach),
        run=read_only_integers(run + 1),
        deviation=read_only_floats(grid[np.where(approach == Approach.POSITIVE, 0, 1), target, run]),
        provenance=Provenance(source="zlmreport.testing"),
    )


@cache
def full_designs() -> Mapping[str, Design]:
    """Return tests with every log and every key of the axis that are known by name, by what they are."""
    return {
        "a complete linear test": _complete(_LINEAR, Method.LINEAR),
        "a complete pendulum test": _complete(_LINEAR, Method.PENDULUM),
        "a complete quasi-pilgrim test": _complete(_LINEAR, Method.QUASI_PILGRIM),
        "a complete rotary test": _complete(_ROTARY, Method.LINEAR),
        "a complete test with a pause": _add_pause(_complete(_LINEAR, Method.LINEAR)),
    }


@cache
def poor_designs() -> Mapping[str, Design]:
    """Return tests that lack much, by what they are; no effect fails on them, and many cannot be tested."""
    bare, turn = Axis("X"), Axis("C", AxisKind.ROTARY)
    five = np.linspace(0.0, 0.4, 5)
    return {
        "a test without logs and times": _number_design(_plan_design(bare, Method.LINEAR, five, 5)),
        "a test in one direction": _plan_design(bare, Method.UNIDIRECTIONAL, five, 5),
        "a test of one run": _plan_design(bare, Method.LINEAR, five, 1),
        "a test of two targets": _plan_design(bare, Method.LINEAR, five[:2], 3),
        "a test of one target": _plan_design(bare, Method.LINEAR, five[1:2], 3),
        "a single reading": _plan_design(bare, Method.UNIDIRECTIONAL, five[1:2], 1),
        "a rotary axis without logs": _plan_design(turn, Method.LINEAR, np.linspace(0.0, 0.7, 8), 3),
    }


def _complete(axis: Axis, method: Method) -> Design:
    random = np.random.default_rng(20)
    targets = compute_target_positions(axis.travel or (0.0, 1.0), 21, axis.screw_pitch or 0.0, random)
    design = _plan_design(axis, method, targets, 5)
    share = design.time / design.duration
    conditions = {
        "axis_temperature": REFERENCE_TEMPERATURE + 0.4 + 1.5 * share**0.7,
        "screw_temperature": REFERENCE_TEMPERATURE + 0.8 - 4.0 * np.expm1(-2.0 * share),
        "air_temperature": REFERENCE_TEMPERATURE - 0.3 + 0.6 * np.sin(5.0 * share),
        "material_temperature": REFERENCE_TEMPERATURE + 0.2 + 0.5 * share,
        "air_pressure": 1005e2 + 120.0 * share**2,
        "relative_humidity": 0.45 + 0.05 * np.cos(3.0 * share),
        "face": np.where(design.target % 2 == 0, 1.0, -1.0),
    }
    return replace(design, conditions={name: read_only_floats(log) for name, log in conditions.items()})


def _add_pause(design: Design) -> Design:
    """Return a test that stood still for half its time in the middle."""
    half = design.duration / 2
    later = np.where(design.time > float(design.time.min()) + half, half, 0.0)
    return replace(design, time=read_only_floats(design.time + later))


def _plan_design(axis: Axis, method: Method, targets: FloatArray, runs: int) -> Design:
    return make_planned_design(
        axis, targets, list_visits(plan_path(method, targets.tolist(), runs, 5e-3)), 0.05, 4.0
    )


def _number_design(design: Design) -> Design:
    count = read_only_floats(np.arange(len(design.time)))
    return replace(design, time=count, time_is_counted=True)
