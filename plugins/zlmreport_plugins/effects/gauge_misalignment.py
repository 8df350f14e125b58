"""The step gauge is not parallel to the axis."""

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


class GaugeMisalignment(Effect):
    """A gauge at an angle φ is P·cos φ long along the axis; projection on its own direction removes this.

    What a lateral offset adds on tilted faces is the same for every face of a kind, and ends in the probe's
    radius. The column `face` tells that a gauge was measured and no beam.
    """

    identifier = "gauge-misalignment"
    title = Words(en="Misalignment of the step gauge", de="Schiefstellung des Stufenendmaßes")
    equation = "−P·φ²/2"
    linear = (
        Parameter(
            "shortening",
            "φ²/2",
            Dimension.SLOPE,
            Words(
                en="relative shortening by the misalignment",
                de="relative Verkürzung durch die Schiefstellung",
            ),
            0.0,
            50e-6,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals fall in proportion to the position.",
        de="Die Residuen fallen im Verhältnis zur Position.",
    )
    confusions = (
        Confusion("cosine-error", experiments.GAUGE_REPLACED_BY_LASER),
        Confusion("scale-error", experiments.GAUGE_REALIGNED),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the faces of a gauge."""
        return needs_linear_axis(design) or needs_logged(design, FACE)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: −P."""
        return -design.position[:, np.newaxis]
