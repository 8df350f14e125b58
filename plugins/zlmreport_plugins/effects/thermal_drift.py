"""The zero moves while the machine or the set-up warms up."""

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
    needs_passing_time,
)
from zlmreport_plugins.effects import told_apart
from zlmreport_plugins.effects.time_constants import time_constants, warmed_up


class ThermalDrift(Effect):
    """Spindle, structure or tripod move alike for every target, approaching a final state exponentially.

    A time constant much longer than the test is a steady drift.
    """

    identifier = "thermal-drift"
    title = Words(en="Drift of the zero while warming up", de="Nullpunktdrift beim Warmlaufen")
    equation = "A·(1 − exp(−t/τ))"
    linear = (
        Parameter(
            "drift",
            "A",
            Dimension.DEVIATION,
            Words(en="drift once warm", de="Drift im warmen Zustand"),
            -50e-6,
            50e-6,
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
        en="The residuals move with time, at all positions alike, ever slower.",
        de="Die Residuen wandern mit der Zeit, an allen Positionen gleich, immer langsamer.",
    )
    confusions = (
        Confusion("datum-temperature", told_apart.TURNING_TEMPERATURE),
        Confusion("first-run", told_apart.MORE_RUNS),
        Confusion("datum-step", told_apart.DRIFT_RUN),
        Confusion("offset", told_apart.PRESET_AGAIN),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand that time passes."""
        return needs_passing_time(design)

    def grid(self, design: Design) -> FloatArray:
        """Return time constants."""
        return time_constants(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return one column: the progress of warming up."""
        return warmed_up(design, theta[0])[:, np.newaxis]
