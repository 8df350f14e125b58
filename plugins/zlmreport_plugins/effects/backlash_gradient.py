"""The gap between the directions grows along the axis."""

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
    needs_both_directions,
)
from zlmreport_plugins.effects import told_apart


class BacklashGradient(Effect):
    """A screw held at one end winds up the more, the farther the nut is from its bearing; guides wear.

    In the linear method the distance since the reversal grows along the axis as well: whatever is in
    proportion to that distance looks the same, until the overrun is changed.
    """

    identifier = "backlash-gradient"
    title = Words(en="Lost motion that grows along the axis", de="Längs der Achse wachsende Umkehrspanne")
    equation = "g·d·P"
    linear = (
        Parameter(
            "gradient",
            "g",
            Dimension.SLOPE,
            Words(en="half the growth of the gap per position", de="halbe Zunahme des Abstands je Position"),
            -50e-6,
            50e-6,
        ),
    )
    shape = Shape.DIRECTION
    look = Words(
        en="The two directions draw apart along the axis.",
        de="Die beiden Richtungen laufen längs der Achse auseinander.",
    )
    confusions = (Confusion("reversal-relaxation", told_apart.OTHER_OVERRUN),)

    def untestable(self, design: Design) -> Words | None:
        """Demand both directions."""
        return needs_both_directions(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: the position, with the sign of the approach."""
        return (design.direction * design.position)[:, np.newaxis]
