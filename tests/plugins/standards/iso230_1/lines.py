"""Measured lines for the tests of ISO 230-1."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from installed import registry
from zlmreport.measurement.measurement_set import join_lines
from zlmreport.plugin import Axis, Evaluation, MeasurementSet, error_named
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import bidirectional_test

_HP = Path(__file__).parents[3] / "data" / "straightness" / "hp_5528a.csv"


def axis_of(symbol: str, at: Sequence[tuple[str, float]] = ()) -> Axis:
    """Return the axis of an error; `at` in m."""
    error = error_named(symbol)
    return Axis(error.axis, quantity=error.measurand, error=symbol, at=tuple(at))


def line(
    symbol: str,
    positions: ArrayLike,
    up: ArrayLike,
    down: ArrayLike | None = None,
    at: Sequence[tuple[str, float]] = (),
) -> MeasurementSet:
    """Return a measured line: positions in mm, a row for each position and a column for each run."""
    forward = np.asarray(up, dtype=float)
    forward = forward[:, np.newaxis] if forward.ndim == 1 else forward
    back = np.full_like(forward, np.nan) if down is None else np.asarray(down, dtype=float)
    back = back[:, np.newaxis] if back.ndim == 1 else back
    return bidirectional_test(positions, forward, back, axis=axis_of(symbol, at))


def hp(axis: int) -> tuple[list[float], list[float]]:
    """Return positions and readings of one of the two printed lines."""
    with _HP.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(each for each in file if not each.startswith("#")))
    of_axis = [row for row in rows if row["axis"] == str(axis)]
    return [float(row["target"]) for row in of_axis], [float(row["reading"]) for row in of_axis]


def evaluated(measurements: MeasurementSet, **keys: Any) -> Evaluation:
    """Evaluate a measured line, or what follows from several."""
    axis = measurements.axis
    standard = registry().standard("iso230-1:2012").of_error(error_named(axis.error))
    return evaluate(standard, measurements, standard.options.model_validate(keys), {})


def values(measurements: MeasurementSet, **keys: Any) -> dict[str, float]:
    """Return the parameters in the units of the results file."""
    usual = measurements.axis.deviation_unit
    return {
        each.quantity.symbol: each.quantity.unit_or(usual).from_si(each.value)
        for each in evaluated(measurements, **keys).parameters
    }


def together(symbol: str, **tests: MeasurementSet) -> MeasurementSet:
    """Return what follows from measured lines."""
    return join_lines(axis_of(symbol), tests)
