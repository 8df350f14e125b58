"""Scale or screw grow while the axis warms up, and no log says how warm it is."""

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
    needs_linear_axis,
    needs_passing_time,
)
from zlmreport_plugins.effects import told_apart
from zlmreport_plugins.effects.time_constants import time_constants, warmed_up


class ThermalGrowth(Effect):
    """A length that approaches its warm state exponentially: a fan over the position that opens with time.

    In pendulum and quasi-pilgrim tests time runs along with the position, and nearly all of this hides in
    the scale error.
    """

    identifier = "thermal-growth"
    title = Words(en="Growth while warming up", de="Längung beim Warmlaufen")
    equation = "A·P·(1 − exp(−t/τ))"
    linear = (
        Parameter(
            "growth",
            "A",
            Dimension.SLOPE,
            Words(en="growth per position once warm", de="Längung je Position im warmen Zustand"),
            -100e-6,
            100e-6,
        ),
    )
    searched = (
        Parameter(
            "time_constant",
            "τ",
            Dimension.TIME,
            Words(en="time constant", de="Zeitkonstante"),
            60.0,
            14_400.0,
        ),
    )
    shape = Shape.TIME
    look = Words(
        en="The residuals fan out over the position while time passes, ever slower.",
        de="Die Residuen fächern mit der Zeit über der Position auf, immer langsamer.",
    )
    confusions = (
        Confusion("screw-expansion", told_apart.TURNING_TEMPERATURE),
        Confusion("scale-expansion", told_apart.TURNING_TEMPERATURE),
        Confusion("scale-error", told_apart.COLD_RESTART),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and that time passes."""
        return needs_linear_axis(design) or needs_passing_time(design)

    def grid(self, design: Design) -> FloatArray:
        """Return time constants."""
        return time_constants(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return one column: position times the progress of warming up."""
        return (design.position * warmed_up(design, theta[0]))[:, np.newaxis]
