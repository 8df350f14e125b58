"""What the course of a test brings: lost motion at reversal, a wave in time, a datum step, a first run."""

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
    needs_both_directions,
    needs_passing_time,
    needs_runs,
    needs_targets,
)
from zlmreport_plugins.effects import experiments

#: Of the travel: a shorter distance ends before the second target, a longer one is a straight line.
_SHORTEST, _LONGEST = 0.01, 0.2
_LENGTHS = 10

_LARGEST = 50e-6
#: Periods within the test: fewer are a drift, more are taken for noise.
_PERIODS_WITHIN = np.linspace(1.3, 9.0, 32)
_MOST_MOMENTS = 200
_LEAST_MOMENTS = 4
#: With two runs nothing says which of them stands off.
_LEAST_RUNS = 3


class Backlash(Effect):
    """The same gap between the directions everywhere: play in the drive, friction, a flexible coupling.

    B has the sign of B_i = x̄_i↑ − x̄_i↓. Play between the drive and a table that is measured at the table
    makes it negative: the table lags behind in either direction. A following error at one feed looks alike.
    """

    identifier = "backlash"
    title = Words(en="Lost motion at reversal", de="Umkehrspanne")
    equation = "½·B·d"
    linear = (
        Parameter(
            "lost_motion",
            "B",
            Dimension.DEVIATION,
            Words(en="reversal value of the whole axis", de="Umkehrspanne der ganzen Achse"),
            -500e-6,
            500e-6,
        ),
    )
    shape = Shape.DIRECTION
    look = Words(
        en="The two directions stand apart by the same amount everywhere.",
        de="Die beiden Richtungen liegen überall um denselben Betrag auseinander.",
    )
    remedy = Words(
        en="Play of nut, bearing, coupling or gear: re-tension bearing and nut, tighten the coupling, "
        "replace what is worn. The backlash value of the control, or a table for each direction, removes "
        "a constant gap; use one of them, never both. Play that changes under load stays.",
        de="Spiel von Mutter, Lager, Kupplung oder Getriebe: Lager und Mutter nachspannen, Kupplung "
        "festziehen, Verschlissenes ersetzen. Der Losewert der Steuerung oder eine Tabelle je Richtung "
        "beseitigt eine feste Umkehrspanne; eines von beiden, nie beides. Spiel, das sich unter Last "
        "ändert, bleibt.",
    )
    confusions = (
        Confusion("probe-radius", experiments.CALIBRATED_BLOCK),
        Confusion("reversal-relaxation", experiments.OTHER_OVERRUN),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand both directions."""
        return needs_both_directions(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: half the direction."""
        return design.direction[:, np.newaxis] / 2


class BacklashGradient(Effect):
    """A screw held at one end winds up the more, the farther the nut is from its bearing; guides wear.

    In the linear method the distance since the reversal grows along the axis as well: whatever is in
    proportion to that distance looks the same, until the overrun is changed.
    """

    identifier = "backlash-gradient"
    title = Words(en="Lost motion that grows along the axis", de="Längs der Achse wachsende Umkehrspanne")
    equation = "g·d·P"
    linear = (
        Parameter(
            "gradient",
            "g",
            Dimension.SLOPE,
            Words(en="half the growth of the gap per position", de="halbe Zunahme des Abstands je Position"),
            -200e-6,
            200e-6,
        ),
    )
    shape = Shape.DIRECTION
    look = Words(
        en="The two directions draw apart along the axis.",
        de="Die beiden Richtungen laufen längs der Achse auseinander.",
    )
    remedy = Words(
        en="The screw winds up against friction that grows with its free length: check lubrication, wipers "
        "and pre-load along the travel. One backlash value removes only the mean gap; a table for each "
        "direction removes it all.",
        de="Die Spindel verdrillt sich gegen Reibung, mit wachsender freier Länge mehr: Schmierung, "
        "Abstreifer und Vorspannung über den Verfahrweg prüfen. Ein Losewert beseitigt nur die mittlere "
        "Umkehrspanne; eine Tabelle je Richtung beseitigt alles.",
    )
    confusions = (Confusion("reversal-relaxation", experiments.OTHER_OVERRUN),)

    def untestable(self, design: Design) -> Words | None:
        """Demand both directions."""
        return needs_both_directions(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: the position, with the sign of the approach."""
        return (design.direction * design.position)[:, np.newaxis]


class BacklashBow(Effect):
    """A screw fixed at both ends is most compliant in its middle, and so is its lost motion."""

    identifier = "backlash-bow"
    title = Words(en="Lost motion that is largest in the middle", de="In der Mitte größte Umkehrspanne")
    equation = "k·d·(1 − p²);  p = (P − P_{mid}) / (L/2)"
    linear = (
        Parameter(
            "bow",
            "k",
            Dimension.DEVIATION,
            Words(en="half the additional gap in the middle", de="halber zusätzlicher Abstand in der Mitte"),
            -100e-6,
            100e-6,
        ),
    )
    shape = Shape.DIRECTION
    look = Words(
        en="The two directions stand apart most in the middle of the travel.",
        de="Die beiden Richtungen liegen in der Mitte des Verfahrwegs am weitesten auseinander.",
    )
    remedy = Words(
        en="A screw held at both ends gives most in its middle: check its tension and both bearings, and "
        "lubricate. One backlash value removes only the mean gap; a table for each direction removes it "
        "all.",
        de="Eine beidseitig gelagerte Spindel gibt in der Mitte am meisten nach: Spannung und beide Lager "
        "prüfen, schmieren. Ein Losewert beseitigt nur die mittlere Umkehrspanne; eine Tabelle je "
        "Richtung beseitigt alles.",
    )
    confusions = (Confusion("reversal-relaxation", experiments.OTHER_OVERRUN),)

    def untestable(self, design: Design) -> Words | None:
        """Demand both directions, and targets between the ends."""
        return needs_both_directions(design) or needs_targets(design, 3)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: a parabola over the travel, with the sign of the approach."""
        scaled = (design.position - design.middle) / (design.length / 2)
        return (design.direction * (1 - scaled**2))[:, np.newaxis]


class ReversalRelaxation(Effect):
    """Friction and elastic wind-up that fade with the distance s since the last reversal.

    Where every target is approached from the same distance (pendulum, quasi-pilgrim step) this is backlash.
    """

    identifier = "reversal-relaxation"
    title = Words(en="Relaxation after a reversal", de="Ausklingen nach einer Umkehr")
    equation = "A·d·exp(−s/λ)"
    linear = (
        Parameter(
            "amplitude",
            "A",
            Dimension.DEVIATION,
            Words(en="deviation at the reversal", de="Abweichung an der Umkehr"),
            -100e-6,
            100e-6,
        ),
    )
    searched = (
        Parameter(
            "relaxation_length",
            "λ",
            Dimension.POSITION,
            Words(
                en="distance over which it fades to a third",
                de="Strecke, auf der sie auf ein Drittel abklingt",
            ),
            0.0,
            0.5,
        ),
    )
    shape = Shape.DIRECTION
    look = Words(
        en="The first targets after each reversal stand off.",
        de="Die ersten Zielpositionen nach jeder Umkehr liegen daneben.",
    )
    remedy = Words(
        en="Friction and elasticity let the axis settle only some way after each reversal: lubricate, check "
        "nut, wipers and pre-load of the guides. A longer overrun in the program avoids it. No table of "
        "positions removes it, for it depends on the way since the reversal.",
        de="Reibung und Nachgiebigkeit lassen die Achse erst ein Stück nach jeder Umkehr zur Ruhe kommen: "
        "schmieren, Mutter, Abstreifer und Vorspannung der Führungen prüfen. Ein längerer Überlauf im "
        "Programm vermeidet es. Keine Positionstabelle beseitigt es, denn es hängt vom Weg seit der "
        "Umkehr ab.",
    )
    confusions = (
        Confusion("backlash", experiments.OTHER_OVERRUN),
        Confusion("backlash-bow", experiments.OTHER_OVERRUN),
        Confusion("backlash-gradient", experiments.OTHER_OVERRUN),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand targets at different distances."""
        return needs_targets(design, 3)

    def grid(self, design: Design) -> FloatArray:
        """Return lengths in a geometric row."""
        return design.length * np.geomspace(_SHORTEST, _LONGEST, _LENGTHS)[:, np.newaxis]

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return one column: the exponential, with the sign of the approach."""
        fading = np.exp(-design.since_reversal / float(theta[0]))
        return (design.direction * fading)[:, np.newaxis]


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
    remedy = Words(
        en="Something comes and goes with this period: cooler, air conditioning, hydraulics, a door. Switch "
        "it off or shield beam and machine from it while measuring; for the work, smooth its cycle. No "
        "table removes it.",
        de="Etwas kommt und geht mit dieser Periode: Kühler, Klimaanlage, Hydraulik, ein Tor. Beim Messen "
        "abschalten oder Strahl und Maschine davor abschirmen; für die Arbeit seinen Takt glätten. Keine "
        "Tabelle beseitigt es.",
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
    remedy = Words(
        en="Something slipped or broke off: the beam, a magnetic base, optics, a reference run. Fasten it, "
        "check the preset and repeat the test. There is nothing to compensate.",
        de="Etwas ist verrutscht oder abgerissen: der Strahl, ein Magnetfuß, eine Optik, eine neue "
        "Referenzfahrt. Befestigen, Nullung prüfen und die Prüfung wiederholen. Zu kompensieren ist "
        "nichts.",
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
    remedy = Words(
        en="The axis was still running in, or the zero was set after the first run: move it to and fro along"
        " the travel some times before the first reading, and repeat. There is nothing to compensate.",
        de="Die Achse lief noch ein, oder der Nullpunkt wurde nach dem ersten Durchlauf gesetzt: vor dem "
        "ersten Messwert einige Male über den Verfahrweg fahren und wiederholen. Zu kompensieren ist "
        "nichts.",
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
