"""Positions, deviations and counts in words: values in SI, phrases in the units that the pages print."""

from __future__ import annotations

from zlmreport.language import Words
from zlmreport.measurement.axis import Axis
from zlmreport.quantities.units import Unit


def position(axis: Axis, value: float) -> Words:
    """Return a position or a distance along the axis, m or rad, with its unit: ``250 mm``, ``90°``."""
    return _with_unit(axis.position_unit, value)


def deviation(axis: Axis, value: float) -> Words:
    """Return a deviation, m or rad, with its unit: ``12.5 µm``, ``3″``."""
    return _with_unit(axis.deviation_unit, value)


def positions(number: int) -> Words:
    """Return a number of target positions: ``1 position``, ``21 positions``."""
    if number == 1:
        return Words("1 position", "1 Position")
    return Words("{number} positions", "{number} Positionen").given(number=number)


def runs(number: int) -> Words:
    """Return a number of runs: ``1 run``, ``5 runs``."""
    if number == 1:
        return Words("1 run", "1 Durchlauf")
    return Words("{number} runs", "{number} Durchläufe").given(number=number)


def _with_unit(unit: Unit, value: float) -> Words:
    phrase = "{value}{unit}" if unit.symbol in "°″" else "{value} {unit}"
    return Words(phrase, phrase).given(value=float(unit.from_si(value)), unit=unit.symbol)
