"""A fitted model as people read it: its error, its parameters with their uncertainties, its polynomials."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from zlmreport.document.blocks import (
    Align,
    Cell,
    Column,
    Facts,
    Formulas,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
)
from zlmreport.document.writer import NOTHING
from zlmreport.language import Language, Words, named, same
from zlmreport.language.formatting import MINUS, round_pair, write_general_number, write_stated_number
from zlmreport.language.numbers import write_significant
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.units import DEGREE, Unit, with_unit
from zlmreport.model.compensation.basis import find_too_fine, find_waves_of
from zlmreport.model.diagnosis.error_numbers import ErrorNumbers
from zlmreport.model.diagnosis.study import Fitted, Wave, list_one_way, list_waves, list_what_moves_with_time
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Dimension, Effect, find_unit_on
from zlmreport.model.fitting.estimate import ParameterEstimate, Plausibility
from zlmreport.model.fitting.fit import Fit

#: Titles of what is said of a model.
ERROR = Words("Error of the model")
EFFECTS = Words("The model's effects")
_EACH_DIRECTION = Words("Each direction by itself")
RMS = Words("Root mean square error")
FLOOR = Words("Noise floor")
LEFT_OUT = Words("Runs predicted from the others")
_READINGS = Words("readings")
_AMPLITUDE = Words("Amplitude of harmonic {order}, from the above")
_PHASE = Words("Phase of harmonic {order}, from the above")
_SUM = Words("The model: the deviation x is the sum of these effects")
_PARAMETERS = Words(
    "Parameters of the model with expanded uncertainty U (coverage probability about 95 %). "
    "Grid: one of the values that were tried, with the half-width of the interval that holds it. "
    "Plausible: within what is usual for the effect"
)
_GIVEN = Words("given")
_HELD = Words("held at {bound}")
_GRID = Words("grid")
_OF_GRID = Words("{half_width} (grid)")
_EXPECTED = Words("expected {value}")
_PLAUSIBLE = {
    Plausibility.PLAUSIBLE: Words("yes"),
    Plausibility.DOUBTFUL: Words("doubtful"),
    Plausibility.IMPLAUSIBLE: Words("no"),
    Plausibility.UNKNOWN: same(NOTHING),
}
#: What is said of a value that physics or machines do not have.
OUTSIDE = Words("outside the plausible range")
_DOUBTS = {
    Plausibility.DOUBTFUL: Words("within its uncertainty of the plausible range"),
    Plausibility.IMPLAUSIBLE: OUTSIDE,
}
_WEIGHTED = Words("Readings are weighted, for they scatter unequally: a single one by {least} to {largest}")
_SCOPE = Words("Δ and {axis} in {unit}, {axis} from {first} to {last}; each direction by itself")
#: SI, or times the value: an uncertainty as large is none.
_UNDETERMINED, _INFINITE = 1e5, "∞"
_OPEN = Words("not determined by these readings")
_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
_MOVES = Words(
    "{effects}: not fixed in position. A table of positions leaves it; it goes away only if the control "
    "compensates it while the axis moves, or if its cause is removed."
)

_TOO_FINE = Words(
    "{effects}: a wave too short for a table with rows at the targets, which leaves it; rows four to a "
    "period carry it (zlmreport compensate --from model --step)."
)


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
    def of(cls, estimate: ParameterEstimate, design: Design, language: Language) -> ParameterRow:
        """Return an estimated parameter."""
        own = estimate.parameter
        unit = find_unit_on(design, own.dimension)
        value, half, number = _round_with_uncertainty(
            estimate.value, estimate.expanded_uncertainty, unit, language
        )
        if own.is_counted and estimate.is_scanned:
            value, half = str(round(estimate.value)), str(int(estimate.expanded_uncertainty))
        if estimate.is_given or estimate.at_bound:
            value, half = write_general_number(unit.from_si(estimate.value), language.decimal_sign), ""
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
            if design.time_is_counted and own.dimension is Dimension.TIME
            else unit.symbol,
            number,
            estimate.is_given,
            estimate.at_bound,
            estimate.is_scanned and not estimate.is_given,
            estimate.plausibility(time_is_counted=design.time_is_counted),
            "" if expected is None else write_general_number(unit.from_si(expected), language.decimal_sign),
        )


def make_parameter_rows(fit: Fit, language: Language) -> tuple[ParameterRow, ...]:
    """Return the parameters of a model, effect by effect."""
    return tuple(
        ParameterRow.of(each, fit.design, language)
        for identifier in fit.model.identifiers
        for each in fit.estimates
        if each.effect == identifier
    )


def make_wave_rows(fit: Fit, language: Language) -> tuple[ParameterRow, ...]:
    """Return the waves of a model by amplitude and phase; one with a given parameter is left out."""
    return tuple(row for each in list_waves(fit) for row in _lay_out_wave(each, fit.design.axis, language))


def fit_sections(fitted: Fitted, language: Language) -> tuple[Section, ...]:
    """Return what is said of a fitted model: ``error``, ``model`` and ``polynomials``."""
    fit = fitted.fit
    sections = (
        Section(
            "error", ERROR.in_language(language), (list_error_facts(fitted.error, fit.design.axis, language),)
        ),
        Section("model", EFFECTS.in_language(language), (lay_out_parameters(fit, language),)),
        Section("polynomials", _EACH_DIRECTION.in_language(language), tuple(_say_one_way(fit, language))),
    )
    return tuple(each for each in sections if each.blocks)


def list_error_facts(error: ErrorNumbers, axis: Axis, language: Language) -> Facts:
    """Return how far model and readings are apart, root mean square first; what the test tells of it."""
    values = ((RMS, error.rms), (FLOOR, error.noise_rms), (LEFT_OUT, error.cross_validated_rms))
    pairs = [
        (
            name.in_language(language),
            with_unit(write_deviation(value, axis, language), axis.deviation_unit.symbol),
        )
        for name, value in values
        if value is not None
    ]
    if error.chi2_per_dof is not None:
        pairs.append(("χ²/ν", write_significant(float(f"{error.chi2_per_dof:.3g}")).in_language(language)))
    return Facts(tuple(pairs), ERROR.in_language(language))


def lay_out_equations(fit: Fit, language: Language) -> Formulas:
    """Return the model: the deviation as a sum of effects."""
    return Formulas(
        _SUM.in_language(language),
        tuple(
            (Symbol(each.identifier), Symbol(each.equation), each.title.in_language(language))
            for each in (term.effect for term in fit.model.terms)
        ),
    )


def lay_out_parameters(fit: Fit, language: Language) -> Table:
    """Return the parameters of a model with their expanded uncertainties, waves by amplitude and phase, too.

    Its columns are ``name``, ``symbol``, ``parameter``, ``value``, ``uncertainty``, ``unit``, ``plausible``
    and ``expected``.
    """
    rows = [*make_parameter_rows(fit, language), *make_wave_rows(fit, language)]

    def say(heading: Words) -> str:
        return heading.in_language(language)

    columns = (
        Column(say(Words("Name")), key="name"),
        Column(say(Words("Symbol")), key="symbol"),
        Column(say(Words("Parameter", context="model")), key="parameter"),
        Column(say(Words("Value")), align=Align.RIGHT, key="value"),
        Column("U", align=Align.RIGHT, key="uncertainty"),
        Column(say(Words("Unit")), key="unit"),
        Column(say(Words("Plausible")), key="plausible"),
        Column(say(Words("Expected")), align=Align.RIGHT, key="expected"),
    )
    groups = tuple(
        RowGroup(
            tuple(_lay_out_cells(each, language) for each in rows if each.effect == effect.identifier),
            named(_name_with_choices(effect), effect.title).in_language(language),
        )
        for effect in (term.effect for term in fit.model.terms)
    )
    return Table(_PARAMETERS.in_language(language), columns, groups)


def list_choices(effect: Effect) -> tuple[str, ...]:
    """Return what an effect is set to by words that are not the usual ones: that it acts on the reversal."""
    settings = effect.settings.model_dump(mode="json", exclude_defaults=True)
    return tuple(f"{key}: {value}" for key, value in settings.items() if isinstance(value, str))


def _name_with_choices(effect: Effect) -> str:
    choices = ", ".join(list_choices(effect))
    return f"{effect.identifier} ({choices})" if choices else effect.identifier


def _lay_out_cells(row: ParameterRow, language: Language) -> tuple[Cell, ...]:
    known = row.uncertainty if not row.is_on_grid else _OF_GRID.given(half_width=row.uncertainty)
    uncertainty = known if row.uncertainty else _say_how_it_is_known(row)
    return (
        row.name,
        Symbol(row.notation),
        row.description,
        row.value,
        uncertainty if isinstance(uncertainty, str) else uncertainty.in_language(language),
        row.unit,
        _PLAUSIBLE[row.plausibility].in_language(language),
        "" if row.is_given else row.expected,
    )


def _say_how_it_is_known(row: ParameterRow) -> Words:
    return _GIVEN if row.is_given else _HELD.given(bound=row.at_bound)


def write_in_a_sentence(row: ParameterRow, language: Language) -> str:
    """Return a parameter within a sentence: ``drift 3.1 ± 0.4 µm``."""
    if row.uncertainty == _INFINITE:
        return f"{row.name} {_OPEN.in_language(language)}"
    number = f"{row.value} ± {row.uncertainty}" if row.uncertainty else row.value
    notes = (f"({each})" for each in say_notes(row, language))
    return " ".join((row.name, with_unit(number, row.unit).rstrip(), *notes))


def say_notes(row: ParameterRow, language: Language) -> tuple[str, ...]:
    """Return how a parameter is known if not by its U alone, and how it lies to what is usual or expected."""
    notes: list[Words] = []
    if not row.uncertainty:
        notes.append(_say_how_it_is_known(row))
    elif row.is_on_grid:
        notes.append(_GRID)
    if row.plausibility in _DOUBTS:
        notes.append(_DOUBTS[row.plausibility])
    elif row.expected and not row.is_given:
        notes.append(_EXPECTED.given(value=with_unit(row.expected, row.unit)))
    return tuple(each.in_language(language) for each in notes)


def _say_one_way(fit: Fit, language: Language) -> Iterator[Paragraph]:
    """Yield that readings have unequal weights, and the polynomial of each direction."""
    axis, (least, largest) = fit.design.axis, fit.noise.span
    if least < largest:
        ends = (write_deviation(least, axis, language), write_deviation(largest, axis, language))
        words = _WEIGHTED.given(least=ends[0], largest=with_unit(ends[1], axis.deviation_unit.symbol))
        yield Paragraph(words.in_language(language))
    curves = tuple(list_one_way(fit))
    for approach, values, _ in curves:
        powers = [(axis.name, power) for power in range(len(values))]
        yield Paragraph(f"Δ{approach.arrow} = {write_polynomial(values.tolist(), powers, language)}")
    if curves:
        first, last = (
            write_stated_number(axis.position_unit.from_si(end), language.decimal_sign)
            for end in fit.design.span
        )
        words = _SCOPE.given(axis=axis.name, unit=axis.position_unit.symbol, first=first, last=last)
        yield Paragraph(words.in_language(language))


def write_polynomial(
    coefficients: Sequence[float], powers: Sequence[tuple[str, int]], language: Language = Language.ENGLISH
) -> str:
    """Write a polynomial: it needs more digits than each of its terms is known to.

    >>> write_polynomial([-0.5, 2e-5, -3e-8], [("X", 0), ("X", 1), ("X", 2)])
    '−0.5 + 2e−5·X − 3e−8·X²'
    """
    terms = []
    for value, (name, power) in zip(coefficients, powers, strict=True):
        number = f"{abs(value):.5g}".replace("e-0", "e-").replace("-", MINUS)
        number = number.replace(".", language.decimal_sign)
        factor = f"·{name}{str(power).translate(_RAISED) if power > 1 else ''}" if power else ""
        terms.append(f"{MINUS if value < 0 else '+'} {number}{factor}")
    first, *others = terms
    return " ".join([first.removeprefix("+ ").replace(f"{MINUS} ", MINUS), *others])


def write_deviation(value: float | None, axis: Axis, language: Language) -> str:
    """Write a deviation (m or rad) with three significant digits, without its unit."""
    if value is None or not math.isfinite(value):
        return NOTHING
    return write_significant(axis.deviation_unit.from_si(value)).in_language(language)


def say_no_table_takes_away(fit: Fit, language: Language) -> str:
    """Return the sentences on effects that no table of positions takes away; empty if there are none."""
    reasons = (
        (_MOVES, list_what_moves_with_time(fit)),
        (_TOO_FINE, find_too_fine(find_waves_of(fit), fit.design.target_positions)),
    )
    said = (words.given(effects=", ".join(effects)) for words, effects in reasons if effects)
    return " ".join(words.in_language(language) for words in said)


def _lay_out_wave(wave: Wave, axis: Axis, language: Language) -> tuple[ParameterRow, ParameterRow]:
    """Return a wave by amplitude and phase, which follow from its sine and cosine."""
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
    amplitude = _round_with_uncertainty(
        harmonic.amplitude, k * harmonic.amplitude_uncertainty, unit, language
    )
    phase = _round_with_uncertainty(harmonic.phase, k * harmonic.phase_uncertainty, DEGREE, language)
    return (row("amplitude", "A", _AMPLITUDE, amplitude, unit), row("phase", "φ", _PHASE, phase, DEGREE))


def _round_with_uncertainty(
    value: float, expanded: float, unit: Unit, language: Language
) -> tuple[str, str, float]:
    """Write a value and its uncertainty (SI), and return the written value as a number too."""
    sign = language.decimal_sign
    if expanded > _UNDETERMINED * max(abs(value), 1.0):
        # Columns that hang together to the last digit: the readings say nothing of it.
        return write_general_number(unit.from_si(value), sign), _INFINITE, float(f"{unit.from_si(value):.6g}")
    printed, half = round_pair(unit.from_si(value), unit.from_si(expanded), sign)
    return printed, half, float(printed.replace(MINUS, "-").replace(sign, "."))
