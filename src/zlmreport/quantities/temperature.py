"""Temperatures that others are counted from."""

from __future__ import annotations

from typing import TypeVar

from zlmreport.quantities.arrays import FloatArray

#: 0 °C in kelvin.
ZERO_CELSIUS = 273.15
#: 20 °C in kelvin, the standard reference temperature of ISO 1.
REFERENCE_TEMPERATURE = 293.15

_Value = TypeVar("_Value", float, FloatArray)


def above_reference(temperature: _Value) -> _Value:
    """Return ΔT = T − 20 °C, K, of a temperature in kelvin."""
    return temperature - REFERENCE_TEMPERATURE
