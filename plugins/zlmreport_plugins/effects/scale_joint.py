"""Two elements of a scale do not meet as they should."""

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

_LEAST_TARGETS = 5


class ScaleJoint(Effect):
    """A step at one position in all runs and both directions: a joint of the scale, or a missed count."""

    identifier = "scale-joint"
    title = Words(en="Step at a joint of the scale", de="Sprung an einem Stoß des Maßstabs")
    equation = "A·H(P − P_{0})"
    linear = (
        Parameter(
            "step",
            "A",
            Dimension.DEVIATION,
            Words(en="height of the step", de="Höhe des Sprungs"),
            -20e-6,
            20e-6,
        ),
    )
    searched = (
        Parameter(
            "joint",
            "P_{0}",
            Dimension.POSITION,
            Words(en="position of the joint", de="Position des Stoßes"),
            is_refined=False,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals step at one position, in all runs and both directions.",
        de="Die Residuen springen an einer Position, in allen Durchläufen und beiden Richtungen.",
    )
    confusions = (
        Confusion("datum-step", told_apart.LINEAR_METHOD),
        Confusion("scale-kink", told_apart.STEP_SEARCHED),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand targets on both sides of an inner gap."""
        return needs_targets(design, _LEAST_TARGETS)

    def grid(self, design: Design) -> FloatArray:
        """Return the middle of every gap between targets but the outer ones."""
        targets = design.target_positions
        return ((targets[1:-2] + targets[2:-1]) / 2)[:, np.newaxis]

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return one column: 1 beyond the joint."""
        return np.where(design.position > theta[0], 1.0, 0.0)[:, np.newaxis]
