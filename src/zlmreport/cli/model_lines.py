"""What people read of an error model on a terminal: its error, its parameters, its diagnosis, its fall."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from zlmreport.certificate.forecast import Forecast
from zlmreport.cli.model_values import Change, Points
from zlmreport.cli.terminal import Colour, said, shown_path, table, wrapped
from zlmreport.job.job import Job
from zlmreport.language import Language
from zlmreport.measurement.axis import Axis
from zlmreport.model.diagnosis import Diagnosis, ErrorNumbers, Verdict
from zlmreport.model.estimate import Plausibility
from zlmreport.model.fit import Fit
from zlmreport.model.report import listed
from zlmreport.model.study import Fitted, one_way
from zlmreport.planning.experiment import Experiment
from zlmreport.presenting.diagnosis import CandidateRow, DiagnosisRows
from zlmreport.presenting.model import (
    ErrorRows,
    ParameterRow,
    deviation,
    no_table_takes_away,
    parameter_rows,
    wave_rows,
)
from zlmreport.presenting.writer import Writer
from zlmreport.quantities.formatting import MINUS, general_number, plain, rounded_pair

_ENGLISH = Language.ENGLISH
_VERDICTS = {
    Verdict.ADEQUATE: Colour.GREEN,
    Verdict.MISSING: Colour.YELLOW,
    Verdict.UNEXPLAINED: Colour.RED,
}
_DOUBTS = {Plausibility.DOUBTFUL: Colour.YELLOW, Plausibility.IMPLAUSIBLE: Colour.RED}
_FURTHER_IN = "     "
_BAR_WIDTH = 28
_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
_EIGHTHS = " ▏▎▍▌▋▊▉█"


def fit_lines(fitted: Fitted, job: Job) -> Iterator[str]:
    """Yield the lines on a fitted model."""
    yield _heading(job, fitted.fit)
    yield ""
    yield f"  {error_line(fitted.error, fitted.fit.design.axis)}"
    yield ""
    yield from _parameters(fitted.fit)
    yield from _one_way(fitted.fit)


def _one_way(fit: Fit) -> Iterator[str]:
    """Yield that readings have unequal weights, and the polynomial of each direction."""
    axis, (least, largest) = fit.design.axis, fit.noise.span
    if least < largest:
        sizes = f"{deviation(least, axis, _ENGLISH)} to {deviation(largest, axis, _ENGLISH)}"
        said_of = f"readings are weighted, for they scatter unequally: a single one by {sizes}"
        yield from ("", *wrapped(f"{said_of} {axis.deviation_unit.symbol}"))
    curves = tuple(one_way(fit))
    for number, (approach, values, _) in enumerate(curves):
        powers = [(axis.name, power) for power in range(len(values))]
        yield from () if number else ("",)
        yield from wrapped(f"Δ{approach.arrow} = {polynomial(values.tolist(), powers)}")
    if curves:
        first, last = (general_number(axis.position_unit.from_si(end)) for end in fit.design.span)
        where = f"{axis.name} from {first} to {last}; each direction by itself"
        yield f"  Δ and {axis.name} in {axis.position_unit.symbol}, {where}"


def polynomial(coefficients: Sequence[float], powers: Sequence[tuple[str, int]]) -> str:
    """Write a polynomial: it needs more digits than each of its terms is known to.

    >>> polynomial([-0.5, 2e-5, -3e-8], [("X", 0), ("X", 1), ("X", 2)])
    '−0.5 + 2e−5·X − 3e−8·X²'
    """
    terms = []
    for value, (name, power) in zip(coefficients, powers, strict=True):
        number = f"{abs(value):.5g}".replace("e-0", "e-").replace("-", MINUS)
        factor = f"·{name}{str(power).translate(_RAISED) if power > 1 else ''}" if power else ""
        terms.append(f"{MINUS if value < 0 else '+'} {number}{factor}")
    first, *others = terms
    return " ".join([first.removeprefix("+ ").replace(f"{MINUS} ", MINUS), *others])


def error_line(error: ErrorNumbers, axis: Axis) -> str:
    """Return how far model and readings are apart, in a line."""
    rows = ErrorRows.of(error, axis, _ENGLISH)
    parts = (
        ("error", rows.rms, " rms"),
        ("noise floor", rows.noise_floor, ""),
        ("χ²/ν", rows.chi2_per_dof, ""),
        ("runs left out", rows.left_out, ""),
    )
    return "   ".join(f"{name} {value}{rest}" for name, value, rest in parts if value is not None)


def point_lines(points: Points | None, axis: Axis) -> Iterator[str]:
    """Yield a table of the deviation at the positions, a column for each direction."""
    if points is None:
        return
    unit, position = axis.deviation_unit, axis.position_unit
    heads = (
        f"{axis.name} {position.symbol}",
        *(f"{each.arrow} {unit.symbol}" for each in points.predictions),
    )
    rows = [heads]
    for number, place in enumerate(position.from_si(points.positions).tolist()):
        cells = (
            rounded_pair(
                unit.from_si(float(each.deviation[number])),
                unit.from_si(float(each.expanded_uncertainty[number])),
            )
            for each in points.predictions.values()
        )
        rows.append((general_number(place), *map(" ± ".join, cells)))
    yield ""
    yield from table(rows, right=range(len(heads)), indent="  ")
    when = "; at the mean time and the mean logged conditions of the test" if points.moves else ""
    yield f"  deviation by the model, ± expanded uncertainty for 95 %{when}"


def diagnosis_lines(
    diagnosis: Diagnosis, job: Job, path: str, experiment: Experiment | None
) -> Iterator[str]:
    """Yield the lines on a diagnosis; `path` is the job as the user types it."""
    fit, rows = diagnosis.fit, DiagnosisRows.of(diagnosis, _ENGLISH)
    yield _heading(job, fit)
    yield ""
    for line in wrapped(rows.statement):
        yield _VERDICTS[diagnosis.verdict].of(line)
    yield f"  {error_line(diagnosis.error, fit.design.axis)}"
    if fit.model.terms:
        yield from ("", Colour.BOLD.of("model"))
        yield from _parameters(fit)
    if rows.failures:
        yield from ("", Colour.BOLD.of("where it fails"))
    for failure in rows.failures:
        yield from wrapped(said(f"{failure.statement} ({failure.where}; {failure.p})"))
    if rows.candidates:
        yield from ("", Colour.BOLD.of("what may be missing"))
        yield from _candidates(rows, fit.design.axis)
    hidden = (*rows.hidden, *rows.not_tested)
    if hidden:
        yield from ("", Colour.BOLD.of("what this test cannot see"))
    for each in hidden:
        yield from wrapped(f"{', '.join(each.effects)}: {each.reason}")
    if hidden:
        yield f"  what would show one: zlmreport plan {path} --decide EFFECT"
    yield ""
    yield from _what_next(rows, diagnosis, path, experiment)


def _what_next(
    rows: DiagnosisRows, diagnosis: Diagnosis, path: str, experiment: Experiment | None
) -> Iterator[str]:
    """Yield the experiment that tells candidates apart, and the command that comes next."""
    if experiment:
        yield from (Colour.BOLD.of("what tells them apart"), *wrapped(said(experiment.statement)), "")
    if experiment and experiment.plan:
        yield f"next: zlmreport plan {path} --decide {','.join(experiment.effects)} --output next"
    elif rows.candidates and diagnosis.verdict is Verdict.MISSING:
        argument = rows.candidates[0].argument
        yield f"next: zlmreport model add {path} " + (f"'{argument}'" if ":" in argument else argument)
    else:
        yield f"next: zlmreport {path}"


def history_lines(
    history: Sequence[Fitted], forecasts: Sequence[Forecast], job: Job, writer: Writer
) -> Iterator[str]:
    """Yield how the error fell, effect by effect."""
    yield _heading(job, history[-1].fit)
    yield ""
    yield from _fall(history, forecasts, writer)


def change_lines(path: Path, change: Change, writer: Writer) -> Iterator[str]:
    """Yield what became of the job, and how the error changed."""
    shown, after = shown_path(path), change.history[-1]
    axis = after.fit.design.axis
    if change.edit.inherited_from:
        origin = shown_path(path.parent / change.edit.inherited_from)
        yield f"{shown} had its effects from {origin}; now they stand in {shown} itself"
    done = [f"− {name}" for name in change.removed] + ([f"+ {change.added}"] if change.added else [])
    yield f"{shown}: {', '.join(done)}"
    yield ""
    rows = [("before", error_line(change.before.error, axis)), ("after", error_line(after.error, axis))]
    yield from table(rows, indent="  ")
    yield ""
    if change.added:
        own = [each for each in parameter_rows(after.fit, _ENGLISH) if each.effect == change.added]
        yield from wrapped(f"{change.added}: {', '.join(map(_in_a_sentence, own))}")
        if not _stands_out(change.added, after.fit):
            yield f"  {Colour.YELLOW.of('nothing')} of it exceeds its uncertainty: it may not be there"
        yield ""
    yield from _fall(change.history, change.forecasts, writer)
    yield ""
    yield f"next: zlmreport model diagnose {shown}"


def _heading(job: Job, fit: Fit) -> str:
    """Return the first line: which job, which axis, which model."""
    model = " + ".join(fit.model.identifiers) or "no effects yet"
    heading = f"{Colour.BOLD.of(job.keys.certificate.number)}  axis {job.axis.name}: {model}"
    others = [each.files[0].name for each in job.sessions]
    runs = [fit.design.cycle[fit.design.session == number] for number in range(1, len(others) + 1)]
    held = [f"{name} (runs {each.min()} to {each.max()})" for name, each in zip(others, runs, strict=True)]
    more = [f"held together with {', '.join(held)}"] if held else []
    if job.priors:
        more.append(f"expects what {job.priors.tests} earlier tests taught")
    return "\n  ".join([heading, *more])


def _parameters(fit: Fit) -> Iterator[str]:
    """Yield the parameters of a model with their uncertainties, waves by amplitude and phase."""
    of_waves = wave_rows(fit, _ENGLISH)
    by_wave = {each.amplitude.effect for each in of_waves}
    rows: list[tuple[str, ...]] = []
    for identifier in fit.model.identifiers:
        of_effect = [
            (each.amplitude.name, *_amount(each.amplitude), f"phase {' '.join(_amount(each.phase))}")
            for each in of_waves
            if each.amplitude.effect == identifier
        ]
        of_effect += [
            (each.name, *_amount(each), _remark(each))
            for each in parameter_rows(fit, _ENGLISH)
            if each.effect == identifier
            and not (identifier in by_wave and each.name.startswith(("sine", "cosine")))
        ]
        rows += [("" if number else identifier, *cells) for number, cells in enumerate(of_effect)]
    yield from table(rows, right=(2,), indent="  ")


def _in_a_sentence(row: ParameterRow) -> str:
    """Return a parameter within a sentence: ``drift 3.1 ± 0.4 µm``."""
    remark = _remark(row)
    return " ".join((row.name, *_amount(row))).strip() + (f" ({remark})" if remark else "")


def _amount(row: ParameterRow) -> tuple[str, str]:
    """Return a value, and its uncertainty with the unit."""
    known = "given" if row.is_given else f"held at {row.at_bound}" if row.at_bound else ""
    if known:
        return row.value, f"{row.unit} ({known})".strip()
    return row.value, f"± {row.uncertainty} {row.unit}".rstrip() + (" (grid)" if row.is_on_grid else "")


def _remark(row: ParameterRow) -> str:
    """Return what is to be said of a value that is not plausible, or of one that was expected."""
    if row.plausibility in _DOUBTS:
        return _DOUBTS[row.plausibility].of(row.plausibility.value)
    return f"expected {row.expected} {row.unit}".rstrip() if row.expected and not row.is_given else ""


def _candidates(found: DiagnosisRows, axis: Axis) -> Iterator[str]:
    rows = [("", "", "probability", f"rms {axis.deviation_unit.symbol}", "left out", "")]
    for number, each in enumerate(found.candidates, start=1):
        probability = f"{each.probability} %"
        rows.append((str(number), each.effect, probability, each.rms, each.left_out, said(each.p)))
    first, *lines = table(rows, right=(2, 3, 4), indent="  ")
    yield first
    for line, each in zip(lines, found.candidates, strict=True):
        yield line
        if each.is_serious:
            yield from _details(each)
            if each.remedy and each in found.leading:
                yield from wrapped(said(f"remedy: {each.remedy}"), _FURTHER_IN)
            if found.not_excluded and each is found.candidates[0]:
                names = ", ".join(found.not_excluded)
                yield from wrapped(f"not excluded, for they could not be tried: {names}", _FURTHER_IN)


def _details(candidate: CandidateRow) -> Iterator[str]:
    yield from wrapped(", ".join(map(_in_a_sentence, candidate.parameters)), _FURTHER_IN)
    yield from wrapped(candidate.explains, _FURTHER_IN)
    if candidate.equals:
        names = said(listed(candidate.equals))
        yield from wrapped(f"not to be told from {names} by these readings", _FURTHER_IN)
    if candidate.tell_apart_by:
        yield from wrapped(f"to tell: {candidate.tell_apart_by}", _FURTHER_IN)


def _fall(history: Sequence[Fitted], forecasts: Sequence[Forecast], writer: Writer) -> Iterator[str]:
    """Yield the fall chart: a bar for each effect, down to the noise floor, and what standards would say."""
    whole, forecast = history[-1], forecasts[0]
    axis = whole.fit.design.axis
    largest = max(each.error.rms for each in history)
    symbols = [plain(quantity.notation) for quantity in forecast.quantities]
    rows = [("", "", f"rms {axis.deviation_unit.symbol}", "left out", *symbols)]
    names = ["without model", *(f"+ {name}" for name in whole.fit.model.identifiers)]
    for name, each, values in zip(names, history, forecast.by_step.tolist(), strict=True):
        bar = _bar(each.error.rms / largest if largest else 0.0)
        errors = (each.error.rms, each.error.cross_validated_rms)
        cells = (*(deviation(value, axis, _ENGLISH) for value in errors), *map(writer.deviation, values))
        rows.append((name, bar, *cells))
    floor = whole.error.noise_rms
    if floor is not None:
        bar, blank = _bar(floor / largest if largest else 0.0), ("",) * (1 + len(symbols))
        rows.append(("noise floor", bar, deviation(floor, axis, _ENGLISH), *blank))
    yield from table(rows, right=range(2, 4 + len(symbols)), indent="  ")
    what = f"{', '.join(symbols)}: {forecast.designation}"
    yield f"  {what}, predicted if the control corrects all effects so far"
    moving = no_table_takes_away(whole.fit, _ENGLISH)
    if moving:
        yield from wrapped(moving)


def _bar(share: float) -> str:
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


def _stands_out(identifier: str, fit: Fit) -> bool:
    """Return whether any size of an effect exceeds its uncertainty: its place or period says nothing."""
    (effect,) = (term.effect for term in fit.model.terms if term.effect.identifier == identifier)
    sizes = [each for each in fit.estimates if each.effect == identifier and each.parameter in effect.linear]
    return any(each.is_given or abs(each.value) > each.expanded_uncertainty for each in sizes)
