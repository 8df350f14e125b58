"""The screw follows its temperature, away from the bearing that holds it."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    Confusion,
    Design,
    Dimension,
    Effect,
    FloatArray,
    Options,
    Parameter,
    Shape,
    Words,
    above_reference_temperature,
    needs_linear_axis,
    needs_logged,
)
from zlmreport_plugins.effects import told_apart

_LOG = "screw_temperature"


class BearingOptions(Options):
    """Where the screw is held."""

    fixed_bearing: Literal["first", "last"] = Field(
        "first",
        description="End of the travel at which the fixed bearing is: the first position, or the last.",
    )


class ScrewExpansion(Effect):
    """A screw measured by its own rotation grows with the heat of nut and bearings: 10 to 12 µm/(m·K).

    It grows away from its fixed bearing; a wrong origin spoils the fit, so both ends are tried.
    """

    identifier = "screw-expansion"
    title = Words(en="Thermal expansion of the screw", de="Wärmeausdehnung der Spindel")
    equation = "α·(P − P_{f})·(T_{b} − 20 °C)"
    linear = (
        Parameter(
            "expansion",
            "α",
            Dimension.EXPANSION,
            Words(en="coefficient of expansion of the screw", de="Ausdehnungskoeffizient der Spindel"),
            0.0,
            25e-6,
        ),
    )
    shape = Shape.TIME
    look = Words(
        en="The residuals fan out from one end of the travel as the screw warms up.",
        de="Die Residuen fächern von einem Ende des Verfahrwegs her auf, während die Spindel warm wird.",
    )
    confusions = (
        Confusion("thermal-growth", told_apart.TURNING_TEMPERATURE),
        Confusion("scale-expansion", told_apart.SCREW_SENSOR),
    )
    options = BearingOptions

    def __init__(self, settings: BearingOptions | None = None) -> None:
        self.settings = settings or BearingOptions()
        self.fixed_bearing = self.settings.fixed_bearing

    def with_settings(self, settings: BearingOptions) -> Effect:
        """Return the effect with the bearing at the stated end."""
        return ScrewExpansion(settings)

    def forms(self) -> tuple[Effect, ...]:
        """Return the bearing at either end."""
        return tuple(ScrewExpansion(BearingOptions(fixed_bearing=end)) for end in ("first", "last"))

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the temperature of the screw."""
        return needs_linear_axis(design) or needs_logged(design, _LOG)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: distance from the bearing times temperature above 20 °C."""
        first, last = design.axis.travel or design.span
        bearing = first if self.fixed_bearing == "first" else last
        return ((design.position - bearing) * above_reference_temperature(design.conditions[_LOG]))[
            :, np.newaxis
        ]
