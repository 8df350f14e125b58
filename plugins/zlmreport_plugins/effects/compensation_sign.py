"""The control's compensation table acts with the wrong sign, twice, or not at all."""

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
    needs_stated,
)
from zlmreport_plugins.effects import told_apart


class CompensationSign(Effect):
    """A deviation in proportion to the table C(P), which is given in the sign of the deviation.

    The factor tells what happened: 2, the table acts with the wrong sign; 1, it does not act; −1, it acts
    twice. Controls differ in the sign that they expect, and a table with the wrong one doubles the error.
    """

    identifier = "compensation-sign"
    title = Words(
        en="Compensation with wrong sign, or off", de="Kompensation mit falschem Vorzeichen oder aus"
    )
    equation = "k·C(P)"
    linear = (
        Parameter(
            "factor",
            "k",
            Dimension.RATIO,
            Words(
                en="2: wrong sign; 1: not active; −1: applied twice",
                de="2: falsches Vorzeichen; 1: nicht aktiv; −1: doppelt angewandt",
            ),
            -1.5,
            2.5,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals look like the compensation table.",
        de="Die Residuen sehen aus wie die Kompensationstabelle.",
    )
    confusions = (
        Confusion("periodic", told_apart.TABLE_OFF),
        Confusion("polynomial", told_apart.TABLE_OFF),
        Confusion("compensation-shift", told_apart.TABLE_READ_BACK),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand the table."""
        return needs_stated(design.axis.compensation_table, "axis.compensation_table")

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: C(P)."""
        table = design.axis.compensation_table
        assert table is not None  # noqa: S101  # else it is untestable
        return table.at(design.position)[:, np.newaxis]
