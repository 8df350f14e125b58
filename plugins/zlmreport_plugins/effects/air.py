"""The air in the beam of an interferometer, as it was logged."""

from __future__ import annotations

import numpy as np

from zlmreport.plugin import (
    STATE_OF_AIR,
    Axis,
    Confusion,
    Design,
    Dimension,
    Effect,
    FloatArray,
    Parameter,
    Shape,
    Words,
    index_change,
    needs_linear_axis,
    needs_logged,
)
from zlmreport_plugins.effects import experiments

LOGS = STATE_OF_AIR


def logged_index_change(design: Design) -> FloatArray:
    """Return Δn at each reading, against standard air."""
    temperature, pressure, humidity = (design.conditions[name] for name in LOGS)
    return index_change(temperature, pressure, humidity)


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
    ranges_from = Words(
        en="by its definition: 0 where the air is corrected wholly, 1 where it is not corrected",
        de="nach seiner Definition: 0, wo die Luft ganz korrigiert ist, 1, wo sie nicht korrigiert ist",
    )
    look = Words(
        en="The residuals fan out over the position, and the slope follows the air.",
        de="Die Residuen fächern über der Position auf, und die Steigung folgt der Luft.",
    )
    confusions = (
        Confusion("dead-path", experiments.DEAD_PATH_CHANGED),
        Confusion("scale-expansion", experiments.OTHER_AIR),
        Confusion("scale-error", experiments.OTHER_AIR),
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
    ranges_from = Words(
        en="no length is negative; 2000 mm is chosen wide",
        de="keine Länge ist negativ; 2000 mm sind weit gewählt",
    )
    look = Words(
        en="The residuals follow the air, at all positions alike.",
        de="Die Residuen folgen der Luft, an allen Positionen gleich.",
    )
    confusions = (
        Confusion("air-index", experiments.DEAD_PATH_CHANGED),
        Confusion("time-periodic", experiments.BEAM_SHIELDED),
        Confusion("offset", experiments.DEAD_PATH_CHANGED),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the state of the air."""
        return needs_linear_axis(design) or needs_logged(design, *LOGS)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: change of the index."""
        return logged_index_change(design)[:, np.newaxis]
