"""The axis settles over some distance after each reversal."""

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
    needs_targets,
)
from zlmreport_plugins.effects import told_apart

#: Of the travel: a shorter distance ends before the second target, a longer one is a straight line.
_SHORTEST, _LONGEST = 0.01, 0.2
_LENGTHS = 10


class ReversalRelaxation(Effect):
    """Friction and elastic wind-up that fade with the distance s since the last reversal.

    Where every target is approached from the same distance (pendulum, quasi-pilgrim step) this is backlash.
    """

    identifier = "reversal-relaxation"
    title = Words(en="Relaxation after a reversal", de="Ausklingen nach einer Umkehr")
    equation = "A·d·exp(−s/λ)"
    linear = (
        Parameter(
            "amplitude",
            "A",
            Dimension.DEVIATION,
            Words(en="deviation at the reversal", de="Abweichung an der Umkehr"),
            -20e-6,
            20e-6,
        ),
    )
    searched = (
        Parameter(
            "relaxation_length",
            "λ",
            Dimension.POSITION,
            Words(
                en="distance over which it fades to a third",
                de="Strecke, auf der sie auf ein Drittel abklingt",
            ),
            0.0,
            0.5,
        ),
    )
    shape = Shape.DIRECTION
    look = Words(
        en="The first targets after each reversal stand off.",
        de="Die ersten Zielpositionen nach jeder Umkehr liegen daneben.",
    )
    confusions = (
        Confusion("backlash", told_apart.OTHER_OVERRUN),
        Confusion("backlash-bow", told_apart.OTHER_OVERRUN),
        Confusion("backlash-gradient", told_apart.OTHER_OVERRUN),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand targets at different distances."""
        return needs_targets(design, 3)

    def grid(self, design: Design) -> FloatArray:
        """Return lengths in a geometric row."""
        return design.length * np.geomspace(_SHORTEST, _LONGEST, _LENGTHS)[:, np.newaxis]

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return one column: the exponential, with the sign of the approach."""
        fading = np.exp(-design.since_reversal / float(theta[0]))
        return (design.direction * fading)[:, np.newaxis]
