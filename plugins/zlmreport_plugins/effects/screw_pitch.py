"""The screw's lead varies within each turn."""

from __future__ import annotations

import numpy as np

from zlmreport.plugin import (
    Axis,
    Confusion,
    Design,
    Dimension,
    Effect,
    FloatArray,
    Parameter,
    Shape,
    Words,
    harmonic_columns,
    harmonic_parameters,
    needs_linear_axis,
    needs_whole_period,
)
from zlmreport_plugins.effects import told_apart
from zlmreport_plugins.effects.harmonic_options import COMBINATIONS, HarmonicOptions

_KEY = "axis.screw_pitch"
_LARGEST = 8e-6


class ScrewPitch(Effect):
    """A periodic error of the ball screw, its bearing or its coupling: it repeats with every turn.

    Targets at whole pitches all see the same phase and do not see it at all; ISO 230-2 asks for random
    fractions in the targets for this reason.
    """

    identifier = "screw-pitch"
    title = Words(en="Periodic error of the screw", de="Periodischer Steigungsfehler der Spindel")
    equation = "Σ A_{h}·sin(2π·h·P/p_{0} + φ_{h})"
    searched = (
        Parameter(
            "period",
            "p_{0}",
            Dimension.POSITION,
            Words(en="pitch of the screw", de="Steigung der Spindel"),
            0.0,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals repeat with the pitch: folded at it, they lie on one wave.",
        de="Die Residuen wiederholen sich mit der Steigung: über ihr gefaltet liegen sie auf einer Welle.",
    )
    confusions = (Confusion("periodic", told_apart.FINE_RUN),)
    options = HarmonicOptions

    def __init__(self, settings: HarmonicOptions | None = None) -> None:
        self.settings = settings or HarmonicOptions()
        self.orders = self.settings.harmonics
        self.linear = harmonic_parameters(self.orders, _LARGEST)

    def with_settings(self, settings: HarmonicOptions) -> Effect:
        """Return the effect with the stated harmonics."""
        return ScrewPitch(settings)

    def forms(self) -> tuple[Effect, ...]:
        """Return the combinations of harmonics that a contest tries."""
        return tuple(ScrewPitch(HarmonicOptions(harmonics=orders)) for orders in COMBINATIONS)

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, its pitch, and a travel of one turn."""
        return needs_linear_axis(design) or needs_whole_period(design, design.axis.screw_pitch, _KEY)

    def grid(self, design: Design) -> FloatArray:
        """Return the pitch that the job states: it is known."""
        return np.array([[design.axis.screw_pitch]], dtype=np.float64)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return sine and cosine of each harmonic."""
        return harmonic_columns(2 * np.pi * design.position / theta[0], self.orders)

    def expected(self, axis: Axis) -> dict[str, float]:
        """Return the pitch."""
        return {} if axis.screw_pitch is None else {"period": axis.screw_pitch}
