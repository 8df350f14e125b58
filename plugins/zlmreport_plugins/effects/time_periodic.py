"""Something repeats in time: a cooler, the air conditioning."""

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
    needs_passing_time,
)
from zlmreport_plugins.effects import told_apart

_LARGEST = 10e-6
#: Periods within the test: fewer are a drift, more are taken for noise.
_PERIODS_WITHIN = np.linspace(1.3, 9.0, 32)


class TimePeriodic(Effect):
    """A wave in time, the same at all positions: the cooler's cycle, warm and cold air in the beam.

    In pendulum and quasi-pilgrim tests position and time run together, and it looks periodic in position.
    """

    identifier = "time-periodic"
    title = Words(en="Periodic in time", de="Zeitlich periodische Abweichung")
    equation = "A·sin(2π·t/T + φ)"
    linear = harmonic_parameters([1], _LARGEST)
    searched = (
        Parameter("period", "T", Dimension.TIME, Words(en="period in time", de="Periodendauer"), 0.0, 3600.0),
    )
    shape = Shape.TIME
    look = Words(
        en="The residuals repeat in the order of time, at all positions alike.",
        de="Die Residuen wiederholen sich in der zeitlichen Folge, an allen Positionen gleich.",
    )
    confusions = (
        Confusion("periodic", told_apart.LINEAR_METHOD),
        Confusion("dead-path", told_apart.BEAM_SHIELDED),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand that time passes."""
        return needs_passing_time(design)

    def grid(self, design: Design) -> FloatArray:
        """Return periods, even in 1/T."""
        return (design.duration / _PERIODS_WITHIN)[:, np.newaxis]

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return sine and cosine."""
        return harmonic_columns(2 * np.pi * design.time / theta[0], [1])
