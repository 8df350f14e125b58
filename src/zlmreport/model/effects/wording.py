"""Deviations, positions and times in the sentences on a model, rounded and with their unit."""

from __future__ import annotations

from zlmreport.language import Words
from zlmreport.language.numbers import write_significant
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.units import SECONDS_PER_MINUTE, Unit, write_behind
from zlmreport.model.effects.design import Design

_QUANTITY = Words("{value}{unit}")
_READING = Words("{position}, {arrow}, run {run}")
_COUNTED = Words("{value} readings")
_LONG = 600.0
#: m or rad: a deviation below it is the rounding of doubles.
_ROUNDING = 1e-14


def quantity(unit: Unit, value: float, digits: int = 3) -> Words:
    """Return an SI value in a unit, rounded to some digits."""
    number = write_significant(unit.from_si(value), digits)
    return _QUANTITY.given(value=number, unit=write_behind(unit.symbol))


def deviation(axis: Axis, value: float) -> Words:
    """Return a deviation given in m or rad."""
    return quantity(axis.deviation_unit, 0.0 if abs(value) < _ROUNDING else value, 2)


def position(axis: Axis, value: float) -> Words:
    """Return a position on the axis given in m or rad."""
    return quantity(axis.position_unit, value, 4)


def length(axis: Axis, value: float) -> Words:
    """Return a distance along the axis given in m or rad."""
    return quantity(axis.position_unit, value)


def span_of_time(design: Design, value: float) -> Words:
    """Return a time given in s, or in readings where the design counts them."""
    if design.time_is_counted:
        return _COUNTED.given(value=write_significant(value, 2))
    if value >= _LONG:
        return _QUANTITY.given(
            value=write_significant(value / SECONDS_PER_MINUTE, 3), unit=write_behind("min")
        )
    return _QUANTITY.given(value=write_significant(value, 3), unit=write_behind("s"))


def cell(design: Design, reading: int) -> Words:
    """Return target and direction of a reading."""
    return Words("{position}, {arrow}").given(
        position=position(design.axis, float(design.position[reading])), arrow=_write_arrow(design, reading)
    )


def reading_at(design: Design, reading: int) -> Words:
    """Return target, direction and run of a reading."""
    return _READING.given(
        position=position(design.axis, float(design.position[reading])),
        arrow=_write_arrow(design, reading),
        run=int(design.cycle[reading]),
    )


def _write_arrow(design: Design, reading: int) -> str:
    return "↑" if design.direction[reading] > 0 else "↓"
