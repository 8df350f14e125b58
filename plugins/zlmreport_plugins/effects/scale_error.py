"""The measuring system's unit of length (angle) is too long or too short."""

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
)
from zlmreport_plugins.effects import told_apart


class ScaleError(Effect):
    """A deviation in proportion to the position: lead of the screw, length of the scale, wavelength.

    In a single test nothing tells it from an expansion at constant temperature, a wrong coefficient of
    expansion in the correction, or a wrong refractive index.
    """

    identifier = "scale-error"
    title = Words(en="Scale error", de="Maßstabsfehler")
    equation = "b·P"
    linear = (
        Parameter(
            "slope",
            "b",
            Dimension.SLOPE,
            Words(en="error per position", de="Abweichung je Position"),
            -50e-6,
            50e-6,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals lie on a straight line over the position, the same in both directions.",
        de="Die Residuen liegen über der Position auf einer Geraden, in beiden Richtungen auf derselben.",
    )
    confusions = (
        Confusion("cosine-error", told_apart.BEAM_REALIGNED),
        Confusion("gauge-misalignment", told_apart.GAUGE_REALIGNED),
        Confusion("scale-expansion", told_apart.WARMER_AXIS),
        Confusion("thermal-growth", told_apart.COLD_RESTART),
        Confusion("air-index", told_apart.OTHER_AIR),
    )

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: P."""
        return design.position[:, np.newaxis]
