"""The first run stands off from the others."""

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
    needs_runs,
)
from zlmreport_plugins.effects import told_apart

#: With two runs nothing says which of them stands off.
_LEAST_RUNS = 3


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
            -50e-6,
            50e-6,
        ),
    )
    shape = Shape.RUN
    look = Words(
        en="The residuals of the first run stand off, those of the others do not.",
        de="Die Residuen des ersten Durchlaufs liegen daneben, die der übrigen nicht.",
    )
    confusions = (
        Confusion("datum-step", told_apart.PRESET_CHECKED),
        Confusion("thermal-drift", told_apart.MORE_RUNS),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand other runs to compare with."""
        return needs_runs(design, _LEAST_RUNS)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: 1 in the first run."""
        return np.where(design.run == 1, 1.0, 0.0)[:, np.newaxis]
