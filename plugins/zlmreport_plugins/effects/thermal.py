"""What warms, and the air in the beam: expansion along a logged temperature, growth and drift with time."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    STATE_OF_AIR,
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
    above_reference_temperature,
    index_change,
    needs_linear_axis,
    needs_logged,
    needs_passing_time,
)
from zlmreport_plugins.effects import experiments

#: Of the duration: a shorter one ends with the first readings, a longer one is a straight line.
_SHORTEST, _LONGEST = 0.05, 1.5
_CONSTANTS = 12
_SCALE_LOG = "axis_temperature"
_SCREW_LOG = "screw_temperature"
_OF_MATERIALS = Words(
    en="from no expansion (glass ceramic) to that of aluminium alloys, some 25 µm/(m·K); steel has 10 to 12",
    de="von keiner Ausdehnung (Glaskeramik) bis zu der von Aluminiumlegierungen, etwa 25 µm/(m·K); Stahl "
    "hat 10 bis 12",
)

_TIME_CONSTANT = Parameter(
    "time_constant", "τ", Dimension.TIME, Words(en="time constant", de="Zeitkonstante"), 60.0, 14_400.0
)

LOGS = STATE_OF_AIR


def time_constants(design: Design) -> FloatArray:
    """Return time constants in a geometric row, shape (12, 1)."""
    return design.duration * np.geomspace(_SHORTEST, _LONGEST, _CONSTANTS)[:, np.newaxis]


def warmed_up(design: Design, time_constant: float) -> FloatArray:
    """Return how much of the way to the final state is done at each reading, from 0 to 1."""
    return -np.expm1(-design.time / time_constant)


class ScaleExpansion(Effect):
    """A scale that is longer than at 20 °C puts the axis too far out, in proportion to the position.

    Glass ceramic 0, glass 8, steel 10 to 12 µm/(m·K). The temperature is never centred: only ΔT from 20 °C
    predicts another day. At constant temperature this is a scale error.
    """

    identifier = "scale-expansion"
    title = Words(en="Thermal expansion of the scale", de="Wärmeausdehnung des Maßstabs")
    equation = "α·P·(T_{s} − 20 °C)"
    linear = (
        Parameter(
            "expansion",
            "α",
            Dimension.EXPANSION,
            Words(
                en="coefficient of expansion, less the one compensated",
                de="nicht kompensierter Ausdehnungskoeffizient",
            ),
            0.0,
            25e-6,
        ),
    )
    shape = Shape.TIME
    ranges_from = _OF_MATERIALS
    look = Words(
        en="The residuals fan out over the position, and the slope follows the temperature of the scale.",
        de="Die Residuen fächern über der Position auf, und die Steigung folgt der Temperatur des Maßstabs.",
    )
    remedy = Words(
        en="The scale is warmer or colder than 20 °C: run a warm-up cycle, and put covers between the scale "
        "and coolant, sun and draught. A control that knows the temperature and coefficient of the scale "
        "follows it; a table holds at the temperature of its test only.",
        de="Der Maßstab ist wärmer oder kälter als 20 °C: Warmlauf fahren und den Maßstab gegen Kühlmittel, "
        "Sonne und Zugluft abdecken. Eine Steuerung, die Temperatur und Koeffizient des Maßstabs kennt, "
        "folgt; eine Tabelle gilt nur bei der Temperatur ihrer Prüfung.",
    )
    confusions = (
        Confusion("thermal-growth", experiments.TURNING_TEMPERATURE),
        Confusion("screw-expansion", experiments.SCREW_SENSOR),
        Confusion("scale-error", experiments.WARMER_AXIS),
        Confusion("air-index", experiments.OTHER_AIR),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the temperature of the scale."""
        return needs_linear_axis(design) or needs_logged(design, _SCALE_LOG)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: position times temperature above 20 °C."""
        return (design.position * above_reference_temperature(design.conditions[_SCALE_LOG]))[:, np.newaxis]


class BearingOptions(Options):
    """Where the screw is held."""

    fixed_bearing: Literal["first", "last"] = Field(
        "first",
        description="End of the travel at which the fixed bearing is: the first position, or the last.",
    )


class ScrewExpansion(Effect):
    """A screw measured by its own rotation grows with the heat of nut and bearings: 10 to 12 µm/(m·K).

    It grows away from its fixed bearing; a wrong origin spoils the fit, so both ends are tried.
    """

    identifier = "screw-expansion"
    title = Words(en="Thermal expansion of the screw", de="Wärmeausdehnung der Spindel")
    equation = "α·(P − P_{f})·(T_{b} − 20 °C)"
    linear = (
        Parameter(
            "expansion",
            "α",
            Dimension.EXPANSION,
            Words(en="coefficient of expansion of the screw", de="Ausdehnungskoeffizient der Spindel"),
            0.0,
            25e-6,
        ),
    )
    shape = Shape.TIME
    ranges_from = _OF_MATERIALS
    look = Words(
        en="The residuals fan out from one end of the travel as the screw warms up.",
        de="Die Residuen fächern von einem Ende des Verfahrwegs her auf, während die Spindel warm wird.",
    )
    remedy = Words(
        en="Nut, bearings and motor heat the screw: run a warm-up cycle, check lubrication and pre-load of "
        "the nut, the tension of the screw and its cooling. Compensation by a sensor at nut or bearing "
        "follows it in part, a linear scale as feedback removes it, a table does not.",
        de="Mutter, Lager und Motor erwärmen die Spindel: Warmlauf fahren, Schmierung und Vorspannung der "
        "Mutter, Reckung und Kühlung der Spindel prüfen. Eine Kompensation mit Fühler an Mutter oder "
        "Lager folgt teilweise, ein Linearmaßstab als Messsystem beseitigt es, eine Tabelle nicht.",
    )
    confusions = (
        Confusion("thermal-growth", experiments.TURNING_TEMPERATURE),
        Confusion("scale-expansion", experiments.SCREW_SENSOR),
    )
    options = BearingOptions

    def __init__(self, settings: BearingOptions | None = None) -> None:
        self.settings = settings or BearingOptions()
        self.fixed_bearing = self.settings.fixed_bearing

    def with_settings(self, settings: BearingOptions) -> Effect:
        """Return the effect with the bearing at the stated end."""
        return ScrewExpansion(settings)

    def forms(self) -> tuple[Effect, ...]:
        """Return the bearing at either end."""
        return tuple(ScrewExpansion(BearingOptions(fixed_bearing=end)) for end in ("first", "last"))

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and the temperature of the screw."""
        return needs_linear_axis(design) or needs_logged(design, _SCREW_LOG)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: distance from the bearing times temperature above 20 °C."""
        first, last = design.axis.travel or design.span
        bearing = first if self.fixed_bearing == "first" else last
        return ((design.position - bearing) * above_reference_temperature(design.conditions[_SCREW_LOG]))[
            :, np.newaxis
        ]


class ThermalGrowth(Effect):
    """A length that approaches its warm state exponentially: a fan over the position that opens with time.

    In pendulum and quasi-pilgrim tests time runs along with the position, and nearly all of this hides in
    the scale error.
    """

    identifier = "thermal-growth"
    title = Words(en="Growth while warming up", de="Längung beim Warmlaufen")
    equation = "A·P·(1 − exp(−t/τ))"
    linear = (
        Parameter(
            "growth",
            "A",
            Dimension.SLOPE,
            Words(en="growth per position once warm", de="Längung je Position im warmen Zustand"),
            -500e-6,
            500e-6,
        ),
    )
    searched = (_TIME_CONSTANT,)
    shape = Shape.TIME
    look = Words(
        en="The residuals fan out over the position while time passes, ever slower.",
        de="Die Residuen fächern mit der Zeit über der Position auf, immer langsamer.",
    )
    remedy = Words(
        en="The axis grows while it warms up: work and measure after a warm-up cycle, keep pauses short, and"
        " lead off the heat of motor, nut and hydraulics. A table holds for one state only; compensation "
        "by temperature follows.",
        de="Die Achse wächst beim Warmlaufen: nach einem Warmlauf arbeiten und messen, Pausen kurz halten, "
        "Wärme von Motor, Mutter und Hydraulik abführen. Eine Tabelle gilt nur für einen Zustand; eine "
        "Kompensation nach Temperatur folgt.",
    )
    confusions = (
        Confusion("screw-expansion", experiments.TURNING_TEMPERATURE),
        Confusion("scale-expansion", experiments.TURNING_TEMPERATURE),
        Confusion("scale-error", experiments.COLD_RESTART),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand a linear axis, and that time passes."""
        return needs_linear_axis(design) or needs_passing_time(design)

    def grid(self, design: Design) -> FloatArray:
        """Return time constants."""
        return time_constants(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return one column: position times the progress of warming up."""
        return (design.position * warmed_up(design, theta[0]))[:, np.newaxis]


class ThermalDrift(Effect):
    """Spindle, structure or tripod move alike for every target, approaching a final state exponentially.

    A time constant much longer than the test is a steady drift.
    """

    identifier = "thermal-drift"
    title = Words(en="Drift of the zero while warming up", de="Nullpunktdrift beim Warmlaufen")
    equation = "A·(1 − exp(−t/τ))"
    linear = (
        Parameter(
            "drift",
            "A",
            Dimension.DEVIATION,
            Words(en="drift once warm", de="Drift im warmen Zustand"),
            -500e-6,
            500e-6,
        ),
    )
    searched = (_TIME_CONSTANT,)
    shape = Shape.TIME
    look = Words(
        en="The residuals move with time, at all positions alike, ever slower.",
        de="Die Residuen wandern mit der Zeit, an allen Positionen gleich, immer langsamer.",
    )
    remedy = Words(
        en="Structure, spindle or tripod warm up: let machine and instrument settle, fix the optics at tool "
        "and table, and shield them. Setting the zero anew before the work removes it; a table of "
        "positions does not.",
        de="Gestell, Hauptspindel oder Stativ werden warm: Maschine und Messgerät zur Ruhe kommen lassen, "
        "die Optiken an Werkzeug und Tisch befestigen und abschirmen. Den Nullpunkt vor der Arbeit neu zu"
        " setzen beseitigt es; eine Positionstabelle nicht.",
    )
    confusions = (
        Confusion("datum-temperature", experiments.TURNING_TEMPERATURE),
        Confusion("first-run", experiments.MORE_RUNS),
        Confusion("datum-step", experiments.DRIFT_RUN),
        Confusion("offset", experiments.PRESET_AGAIN),
    )

    def untestable(self, design: Design) -> Words | None:
        """Demand that time passes."""
        return needs_passing_time(design)

    def grid(self, design: Design) -> FloatArray:
        """Return time constants."""
        return time_constants(design)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return one column: the progress of warming up."""
        return warmed_up(design, theta[0])[:, np.newaxis]


class DatumTemperature(Effect):
    """The place where scale or optics are fixed moves with the temperature, the same for every target."""

    identifier = "datum-temperature"
    title = Words(en="Zero that follows the temperature", de="Nullpunkt folgt der Temperatur")
    equation = "k·(T_{s} − 20 °C)"
    linear = (
        Parameter(
            "sensitivity",
            "k",
            Dimension.DEVIATION_PER_KELVIN,
            Words(en="motion of the zero per kelvin", de="Bewegung des Nullpunkts je Kelvin"),
            -100e-6,
            100e-6,
        ),
    )
    shape = Shape.TIME
    look = Words(
        en="The residuals follow the logged temperature, at all positions alike.",
        de="Die Residuen folgen der aufgezeichneten Temperatur, an allen Positionen gleich.",
    )
    remedy = Words(
        en="The place where scale or optics are held moves with the temperature: check the fixed point of "
        "the scale, fix the optics at tool and table, and hold the temperature. Setting the zero anew, or"
        " a shift of the zero by temperature in the control, removes it; a table of positions does not.",
        de="Die Stelle, an der Maßstab oder Optiken gehalten sind, wandert mit der Temperatur: Festpunkt des"
        " Maßstabs prüfen, Optiken an Werkzeug und Tisch befestigen, Temperatur halten. Neues Nullen oder"
        " eine Nullpunktverschiebung nach Temperatur in der Steuerung beseitigt es; eine Positionstabelle"
        " nicht.",
    )
    confusions = (Confusion("thermal-drift", experiments.TURNING_TEMPERATURE),)

    def untestable(self, design: Design) -> Words | None:
        """Demand the temperature of the axis."""
        return needs_logged(design, _SCALE_LOG)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column: temperature above 20 °C."""
        return above_reference_temperature(design.conditions[_SCALE_LOG])[:, np.newaxis]


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
    remedy = Words(
        en="The instrument, not the machine: switch on its environmental compensation, put the sensors "
        "beside the beam and have them calibrated, then measure anew. Never compensate it in the control;"
        " readings whose air was logged can be corrected.",
        de="Das Messgerät, nicht die Maschine: dessen Umweltkompensation einschalten, die Fühler neben den "
        "Strahl setzen und kalibrieren lassen, dann neu messen. Nie in der Steuerung kompensieren; "
        "Messwerte mit aufgezeichneter Luft lassen sich korrigieren.",
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
    remedy = Words(
        en="The instrument, not the machine: set the fixed optics close to the zero of the axis, preset "
        "there, or state the dead path to the correction. Never compensate it in the control.",
        de="Das Messgerät, nicht die Maschine: die feste Optik dicht an den Nullpunkt der Achse setzen, dort"
        " nullen oder die Totstrecke der Korrektur angeben. Nie in der Steuerung kompensieren.",
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
