"""The zero follows the temperature of the axis."""

from __future__ import annotations

import numpy as np

from zlmreport.plugin import (
    Confusion,
    Design,
    Dimension,
    Effect,
    FloatArray,
    Parameter,
    Shape,
    Words,
    above_reference_temperature,
    needs_logged,
)
from zlmreport_plugins.effects import told_apart

_LOG = "axis_temperature"


class DatumTemperature(Effect):
    """The place where scale or optics are fixed moves with the temperature, the same for every target."""

    identifier = "datum-temperature"
    title = Words(en="Zero that follows the temperature", de="Nullpunkt folgt der Temperatur")
    equation = "k·(T_{s} − 20 °C)"
    linear = (
        Parameter(
            "sensitivity",
            "k",
            Dimension.DEVIATION_PER_KELVIN,
            Words(en="motion of the zero per kelvin", de="Bewegung des Nullpunkts je Kelvin"),
            -20e-6,
            20e-6,
        ),
    )
    shape = Shape.TIME
    look = Words(
        en="The residuals follow the logged temperature, at all positions alike.",
        de="Die Residuen folgen der aufgezeichneten Temperatur, an allen Positionen gleich.",
    )
    confusions = (Confusion("thermal-drift", told_apart.TURNING_TEMPERATURE),)

    def untestable(self, design: Design) -> Words | None:
        """Demand the temperature of the axis."""
        return needs_logged(design, _LOG)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: temperature above 20 °C."""
        return above_reference_temperature(design.conditions[_LOG])[:, np.newaxis]
