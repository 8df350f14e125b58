"""Plates whose heights are known, as a carriage reads them along the lines of a union jack."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from installed import registry
from zlmreport.measurement.measurement_set import join_lines
from zlmreport.plugin import Axis, Evaluation, MeasurementSet
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import bidirectional_test
from zlmreport_plugins.union_jack_lines import FLATNESS, LINE, LINES, PLACES

ARCSECOND = np.pi / 180 / 3600
#: Feet and sides, mm: diagonals of 1000 mm.
FOOT, SIDES = 100.0, (800.0, 600.0)


def line(name: str, readings: Sequence[float], foot: float = FOOT) -> MeasurementSet:
    """Return the readings of one line, arc seconds, in the order of stations."""
    up = np.array(readings, dtype=float)[:, np.newaxis]
    stations = foot * np.arange(1, len(up) + 1)
    return bidirectional_test(stations, up, np.full_like(up, np.nan), axis=Axis(name, quantity=LINE))


def read(
    height: Callable[[float, float], float], names: Sequence[str] = LINES, zero: float = 5.0
) -> dict[str, MeasurementSet]:
    """Return what a carriage reads on a plate: heights, µm, at mm towards the east and the north."""
    lines = {}
    for name in names:
        first, last = (np.array(PLACES[point]) * SIDES for point in name.split("-"))
        steps = round(float(np.linalg.norm(last - first)) / FOOT)
        heights = [height(*(first + (last - first) * step / steps)) for step in range(steps + 1)]
        lines[name] = line(name, zero + np.diff(heights) * 1e-3 / FOOT / ARCSECOND)
    return lines


def evaluated(lines: Mapping[str, MeasurementSet]) -> Evaluation:
    """Return the evaluation of lines by the standard."""
    standard = registry().standard("union-jack")
    return evaluate(standard, join_lines(Axis("plate", quantity=FLATNESS), lines), standard.options(), {})


def values(lines: Mapping[str, MeasurementSet]) -> dict[str, float]:
    """Return the parameters by symbol, µm."""
    return {each.quantity.symbol: each.value * 1e6 for each in evaluated(lines).parameters}
