"""The air in the beam, as it was logged."""

from __future__ import annotations

from zlmreport.correction.refractive_index import index_change
from zlmreport.measurement.conditions import STATE_OF_AIR
from zlmreport.model.design import Design
from zlmreport.quantities.arrays import FloatArray

LOGS = STATE_OF_AIR


def logged_index_change(design: Design) -> FloatArray:
    """Return Δn at each reading, against standard air."""
    temperature, pressure, humidity = (design.conditions[name] for name in LOGS)
    return index_change(temperature, pressure, humidity)
