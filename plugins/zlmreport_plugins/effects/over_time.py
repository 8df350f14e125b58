"""What changes with time whatever the position: a wave, a step of the datum, a first run that stands off."""

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
    needs_runs,
)
from zlmreport_plugins.effects import experiments

_LARGEST = 50e-6
#: Periods within the test: fewer are a drift, more are taken for noise.
_PERIODS_WITHIN = np.linspace(1.3, 9.0, 32)
_MOST_MOMENTS = 200
_LEAST_MOMENTS = 4
#: With two runs nothing says which of them stands off.
_LEAST_RUNS = 3


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
        Confusion("periodic", experiments.LINEAR_METHOD),
        Confusion("dead-path", experiments.BEAM_SHIELDED),
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
            -1e-3,
            1e-3,
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
        Confusion("scale-joint", experiments.LINEAR_METHOD),
        Confusion("first-run", experiments.PRESET_CHECKED),
        Confusion("thermal-drift", experiments.DRIFT_RUN),
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


class FirstRun(Effect):
    """The axis runs in, lubrication settles, or the zero was set anew after the first run."""

    identifier = "first-run"
    title = Words(en="First run stands off", de="Erster Durchlauf weicht ab")
    equation = "A·1[c = 1]"
    linear = (
        Parameter(
            "step",
            "A",
            Dimension.DEVIATION,
            Words(en="first run less the others", de="erster Durchlauf gegen die übrigen"),
            -500e-6,
            500e-6,
        ),
    )
    shape = Shape.RUN
    look = Words(
        en="The residuals of the first run stand off, those of the others do not.",
        de="Die Residuen des ersten Durchlaufs liegen daneben, die der übrigen nicht.",
    )
    confusions = (
        Confusion("datum-step", experiments.PRESET_CHECKED),
        Confusion("thermal-drift", experiments.MORE_RUNS),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand other runs to compare with."""
        return needs_runs(design, _LEAST_RUNS)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: 1 in the first run."""
        return np.where(design.run == 1, 1.0, 0.0)[:, np.newaxis]
