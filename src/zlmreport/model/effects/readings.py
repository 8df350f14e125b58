"""What each name in a formula stands for: readings, logs, tables and keys of the axis."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import cast

import numpy as np

from zlmreport.job.formula import UnitOf, find_column_of
from zlmreport.job.formula_parts import AXIS_KEYS
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.axis import PositionTable
from zlmreport.measurement.measurement_set import CONDITIONS
from zlmreport.measurement.refractive_index import STANDARD_HUMIDITY, index_change
from zlmreport.model.effects.design import Design

#: Logs by which the refractive index of air is known: 30 % of relative humidity change it by 0.26 µm/m, as
#: much as 1 hPa, so that it may stay where none was logged.
LOGS_OF_AIR = ("air_temperature", "air_pressure")
#: Logged temperatures of what carries the position.
_TEMPERATURES = ("axis_temperature", "screw_temperature", "material_temperature")


def collect_readings_of(
    design: Design, names: Iterable[str], units: Mapping[str, UnitOf]
) -> dict[str, FloatArray | float]:
    """Return the values of names, SI but temperatures in °C; positions in any case.

    `units`: Of the names.
    """
    found: dict[str, FloatArray | float] = {"P": design.position}
    for name in names:
        if name in _OF_DESIGN:
            found[name] = _OF_DESIGN[name](design)
        elif name in AXIS_KEYS:
            found[name] = float(getattr(design.axis, name))
        elif name == "v":
            found[name] = design.conditions[name] / units[name].per_si
        elif column := find_column_of(name):
            kind = CONDITIONS.get(column)
            found[name] = design.rates[column] / (1.0 if kind is None else kind.unit.si)
        else:
            kind, log = CONDITIONS.get(name), design.conditions[name]
            found[name] = log if kind is None else kind.unit.from_si(log)
    return found


def find_logged_rise(design: Design) -> float | None:
    """Return the largest rise or fall of a logged temperature of the axis, K; None where none was logged."""
    rises = [float(np.ptp(design.conditions[name])) for name in _TEMPERATURES if name in design.conditions]
    return max(rises, default=None)


def _read_compensation(design: Design, rows: int) -> FloatArray:
    """Return what the table says at each reading, or some rows beside it."""
    table = cast("PositionTable", design.axis.compensation_table)
    places = design.position + rows * table.interval if rows else design.position
    return table.at(places, design.direction)


def _compute_index_change(design: Design) -> FloatArray:
    """Return the change of the air's index, with a humidity that stays where none was logged."""
    temperature, pressure = (design.conditions[name] for name in LOGS_OF_AIR)
    humidity = design.conditions.get("relative_humidity", np.full_like(temperature, STANDARD_HUMIDITY))
    return index_change(temperature, pressure, humidity)


_OF_DESIGN: Mapping[str, Callable[[Design], FloatArray | float]] = {
    "P": lambda design: design.position,
    "D": lambda design: design.direction,
    "t": lambda design: design.time,
    "run": lambda design: design.run.astype(np.float64),
    "since_reversal": lambda design: design.since_reversal,
    "middle": lambda design: design.middle,
    "half_travel": lambda design: design.length / 2,
    "travel_first": lambda design: (design.axis.travel or design.span)[0],
    "travel_last": lambda design: (design.axis.travel or design.span)[1],
    "turn": lambda _: 2 * np.pi,
    "air_index": _compute_index_change,
    "compensation": lambda design: _read_compensation(design, 0),
    "compensation_next": lambda design: _read_compensation(design, 1),
    "compensation_before": lambda design: _read_compensation(design, -1),
    "angular_error": lambda design: cast("PositionTable", design.axis.angular_errors).at(design.position),
}
