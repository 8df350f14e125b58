"""The beam passes through air that the interferometer does not count."""

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
    needs_linear_axis,
    needs_logged,
)
from zlmreport_plugins.effects import told_apart
from zlmreport_plugins.effects.air import LOGS, logged_index_change


class DeadPath(Effect):
    """The path between the optics at the zero: the zero moves with the air, by 0.5 µm for 0.5 m and 1 ppm.

    In constant air it is part of the offset, and cannot be seen.
    """

    identifier = "dead-path"
    title = Words(en="Dead path not corrected", de="Totstrecke nicht korrigiert")
    equation = "D·Δn"
    linear = (
        Parameter(
            "dead_path",
            "D",
            Dimension.LENGTH,
            Words(en="length of the dead path", de="Länge der Totstrecke"),
            0.0,
            2.0,
        ),
    )
    shape = Shape.TIME
    look = Words(
        en="The residuals follow the air, at all positions alike.",
        de="Die Residuen folgen der Luft, an allen Positionen gleich.",
    )
    confusions = (
        Confusion("air-index", told_apart.DEAD_PATH_CHANGED),
        Confusion("time-periodic", told_apart.BEAM_SHIELDED),
        Confusion("offset", told_apart.DEAD_PATH_CHANGED),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the state of the air."""
        return needs_linear_axis(design) or needs_logged(design, *LOGS)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: change of the index."""
        return logged_index_change(design)[:, np.newaxis]
