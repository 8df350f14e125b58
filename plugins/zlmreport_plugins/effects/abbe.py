"""The axis tilts as it moves, and the measuring line lies beside the scale."""

from __future__ import annotations

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
    needs_linear_axis,
    needs_stated,
)
from zlmreport_plugins.effects import told_apart


class Abbe(Effect):
    """The offset of the measuring line times the rotation of the axis.

    200 mm and 10 µrad are 2 µm; 1 m and 1″ are 4.85 µm. The parameter is the offset: where the job states
    it, estimate and statement can be compared.
    """

    identifier = "abbe"
    title = Words(en="Abbe error", de="Abbe-Fehler")
    equation = "h·θ(P)"
    linear = (
        Parameter(
            "abbe_offset",
            "h",
            Dimension.LENGTH,
            Words(en="distance of the measuring line from the scale", de="Abstand der Messlinie vom Maßstab"),
            -2.0,
            2.0,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals have the shape of the axis's pitch or yaw.",
        de="Die Residuen haben den Verlauf des Nick- oder Gierwinkels der Achse.",
    )
    confusions = (
        Confusion("polynomial", told_apart.OTHER_HEIGHT),
        Confusion("periodic", told_apart.OTHER_HEIGHT),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the record of its angles."""
        return needs_linear_axis(design) or needs_stated(design.axis.angular_errors, "axis.angular_errors")

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: the angle at the position."""
        record = design.axis.angular_errors
        assert record is not None  # noqa: S101  # else it is untestable
        return record.at(design.position)[:, np.newaxis]

    def expected(self, axis: Axis) -> dict[str, float]:
        """Return the offset that the job states."""
        return {} if axis.abbe_offset is None else {"abbe_offset": axis.abbe_offset}
