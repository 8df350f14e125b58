"""A rotary axis or its coupling is out of line: two waves a turn."""

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
_WAVES = 2


class Ellipticity(Effect):
    """Two waves a turn: a misaligned coupling (β²/4; 10 mrad are 5″), an oval bearing, a wobbling disc."""

    identifier = "ellipticity"
    title = Words(en="Two waves a turn (coupling, wobble)", de="Zwei Wellen je Umdrehung (Kupplung, Taumeln)")
    equation = "A·sin(2·θ + φ)"
    linear = harmonic_parameters([1], _LARGEST)
    shape = Shape.POSITION
    look = Words(
        en="The residuals make two waves a turn.",
        de="Die Residuen bilden zwei Wellen je Umdrehung.",
    )
    confusions = (
        Confusion("polynomial", told_apart.FULL_TURN),
        Confusion("eccentricity", told_apart.TWO_HEADS),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a rotary axis."""
        return needs_rotary_axis(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return sine and cosine of the double angle."""
        return harmonic_columns(_WAVES * design.position, [1])
