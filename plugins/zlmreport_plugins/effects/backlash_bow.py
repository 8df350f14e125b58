"""The gap between the directions is largest in the middle of the travel."""

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
    needs_targets,
)
from zlmreport_plugins.effects import told_apart


class BacklashBow(Effect):
    """A screw fixed at both ends is most compliant in its middle, and so is its lost motion."""

    identifier = "backlash-bow"
    title = Words(en="Lost motion that is largest in the middle", de="In der Mitte größte Umkehrspanne")
    equation = "k·d·(1 − p²);  p = (P − P_{mid}) / (L/2)"
    linear = (
        Parameter(
            "bow",
            "k",
            Dimension.DEVIATION,
            Words(en="half the additional gap in the middle", de="halber zusätzlicher Abstand in der Mitte"),
            -20e-6,
            20e-6,
        ),
    )
    shape = Shape.DIRECTION
    look = Words(
        en="The two directions stand apart most in the middle of the travel.",
        de="Die beiden Richtungen liegen in der Mitte des Verfahrwegs am weitesten auseinander.",
    )
    confusions = (Confusion("reversal-relaxation", told_apart.OTHER_OVERRUN),)

    def untestable(self, design: Design) -> Words | None:
        """Demand both directions, and targets between the ends."""
        return needs_both_directions(design) or needs_targets(design, 3)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: a parabola over the travel, with the sign of the approach."""
        scaled = (design.position - design.middle) / (design.length / 2)
        return (design.direction * (1 - scaled**2))[:, np.newaxis]
