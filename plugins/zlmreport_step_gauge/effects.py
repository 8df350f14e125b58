"""Effects of probing a gauge: the radius of the probe, and a gauge that lies askew."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from zlmreport.plugin import FloatArray, Words, hookimpl
from zlmreport.plugin.effect import (
    Confusion,
    Design,
    Dimension,
    Effect,
    Parameter,
    Shape,
    needs_linear_axis,
    needs_logged,
)

#: A logged column: +1 where a probe touched the gauge in the positive direction, −1 in the negative.
FACE = "face"

_CALIBRATED_BLOCK = Words("measure a calibrated gauge block or ring with both faces")
_GAUGE_REALIGNED = Words("align the gauge anew, or take the lengths along its own measured direction")
_GAUGE_REPLACED_BY_LASER = Words("repeat with an aligned laser beam in place of the gauge")


class ProbeRadius(Effect):
    """Faces of a gauge that are touched in opposite directions stand apart by twice the error of the radius.

    The column `face` says which was touched: +1 in the positive direction, −1 in the negative. Where the
    face is always that of the direction of approach, this is backlash.
    """

    identifier = "probe-radius"
    title = Words("Error of the probe radius")
    equation = "f·ΔR"
    linear = (
        Parameter(
            "radius_error",
            "ΔR",
            Dimension.DEVIATION,
            Words("error of the effective radius"),
            -15e-6,
            15e-6,
        ),
    )
    shape = Shape.DIRECTION
    look = Words("The two kinds of faces stand apart by the same amount everywhere.")
    remedy = Words(
        "The probe, not the machine: qualify it at a calibrated sphere or ring with the force and speed "
        "of the test, enter its effective radius and evaluate anew. Never compensate it as backlash."
    )
    confusions = (Confusion("backlash", _CALIBRATED_BLOCK),)

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the faces."""
        return needs_linear_axis(design) or needs_logged(design, FACE)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: the sign of the face."""
        return np.sign(design.conditions[FACE])[:, np.newaxis]


class GaugeMisalignment(Effect):
    """A gauge at an angle φ is P·cos φ long along the axis; projection on its own direction removes this.

    What a lateral offset adds on tilted faces is the same for every face of a kind, and ends in the probe's
    radius. The column `face` tells that a gauge was measured and no beam.
    """

    identifier = "gauge-misalignment"
    title = Words("Misalignment of the step gauge")
    equation = "−P·φ²/2"
    linear = (
        Parameter(
            "shortening",
            "φ²/2",
            Dimension.SLOPE,
            Words("relative shortening by the misalignment"),
            0.0,
            50e-6,
        ),
    )
    shape = Shape.POSITION
    look = Words("The residuals fall in proportion to the position.")
    remedy = Words(
        "The set-up, not the machine: align the gauge to the axis, or take the lengths along its own "
        "measured direction. Never compensate it."
    )
    confusions = (
        Confusion("cosine-error", _GAUGE_REPLACED_BY_LASER),
        Confusion("scale-error", _GAUGE_REALIGNED),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the faces of a gauge."""
        return needs_linear_axis(design) or needs_logged(design, FACE)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: −P."""
        return -design.position[:, np.newaxis]


@hookimpl
def zlmreport_effects() -> Iterable[Effect]:
    """Return what a probe and a gauge that lies askew add to the error model."""
    return [ProbeRadius(), GaugeMisalignment()]
