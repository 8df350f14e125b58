"""The air in the beam, as it was logged."""

from __future__ import annotations

from zlmreport.plugin import STATE_OF_AIR, Design, FloatArray, index_change

LOGS = STATE_OF_AIR


def logged_index_change(design: Design) -> FloatArray:
    """Return Δn at each reading, against standard air."""
    temperature, pressure, humidity = (design.conditions[name] for name in LOGS)
    return index_change(temperature, pressure, humidity)
