"""What people read of an error model on a terminal: error, parameters, diagnosis, fall and build."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from zlmreport.cli.layout import lay_out_sections, write_in_a_line
from zlmreport.cli.model_values import ModelChange, PredictedPoints
from zlmreport.cli.terminal import (
    Colour,
    lay_out_changes,
    lay_out_heading,
    lay_out_table,
    show_path,
    wrap,
    wrap_steps,
)
from zlmreport.document.blocks import Section, Table
from zlmreport.document.subjects.diagnosis import lay_out_diagnosis, write_effect_argument
from zlmreport.document.subjects.fit import (
    fit_sections,
    list_error_facts,
    make_parameter_rows,
    write_deviation,
    write_in_a_sentence,
)
from zlmreport.document.subjects.forecast import StandardForecast, lay_out_fall
from zlmreport.document.writer import Writer
from zlmreport.errors import count_in_words, list_names
from zlmreport.job.edit import Edit
from zlmreport.job.job import Job
from zlmreport.language import Language
from zlmreport.language.formatting import round_pair, write_general_number, write_plain
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.units import write_behind
from zlmreport.model.diagnosis.asking import list_lengths_asked
from zlmreport.model.diagnosis.building import (
    Built,
    ModelStep,
    is_outstanding,
    list_needless,
    name_changes,
    name_steps,
)
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict
from zlmreport.model.diagnosis.faults import FaultKind
from zlmreport.model.diagnosis.looking import look_for
from zlmreport.model.diagnosis.report import (
    find_stated_fault,
    list_chances,
    write_formula_entry,
    write_statement_after_build,
)
from zlmreport.model.diagnosis.study import Fitted, Study
from zlmreport.model.effects.effect import Effect, is_of_another_axis
from zlmreport.model.fitting.fit import Fit
from zlmreport.model.planning.experiment import Experiment

_ENGLISH = Language.ENGLISH


def tell_fit(fitted: Fitted, job: Job) -> Iterator[str]:
    """Yield the lines on a fitted model."""
    yield from _lay_out_heading(job, fitted.fit)
    yield from lay_out_sections(map(_drop_unused_columns, fit_sections(fitted, _ENGLISH)))


def tell_points(points: PredictedPoints | None, axis: Axis) -> Iterator[str]:
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
            round_pair(
                unit.from_si(float(each.deviation[number])),
                unit.from_si(float(each.expanded_uncertainty[number])),
            )
            for each in points.predictions.values()
        )
        rows.append((write_general_number(place), *map(" ± ".join, cells)))
    yield ""
    yield from lay_out_table(rows, right=range(len(heads)), indent="  ")
    when = "; at the mean time and the mean logged conditions of the test" if points.moves else ""
    yield f"  deviation by the model, ± expanded uncertainty for 95 %{when}"


def tell_diagnosis(
    diagnosis: AxisDiagnosis,
    study: Study,
    path: str,
    experiment: Experiment | None,
    effects: Sequence[Effect],
) -> Iterator[str]:
    """Yield the lines on a diagnosis; `path` is the job as the user types it.

    `effects`: All that are installed.
    """
    yield from _lay_out_heading(study.job, diagnosis.fit)
    sections = lay_out_diagnosis(diagnosis, _ENGLISH, study.list_titles(effects), experiment)
    following = f"next: {find_next_step(diagnosis, path, experiment)}"
    for each in sections:
        yield from lay_out_sections([_drop_unused_columns(each)])
        if each.key == "verdict":
            yield from _tell_what_to_measure(diagnosis, "  ")
            yield from _tell_what_to_state(diagnosis, effects, "  ")
            yield f"  {following}"
    unseen = {each.effect for each in diagnosis.not_testable if not is_of_another_axis(each.reason)}
    unseen |= {each.effect for each in diagnosis.visibility if each.is_hidden}
    if unseen:
        yield ""
        yield from wrap(
            f"What this test cannot see or try: {count_in_words(len(unseen), 'effect')}. The list: --json; "
            f"what would show one: zlmreport plan {path} --decide EFFECT",
            "",
        )
    yield ""
    yield from _tell_needless(list_needless(diagnosis), path)
    yield from _tell_what_to_measure(diagnosis)
    yield from _tell_what_to_state(diagnosis, effects)
    yield following


def _tell_needless(effects: Iterable[str], path: str) -> Iterator[str]:
    """Yield how effects are taken out that may not be there; `path` is the job as the user types it."""
    for each in effects:
        yield from wrap(
            f"{each}: nothing of it exceeds its uncertainty, it may not be there; without it: "
            f"zlmreport model remove {path} {each}",
            "",
        )


def _tell_what_to_measure(diagnosis: AxisDiagnosis, indent: str = "") -> Iterator[str]:
    """Yield what to look at and to measure before the certificate, where nothing can be tried."""
    left = diagnosis.remainder
    if diagnosis.verdict is DiagnosisVerdict.UNEXPLAINED and left is not None and left.formula is None:
        look = look_for(left, diagnosis.fit.design)
        yield from wrap(f"look at: {look.at.in_language(_ENGLISH)}", indent)
        yield from wrap(f"measure: {look.measure.in_language(_ENGLISH)}", indent)


def _tell_what_to_state(
    diagnosis: AxisDiagnosis, effects: Sequence[Effect], indent: str = ""
) -> Iterator[str]:
    """Yield which lengths to state where what is left may repeat with one of them: it looks irregular."""
    left, fitted = diagnosis.remainder, diagnosis.fit
    courses = () if left is None else (left.course, *(each.course for each in left.further))
    asked = list_lengths_asked(fitted.design, fitted.model.identifiers, effects)
    if asked and any(each.is_irregular for each in courses):
        keys = list_names([f"axis.{each.key}" for each in asked], "or")
        waiting = list_names(sorted({effect for each in asked for effect in each.effects}))
        yield from wrap(
            f"state: {keys} ({asked[0].unit}), whichever the axis has; without it these cannot be tried: "
            f"{waiting}",
            indent,
        )


def find_next_step(diagnosis: AxisDiagnosis, path: str, experiment: Experiment | None = None) -> str:
    """Return the command that a diagnosis asks for next, and what comes before it.

    `path`: The job as the user types it.
    `experiment`: What would tell effects apart.
    """
    first = _say_what_comes_first(diagnosis)
    if first:
        return f"{first}, then zlmreport model diagnose {path}"
    if experiment and experiment.plan:
        return f"zlmreport plan {path} --decide {','.join(experiment.effects)} --output next"
    if len(diagnosis.together) > 1:
        return f"zlmreport model build {path}"
    if diagnosis.verdict is DiagnosisVerdict.MISSING and diagnosis.together:
        return f"zlmreport model add {path} {_quote_for_shell(write_effect_argument(diagnosis.together[0]))}"
    left = diagnosis.remainder
    if left and left.formula:
        return f"zlmreport model add {path} {_quote_for_shell(write_formula_entry(left.formula))}"
    return f"zlmreport {path}"


def _say_what_comes_first(diagnosis: AxisDiagnosis) -> str:
    """Return what is to be put right before a cause is sought; empty if nothing is."""
    fault = find_stated_fault(diagnosis)
    if fault:
        return "state the unit" if fault.kind is FaultKind.WRONG_UNIT else "correct the data"
    return "free or mend the given value in model.effects" if diagnosis.contradicted else ""


def _quote_for_shell(argument: str) -> str:
    return f"'{argument}'" if set(argument) & set(" :{") else argument


def _drop_unused_columns(section: Section) -> Section:
    """Return a section without the columns that a job has no use for: symbols, and parameters in words."""
    blocks = (
        each.without("symbol", "parameter") if isinstance(each, Table) else each for each in section.blocks
    )
    return replace(section, blocks=tuple(blocks))


def tell_history(
    history: Sequence[Fitted], forecasts: Sequence[StandardForecast], job: Job, writer: Writer
) -> Iterator[str]:
    """Yield how the error fell, effect by effect."""
    yield from _lay_out_heading(job, history[-1].fit)
    yield from _draw_fall(history, forecasts, writer)


def _draw_fall(
    history: Sequence[Fitted], forecasts: Sequence[StandardForecast], writer: Writer
) -> Iterator[str]:
    """Yield the fall chart: a bar for each effect, down to the noise floor, and what standards would say."""
    forecast = next(iter(forecasts), None)
    yield from lay_out_sections([lay_out_fall(history, forecast, writer)])
    if forecast:
        symbols = ", ".join(write_plain(quantity.notation) for quantity in forecast.quantities)
        what = f"{symbols}: {forecast.designation}"
        yield from wrap(f"{what}, predicted if the control corrects all effects so far")


def tell_change(path: Path, change: ModelChange, writer: Writer) -> Iterator[str]:
    """Yield what became of the job, and how the error changed."""
    shown, after = show_path(path), change.history[-1]
    axis = after.fit.design.axis
    yield from _tell_origin(change.edit, path)
    done = [f"− {name}" for name in change.removed] + ([f"+ {change.added}"] if change.added else [])
    yield f"{shown}: {', '.join(done)}"
    yield ""
    errors = (("before", change.before.error), ("after", after.error))
    for name, error in errors:
        yield from wrap(f"{name}: {write_in_a_line(list_error_facts(error, axis, _ENGLISH))}")
    yield ""
    if change.added:
        own = [each for each in make_parameter_rows(after.fit, _ENGLISH) if each.effect == change.added]
        yield from wrap(f"{change.added}: {', '.join(write_in_a_sentence(each, _ENGLISH) for each in own)}")
        if not is_outstanding(change.added, after.fit):
            yield f"  {Colour.YELLOW.set('nothing')} of it exceeds its uncertainty: it may not be there"
    yield from _draw_fall(change.history, change.forecasts, writer)
    yield ""
    yield f"next: zlmreport model diagnose {shown}"


def _tell_origin(edit: Edit, path: Path) -> Iterator[str]:
    """Yield that the job has its effects from another file no longer."""
    if edit.inherited_from:
        shown, origin = show_path(path), show_path(path.parent / edit.inherited_from)
        yield f"{shown} had its effects from {origin}; now they stand in {shown} itself"


def _lay_out_heading(job: Job, fit: Fit) -> Iterator[str]:
    """Yield the first lines: which job, which axis, which model, and what it is held together with."""
    model = " + ".join(fit.model.identifiers) or "no effects yet"
    yield from lay_out_heading(job.keys.certificate.number, f"axis {job.axis.name}: {model}")
    others = [each.files[0].name for each in job.sessions]
    runs = [fit.design.cycle[fit.design.session == number] for number in range(1, len(others) + 1)]
    held = [f"{name} (runs {each.min()} to {each.max()})" for name, each in zip(others, runs, strict=True)]
    if held:
        yield from wrap(f"held together with {', '.join(held)}")


def tell_build(built: Built, job: Job, path: str, edit: Edit | None, *, is_tried: bool) -> Iterator[str]:
    """Yield the lines on a build but for what follows; `path` is the job as the user types it."""
    last = built.last
    yield from lay_out_heading(job.keys.certificate.number, f"axis {job.axis.name}")
    yield from wrap_steps(_write_staircase(built))
    yield from wrap(write_statement_after_build(last, has_steps=bool(built.steps)).in_language(_ENGLISH), "")
    if built.exchange is not None:
        coming, going = map(" and ".join, (built.exchange.coming, built.exchange.going))
        yield from wrap(
            f"{coming} in place of {going} would do as well: the readings do not tell which it is", ""
        )
    if built.doubts:
        chances = list_chances(built.doubts).in_language(_ENGLISH)
        yield from wrap(f"not sure: {chances}; else another effect, or something without a name", "")
    for question in built.questions:
        yield from wrap(question.in_language(_ENGLISH), "")
    yield from _tell_needless(built.needless, path)
    if edit is not None and not is_tried:
        yield from _tell_origin(edit, Path(path))
    yield from lay_out_changes(path, () if edit is None else name_changes(built), is_tried=is_tried)


def tell_what_follows(
    last: AxisDiagnosis, path: str, effects: Sequence[Effect], *, is_to_be_written: bool
) -> Iterator[str]:
    """Yield what to do after a build; `path` is the job as the user types it.

    `last`: The diagnosis that it ended with.
    `effects`: All that are installed.
    `is_to_be_written`: Whether it was made on trial, and would change the job.
    """
    if is_to_be_written and find_stated_fault(last) is None:
        following = f"zlmreport model build {path}"
    else:
        yield from _tell_what_to_measure(last)
        following = find_next_step(last, path)
    yield from _tell_what_to_state(last, effects)
    yield f"next: {following}"


def _write_staircase(built: Built) -> str:
    """Return how the error fell in one line: ``offset 5.4 → + backlash 3.2 µm; noise 0.7 µm``.

    What goes out for what comes in is one stair with it: on the way both were there, or neither.
    """
    axis = built.first.fit.design.axis
    unit = write_behind(axis.deviation_unit.symbol)
    began = " + ".join(built.first.fit.model.identifiers) or "without model"
    stairs = [f"{began} {write_deviation(built.first.error.rms, axis, _ENGLISH)}"]
    for flight in _unite_exchanges(built.steps):
        error = write_deviation(flight[-1].after.rms, axis, _ENGLISH)
        stairs.append(f"{', '.join(name_steps(flight))} {error}")
    floor = built.last.error.noise_rms
    noise = "" if floor is None else f"; noise {write_deviation(floor, axis, _ENGLISH)}{unit}"
    return f"{' → '.join(stairs)}{unit}{noise}"


def _unite_exchanges(steps: Sequence[ModelStep]) -> list[list[ModelStep]]:
    united: list[list[ModelStep]] = []
    for each in steps:
        if united and (each.is_removed or all(other.is_removed for other in united[-1])):
            united[-1].append(each)
        else:
            united.append([each])
    return united
