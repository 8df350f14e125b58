"""A fitted model as people read it: its error, and its parameters with their uncertainties."""

from __future__ import annotations

import math
from dataclasses import dataclass

from zlmreport.compensation.basis import too_fine, waves_of
from zlmreport.language import Language, Words
from zlmreport.measurement.axis import Axis
from zlmreport.model import wording
from zlmreport.model.design import Design
from zlmreport.model.diagnosis import ErrorNumbers
from zlmreport.model.effect import Dimension, unit_of
from zlmreport.model.estimate import Estimate, Plausibility
from zlmreport.model.fit import Fit
from zlmreport.model.study import Wave, moves_with_time, waves
from zlmreport.presenting.writer import NOTHING
from zlmreport.quantities.formatting import MINUS, general_number, rounded_pair
from zlmreport.quantities.units import DEGREE, Unit, with_unit

_RMS = Words(en="Root mean square error", de="Quadratischer Mittelwert der Abweichungen")
_FLOOR = Words(en="Noise floor", de="Grundrauschen")
_LEFT_OUT = Words(en="Runs predicted from the others", de="Durchläufe, aus den übrigen vorhergesagt")
_READINGS = Words(en="readings", de="Messwerte")
_AMPLITUDE = Words(
    en="Amplitude of harmonic {order}, from the above", de="Amplitude der {order}. Harmonischen, aus Obigem"
)
_PHASE = Words(
    en="Phase of harmonic {order}, from the above", de="Phase der {order}. Harmonischen, aus Obigem"
)
_MOVES = Words(
    en="{effects}: not fixed in position. A table of positions leaves it; it goes away only if the control "
    "compensates it while the axis moves, or if its cause is removed.",
    de="{effects}: nicht an die Position gebunden. Eine Positionstabelle lässt das stehen; es verschwindet "
    "nur, wenn die Steuerung es während der Bewegung kompensiert oder die Ursache beseitigt wird.",
)

_TOO_FINE = Words(
    en="{effects}: a wave too short for a table with rows at the targets, which leaves it; rows four to a "
    "period carry it (zlmreport compensate --from model --step).",
    de="{effects}: eine Welle, zu kurz für eine Tabelle mit Zeilen an den Zielpositionen, die sie stehen "
    "lässt; vier Zeilen je Periode tragen sie (zlmreport compensate --from model --step).",
)


@dataclass(frozen=True, slots=True)
class ErrorRows:
    """How far model and readings are apart."""

    #: rms, noise_floor and left_out: Root mean square error; scatter of a single reading; error at runs
    #: predicted from the others. Each with three significant digits and its unit; None where the test does
    #: not tell.
    rms: str
    noise_floor: str | None
    left_out: str | None
    chi2_per_dof: str | None  #: χ²/ν, likewise.
    language: Language  #: Of the names.

    @classmethod
    def of(cls, error: ErrorNumbers, axis: Axis, language: Language) -> ErrorRows:
        """Return the error of a model."""
        unit = axis.deviation_unit.symbol

        def amount(value: float | None) -> str | None:
            return None if value is None else with_unit(deviation(value, axis, language), unit)

        return cls(
            with_unit(deviation(error.rms, axis, language), unit),
            amount(error.noise_rms),
            amount(error.cross_validated_rms),
            None
            if error.chi2_per_dof is None
            else wording.significant(error.chi2_per_dof).in_language(language),
            language,
        )

    @property
    def named(self) -> tuple[tuple[str, str], ...]:
        """Name and value of each number that there is."""
        pairs = ((_RMS, self.rms), (_FLOOR, self.noise_floor), (_LEFT_OUT, self.left_out))
        found = [(name.in_language(self.language), value) for name, value in pairs if value is not None]
        return (*found, *([("χ²/ν", self.chi2_per_dof)] if self.chi2_per_dof else []))


@dataclass(frozen=True, slots=True)
class ParameterRow:
    """A parameter of a fitted model, rounded to what is known."""

    effect: str  #: Identifier of its effect.
    #: name, notation and description: As jobs name it, as it is printed, and in words.
    name: str
    notation: str
    description: str
    #: value, uncertainty and unit: As they are printed; no uncertainty of a value given or held.
    value: str
    uncertainty: str
    unit: str
    number: float  #: The printed value as a number: what a click fixes is what was shown.
    is_given: bool = False  #: Whether the job states it.
    at_bound: str = ""  #: The bound at which it is held, ``min`` or ``max``.
    #: Whether it is one of the values that were tried, and the uncertainty half the interval about it.
    is_on_grid: bool = False
    plausibility: Plausibility = Plausibility.UNKNOWN  #: How it lies to what is usual for the effect.
    expected: str = ""  #: The value that follows from the job, without unit; empty where none does.

    @classmethod
    def of(cls, estimate: Estimate, design: Design, language: Language) -> ParameterRow:
        """Return an estimated parameter."""
        own, is_counted = estimate.parameter, design.time_is_counted
        unit = unit_of(own.dimension, design.axis.kind, time_is_counted=is_counted)
        value, half, number = _rounded(estimate.value, estimate.expanded_uncertainty, unit, language)
        if estimate.is_given or estimate.at_bound:
            value, half = general_number(unit.from_si(estimate.value), language.decimal_sign), ""
            number = float(f"{unit.from_si(estimate.value):.6g}")
        expected = estimate.expected
        return cls(
            estimate.effect,
            own.name,
            own.notation,
            own.description.in_language(language),
            value,
            half,
            _READINGS.in_language(language)
            if is_counted and own.dimension is Dimension.TIME
            else unit.symbol,
            number,
            estimate.is_given,
            estimate.at_bound,
            estimate.is_scanned and not estimate.is_given,
            estimate.plausibility(time_is_counted=is_counted),
            "" if expected is None else general_number(unit.from_si(expected), language.decimal_sign),
        )


@dataclass(frozen=True, slots=True)
class WaveRows:
    """A wave by amplitude and phase, which follow from its sine and cosine."""

    amplitude: ParameterRow
    phase: ParameterRow


def parameter_rows(fit: Fit, language: Language) -> tuple[ParameterRow, ...]:
    """Return the parameters of a model, effect by effect."""
    return tuple(
        ParameterRow.of(each, fit.design, language)
        for identifier in fit.model.identifiers
        for each in fit.estimates
        if each.effect == identifier
    )


def wave_rows(fit: Fit, language: Language) -> tuple[WaveRows, ...]:
    """Return the waves of a model; one with a given parameter is left out."""
    return tuple(_wave(each, fit.design.axis, language) for each in waves(fit))


def deviation(value: float | None, axis: Axis, language: Language) -> str:
    """Write a deviation (m or rad) with three significant digits, without its unit."""
    if value is None or not math.isfinite(value):
        return NOTHING
    return wording.significant(axis.deviation_unit.from_si(value)).in_language(language)


def no_table_takes_away(fit: Fit, language: Language) -> str:
    """Return the sentences on effects that no table of positions takes away; empty if there are none."""
    named = (
        (_MOVES, moves_with_time(fit)),
        (_TOO_FINE, too_fine(waves_of(fit), fit.design.target_positions)),
    )
    said = (words.given(effects=", ".join(effects)) for words, effects in named if effects)
    return " ".join(words.in_language(language) for words in said)


def _wave(wave: Wave, axis: Axis, language: Language) -> WaveRows:
    harmonic, k = wave.harmonic, wave.coverage_factor

    def row(
        name: str, letter: str, words: Words, rounded: tuple[str, str, float], unit: Unit
    ) -> ParameterRow:
        value, half, number = rounded
        return ParameterRow(
            effect=wave.effect,
            name=name if harmonic.order == 1 else f"{name} {harmonic.order}",
            notation=f"{letter}_{{{harmonic.order}}}",
            description=words.given(order=harmonic.order).in_language(language),
            value=value,
            uncertainty=half,
            unit=unit.symbol,
            number=number,
        )

    unit = axis.deviation_unit
    amplitude = _rounded(harmonic.amplitude, k * harmonic.amplitude_uncertainty, unit, language)
    phase = _rounded(harmonic.phase, k * harmonic.phase_uncertainty, DEGREE, language)
    return WaveRows(
        row("amplitude", "A", _AMPLITUDE, amplitude, unit), row("phase", "φ", _PHASE, phase, DEGREE)
    )


def _rounded(value: float, expanded: float, unit: Unit, language: Language) -> tuple[str, str, float]:
    """Write a value and its uncertainty (SI), and return the written value as a number too."""
    sign = language.decimal_sign
    printed, half = rounded_pair(unit.from_si(value), unit.from_si(expanded), sign)
    return printed, half, float(printed.replace(MINUS, "-").replace(sign, "."))
