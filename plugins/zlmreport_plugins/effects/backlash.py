"""The two directions of approach end at different places."""

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


class Backlash(Effect):
    """The same gap between the directions everywhere: play in the drive, friction, a flexible coupling.

    B has the sign of B_i = x̄_i↑ − x̄_i↓. Play between the drive and a table that is measured at the table
    makes it negative: the table lags behind in either direction. A following error at one feed looks alike.
    """

    identifier = "backlash"
    title = Words(en="Lost motion at reversal", de="Umkehrspanne")
    equation = "½·B·d"
    linear = (
        Parameter(
            "lost_motion",
            "B",
            Dimension.DEVIATION,
            Words(en="reversal value of the whole axis", de="Umkehrspanne der ganzen Achse"),
            -100e-6,
            100e-6,
        ),
    )
    shape = Shape.DIRECTION
    look = Words(
        en="The two directions stand apart by the same amount everywhere.",
        de="Die beiden Richtungen liegen überall um denselben Betrag auseinander.",
    )
    confusions = (
        Confusion("probe-radius", told_apart.CALIBRATED_BLOCK),
        Confusion("reversal-relaxation", told_apart.OTHER_OVERRUN),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand both directions."""
        return needs_both_directions(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: half the direction."""
        return design.direction[:, np.newaxis] / 2
