"""The scale follows its temperature."""

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
    needs_linear_axis,
    needs_logged,
)
from zlmreport_plugins.effects import told_apart

_LOG = "axis_temperature"


class ScaleExpansion(Effect):
    """A scale that is longer than at 20 °C puts the axis too far out, in proportion to the position.

    Glass ceramic 0, glass 8, steel 10 to 12 µm/(m·K). The temperature is never centred: only ΔT from 20 °C
    predicts another day. At constant temperature this is a scale error.
    """

    identifier = "scale-expansion"
    title = Words(en="Thermal expansion of the scale", de="Wärmeausdehnung des Maßstabs")
    equation = "α·P·(T_{s} − 20 °C)"
    linear = (
        Parameter(
            "expansion",
            "α",
            Dimension.EXPANSION,
            Words(
                en="coefficient of expansion, less the one compensated",
                de="nicht kompensierter Ausdehnungskoeffizient",
            ),
            0.0,
            25e-6,
        ),
    )
    shape = Shape.TIME
    look = Words(
        en="The residuals fan out over the position, and the slope follows the temperature of the scale.",
        de="Die Residuen fächern über der Position auf, und die Steigung folgt der Temperatur des Maßstabs.",
    )
    confusions = (
        Confusion("thermal-growth", told_apart.TURNING_TEMPERATURE),
        Confusion("screw-expansion", told_apart.SCREW_SENSOR),
        Confusion("scale-error", told_apart.WARMER_AXIS),
        Confusion("air-index", told_apart.OTHER_AIR),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the temperature of the scale."""
        return needs_linear_axis(design) or needs_logged(design, _LOG)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: position times temperature above 20 °C."""
        return (design.position * above_reference_temperature(design.conditions[_LOG]))[:, np.newaxis]
