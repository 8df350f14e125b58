"""The interferometer does not correct the refractive index of the air."""

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
    needs_logged,
)
from zlmreport_plugins.effects import told_apart
from zlmreport_plugins.effects.air import LOGS, logged_index_change


class AirIndex(Effect):
    """An error in proportion to the position that changes with the air: 1 µm/m for about 1 K or 4 hPa.

    30 % of humidity change it by a quarter of that. The factor is 1 where nothing was corrected; Δn is the
    index less that of air at 20 °C, 1013.25 hPa and 50 %, by the updated Edlén equation.
    """

    identifier = "air-index"
    title = Words(en="Refractive index not corrected", de="Brechzahl der Luft nicht korrigiert")
    equation = "k·P·Δn"
    linear = (
        Parameter(
            "factor",
            "k",
            Dimension.RATIO,
            Words(en="1: not corrected at all", de="1: gar nicht korrigiert"),
            0.0,
            1.0,
        ),
    )
    shape = Shape.TIME
    look = Words(
        en="The residuals fan out over the position, and the slope follows the air.",
        de="Die Residuen fächern über der Position auf, und die Steigung folgt der Luft.",
    )
    confusions = (
        Confusion("dead-path", told_apart.DEAD_PATH_CHANGED),
        Confusion("scale-expansion", told_apart.OTHER_AIR),
        Confusion("scale-error", told_apart.OTHER_AIR),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the state of the air."""
        return needs_linear_axis(design) or needs_logged(design, *LOGS)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: position times change of the index."""
        return (design.position * logged_index_change(design))[:, np.newaxis]

    def expected(self, axis: Axis) -> dict[str, float]:  # noqa: ARG002 - of any axis
        """Return that nothing was corrected."""
        return {"factor": 1.0}
