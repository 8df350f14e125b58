"""What probing a gauge adds to the error model: the radius of the probe, and a gauge that lies askew."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from zlmreport.plugin import FloatArray, Words, hookimpl
from zlmreport.plugin.effect import (
    Confusion,
    Design,
    Dimension,
    Effect,
    Parameter,
    Shape,
    needs_linear_axis,
    needs_logged,
)

#: A logged column: +1 where a probe touched the gauge in the positive direction, −1 in the negative.
FACE = "face"

_CALIBRATED_BLOCK = Words(
    en="measure a calibrated gauge block or ring with both faces",
    de="ein kalibriertes Endmaß oder einen Einstellring mit beiden Flächen messen",
)
_GAUGE_REALIGNED = Words(
    en="align the gauge anew, or take the lengths along its own measured direction",
    de="den Prüfkörper neu ausrichten oder die Längen entlang seiner eigenen, gemessenen Richtung nehmen",
)
_GAUGE_REPLACED_BY_LASER = Words(
    en="repeat with an aligned laser beam in place of the gauge",
    de="mit einem ausgerichteten Laserstrahl statt des Prüfkörpers wiederholen",
)


class ProbeRadius(Effect):
    """Faces of a gauge that are touched in opposite directions stand apart by twice the error of the radius.

    The column `face` says which was touched: +1 in the positive direction, −1 in the negative. Where the
    face is always that of the direction of approach, this is backlash.
    """

    identifier = "probe-radius"
    title = Words(en="Error of the probe radius", de="Abweichung des Tastkugelradius")
    equation = "f·ΔR"
    linear = (
        Parameter(
            "radius_error",
            "ΔR",
            Dimension.DEVIATION,
            Words(en="error of the effective radius", de="Abweichung des wirksamen Radius"),
            -15e-6,
            15e-6,
        ),
    )
    shape = Shape.DIRECTION
    look = Words(
        en="The two kinds of faces stand apart by the same amount everywhere.",
        de="Die beiden Arten von Flächen liegen überall um denselben Betrag auseinander.",
    )
    remedy = Words(
        en="The probe, not the machine: qualify it at a calibrated sphere or ring with the force and speed "
        "of the test, enter its effective radius and evaluate anew. Never compensate it as backlash.",
        de="Der Taster, nicht die Maschine: mit Kraft und Geschwindigkeit der Prüfung an kalibrierter Kugel "
        "oder Ring einmessen, den wirksamen Radius eintragen und neu auswerten. Nie als Lose "
        "kompensieren.",
    )
    confusions = (Confusion("backlash", _CALIBRATED_BLOCK),)

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the faces."""
        return needs_linear_axis(design) or needs_logged(design, FACE)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: the sign of the face."""
        return np.sign(design.conditions[FACE])[:, np.newaxis]


class GaugeMisalignment(Effect):
    """A gauge at an angle φ is P·cos φ long along the axis; projection on its own direction removes this.

    What a lateral offset adds on tilted faces is the same for every face of a kind, and ends in the probe's
    radius. The column `face` tells that a gauge was measured and no beam.
    """

    identifier = "gauge-misalignment"
    title = Words(en="Misalignment of the step gauge", de="Schiefstellung des Stufenendmaßes")
    equation = "−P·φ²/2"
    linear = (
        Parameter(
            "shortening",
            "φ²/2",
            Dimension.SLOPE,
            Words(
                en="relative shortening by the misalignment",
                de="relative Verkürzung durch die Schiefstellung",
            ),
            0.0,
            50e-6,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals fall in proportion to the position.",
        de="Die Residuen fallen im Verhältnis zur Position.",
    )
    remedy = Words(
        en="The set-up, not the machine: align the gauge to the axis, or take the lengths along its own "
        "measured direction. Never compensate it.",
        de="Der Messaufbau, nicht die Maschine: den Prüfkörper zur Achse ausrichten oder die Längen entlang "
        "seiner eigenen, gemessenen Richtung nehmen. Nie kompensieren.",
    )
    confusions = (
        Confusion("cosine-error", _GAUGE_REPLACED_BY_LASER),
        Confusion("scale-error", _GAUGE_REALIGNED),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the faces of a gauge."""
        return needs_linear_axis(design) or needs_logged(design, FACE)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: −P."""
        return -design.position[:, np.newaxis]


@hookimpl
def zlmreport_effects() -> Iterable[Effect]:
    """Return what a probe and a gauge that lies askew add to the error model."""
    return [ProbeRadius(), GaugeMisalignment()]
