"""Something repeats along the axis, and nothing says what it is."""

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
    harmonic_columns,
    harmonic_parameters,
    needs_targets,
)
from zlmreport_plugins.effects import told_apart

_LARGEST = 20e-6
#: Fewer periods within the travel are a bow; more than half the number of targets cannot be told from fewer.
_FEWEST_PERIODS = 1.3
_STEPS_PER_PERIOD = 4
_LEAST_TARGETS = 6


class Periodic(Effect):
    """A wave of unknown period: magnets of a linear motor, teeth of a rack, a gear, a wavy guideway.

    The period is searched, which makes this the dearest of all effects: it takes much evidence. On evenly
    spaced targets a short period looks like a longer one as well; random fractions in the targets part them.
    """

    identifier = "periodic"
    title = Words(en="Periodic error of unknown period", de="Periodische Abweichung unbekannter Periode")
    equation = "A·sin(2π·P/Λ + φ)"
    linear = harmonic_parameters([1], _LARGEST)
    searched = (
        Parameter(
            "period",
            "Λ",
            Dimension.POSITION,
            Words(en="period along the axis", de="Periode längs der Achse"),
            0.0,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals repeat along the axis, the same in both directions.",
        de="Die Residuen wiederholen sich längs der Achse, in beiden Richtungen gleich.",
    )
    confusions = (
        Confusion("screw-pitch", told_apart.FINE_RUN),
        Confusion("gear-mesh", told_apart.FULL_TURN),
        Confusion("compensation-sign", told_apart.TABLE_OFF),
        Confusion("time-periodic", told_apart.LINEAR_METHOD),
        Confusion("polynomial", told_apart.DENSER_TARGETS),
        Confusion("abbe", told_apart.OTHER_HEIGHT),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand enough targets for a wave."""
        return needs_targets(design, _LEAST_TARGETS)

    def grid(self, design: Design) -> FloatArray:
        """Return periods, even in 1/Λ: steps by which a wave shifts a quarter of a period over the travel."""
        most = len(design.target_positions) / 2
        periods_within = np.arange(_FEWEST_PERIODS, most + 1e-9, 1 / _STEPS_PER_PERIOD)
        return (design.length / periods_within)[:, np.newaxis]

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return sine and cosine."""
        return harmonic_columns(2 * np.pi * design.position / theta[0], [1])
