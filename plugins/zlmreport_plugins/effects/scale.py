"""A scale that is not of one piece: a joint, and a kink of its slope."""

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
from zlmreport_plugins.effects import experiments

_LEAST_TARGETS = 5
#: Closer to the ends a kink is hardly more than a single target that stands off.
_PLACES = np.linspace(0.12, 0.88, 20)


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
            -100e-6,
            100e-6,
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
        Confusion("datum-step", experiments.LINEAR_METHOD),
        Confusion("scale-kink", experiments.STEP_SEARCHED),
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


class ScaleKink(Effect):
    """A kink: the end of a segment in a compensation table, a worn stretch, a second element of the scale."""

    identifier = "scale-kink"
    title = Words(en="Change of slope at one position", de="Knick der Abweichung an einer Position")
    equation = "A·max(0, P − P_{0})"
    linear = (
        Parameter(
            "slope",
            "A",
            Dimension.SLOPE,
            Words(en="change of the slope", de="Änderung der Steigung"),
            -500e-6,
            500e-6,
        ),
    )
    searched = (
        Parameter(
            "kink", "P_{0}", Dimension.POSITION, Words(en="position of the kink", de="Position des Knicks")
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals lie on two straight lines that meet at one position.",
        de="Die Residuen liegen auf zwei Geraden, die sich an einer Position treffen.",
    )
    confusions = (
        Confusion("polynomial", experiments.DENSER_TARGETS),
        Confusion("scale-joint", experiments.STEP_SEARCHED),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand targets on both sides."""
        return needs_targets(design, _LEAST_TARGETS)

    def grid(self, design: Design) -> FloatArray:
        """Return places along the travel, the ends left out."""
        return (design.middle + (_PLACES - 0.5) * design.length)[:, np.newaxis]

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return one column: the distance beyond the kink."""
        beyond = design.position - float(theta[0])
        return np.maximum(0.0, beyond)[:, np.newaxis]
