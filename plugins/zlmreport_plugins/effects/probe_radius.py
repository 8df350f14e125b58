"""The effective radius of the probe is not the one that was calibrated."""

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
    needs_logged,
)
from zlmreport_plugins.effects import experiments
from zlmreport_plugins.effects.faces import FACE


class ProbeRadius(Effect):
    """Faces of a gauge that are touched in opposite directions stand apart by twice the error of the radius.

    The column `face` says which was touched: +1 in the positive direction, −1 in the negative. Where the
    face is always that of the direction of approach, this is backlash.
    """

    identifier = "probe-radius"
    title = Words(en="Error of the probe radius", de="Abweichung des Tastkugelradius")
    equation = "f·ΔR"
    linear = (
        Parameter(
            "radius_error",
            "ΔR",
            Dimension.DEVIATION,
            Words(en="error of the effective radius", de="Abweichung des wirksamen Radius"),
            -15e-6,
            15e-6,
        ),
    )
    shape = Shape.DIRECTION
    look = Words(
        en="The two kinds of faces stand apart by the same amount everywhere.",
        de="Die beiden Arten von Flächen liegen überall um denselben Betrag auseinander.",
    )
    confusions = (Confusion("backlash", experiments.CALIBRATED_BLOCK),)

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the faces."""
        return needs_linear_axis(design) or needs_logged(design, FACE)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: the sign of the face."""
        return np.sign(design.conditions[FACE])[:, np.newaxis]
