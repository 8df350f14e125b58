"""The laser beam is not parallel to the axis."""

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
)
from zlmreport_plugins.effects import told_apart


class CosineError(Effect):
    """A beam at an angle φ reads P·cos φ: always too short, by φ²/2 in proportion.

    1 mrad costs 0.5 µm/m. If the returned beam walks by S over the distance D, then φ = S/(2D) and the
    error is S²/(8D²). A rising line cannot be a cosine error.
    """

    identifier = "cosine-error"
    title = Words(en="Cosine error of the beam", de="Kosinusfehler des Strahls")
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
        Confusion("scale-error", told_apart.BEAM_REALIGNED),
        Confusion("gauge-misalignment", told_apart.GAUGE_REPLACED_BY_LASER),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis."""
        return needs_linear_axis(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: −P."""
        return -design.position[:, np.newaxis]
