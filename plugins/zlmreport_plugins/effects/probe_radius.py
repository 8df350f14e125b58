"""The effective radius of the probe is not the one that was calibrated."""

from __future__ import annotations

import numpy as np

from zlmreport.language import Words
from zlmreport.model import needs
from zlmreport.model.design import Design
from zlmreport.model.effect import Confusion, Effect, Shape
from zlmreport.model.parameter import Dimension, Parameter
from zlmreport.quantities.arrays import FloatArray
from zlmreport_plugins.effects import told_apart
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
    confusions = (Confusion("backlash", told_apart.CALIBRATED_BLOCK),)

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the faces."""
        return needs.linear_axis(design) or needs.logged(design, FACE)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: the sign of the face."""
        return np.sign(design.conditions[FACE])[:, np.newaxis]
