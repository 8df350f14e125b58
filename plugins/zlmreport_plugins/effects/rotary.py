"""Errors of rotary axes: eccentricity, ellipticity, and the mesh of a gear."""

from __future__ import annotations

import math

import numpy as np

from zlmreport.plugin import (
    Axis,
    Confusion,
    Design,
    Dimension,
    Effect,
    FloatArray,
    Parameter,
    Shape,
    Words,
    harmonic_columns,
    harmonic_parameters,
    needs_rotary_axis,
    needs_targets,
)
from zlmreport_plugins.effects import experiments

_LARGEST = 2e-3
_WAVES = 2
_TURN = 2 * math.pi
#: One and two waves a turn have names of their own; fewer waves in the travel are a bow.
_FEWEST_TEETH = 3
_FEWEST_WAVES = 1.3
_LEAST_TARGETS = 6


class Eccentricity(Effect):
    """A wave of one period a turn, of amplitude e/R: 1 µm at a radius of 50 mm is 20 µrad or 4.1″.

    Over part of a turn a polynomial imitates it; over 40° it cannot be seen.
    """

    identifier = "eccentricity"
    title = Words(en="Eccentricity of the graduation", de="Exzentrizität der Teilung")
    equation = "A·sin(θ + φ)"
    linear = harmonic_parameters([1], _LARGEST)
    shape = Shape.POSITION
    look = Words(
        en="The residuals make one wave a turn.",
        de="Die Residuen bilden eine Welle je Umdrehung.",
    )
    confusions = (
        Confusion("polynomial", experiments.FULL_TURN),
        Confusion("ellipticity", experiments.TWO_HEADS),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a rotary axis."""
        return needs_rotary_axis(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return sine and cosine."""
        return harmonic_columns(design.position, [1])


class Ellipticity(Effect):
    """Two waves a turn: a misaligned coupling (β²/4; 10 mrad are 5″), an oval bearing, a wobbling disc."""

    identifier = "ellipticity"
    title = Words(en="Two waves a turn (coupling, wobble)", de="Zwei Wellen je Umdrehung (Kupplung, Taumeln)")
    equation = "A·sin(2·θ + φ)"
    linear = harmonic_parameters([1], _LARGEST)
    shape = Shape.POSITION
    look = Words(
        en="The residuals make two waves a turn.",
        de="Die Residuen bilden zwei Wellen je Umdrehung.",
    )
    confusions = (
        Confusion("polynomial", experiments.FULL_TURN),
        Confusion("eccentricity", experiments.TWO_HEADS),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a rotary axis."""
        return needs_rotary_axis(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return sine and cosine of the double angle."""
        return harmonic_columns(_WAVES * design.position, [1])


class GearMesh(Effect):
    """A whole number of waves a turn: teeth of the worm wheel or of the pinion, poles of a torque motor.

    The pitch of the gear in degrees, `axis.screw_pitch`, gives the number; without it whole numbers are
    scanned, as many as the targets can tell. Targets every 30° are blind to a wheel of 360 teeth.
    """

    identifier = "gear-mesh"
    title = Words(en="Periodic error of the gear", de="Periodische Abweichung des Getriebes")
    equation = "A·sin(z·θ + φ)"
    linear = harmonic_parameters([1], _LARGEST)
    searched = (
        Parameter(
            "teeth",
            "z",
            Dimension.RATIO,
            Words(en="waves a turn: teeth or poles", de="Wellen je Umdrehung: Zähne oder Pole"),
            _FEWEST_TEETH,
            is_refined=False,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals make a whole number of waves a turn.",
        de="Die Residuen bilden eine ganze Zahl von Wellen je Umdrehung.",
    )
    confusions = (Confusion("periodic", experiments.FULL_TURN),)

    def untestable(self, design: Design) -> Words | None:
        """Demand a rotary axis, and enough targets for a wave."""
        return needs_rotary_axis(design) or needs_targets(design, _LEAST_TARGETS)

    def grid(self, design: Design) -> FloatArray:
        """Return the number that the job states, or the numbers that the targets can tell."""
        stated = self.expected(design.axis)
        if stated:
            return np.array([[stated["teeth"]]])
        turns = design.length / _TURN
        fewest = max(_FEWEST_TEETH, math.ceil(_FEWEST_WAVES / turns))
        most = max(fewest, math.floor(len(design.target_positions) / (2 * turns)))
        return np.arange(fewest, most + 1, dtype=np.float64)[:, np.newaxis]

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return sine and cosine."""
        return harmonic_columns(theta[0] * design.position, [1])

    def expected(self, axis: Axis) -> dict[str, float]:
        """Return the number of teeth that a stated pitch means."""
        return {} if axis.screw_pitch is None else {"teeth": float(round(_TURN / axis.screw_pitch))}
