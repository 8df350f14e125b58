"""What is fixed in position: errors of length, of beam and of guide, and a scale that is not of one piece."""

from __future__ import annotations

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
    needs_linear_axis,
    needs_stated,
    needs_targets,
)
from zlmreport_plugins.effects import experiments

_ORDERS_OF_A_CONTEST = (2, 3, 4, 5)
_LARGEST = 500e-6

_LEAST_TARGETS = 5
#: Closer to the ends a kink is hardly more than a single target that stands off.
_PLACES = np.linspace(0.12, 0.88, 20)


class Offset(Effect):
    """A constant: where the instrument was preset.

    It says nothing of the axis: the instrument's common error, a dead path in constant air and the mean of
    every drift end here as well.
    """

    identifier = "offset"
    title = Words(en="Zero offset", de="Nullpunktverschiebung")
    equation = "a"
    linear = (
        Parameter(
            "offset",
            "a",
            Dimension.DEVIATION,
            Words(en="offset of the zero", de="Verschiebung des Nullpunkts"),
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals stand off zero by the same amount everywhere.",
        de="Die Residuen liegen überall um denselben Betrag neben null.",
    )
    remedy = Words(
        en="A choice of zero, no error of the machine: preset the instrument at the reference point of the "
        "axis. There is nothing to mend; a compensation table begins with zero there.",
        de="Eine Wahl des Nullpunkts, kein Fehler der Maschine: das Messgerät am Referenzpunkt der Achse "
        "nullen. Zu beheben ist nichts; eine Kompensationstabelle beginnt dort mit null.",
    )
    confusions = (
        Confusion("dead-path", experiments.DEAD_PATH_CHANGED),
        Confusion("thermal-drift", experiments.PRESET_AGAIN),
    )

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: 1."""
        return np.ones((len(design.position), 1))


class ScaleError(Effect):
    """A deviation in proportion to the position: lead of the screw, length of the scale, wavelength.

    In a single test nothing tells it from an expansion at constant temperature, a wrong coefficient of
    expansion in the correction, or a wrong refractive index.
    """

    identifier = "scale-error"
    title = Words(en="Scale error", de="Maßstabsfehler")
    equation = "b·P"
    linear = (
        Parameter(
            "slope",
            "b",
            Dimension.SLOPE,
            Words(en="error per position", de="Abweichung je Position"),
            -500e-6,
            500e-6,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals lie on a straight line over the position, the same in both directions.",
        de="Die Residuen liegen über der Position auf einer Geraden, in beiden Richtungen auf derselben.",
    )
    remedy = Words(
        en="Mostly the lead of the screw, a scale mounted under strain, or the set-up. Check the "
        "compensation of wavelength and material and the alignment of the beam first, then mounting and "
        "tension of scale or screw. A slope in the pitch table removes what is left, at this temperature "
        "only.",
        de="Meist die Steigung der Spindel, ein unter Zwang montierter Maßstab oder der Messaufbau. Zuerst "
        "die Kompensation von Wellenlänge und Material und die Ausrichtung des Strahls prüfen, dann "
        "Montage und Spannung von Maßstab oder Spindel. Eine Steigung in der Spindelfehlertabelle "
        "beseitigt den Rest, nur bei dieser Temperatur.",
    )
    confusions = (
        Confusion("cosine-error", experiments.BEAM_REALIGNED),
        Confusion("gauge-misalignment", experiments.GAUGE_REALIGNED),
        Confusion("scale-expansion", experiments.WARMER_AXIS),
        Confusion("thermal-growth", experiments.COLD_RESTART),
        Confusion("air-index", experiments.OTHER_AIR),
    )

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: P."""
        return design.position[:, np.newaxis]


class PolynomialOptions(Options):
    """The order of the polynomial."""

    order: int = Field(3, ge=2, le=9, description="Highest power of the position; 3 is a cubic.")


class Polynomial(Effect):
    """The full polynomial from its constant up, over the position scaled to −1 … 1 of the measured travel.

    It describes and explains nothing: guideways, a screw's lead and a table's bow all look like this. Its
    constant and its slope are those of `offset` and `scale-error`, which cannot stand beside it. An order
    above 3 swallows Abbe errors and kinks.
    """

    identifier = "polynomial"
    title = Words(en="Polynomial over the position", de="Polynom über der Position")
    equation = "Σ c_{k}·p^k, k = 0 … n;  p = (P − P_{mid}) / (L/2)"
    shape = Shape.POSITION
    look = Words(
        en="The residuals follow a smooth bow over the position, the same in both directions.",
        de="Die Residuen folgen über der Position einem glatten Bogen, in beiden Richtungen demselben.",
    )
    remedy = Words(
        en="It names no cause: the lead of the screw, bent guideways and the bow of a mounted scale look "
        "like this. Check level, straightness and tension. A pitch table with rows at the targets removes"
        " what stays, in the measured line.",
        de="Es nennt keine Ursache: Spindelsteigung, krumme Führungen und der Bogen eines montierten "
        "Maßstabs sehen so aus. Aufstellung, Geradheit und Spannung prüfen. Eine Spindelfehlertabelle mit"
        " Zeilen an den Zielpositionen beseitigt, was bleibt, in der gemessenen Linie.",
    )
    confusions = (
        Confusion("abbe", experiments.OTHER_HEIGHT),
        Confusion("scale-kink", experiments.DENSER_TARGETS),
        Confusion("periodic", experiments.DENSER_TARGETS),
        Confusion("compensation-sign", experiments.TABLE_OFF),
        Confusion("eccentricity", experiments.FULL_TURN),
        Confusion("ellipticity", experiments.FULL_TURN),
    )
    contains = ("offset", "scale-error")
    options = PolynomialOptions

    def __init__(self, order: int = 3) -> None:
        self.settings = PolynomialOptions(order=order)
        self.order = order
        self.linear = tuple(_coefficient(power) for power in range(order + 1))

    def with_settings(self, settings: PolynomialOptions) -> Effect:
        """Return the polynomial of the stated order."""
        return Polynomial(settings.order)

    def forms(self) -> tuple[Effect, ...]:
        """Return the polynomials that a contest tries."""
        return tuple(Polynomial(order) for order in _ORDERS_OF_A_CONTEST)

    def untestable(self, design: Design) -> Words | None:
        """Demand more targets than coefficients."""
        return needs_targets(design, self.order + 2)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return the powers of p."""
        scaled = (design.position - design.middle) / (design.length / 2)
        return np.vander(scaled, self.order + 1, increasing=True)


def _coefficient(power: int) -> Parameter:
    bound = _LARGEST if power > 1 else None
    return Parameter(
        f"c{power}",
        f"c_{{{power}}}",
        Dimension.DEVIATION,
        Words(en="coefficient of power {power}", de="Koeffizient der {power}. Potenz").given(power=power),
        None if bound is None else -bound,
        bound,
    )


class CosineError(Effect):
    """A beam at an angle φ reads P·cos φ: always too short, by φ²/2 in proportion.

    1 mrad costs 0.5 µm/m. If the returned beam walks by S over the distance D, then φ = S/(2D) and the
    error is S²/(8D²). A rising line cannot be a cosine error.
    """

    identifier = "cosine-error"
    title = Words(en="Cosine error of the beam", de="Kosinusfehler des Strahls")
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
            500e-6,
        ),
    )
    shape = Shape.POSITION
    ranges_from = Words(
        en="its sign by geometry: an inclined beam reads too short; the limit, 32 mrad, is chosen wide",
        de="ihr Vorzeichen nach der Geometrie: ein geneigter Strahl misst zu kurz; die Grenze, 32 mrad, ist "
        "weit gewählt",
    )
    look = Words(
        en="The residuals fall in proportion to the position.",
        de="Die Residuen fallen im Verhältnis zur Position.",
    )
    remedy = Words(
        en="The set-up, not the machine: align the beam along the whole travel and measure anew. Never "
        "compensate it, for the table would carry the error of the set-up into the machine.",
        de="Der Messaufbau, nicht die Maschine: den Strahl über den ganzen Verfahrweg ausrichten und neu "
        "messen. Nie kompensieren, denn die Tabelle trüge den Fehler des Aufbaus in die Maschine.",
    )
    confusions = (
        Confusion("scale-error", experiments.BEAM_REALIGNED),
        Confusion("gauge-misalignment", experiments.GAUGE_REPLACED_BY_LASER),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis."""
        return needs_linear_axis(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: −P."""
        return -design.position[:, np.newaxis]


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
    remedy = Words(
        en="The axis pitches or yaws, and the line lies beside the scale: adjust carriages, gibs or "
        "counterweight so that the angle gets less, or measure closer to the working line. A table "
        "removes it in this line only, and is wrong beside it.",
        de="Die Achse nickt oder giert, und die Messlinie liegt neben dem Maßstab: Führungswagen, Leisten "
        "oder Gegengewicht einstellen, damit der Winkel kleiner wird, oder näher an der Arbeitslinie "
        "messen. Eine Tabelle beseitigt es nur in dieser Linie und ist daneben falsch.",
    )
    confusions = (
        Confusion("polynomial", experiments.OTHER_HEIGHT),
        Confusion("periodic", experiments.OTHER_HEIGHT),
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


class ScaleJoint(Effect):
    """A step at one position in all runs and both directions: a joint of the scale, or a missed count."""

    identifier = "scale-joint"
    title = Words(en="Step at a joint of the scale", de="Sprung an einem Stoß des Maßstabs")
    equation = "A·H(P − P_{0})"
    linear = (
        Parameter(
            "step",
            "A",
            Dimension.DEVIATION,
            Words(en="height of the step", de="Höhe des Sprungs"),
            -100e-6,
            100e-6,
        ),
    )
    searched = (
        Parameter(
            "joint",
            "P_{0}",
            Dimension.POSITION,
            Words(en="position of the joint", de="Position des Stoßes"),
            is_refined=False,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals step at one position, in all runs and both directions.",
        de="Die Residuen springen an einer Position, in allen Durchläufen und beiden Richtungen.",
    )
    remedy = Words(
        en="Two pieces of scale or rack that do not butt as they should, or a count missed there: clean the "
        "place, and set the joint as its maker says. A table removes the step if it has a row close to "
        "either side.",
        de="Zwei Stücke Maßstab oder Zahnstange, die nicht richtig stoßen, oder ein dort verlorener "
        "Zählschritt: die Stelle reinigen und den Stoß nach Herstellerangabe einstellen. Eine Tabelle "
        "beseitigt den Sprung, wenn beiderseits dicht daneben eine Zeile steht.",
    )
    confusions = (
        Confusion("datum-step", experiments.LINEAR_METHOD),
        Confusion("scale-kink", experiments.STEP_SEARCHED),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand targets on both sides of an inner gap."""
        return needs_targets(design, _LEAST_TARGETS)

    def grid(self, design: Design) -> FloatArray:
        """Return the middle of every gap between targets but the outer ones."""
        targets = design.target_positions
        return ((targets[1:-2] + targets[2:-1]) / 2)[:, np.newaxis]

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return one column: 1 beyond the joint."""
        return np.where(design.position > theta[0], 1.0, 0.0)[:, np.newaxis]


class ScaleKink(Effect):
    """A kink: the end of a segment in a compensation table, a worn stretch, a second element of the scale."""

    identifier = "scale-kink"
    title = Words(en="Change of slope at one position", de="Knick der Abweichung an einer Position")
    equation = "A·max(0, P − P_{0})"
    linear = (
        Parameter(
            "slope",
            "A",
            Dimension.SLOPE,
            Words(en="change of the slope", de="Änderung der Steigung"),
            -500e-6,
            500e-6,
        ),
    )
    searched = (
        Parameter(
            "kink", "P_{0}", Dimension.POSITION, Words(en="position of the kink", de="Position des Knicks")
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals lie on two straight lines that meet at one position.",
        de="Die Residuen liegen auf zwei Geraden, die sich an einer Position treffen.",
    )
    remedy = Words(
        en="The end of a segment in an older compensation table, a worn stretch of the screw, or a scale "
        "that is held at one place: read the table back, check wear and mounting. A table with a row at "
        "the kink removes it, as long as the wear does not go on.",
        de="Das Ende eines Abschnitts in einer älteren Kompensationstabelle, ein verschlissenes Stück der "
        "Spindel oder ein an einer Stelle festgehaltener Maßstab: Tabelle zurücklesen, Verschleiß und "
        "Montage prüfen. Eine Tabelle mit einer Zeile am Knick beseitigt ihn, solange der Verschleiß "
        "nicht fortschreitet.",
    )
    confusions = (
        Confusion("polynomial", experiments.DENSER_TARGETS),
        Confusion("scale-joint", experiments.STEP_SEARCHED),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand targets on both sides."""
        return needs_targets(design, _LEAST_TARGETS)

    def grid(self, design: Design) -> FloatArray:
        """Return places along the travel, the ends left out."""
        return (design.middle + (_PLACES - 0.5) * design.length)[:, np.newaxis]

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return one column: the distance beyond the kink."""
        beyond = design.position - float(theta[0])
        return np.maximum(0.0, beyond)[:, np.newaxis]
