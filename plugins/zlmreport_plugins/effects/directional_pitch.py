"""The gap between the directions varies within each turn of the screw."""

from __future__ import annotations

import numpy as np

from zlmreport.plugin import (
    Axis,
    Design,
    Dimension,
    Effect,
    FloatArray,
    Parameter,
    Shape,
    Words,
    harmonic_columns,
    harmonic_parameters,
    needs_both_directions,
    needs_whole_period,
)

_KEY = "axis.screw_pitch"
_LARGEST = 3e-6


class DirectionalPitch(Effect):
    """A wobbling axial bearing or a bent screw: the reversal value itself repeats with the pitch.

    Nothing else known does so; a fine run over two pitches shows it. It cannot be seen at whole pitches.
    """

    identifier = "directional-pitch"
    title = Words(en="Periodic lost motion of the screw", de="Periodische Umkehrspanne der Spindel")
    equation = "d·A·sin(2π·P/p_{0} + φ)"
    linear = harmonic_parameters([1], _LARGEST)
    searched = (
        Parameter(
            "period",
            "p_{0}",
            Dimension.POSITION,
            Words(en="pitch of the screw or gear", de="Steigung der Spindel oder Teilung des Getriebes"),
            0.0,
        ),
    )
    shape = Shape.DIRECTION
    look = Words(
        en="The gap between the directions repeats with the pitch.",
        de="Der Abstand der beiden Richtungen wiederholt sich mit der Steigung.",
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand both directions, the pitch, and a travel of one turn."""
        return needs_both_directions(design) or needs_whole_period(design, design.axis.screw_pitch, _KEY)

    def grid(self, design: Design) -> FloatArray:
        """Return the pitch that the job states: it is known."""
        return np.array([[design.axis.screw_pitch]], dtype=np.float64)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return sine and cosine, with the sign of the approach."""
        return design.direction[:, np.newaxis] * harmonic_columns(2 * np.pi * design.position / theta[0], [1])

    def expected(self, axis: Axis) -> dict[str, float]:
        """Return the pitch."""
        return {} if axis.screw_pitch is None else {"period": axis.screw_pitch}
