"""The zero of the measurement is not the zero of the axis."""

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


class Offset(Effect):
    """A constant: where the instrument was preset.

    It says nothing of the axis: the instrument's common error, a dead path in constant air and the mean of
    every drift end here as well.
    """

    identifier = "offset"
    title = Words(en="Zero offset", de="Nullpunktverschiebung")
    equation = "a"
    linear = (
        Parameter(
            "offset",
            "a",
            Dimension.DEVIATION,
            Words(en="offset of the zero", de="Verschiebung des Nullpunkts"),
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals stand off zero by the same amount everywhere.",
        de="Die Residuen liegen überall um denselben Betrag neben null.",
    )
    confusions = (
        Confusion("dead-path", told_apart.DEAD_PATH_CHANGED),
        Confusion("thermal-drift", told_apart.PRESET_AGAIN),
    )

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: 1."""
        return np.ones((len(design.position), 1))
