"""The zero jumps at one moment."""

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
    needs_passing_time,
)
from zlmreport_plugins.effects import told_apart

_MOST_MOMENTS = 200
_LEAST_MOMENTS = 4


class DatumStep(Effect):
    """A jump in time, the same at all positions: beam interrupted, optic slipped, axis homed again."""

    identifier = "datum-step"
    title = Words(en="Jump of the zero", de="Sprung des Nullpunkts")
    equation = "A·H(t − t_{0})"
    linear = (
        Parameter(
            "step",
            "A",
            Dimension.DEVIATION,
            Words(en="height of the jump", de="Höhe des Sprungs"),
            -100e-6,
            100e-6,
        ),
    )
    searched = (
        Parameter(
            "moment",
            "t_{0}",
            Dimension.TIME,
            Words(en="moment of the jump", de="Zeitpunkt des Sprungs"),
            is_refined=False,
        ),
    )
    shape = Shape.TIME
    look = Words(
        en="The residuals jump at one moment, at all positions alike.",
        de="Die Residuen springen zu einem Zeitpunkt, an allen Positionen gleich.",
    )
    confusions = (
        Confusion("scale-joint", told_apart.LINEAR_METHOD),
        Confusion("first-run", told_apart.PRESET_CHECKED),
        Confusion("thermal-drift", told_apart.DRIFT_RUN),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand readings at several moments."""
        few = len(np.unique(design.time)) < _LEAST_MOMENTS
        return (needs_passing_time(design) or _FEW_MOMENTS) if few else None

    def grid(self, design: Design) -> FloatArray:
        """Return moments between readings, spread evenly over them, but for the first and the last gap."""
        moments = np.unique(design.time)
        between = (moments[1:-2] + moments[2:-1]) / 2
        chosen = np.linspace(0, len(between) - 1, min(_MOST_MOMENTS, len(between))).round().astype(int)
        return between[chosen, np.newaxis]

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return one column: 1 after the jump."""
        return np.where(design.time > theta[0], 1.0, 0.0)[:, np.newaxis]


_FEW_MOMENTS = Words(
    en="the readings were taken at too few different times",
    de="die Messwerte wurden zu zu wenigen verschiedenen Zeiten aufgenommen",
)
