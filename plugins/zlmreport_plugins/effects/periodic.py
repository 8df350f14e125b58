"""Errors that repeat: with the turn of a screw or a rotary axis, the signal of a scale, or with neither."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np
from pydantic import AfterValidator, Field

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
    harmonic_columns,
    harmonic_parameters,
    needs_both_directions,
    needs_linear_axis,
    needs_rotary_axis,
    needs_targets,
    needs_whole_period,
)
from zlmreport_plugins.effects import experiments

#: In which a contest tries such an effect.
COMBINATIONS = ((1,), (2,), (1, 2))
_SCREW_PITCH = "axis.screw_pitch"
_LARGEST_OF_PITCH = 50e-6
_LARGEST_OF_DIRECTION = 20e-6
_SIGNAL_PERIOD = "axis.signal_period"
_LARGEST_OF_SIGNAL = 10e-6
_LARGEST_OF_ANY = 200e-6
#: Fewer periods within the travel are a bow; more than half the number of targets cannot be told from fewer.
_FEWEST_PERIODS = 1.3
_STEPS_PER_PERIOD = 4
_LEAST_TARGETS = 6

_LARGEST = 2e-3
_WAVES = 2
_TURN = 2 * math.pi
#: One and two waves a turn have names of their own; fewer waves in the travel are a bow.
_FEWEST_TEETH = 3
_FEWEST_WAVES = 1.3
_LEAST_TARGETS_OF_A_GEAR = 6


def _distinct(harmonics: tuple[int, ...]) -> tuple[int, ...]:
    if len(set(harmonics)) < len(harmonics):
        raise ValueError("a harmonic stands there twice; each is named once, as in [1, 2]")
    return harmonics


class HarmonicOptions(Options):
    """The harmonics of a known period."""

    harmonics: Annotated[tuple[Annotated[int, Field(ge=1, le=4)], ...], AfterValidator(_distinct)] = Field(
        (1, 2), min_length=1, description="Harmonics of the period, 1 to 4: 1 is once a period."
    )


def _period(notation: str, meaning: Words) -> tuple[Parameter]:
    return (Parameter("period", notation, Dimension.POSITION, meaning, 0.0),)


class _KnownPeriod(Effect):
    """What waves share whose period the job states: it is known, and not searched."""

    #: The key of the axis that states it.
    stated_as = "screw_pitch"

    def grid(self, design: Design) -> FloatArray:
        """Return the period that the job states."""
        return np.array([[getattr(design.axis, self.stated_as)]], dtype=np.float64)

    def expected(self, axis: Axis) -> dict[str, float]:
        """Return the period."""
        period = getattr(axis, self.stated_as)
        return {} if period is None else {"period": period}


class _Harmonics(_KnownPeriod):
    """Such a wave by position, with the harmonics that its keys choose."""

    options = HarmonicOptions
    largest: float  #: Amplitude that is plausible, m or rad.

    def __init__(self, settings: HarmonicOptions | None = None) -> None:
        self.settings = settings or HarmonicOptions()
        self.orders = self.settings.harmonics
        self.linear = harmonic_parameters(self.orders, self.largest)

    def with_settings(self, settings: HarmonicOptions) -> Effect:
        """Return the effect with the stated harmonics."""
        return type(self)(settings)

    def forms(self) -> tuple[Effect, ...]:
        """Return the combinations of harmonics that a contest tries."""
        return tuple(type(self)(HarmonicOptions(harmonics=orders)) for orders in COMBINATIONS)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return sine and cosine of each harmonic."""
        return harmonic_columns(2 * np.pi * design.position / theta[0], self.orders)


class ScrewPitch(_Harmonics):
    """A periodic error of the ball screw, its bearing or its coupling: it repeats with every turn.

    Targets at whole pitches all see the same phase and do not see it at all; ISO 230-2 asks for random
    fractions in the targets for this reason.
    """

    identifier = "screw-pitch"
    title = Words(en="Periodic error of the screw", de="Periodischer Steigungsfehler der Spindel")
    equation = "Σ A_{h}·sin(2π·h·P/p_{0} + φ_{h})"
    searched = _period("p_{0}", Words(en="pitch of the screw", de="Steigung der Spindel"))
    shape = Shape.POSITION
    look = Words(
        en="The residuals repeat with the pitch: folded at it, they lie on one wave.",
        de="Die Residuen wiederholen sich mit der Steigung: über ihr gefaltet liegen sie auf einer Welle.",
    )
    remedy = Words(
        en="Mostly wobble of the screw in its bearings, a coupling out of line or a bent shaft: check run-"
        "out, bearings and coupling, then the screw. A pitch table carries it only with four or more rows"
        " a pitch, else leave it out. A linear scale as feedback removes it.",
        de="Meist Taumeln der Spindel in ihren Lagern, eine nicht fluchtende Kupplung oder eine krumme "
        "Welle: Rundlauf, Lager und Kupplung prüfen, dann die Spindel. Eine Spindelfehlertabelle trägt es"
        " nur mit vier oder mehr Zeilen je Steigung, sonst weglassen. Ein Linearmaßstab als Messsystem "
        "beseitigt es.",
    )
    confusions = (Confusion("periodic", experiments.FINE_RUN),)
    largest = _LARGEST_OF_PITCH

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, its pitch, and a travel of one turn."""
        return needs_linear_axis(design) or needs_whole_period(design, design.axis.screw_pitch, _SCREW_PITCH)


class DirectionalPitch(_KnownPeriod):
    """A wobbling axial bearing or a bent screw: the reversal value itself repeats with the pitch.

    Nothing else known does so; a fine run over two pitches shows it. It cannot be seen at whole pitches.
    """

    identifier = "directional-pitch"
    title = Words(en="Periodic lost motion of the screw", de="Periodische Umkehrspanne der Spindel")
    equation = "d·A·sin(2π·P/p_{0} + φ)"
    linear = harmonic_parameters([1], _LARGEST_OF_DIRECTION)
    searched = _period(
        "p_{0}", Words(en="pitch of the screw or gear", de="Steigung der Spindel oder Teilung des Getriebes")
    )
    shape = Shape.DIRECTION
    look = Words(
        en="The gap between the directions repeats with the pitch.",
        de="Der Abstand der beiden Richtungen wiederholt sich mit der Steigung.",
    )
    remedy = Words(
        en="A bent screw or an axial run-out of its bearing that changes sides with the direction: check "
        "run-out, bearing and alignment of the nut. Only a table for each direction with four or more "
        "rows a pitch removes it.",
        de="Eine krumme Spindel oder ein Axialschlag ihres Lagers, der mit der Richtung die Seite wechselt: "
        "Schlag, Lager und Flucht der Mutter prüfen. Nur eine Tabelle je Richtung mit vier oder mehr "
        "Zeilen je Steigung beseitigt es.",
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand both directions, the pitch, and a travel of one turn."""
        return needs_both_directions(design) or needs_whole_period(
            design, design.axis.screw_pitch, _SCREW_PITCH
        )

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return sine and cosine, with the sign of the approach."""
        return design.direction[:, np.newaxis] * harmonic_columns(2 * np.pi * design.position / theta[0], [1])


class EncoderInterpolation(_Harmonics):
    """Offset, unequal amplitudes and phase of an encoder's two signals: an error within each signal period.

    Makers state 1 % to 2 % of the signal period: 0.2 µm to 0.4 µm at 20 µm. The period is exact in the
    encoder's own positions, so it is known; targets must be true to a micrometre, and at random fractions
    of the period, or the error looks like independent noise. Micro steps over two or three signal periods
    show it plainly.
    """

    identifier = "encoder-interpolation"
    title = Words(en="Interpolation error of the encoder", de="Interpolationsabweichung des Messsystems")
    equation = "Σ A_{h}·sin(2π·h·P/Λ_{s} + φ_{h})"
    searched = _period("Λ_{s}", Words(en="signal period of the scale", de="Signalperiode des Maßstabs"))
    stated_as = "signal_period"
    shape = Shape.POSITION
    look = Words(
        en="The residuals look like noise over the travel; folded at the signal period they lie on a wave.",
        de="Die Residuen sehen über dem Verfahrweg wie Rauschen aus; über der Signalperiode gefaltet "
        "liegen sie auf einer Welle.",
    )
    remedy = Words(
        en="Dirt, a wrong gap or badly adjusted signals of the reading head: clean the scale, set gap and "
        "tilt, adjust amplitude, offset and phase of the signals. No table of a control is fine enough "
        "for it.",
        de="Schmutz, ein falscher Spalt oder schlecht abgeglichene Signale des Abtastkopfs: Maßstab "
        "reinigen, Spalt und Neigung einstellen, Amplitude, Offset und Phase der Signale abgleichen. "
        "Keine Tabelle einer Steuerung ist fein genug dafür.",
    )
    largest = _LARGEST_OF_SIGNAL

    def untestable(self, design: Design) -> Words | None:
        """Demand the signal period, and a travel that holds one."""
        return needs_whole_period(design, design.axis.signal_period, _SIGNAL_PERIOD)


class Periodic(Effect):
    """A wave of unknown period: magnets of a linear motor, teeth of a rack, a gear, a wavy guideway.

    The period is searched, which makes this the dearest of all effects: it takes much evidence. On evenly
    spaced targets a short period looks like a longer one as well; random fractions in the targets part them.
    """

    identifier = "periodic"
    title = Words(en="Periodic error of unknown period", de="Periodische Abweichung unbekannter Periode")
    equation = "A·sin(2π·P/Λ + φ)"
    linear = harmonic_parameters([1], _LARGEST_OF_ANY)
    searched = _period("Λ", Words(en="period along the axis", de="Periode längs der Achse"))
    shape = Shape.POSITION
    look = Words(
        en="The residuals repeat along the axis, the same in both directions.",
        de="Die Residuen wiederholen sich längs der Achse, in beiden Richtungen gleich.",
    )
    remedy = Words(
        en="The period tells the part: motor poles, coupling, gear, rack, guide carriages, the spacing of "
        "mounting screws. Mend that part. A table with four or more rows a period removes what is fixed "
        "in position.",
        de="Die Periode verrät das Bauteil: Motorpole, Kupplung, Getriebe, Zahnstange, Führungswagen, "
        "Abstand der Befestigungsschrauben. Dieses Teil instand setzen. Eine Tabelle mit vier oder mehr "
        "Zeilen je Periode beseitigt, was an die Position gebunden ist.",
    )
    confusions = (
        Confusion("screw-pitch", experiments.FINE_RUN),
        Confusion("gear-mesh", experiments.FULL_TURN),
        Confusion("compensation-sign", experiments.TABLE_OFF),
        Confusion("time-periodic", experiments.LINEAR_METHOD),
        Confusion("polynomial", experiments.DENSER_TARGETS),
        Confusion("abbe", experiments.OTHER_HEIGHT),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand enough targets for a wave."""
        return needs_targets(design, _LEAST_TARGETS)

    def grid(self, design: Design) -> FloatArray:
        """Return periods, even in 1/Λ: steps by which a wave shifts a quarter of a period over the travel."""
        most = len(design.target_positions) / 2
        periods_within = np.arange(_FEWEST_PERIODS, most + 1e-9, 1 / _STEPS_PER_PERIOD)
        return (design.length / periods_within)[:, np.newaxis]

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return sine and cosine."""
        return harmonic_columns(2 * np.pi * design.position / theta[0], [1])


class Eccentricity(Effect):
    """A wave of one period a turn, of amplitude e/R: 1 µm at a radius of 50 mm is 20 µrad or 4.1″.

    Over part of a turn a polynomial imitates it; over 40° it cannot be seen.
    """

    identifier = "eccentricity"
    title = Words(en="Eccentricity of the graduation", de="Exzentrizität der Teilung")
    equation = "A·sin(θ + φ)"
    linear = harmonic_parameters([1], _LARGEST)
    shape = Shape.POSITION
    look = Words(
        en="The residuals make one wave a turn.",
        de="Die Residuen bilden eine Welle je Umdrehung.",
    )
    remedy = Words(
        en="The graduation is not centred on the axis: centre the disc or ring with a dial gauge, or read it"
        " with two heads 180° apart. A table of the control removes the wave as long as nobody touches "
        "the mounting.",
        de="Die Teilung ist nicht zur Achse zentriert: Scheibe oder Ring mit der Messuhr zentrieren oder mit"
        " zwei um 180° versetzten Köpfen ablesen. Eine Tabelle der Steuerung beseitigt die Welle, solange"
        " niemand die Montage verändert.",
    )
    confusions = (
        Confusion("polynomial", experiments.FULL_TURN),
        Confusion("ellipticity", experiments.TWO_HEADS),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a rotary axis."""
        return needs_rotary_axis(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return sine and cosine."""
        return harmonic_columns(design.position, [1])


class Ellipticity(Effect):
    """Two waves a turn: a misaligned coupling (β²/4; 10 mrad are 5″), an oval bearing, a wobbling disc."""

    identifier = "ellipticity"
    title = Words(en="Two waves a turn (coupling, wobble)", de="Zwei Wellen je Umdrehung (Kupplung, Taumeln)")
    equation = "A·sin(2·θ + φ)"
    linear = harmonic_parameters([1], _LARGEST)
    shape = Shape.POSITION
    look = Words(
        en="The residuals make two waves a turn.",
        de="Die Residuen bilden zwei Wellen je Umdrehung.",
    )
    remedy = Words(
        en="A coupling between shafts at an angle, a ring distorted by its screws, or a wobbling disc: align"
        " the coupling, tighten the ring evenly. A table removes what stays fixed to the angle.",
        de="Eine Kupplung zwischen winkligen Wellen, ein von seinen Schrauben verzogener Ring oder eine "
        "taumelnde Scheibe: Kupplung ausrichten, Ring gleichmäßig anziehen. Eine Tabelle beseitigt, was "
        "an den Winkel gebunden bleibt.",
    )
    confusions = (
        Confusion("polynomial", experiments.FULL_TURN),
        Confusion("eccentricity", experiments.TWO_HEADS),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a rotary axis."""
        return needs_rotary_axis(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return sine and cosine of the double angle."""
        return harmonic_columns(_WAVES * design.position, [1])


class GearMesh(Effect):
    """A whole number of waves a turn: teeth of the worm wheel or of the pinion, poles of a torque motor.

    The pitch of the gear in degrees, `axis.screw_pitch`, gives the number; without it whole numbers are
    scanned, as many as the targets can tell. Targets every 30° are blind to a wheel of 360 teeth.
    """

    identifier = "gear-mesh"
    title = Words(en="Periodic error of the gear", de="Periodische Abweichung des Getriebes")
    equation = "A·sin(z·θ + φ)"
    linear = harmonic_parameters([1], _LARGEST)
    searched = (
        Parameter(
            "teeth",
            "z",
            Dimension.RATIO,
            Words(en="waves a turn: teeth or poles", de="Wellen je Umdrehung: Zähne oder Pole"),
            _FEWEST_TEETH,
            is_refined=False,
        ),
    )
    shape = Shape.POSITION
    look = Words(
        en="The residuals make a whole number of waves a turn.",
        de="Die Residuen bilden eine ganze Zahl von Wellen je Umdrehung.",
    )
    remedy = Words(
        en="Worm or gear repeat with each tooth: check run-out, pre-load and wear of the worm. A table "
        "carries it only with four or more rows a tooth; an encoder on the table itself removes it.",
        de="Schnecke oder Rad wiederholen sich mit jedem Zahn: Rundlauf, Vorspannung und Verschleiß der "
        "Schnecke prüfen. Eine Tabelle trägt es nur mit vier oder mehr Zeilen je Zahn; ein Messsystem am "
        "Tisch selbst beseitigt es.",
    )
    confusions = (Confusion("periodic", experiments.FULL_TURN),)

    def untestable(self, design: Design) -> Words | None:
        """Demand a rotary axis, and enough targets for a wave."""
        return needs_rotary_axis(design) or needs_targets(design, _LEAST_TARGETS_OF_A_GEAR)

    def grid(self, design: Design) -> FloatArray:
        """Return the number that the job states, or the numbers that the targets can tell."""
        stated = self.expected(design.axis)
        if stated:
            return np.array([[stated["teeth"]]])
        turns = design.length / _TURN
        fewest = max(_FEWEST_TEETH, math.ceil(_FEWEST_WAVES / turns))
        most = max(fewest, math.floor(len(design.target_positions) / (2 * turns)))
        return np.arange(fewest, most + 1, dtype=np.float64)[:, np.newaxis]

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return sine and cosine."""
        return harmonic_columns(theta[0] * design.position, [1])

    def expected(self, axis: Axis) -> dict[str, float]:
        """Return the number of teeth that a stated pitch means."""
        return {} if axis.screw_pitch is None else {"teeth": float(round(_TURN / axis.screw_pitch))}
