"""One command for several jobs: their exit code, findings and values as lines, ``zlmreport/summary/1``."""

from __future__ import annotations

import textwrap
from argparse import Namespace
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from zlmreport.cli.terminal import (
    Colour,
    collect_problem,
    lay_out_beside,
    lay_out_heading,
    lay_out_table,
    measure_line,
    measure_width,
    print_json,
    print_problems,
    show_path,
    wrap,
)
from zlmreport.document.blocks import Notice
from zlmreport.document.certificate.conformity import STATEMENTS
from zlmreport.document.certificate.readings import list_missing_readings
from zlmreport.document.certificate.results import NO_PARAMETER
from zlmreport.document.certificate.statements import make_exclusion_notice
from zlmreport.document.certificate.uncertainty import say_uncertainty
from zlmreport.document.certificate.values import limit
from zlmreport.document.writer import Writer, is_mixed, write_with_uncertainty
from zlmreport.errors import NOT_MET, InputError, ZlmreportError, as_problems, count_in_words
from zlmreport.evaluation.evaluation import judge_together
from zlmreport.evaluation.report import report_parameter
from zlmreport.evaluation.uncertainty.budget import NoBudget
from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.language.formatting import write_plain
from zlmreport.version import __version__

if TYPE_CHECKING:
    from zlmreport.evaluation.evaluation import EvaluatedParameter, Evaluation, Finding
    from zlmreport.evaluation.uncertainty.budget import Budget
    from zlmreport.job.job import Job
    from zlmreport.language import Words
    from zlmreport.measurement.axis import Axis
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis
    from zlmreport.model.diagnosis.faults import DataFault
    from zlmreport.plugin.registry import Registry


SCHEMA = "zlmreport/summary/1"
#: What the summary has of a parameter in the results file; null where that has nothing.
_OF_PARAMETER = (
    *("symbol", "name", "value", "unit"),
    *("expanded_uncertainty", "coverage_factor", "limit", "conforms"),
)

#: In letters: between two columns, and what is always shown of a name.
_GAP, _SHORTEST_NAME = 2, 24
#: Column in which notices begin, behind the longest of their labels.
_NOTICES_AT = 11
_SOUND = "the job and its data are sound"


_COLOURS = {True: Colour.GREEN, False: Colour.RED, None: Colour.YELLOW}


def do_all(
    loaded: Sequence[JobResult],
    work: Callable[[JobResult, Job], JobResult],
    lines: Callable[[JobResult], Iterable[str]],
    options: Namespace,
    *,
    fail_on_nonconformity: bool = False,
) -> int:
    """Work on every job that has no mistake so far, and return the worst exit code."""
    results = []
    printed = False
    for checked in _refuse_shared_files(loaded):
        result = _try_step(checked, partial(work, checked, checked.job)) if checked.job else checked
        results.append(result)
        if result.error:
            print_problems(result.error)
        elif not (options.quiet or options.json):
            if printed:
                print()
            print(*lines(result), sep="\n", flush=True)
            printed = True
    code = max(result.choose_exit_code(fail_on_nonconformity=fail_on_nonconformity) for result in results)
    if options.json:
        print_json(_summarise(results, code))
    return code


@dataclass(frozen=True, slots=True)
class JobResult:
    """What became of a job."""

    path: Path  #: The job file, as the user named it.
    job: Job | None = None  #: The checked job; None if it is wrong.
    evaluations: tuple[Evaluation, ...] = ()  #: By each of its standards.
    diagnosis: AxisDiagnosis | None = None  #: Of its error model; None where the job names none.
    doubts: tuple[Words, ...] = ()  #: Values that seem to be in another unit, in sentences.
    #: What the readings show that the job does not say, and what of calibrations is open.
    evidence: tuple[Words, ...] = ()
    budget: Budget | NoBudget | None = None  #: Of the uncertainty; None where nothing was evaluated.
    files: tuple[Path, ...] = ()  #: That were written.
    error: ZlmreportError | None = None  #: What ended the work; None if nothing did.

    @property
    def conforms(self) -> bool | None:
        """Whether every stated limit is met; None without limits, or where one is not decided."""
        return judge_together(self.evaluations)

    def choose_exit_code(self, *, fail_on_nonconformity: bool) -> int:
        """Return the exit code of this job alone."""
        if self.error:
            return self.error.exit_code
        return NOT_MET if fail_on_nonconformity and self.conforms is False else 0


def load_all(paths: Sequence[Path], registry: Registry, formats: tuple[str, ...] = ()) -> list[JobResult]:
    """Load every job before any is run, so that a mistake in one hides none in another.

    `formats` stand instead of those that the jobs name.
    """
    return [_try_step(JobResult(path), partial(_load_job, path, registry, formats)) for path in paths]


def _try_step(result: JobResult, step: Callable[[], JobResult]) -> JobResult:
    """Return what a step makes of a result, or the result with the error that ended the step."""
    try:
        return step()
    except Exception as error:  # noqa: BLE001 - one job's trouble must not take the others along
        return replace(result, error=as_problems(result.path, error))


def _refuse_shared_files(results: Sequence[JobResult]) -> list[JobResult]:
    """Refuse jobs whose files would overwrite those of a job before them."""
    first: dict[Path, tuple[Path, str]] = {}
    checked = []
    for result in results:
        job = result.job
        if job is None:
            checked.append(result)
            continue
        number = job.keys.certificate.number
        owner, taken = first.setdefault(job.directory.resolve() / number.casefold(), (result.path, number))
        if owner is not result.path:
            message = f"{owner} writes files of the number {taken} to the same folder"
            message += "" if taken == number else f"; {number} differs from it in case alone"
            error = InputError.at(job.place_of("certificate.number"), message)
            checked.append(replace(result, job=None, error=error))
        else:
            checked.append(result)
    return checked


def _load_job(path: Path, registry: Registry, formats: tuple[str, ...]) -> JobResult:
    return JobResult(path, load(path, registry, formats))


def _summarise(results: Sequence[JobResult], exit_code: int) -> dict[str, Any]:
    """Return what became of all jobs; values in full precision, µm or ″, as in the results file."""
    return {
        "schema": SCHEMA,
        "zlmreport": __version__,
        "exit_code": exit_code,
        "jobs": [_collect_job(result) for result in results],
    }


def _collect_job(result: JobResult) -> dict[str, Any]:
    certificate = result.job.keys.certificate if result.job else None
    return {
        "job": str(result.path),
        "number": certificate.number if certificate else None,
        "kind": certificate.kind if certificate else None,
        "status": "failed" if result.error else "done",
        "conforms": result.conforms,
        "files": [str(path) for path in result.files],
        "evaluations": [_collect_evaluation(evaluation) for evaluation in result.evaluations],
        "missing_readings": _list_missing_readings(result),
        "doubts": [each.in_language(Language.ENGLISH) for each in result.doubts],
        "evidence": [each.in_language(Language.ENGLISH) for each in result.evidence],
        "problems": [collect_problem(problem) for problem in (result.error.problems if result.error else ())],
    }


def _collect_evaluation(evaluation: Evaluation) -> dict[str, Any]:
    usual = evaluation.measurements.axis.deviation_unit
    reported = (report_parameter(each, usual, Language.ENGLISH) for each in evaluation.parameters)
    return {
        "standard": evaluation.standard,
        "parameters": [{key: each.get(key) for key in _OF_PARAMETER} for each in reported],
        "requirements": [
            {
                "requirement": finding.requirement.in_language(Language.ENGLISH),
                "found": finding.found.in_language(Language.ENGLISH),
                "met": finding.met,
            }
            for finding in evaluation.findings
        ],
    }


def _list_missing_readings(result: JobResult) -> list[dict[str, Any]]:
    if not result.evaluations:
        return []
    return [
        {
            "target": measurements.axis.position_unit.from_si(reading.target_position),
            "unit": measurements.axis.position_unit.ascii,
            "direction": reading.approach.sign,
            "run": reading.run,
            **({"measurement": name} if name else {}),
        }
        for name, measurements in _name_measured_sets(result)
        for reading in measurements.missing()
    ]


def _name_measured_sets(result: JobResult) -> Iterator[tuple[str, MeasurementSet]]:
    """Yield every set of readings with what it is called; with nothing, where there is only one."""
    sets = list({id(each.measurements): each.measurements for each in result.evaluations}.values())
    for measurements in sets:
        name = (measurements.axis.error or measurements.axis.name) if len(sets) > 1 else ""
        for line, readings in (measurements.tests or {"": measurements}).items():
            yield " ".join(filter(None, (name, line))), readings


def tell_result(result: JobResult) -> Iterator[str]:
    """Yield the lines on a finished job."""
    job = result.job
    if job is None or not result.evaluations:
        return
    writer = Writer.of(result.evaluations[0].measurements, Language.ENGLISH)
    yield from lay_out_heading(job.keys.certificate.number, _name_subject(job))
    for path in result.files:
        yield f"  {show_path(path)}"
    for evaluation in result.evaluations:
        measurements = evaluation.measurements
        yield ""
        if job.measurements:
            yield f"  {Colour.BOLD.set(measurements.axis.subject.in_language(Language.ENGLISH))}"
        yield from _tell_parameters(evaluation, Writer.of(measurements, Language.ENGLISH))
    yield from _tell_notices(result, writer)


def tell_findings(result: JobResult) -> Iterator[str]:
    """Yield the lines on a checked job: each standard's requirements, met or not."""
    if not result.evaluations:
        return
    writer = Writer.of(result.evaluations[0].measurements, Language.ENGLISH)
    faults = [each for _, measurements in _name_measured_sets(result) for each in _find_faults(measurements)]
    reserved = (*_tell_incomplete(result, writer), *_tell_unlikely(result, writer))
    sound = Colour.YELLOW.set("can be evaluated, with reservations") if reserved else _SOUND
    yield f"{Colour.BOLD.set(str(result.path))}  {Colour.RED.set('its data look wrong') if faults else sound}"
    for fault in faults:
        yield from wrap(f"{writer.say(fault.statement)}; {writer.say(fault.remedy)}")
    yield from reserved
    for evaluation in result.evaluations:
        yield from tell_requirements(evaluation.designation, evaluation.findings, writer)
    yield from _tell_missing(result, writer)
    yield from _tell_model(result)


def _find_faults(measurements: MeasurementSet) -> tuple[DataFault, ...]:
    """Return what the rows of a file themselves show to be wrong; units are among the doubts."""
    import numpy as np  # noqa: PLC0415 - the same

    from zlmreport.model.diagnosis.faults import FaultKind, find_recorded_faults  # noqa: PLC0415 - only where data are checked
    from zlmreport.model.fitting.observations import make_observations_of  # noqa: PLC0415 - the same

    if np.all(np.isnan(measurements.deviation)):
        return ()
    observed = make_observations_of(measurements)
    found = find_recorded_faults(observed.design, observed.deviation)
    return tuple(each for each in found if each.is_sure and each.kind is not FaultKind.WRONG_UNIT)


def tell_requirements(designation: str, found: Iterable[Finding], writer: Writer) -> Iterator[str]:
    """Yield the lines on what a standard asks of a test."""
    yield f"  {designation}"
    words = {True: "met", False: Colour.RED.set("not met"), None: Colour.YELLOW.set("open")}
    told = [
        (f"    {words[each.met]}", writer.say(each.requirement), writer.say(each.found)) for each in found
    ]
    column = max((measure_width(label) for label, _, _ in told), default=0) + _GAP
    for label, requirement, had in told:
        yield from _lay_out_finding(label, requirement, had, column)


def _lay_out_finding(label: str, requirement: str, found: str, column: int) -> Iterator[str]:
    """Yield what is asked and what was found in a line, or below each other where that has no room."""
    in_a_line = f"{requirement}: {found}"
    fits = len(wrap(in_a_line, " " * column)) == 1
    yield from lay_out_beside(label, [in_a_line] if fits else [f"{requirement}:", found], column)


def _name_subject(job: Job) -> str:
    machine = job.keys.machine
    serial = f"serial {machine.serial}" if machine.serial else ""
    of = (
        count_in_words(len(job.measurements), "measurement")
        if job.measurements
        else _name_in_a_line(job.axis)
    )
    return ", ".join(part for part in (of, machine.type, serial) if part)


def _name_in_a_line(axis: Axis) -> str:
    """Return what was measured of, within a line: ``axis X``, ``plane XY``."""
    heading = axis.heading.in_language(Language.ENGLISH)
    return heading[:1].lower() + heading[1:]


def _tell_parameters(evaluation: Evaluation, writer: Writer) -> Iterator[str]:
    parameters = evaluation.parameters
    if not parameters:
        yield f"  {evaluation.designation}"
        yield from wrap(writer.say(NO_PARAMETER), "    ")
        return
    has_limits = any(each.limit is not None for each in parameters)
    has_uncertainty = any(each.expanded_uncertainty is not None for each in parameters)
    mixed = is_mixed(parameters, writer)
    values = (_write_value(each, writer, with_uncertainty=has_uncertainty) for each in parameters)
    columns = [
        [write_plain(each.quantity.notation) for each in parameters],
        *map(_align_on_the_point, zip(*values, strict=True)),
        *([[each.quantity.unit_or(writer.deviation_unit).symbol for each in parameters]] if mixed else []),
        [limit(each, writer) if has_limits else "" for each in parameters],
        [_tell_verdict(each, writer) for each in parameters],
    ]
    headings = [
        *("", "" if mixed else writer.deviation_unit.symbol, *(["± U"] if has_uncertainty else [])),
        *([""] if mixed else []),
        *("limit" if has_limits else "", ""),
    ]
    without_names = lay_out_table([headings, *zip(*columns, strict=True)])
    room = max(_SHORTEST_NAME, measure_line() - max(map(measure_width, without_names)) - _GAP)
    names = [_name_lines(writer.say(each.quantity.name), room) for each in parameters]
    rows = [
        row
        for (symbol, *others), (name, *further) in zip(zip(*columns, strict=True), names, strict=True)
        for row in ((symbol, name, *others), *(("", line, *("" for _ in others)) for line in further))
    ]
    headings.insert(1, "")
    first, *below = lay_out_table([headings, *rows], right=range(2, len(headings) - 1))
    start = len(first) - len(first.lstrip()) - 1
    yield f"  {evaluation.designation}".ljust(start) + first[start:]
    yield from below


def _write_value(parameter: EvaluatedParameter, writer: Writer, *, with_uncertainty: bool) -> tuple[str, ...]:
    """Return a value, and with its uncertainty both as the certificate prints them."""
    return (
        write_with_uncertainty(parameter, writer)
        if with_uncertainty
        else (writer.of_quantity(parameter.quantity).deviation(parameter.printed_value),)
    )


def _align_on_the_point(numbers: Sequence[str]) -> list[str]:
    """Return numbers that stand with their decimal points below each other when they end alike."""
    decimals = [len(number) - number.find(".") if "." in number else 0 for number in numbers]
    return [number + " " * (max(decimals) - own) for number, own in zip(numbers, decimals, strict=True)]


def _tell_verdict(parameter: EvaluatedParameter, writer: Writer) -> str:
    if parameter.decision is None:
        return ""
    _, words = STATEMENTS[parameter.decision.conformity]
    return _COLOURS[parameter.conforms].set(writer.say(words))


def _tell_notices(result: JobResult, writer: Writer) -> Iterator[str]:
    notices = [
        *_tell_incomplete(result, writer),
        *_tell_unlikely(result, writer),
        *_tell_missing(result, writer),
    ]
    for evaluation in result.evaluations:
        for finding in evaluation.findings:
            if finding.met is False:
                asked = f"{evaluation.designation}: {writer.say(finding.requirement)}"
                label, found = f"  {Colour.YELLOW.set('not met')}", writer.say(finding.found)
                notices.extend(_lay_out_finding(label, asked, found, _NOTICES_AT))
    notices.extend(_tell_model(result))
    if notices:
        yield ""
        yield from notices


def _tell_incomplete(result: JobResult, writer: Writer) -> Iterator[str]:
    """Yield what U leaves out, where there is one; or why there is none, though a budget is stated."""
    if isinstance(result.budget, NoBudget):
        if result.job and result.job.keys.uncertainty.model_fields_set:
            yield from _tell_notice("open", f"no U: {writer.say(result.budget.reason)}")
    elif result.budget:
        for block in say_uncertainty(result.budget, result.evaluations, writer):
            if isinstance(block, Notice):
                yield from _tell_notice("open", block.heading)


def _tell_unlikely(result: JobResult, writer: Writer) -> Iterator[str]:
    for doubt in result.doubts:
        yield from _tell_notice("unlikely", writer.say(doubt))
    for shown in result.evidence:
        yield from _tell_notice("doubtful", writer.say(shown))


def _tell_missing(result: JobResult, writer: Writer) -> Iterator[str]:
    for name, measurements in _name_measured_sets(result):
        own, before = Writer.of(measurements, writer.language), f"{name}: " if name else ""
        for notice in list_missing_readings(measurements, own):
            yield from _tell_notice("missing", f"{before}{notice.heading}", *notice.items)
        for notice in make_exclusion_notice(measurements, own):
            yield from _tell_notice("aside", f"{before}{notice.heading}", *notice.items)


def _tell_model(result: JobResult) -> Iterator[str]:
    diagnosis = result.diagnosis
    if diagnosis is None:
        return
    from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict  # noqa: PLC0415 - brings the error model
    from zlmreport.model.diagnosis.report import write_verdict_statement  # noqa: PLC0415

    is_adequate = diagnosis.verdict is DiagnosisVerdict.ADEQUATE
    statement = write_verdict_statement(diagnosis).in_language(Language.ENGLISH)
    yield from _tell_notice("model", statement, colour=Colour.GREEN if is_adequate else Colour.YELLOW)
    if not is_adequate:
        yield f"{'':{_NOTICES_AT}}see: zlmreport model diagnose {show_path(result.path)}"


def _tell_notice(label: str, *texts: str, colour: Colour = Colour.YELLOW) -> Iterator[str]:
    yield from lay_out_beside(f"  {colour.set(label)}", texts, _NOTICES_AT)


def _name_lines(name: str, room: int) -> list[str]:
    """Return the lines of a name; its last part, a direction that the symbol shows, goes before it wraps."""
    return textwrap.wrap(name if len(name) <= room else name.rsplit(", ", 1)[0], room)
