"""Measurement sets for tests: from a printed table, simulated, and as poor as they come from a workshop."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.provenance import Provenance
from zlmreport.quantities.arrays import FloatArray, read_only_floats, read_only_integers

_NOISE = {AxisKind.LINEAR: 0.8, AxisKind.ROTARY: 0.5}  # µm, ″
_BACKLASH = 4.0
_RISE = 12.0


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
    return _in_linear_cycles(
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
    return _in_linear_cycles(
        axis, axis.position_unit.to_si(positions), axis.deviation_unit.to_si(deviations), approaches
    )


def good_tests() -> Mapping[str, MeasurementSet]:
    """Return complete tests, by what they are."""
    return {
        "a complete linear test": simulated_test(),
        "a complete rotary test": simulated_test(13, axis=Axis("C", AxisKind.ROTARY), length=360.0),
        "a complete test of described travel": simulated_test(
            11, axis=Axis("Y", travel=(0.0, 0.4), screw_pitch=0.01, signal_period=20e-6, scale_element=0.2)
        ),
    }


def poor_tests() -> Mapping[str, MeasurementSet]:
    """Return tests that fall short in one way each, by what is wrong; a standard refuses none of them."""
    full = simulated_test()
    grid = full.deviations()
    half = grid.copy()
    half[Approach.POSITIVE.index, ::2] = np.nan
    half[Approach.NEGATIVE.index, 1::2] = np.nan
    gap = grid.copy()
    gap[Approach.NEGATIVE.index, 2, 3] = np.nan
    hole = grid.copy()
    hole[Approach.POSITIVE.index, 0] = np.nan
    rotary = Axis("C", AxisKind.ROTARY, travel=(0.0, 4 * np.pi))
    return {
        "a single reading": simulated_test(1, 1, approaches=[Approach.POSITIVE]),
        "a single target": simulated_test(1),
        "two targets": simulated_test(2),
        "a single run": simulated_test(runs=1),
        "the positive direction only": simulated_test(approaches=[Approach.POSITIVE]),
        "the negative direction only": simulated_test(approaches=[Approach.NEGATIVE]),
        "a single run in one direction": simulated_test(runs=1, approaches=[Approach.POSITIVE]),
        "a missing reading": _with_deviations(full, gap),
        "a target without positive approach": _with_deviations(full, hole),
        "no target approached from both sides": _with_deviations(full, half),
        "no reading at all": _with_deviations(full, np.full_like(grid, np.nan)),
        "no deviation anywhere": _with_deviations(full, np.zeros_like(grid)),
        "a long axis with a single run": simulated_test(13, 1, length=3000.0),
        "two turns with a single run": simulated_test(17, 1, axis=rotary, length=720.0),
    }


def _with_deviations(measurements: MeasurementSet, grid: FloatArray) -> MeasurementSet:
    return _in_linear_cycles(measurements.axis, measurements.target_positions, grid, measurements.approaches)


def _in_linear_cycles(
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
