"""What people read of an error model on a terminal: its error and its parameters."""

from __future__ import annotations

import re
import shutil
import textwrap
from collections.abc import Iterator, Sequence
from math import degrees

from zlmreport.cli.terminal import Colour, table
from zlmreport.job.job import Job
from zlmreport.language import Language, Words
from zlmreport.model import wording
from zlmreport.model.design import Design
from zlmreport.model.diagnosis import ErrorNumbers
from zlmreport.model.effect import Dimension, unit_of
from zlmreport.model.estimate import Estimate, Plausibility
from zlmreport.model.fit import Fit
from zlmreport.model.study import Fitted, waves
from zlmreport.quantities.formatting import fixed_number, general_number
from zlmreport.quantities.uncertain import rounded_pair

_USUAL_WIDTH, _SMALLEST_WIDTH = 110, 60
#: A blank at which no line ends: before a number or a unit, and around a sign between numbers.
_HELD = "\N{NO-BREAK SPACE}"
_WITHIN_A_VALUE = re.compile(
    r" (?=[−\d]|[±=<≈] )|(?<=[±=<≈]) |(?<=\d) (?=(?:[mµn]?m|s|min|readings|%|°|″)(?!\w))"
)
_DOUBTS = {Plausibility.DOUBTFUL: Colour.YELLOW, Plausibility.IMPLAUSIBLE: Colour.RED}


def said(words: Words) -> str:
    """Return words as the terminal has them: in English."""
    return words.in_language(Language.ENGLISH)


def width() -> int:
    """Return how many letters a line may have."""
    return max(_SMALLEST_WIDTH, shutil.get_terminal_size((_USUAL_WIDTH, 0)).columns)


def wrapped(text: str, indent: str = "  ") -> list[str]:
    """Return a text in lines that fit, all but the first further in; no line ends within a value."""
    lines = textwrap.wrap(
        _WITHIN_A_VALUE.sub(_HELD, text),
        width(),
        initial_indent=indent,
        subsequent_indent=f"{indent}  ",
        break_on_hyphens=False,
    )
    return [line.replace(_HELD, " ") for line in lines]


def heading(job: Job, identifiers: Sequence[str]) -> str:
    """Return the first line: which job, which axis, which model."""
    model = " + ".join(identifiers) or "no effects yet"
    return f"{Colour.BOLD.of(job.keys.certificate.number)}  axis {job.axis.name}: {model}"


def fit_lines(fitted: Fitted, job: Job) -> Iterator[str]:
    """Yield the lines on a fitted model."""
    yield heading(job, fitted.fit.model.identifiers)
    yield ""
    yield f"  {error_line(fitted.error, fitted.fit.design)}"
    yield ""
    yield from parameter_lines(fitted.fit)


def error_line(error: ErrorNumbers, design: Design) -> str:
    """Return how far model and readings are apart, in a line."""
    parts = [f"error {_deviation(error.rms, design)} rms"]
    if error.noise_rms is not None:
        parts.append(f"noise floor {_deviation(error.noise_rms, design)}")
    if error.chi2_per_dof is not None:
        parts.append(f"χ²/ν {said(wording.significant(error.chi2_per_dof))}")
    if error.cross_validated_rms is not None:
        parts.append(f"runs left out {_deviation(error.cross_validated_rms, design)}")
    return "   ".join(parts)


def parameter_lines(fit: Fit) -> Iterator[str]:
    """Yield the parameters of a model with their uncertainties, waves by amplitude and phase."""
    rows: list[tuple[str, ...]] = []
    of_waves = list(_wave_rows(fit))
    by_wave = {effect for effect, *_ in of_waves}
    for identifier in fit.model.identifiers:
        rows.extend(row for row in of_waves if row[0] == identifier)
        rows.extend(
            (identifier, each.parameter.name, *_value(each, fit.design), _remark(each, fit.design))
            for each in fit.estimates
            if each.effect == identifier
            and not (identifier in by_wave and each.parameter.name.startswith(("sine", "cosine")))
        )
    shown: list[tuple[str, ...]] = []
    for row in rows:
        is_first = not shown or row[0] != rows[len(shown) - 1][0]
        shown.append((row[0] if is_first else "", *row[1:]))
    yield from table(shown, right=(2,), indent="  ")


def estimate_text(estimate: Estimate, design: Design) -> str:
    """Return a parameter within a sentence: ``drift 3.1 ± 0.4 µm``."""
    value, uncertainty = _value(estimate, design)
    remark = _remark(estimate, design)
    return f"{estimate.parameter.name} {value} {uncertainty}".strip() + (f" ({remark})" if remark else "")


def _wave_rows(fit: Fit) -> Iterator[tuple[str, ...]]:
    unit = fit.design.axis.deviation_unit
    angle = unit_of(Dimension.ANGLE, fit.design.axis.kind)
    for wave in waves(fit):
        harmonic, k = wave.harmonic, wave.coverage_factor
        value, half = rounded_pair(
            unit.from_si(harmonic.amplitude), k * unit.from_si(harmonic.amplitude_uncertainty)
        )
        name = "amplitude" if harmonic.order == 1 else f"amplitude {harmonic.order}"
        phase = f"phase {general_number(round(degrees(harmonic.phase)))}{angle.symbol}"
        yield wave.effect, name, value, f"± {half} {unit.symbol}", phase


def _value(estimate: Estimate, design: Design) -> tuple[str, str]:
    """Return a value, and its uncertainty with the unit."""
    unit = unit_of(estimate.parameter.dimension, design.axis.kind, time_is_counted=design.time_is_counted)
    if estimate.is_given:
        return general_number(estimate.value * unit.per_si), f"{unit.symbol} (given)".strip()
    value, half = rounded_pair(estimate.value * unit.per_si, estimate.expanded_uncertainty * unit.per_si)
    grid = " (grid)" if estimate.is_scanned else ""
    return value, f"± {half} {unit.symbol}".rstrip() + grid


def _remark(estimate: Estimate, design: Design) -> str:
    """Return what is to be said of a value that is not plausible, or of one that was expected."""
    plausibility = estimate.plausibility(time_is_counted=design.time_is_counted)
    if plausibility in _DOUBTS:
        return _DOUBTS[plausibility].of(plausibility.value)
    if estimate.expected is not None and not estimate.is_given:
        unit = unit_of(estimate.parameter.dimension, design.axis.kind)
        return f"expected {general_number(estimate.expected * unit.per_si)} {unit.symbol}".rstrip()
    return ""


def _deviation(value: float, design: Design) -> str:
    unit = design.axis.deviation_unit
    return f"{number(unit.from_si(value))} {unit.symbol}"


def number(value: float) -> str:
    """Write a number with two decimals, or more if it is small."""
    if value != value:  # noqa: PLR0124 - NaN is what differs from itself
        return "–"
    return (
        fixed_number(value, 2, Language.ENGLISH.decimal_sign)
        if abs(value) >= 0.1
        else said(wording.significant(value, 2))
    )
