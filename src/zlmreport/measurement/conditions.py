"""The conditions that are known by name; any other is kept as it was found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from zlmreport.language import Words
from zlmreport.quantities.units import (
    CELSIUS,
    HECTOPASCAL,
    PERCENT,
    PRESSURE_UNITS,
    RATIO_UNITS,
    TEMPERATURE_UNITS,
    Scale,
)


@dataclass(frozen=True, slots=True)
class ConditionKind:
    """A kind of condition.

    Attributes
    ----------
    units
        The units that files may give it in, by their spellings.
    unit
        The one that is meant where a file names none, and in which messages speak.
    lowest, highest
        In that unit: beyond, the value is a mistake and not the condition of a measurement.
    """

    units: Mapping[str, Scale]
    unit: Scale
    lowest: float
    highest: float


#: What the conditions are called on pages.
CONDITION_NAMES: Mapping[str, Words] = MappingProxyType(
    {
        "axis_temperature": Words(
            en="Temperature of the machine's scale", de="Temperatur des Maschinenmaßstabs"
        ),
        "screw_temperature": Words(en="Temperature of the screw", de="Temperatur der Spindel"),
        "air_temperature": Words(en="Air temperature", de="Lufttemperatur"),
        "material_temperature": Words(en="Material temperature", de="Materialtemperatur"),
        "air_pressure": Words(en="Air pressure", de="Luftdruck"),
        "relative_humidity": Words(en="Relative humidity", de="Relative Luftfeuchte"),
    }
)

#: What the refractive index of air follows from.
STATE_OF_AIR = ("air_temperature", "air_pressure", "relative_humidity")

_TEMPERATURE = ConditionKind(TEMPERATURE_UNITS, CELSIUS, -50.0, 150.0)
_PRESSURE = ConditionKind(PRESSURE_UNITS, HECTOPASCAL, 0.0, 1200.0)
_HUMIDITY = ConditionKind(RATIO_UNITS, PERCENT, 0.0, 100.0)

#: By name; `axis_temperature` is that of the machine's scale.
CONDITIONS: Mapping[str, ConditionKind] = MappingProxyType(
    {
        "axis_temperature": _TEMPERATURE,
        "screw_temperature": _TEMPERATURE,
        "air_temperature": _TEMPERATURE,
        "material_temperature": _TEMPERATURE,
        "air_pressure": _PRESSURE,
        "relative_humidity": _HUMIDITY,
    }
)
