"""What people read of an error model on a terminal: its parameters, how the error fell, what was changed."""

from __future__ import annotations

import shutil
import sys
import textwrap
from collections.abc import Iterator, Sequence
from math import degrees

from zlmreport.certificate.forecast import Forecast
from zlmreport.cli.model_session import Change, Session
from zlmreport.cli.terminal import Colour, shown_path, table
from zlmreport.job.job import Job
from zlmreport.language import Language, Words
from zlmreport.model import wording
from zlmreport.model.amplitudes import waves
from zlmreport.model.correction import moves_with_time
from zlmreport.model.design import Design
from zlmreport.model.diagnosis import ErrorNumbers
from zlmreport.model.estimate import Estimate, Plausibility
from zlmreport.model.fit import Fit
from zlmreport.model.parameter import Dimension, unit_of
from zlmreport.model.study import Fitted
from zlmreport.quantities.formatting import fixed_number, general_number
from zlmreport.quantities.notation import plain
from zlmreport.quantities.uncertain import rounded_pair

_USUAL_WIDTH, _SMALLEST_WIDTH = 110, 60
_BAR_WIDTH = 28
_EIGHTHS = " ▏▎▍▌▋▊▉█"
_DOUBTS = {Plausibility.DOUBTFUL: Colour.YELLOW, Plausibility.IMPLAUSIBLE: Colour.RED}


def said(words: Words) -> str:
    """Return words as the terminal has them: in English."""
    return words.in_language(Language.ENGLISH)


def width() -> int:
    """Return how many letters a line may have."""
    return max(_SMALLEST_WIDTH, shutil.get_terminal_size((_USUAL_WIDTH, 0)).columns)


def wrapped(text: str, indent: str = "  ") -> list[str]:
    """Return a text in lines that fit, all but the first further in."""
    return textwrap.wrap(
        text, width(), initial_indent=indent, subsequent_indent=f"{indent}  ", break_on_hyphens=False
    )


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


def history_lines(history: Sequence[Fitted], forecasts: Sequence[Forecast], job: Job) -> Iterator[str]:
    """Yield how the error fell, effect by effect."""
    yield heading(job, history[-1].fit.model.identifiers)
    yield ""
    yield from fall_lines(history, forecasts)


def change_lines(session: Session, change: Change) -> Iterator[str]:
    """Yield what became of the job, and how the error changed."""
    path, after = session.shown_path, change.history[-1]
    if change.edit.inherited_from:
        origin = shown_path(session.path.parent / change.edit.inherited_from)
        yield f"{path} had its effects from {origin}; now they stand in {path} itself"
    done = [f"− {name}" for name in change.removed] + ([f"+ {change.added}"] if change.added else [])
    yield f"{path}: {', '.join(done)}"
    yield ""
    design = after.fit.design
    rows = [
        ("before", error_line(change.before.error, change.before.fit.design)),
        ("after", error_line(after.error, design)),
    ]
    yield from table(rows, indent="  ")
    yield ""
    if change.added:
        own = [each for each in after.fit.estimates if each.effect == change.added]
        yield from wrapped(f"{change.added}: {', '.join(estimate_text(each, design) for each in own)}")
        if all(each.is_given or abs(each.value) < each.expanded_uncertainty for each in own):
            yield f"  {Colour.YELLOW.of('nothing')} of it exceeds its uncertainty: it may not be there"
        yield ""
    yield from fall_lines(change.history, change.forecasts)
    yield ""
    yield f"next: zlmreport model diagnose {path}"


def fall_lines(history: Sequence[Fitted], forecasts: Sequence[Forecast]) -> Iterator[str]:
    """Yield the fall chart: a bar for each effect, down to the noise floor, and what standards would say."""
    whole = history[-1]
    unit = whole.fit.design.axis.deviation_unit
    largest = max(each.error.rms for each in history)
    forecast = forecasts[0]
    symbols = [plain(quantity.notation) for quantity in forecast.quantities]
    rows = [("", "", f"rms {unit.symbol}", "left out", *symbols)]
    names = ["without model", *(f"+ {name}" for name in whole.fit.model.identifiers)]
    for name, each, values in zip(names, history, forecast.by_step.tolist(), strict=True):
        rows.append(
            (
                name,
                bar(each.error.rms / largest if largest else 0.0),
                _number(unit.from_si(each.error.rms)),
                _number_or_nothing(each.error.cross_validated_rms, whole),
                *(_number(unit.from_si(value)) for value in values),
            )
        )
    floor = whole.error.noise_rms
    if floor is not None:
        blank = ("",) * (1 + len(symbols))
        share = floor / largest if largest else 0.0
        rows.append(("noise floor", bar(share), _number(unit.from_si(floor)), *blank))
    yield from table(rows, right=range(2, 4 + len(symbols)), indent="  ")
    what = f"{', '.join(symbols)}: {forecast.designation}"
    yield f"  {what}, predicted if the control corrects all effects so far"
    moving = moves_with_time(whole.fit)
    if moving:
        yield f"  no table of positions takes away {', '.join(moving)}: not fixed in position"


def bar(share: float) -> str:
    """Return a bar of a length between 0 and 1."""
    eighths = round(share * 8 * _BAR_WIDTH)
    if not _can_print(_EIGHTHS):
        return "#" * max(1, round(eighths / 8)) if eighths else ""
    return (_EIGHTHS[-1] * (eighths // 8) + _EIGHTHS[eighths % 8]).rstrip()


def _can_print(text: str) -> bool:
    try:
        text.encode(sys.stdout.encoding or "ascii")
    except UnicodeEncodeError:
        return False
    return True


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
    return value, f"± {half} {unit.symbol}".rstrip()


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
    return f"{_number(unit.from_si(value))} {unit.symbol}"


def _number(value: float) -> str:
    """Write a number with two decimals, or more if it is small."""
    if value != value:  # noqa: PLR0124 - NaN is what differs from itself
        return "–"
    return (
        fixed_number(value, 2, Language.ENGLISH.decimal_sign)
        if abs(value) >= 0.1
        else said(wording.significant(value, 2))
    )


def _number_or_nothing(value: float | None, fitted: Fitted) -> str:
    return "–" if value is None else _number(fitted.fit.design.axis.deviation_unit.from_si(value))
