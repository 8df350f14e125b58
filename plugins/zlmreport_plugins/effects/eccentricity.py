"""The graduation of a rotary encoder is not centred on its axis."""

from __future__ import annotations

from zlmreport.plugin import (
    Confusion,
    Design,
    Effect,
    FloatArray,
    Shape,
    Words,
    harmonic_columns,
    harmonic_parameters,
    needs_rotary_axis,
)
from zlmreport_plugins.effects import told_apart

_LARGEST = 200e-6


class Eccentricity(Effect):
    """A wave of one period a turn, of amplitude e/R: 1 µm at a radius of 50 mm is 20 µrad or 4.1″.

    Over part of a turn a polynomial imitates it; over 40° it cannot be seen.
    """

    identifier = "eccentricity"
    title = Words(en="Eccentricity of the graduation", de="Exzentrizität der Teilung")
    equation = "A·sin(θ + φ)"
    linear = harmonic_parameters([1], _LARGEST)
    shape = Shape.POSITION
    look = Words(
        en="The residuals make one wave a turn.",
        de="Die Residuen bilden eine Welle je Umdrehung.",
    )
    confusions = (
        Confusion("polynomial", told_apart.FULL_TURN),
        Confusion("ellipticity", told_apart.TWO_HEADS),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a rotary axis."""
        return needs_rotary_axis(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return sine and cosine."""
        return harmonic_columns(design.position, [1])
