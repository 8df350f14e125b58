"""A compensation table of the control that acts wrongly: with another sign, or displaced."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    Axis,
    Confusion,
    Design,
    Dimension,
    Effect,
    FloatArray,
    Options,
    Parameter,
    Shape,
    Words,
    needs_stated,
)
from zlmreport_plugins.effects import experiments


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
            -3.0,
            3.0,
        ),
    )
    shape = Shape.POSITION
    ranges_from = Words(
        en="2, 1 and −1 are what can happen; beyond −3 to 3 nothing of the kind does",
        de="2, 1 und −1 kommen vor; jenseits von −3 bis 3 nichts dergleichen",
    )
    look = Words(
        en="The residuals look like the compensation table.",
        de="Die Residuen sehen aus wie die Kompensationstabelle.",
    )
    remedy = Words(
        en="The table acts with the wrong sign (a factor near 2), not at all (1), or twice (−1). Read it "
        "back, correct the sign or the switch, and measure anew. Mend this table; do not write a second "
        "one over it.",
        de="Die Tabelle wirkt mit falschem Vorzeichen (Faktor nahe 2), gar nicht (1) oder doppelt (−1). "
        "Zurücklesen, Vorzeichen oder Schalter berichtigen und neu messen. Diese Tabelle berichtigen, "
        "keine zweite darüberschreiben.",
    )
    confusions = (
        Confusion("periodic", experiments.TABLE_OFF),
        Confusion("polynomial", experiments.TABLE_OFF),
        Confusion("compensation-shift", experiments.TABLE_READ_BACK),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand the table."""
        return needs_stated(design.axis.compensation_table, "axis.compensation_table")

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: C(P)."""
        table = design.axis.compensation_table
        assert table is not None  # noqa: S101  # else it is untestable
        return table.at(design.position, design.direction)[:, np.newaxis]


class ShiftOptions(Options):
    """Which way the table is off."""

    rows: Literal[1, -1] = Field(
        1, description="1: the control applies the value of the next row; -1: that of the row before."
    )


class CompensationShift(Effect):
    """Each value of the table acts where its neighbour should: the first row was counted from 0 or from 1.

    What is left is the table's own change from row to row; the factor is 1 if this is the cause.
    """

    identifier = "compensation-shift"
    title = Words(en="Compensation one row off", de="Kompensation um eine Zeile verschoben")
    equation = "k·[C(P) − C(P + Δ)]"
    linear = (
        Parameter(
            "factor",
            "k",
            Dimension.RATIO,
            Words(en="1: exactly one row off", de="1: genau eine Zeile verschoben"),
            -3.0,
            3.0,
        ),
    )
    shape = Shape.POSITION
    ranges_from = Words(
        en="1 is what happens; beyond −3 to 3 nothing of the kind does",
        de="1 kommt vor; jenseits von −3 bis 3 nichts dergleichen",
    )
    look = Words(
        en="The residuals look like the slope of the compensation table.",
        de="Die Residuen sehen aus wie die Steigung der Kompensationstabelle.",
    )
    remedy = Words(
        en="The table lies a row beside the axis: check the position of its first row, its interval and the "
        "reference point. Enter it anew and measure anew; then there is nothing left to compensate.",
        de="Die Tabelle liegt eine Zeile neben der Achse: Position der ersten Zeile, Intervall und "
        "Referenzpunkt prüfen. Neu eingeben und neu messen; dann bleibt nichts zu kompensieren.",
    )
    confusions = (Confusion("compensation-sign", experiments.TABLE_READ_BACK),)
    options = ShiftOptions

    def __init__(self, settings: ShiftOptions | None = None) -> None:
        self.settings = settings or ShiftOptions()
        self.rows = self.settings.rows

    def with_settings(self, settings: ShiftOptions) -> Effect:
        """Return the effect with the stated shift."""
        return CompensationShift(settings)

    def forms(self) -> tuple[Effect, ...]:
        """Return the shift to either side."""
        return (CompensationShift(ShiftOptions(rows=1)), CompensationShift(ShiftOptions(rows=-1)))

    def untestable(self, design: Design) -> Words | None:
        """Demand the table."""
        return needs_stated(design.axis.compensation_table, "axis.compensation_table")

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: what the table should do, less what it does."""
        table = design.axis.compensation_table
        assert table is not None  # noqa: S101  # else it is untestable
        shifted = design.position + self.rows * table.interval
        value = table.at(design.position, design.direction)
        return (value - table.at(shifted, design.direction))[:, np.newaxis]

    def expected(self, axis: Axis) -> dict[str, float]:  # noqa: ARG002 - of any axis
        """Return that the shift is one row, and not part of one."""
        return {"factor": 1.0}
