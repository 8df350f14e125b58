"""The same done with every job of a command line, and what is read of it: lines, ``zlmreport/summary/1``."""

from __future__ import annotations

import shutil
import textwrap
from argparse import Namespace
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from zlmreport.cli.terminal import (
    Colour,
    print_json,
    print_problems,
    problem_values,
    shown_path,
    table,
    width_of,
)
from zlmreport.document.blocks import Notice
from zlmreport.document.certificate.conformity import STATEMENTS
from zlmreport.document.certificate.readings import missing_readings
from zlmreport.document.certificate.statements import exclusion_notice
from zlmreport.document.certificate.uncertainty import statement
from zlmreport.document.certificate.values import is_mixed, limit
from zlmreport.document.writer import Writer, written
from zlmreport.errors import InputError, ZlmreportError, as_problems
from zlmreport.evaluation.uncertainty.budget import Budget
from zlmreport.job.loading import load
from zlmreport.job.parse import counted
from zlmreport.language import Language
from zlmreport.language.formatting import plain
from zlmreport.measurement.units import Unit
from zlmreport.version import __version__

if TYPE_CHECKING:
    from zlmreport.evaluation.evaluation import Evaluation, Finding, Parameter
    from zlmreport.evaluation.uncertainty.budget import Budget, NoBudget
    from zlmreport.job.job import Job
    from zlmreport.language import Words
    from zlmreport.measurement.axis import Axis
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.model.diagnosis.diagnosis import Diagnosis
    from zlmreport.model.diagnosis.faults import DataFault
    from zlmreport.plugin.registry import Registry


_NOT_MET = 1
SCHEMA = "zlmreport/summary/1"

#: In letters: the width of a terminal that has none, between two columns, and what is always shown of a name.
_USUAL_WIDTH, _GAP, _SHORTEST_NAME = 120, 2, 24
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
    for checked in refuse_shared_files(loaded):
        result = attempt(checked, partial(work, checked, checked.job)) if checked.job else checked
        results.append(result)
        if result.error:
            print_problems(result.error)
        elif not (options.quiet or options.json):
            if printed:
                print()
            print(*lines(result), sep="\n", flush=True)
            printed = True
    code = max(result.exit_code(fail_on_nonconformity=fail_on_nonconformity) for result in results)
    if options.json:
        print_json(summary(results, code))
    return code


@dataclass(frozen=True, slots=True)
class JobResult:
    """What became of a job."""

    path: Path  #: The job file, as the user named it.
    job: Job | None = None  #: The checked job; None if it is wrong.
    evaluations: tuple[Evaluation, ...] = ()  #: By each of its standards.
    diagnosis: Diagnosis | None = None  #: Of its error model; None where the job names none.
    doubts: tuple[Words, ...] = ()  #: Values that seem to be in another unit, in sentences.
    #: What the readings show that the job does not say, and what of calibrations is open.
    evidence: tuple[Words, ...] = ()
    budget: Budget | NoBudget | None = None  #: Of the uncertainty; None where nothing was evaluated.
    files: tuple[Path, ...] = ()  #: That were written.
    error: ZlmreportError | None = None  #: What ended the work; None if nothing did.

    @property
    def conforms(self) -> bool | None:
        """Whether every stated limit is met; None without limits, or where one is not decided."""
        verdicts = [
            parameter.conforms
            for evaluation in self.evaluations
            for parameter in evaluation.parameters
            if parameter.limit is not None
        ]
        if False in verdicts:
            return False
        return True if verdicts and None not in verdicts else None

    def exit_code(self, *, fail_on_nonconformity: bool = False) -> int:
        """Return the exit code of this job alone."""
        if self.error:
            return self.error.exit_code
        return _NOT_MET if fail_on_nonconformity and self.conforms is False else 0


def load_all(paths: Sequence[Path], registry: Registry, formats: tuple[str, ...] = ()) -> list[JobResult]:
    """Load every job before any is run, so that a mistake in one hides none in another.

    `formats` stand instead of those that the jobs name.
    """
    return [attempt(JobResult(path), partial(_loaded, path, registry, formats)) for path in paths]


def attempt(result: JobResult, step: Callable[[], JobResult]) -> JobResult:
    """Return what a step makes of a result, or the result with the error that ended the step."""
    try:
        return step()
    except Exception as error:  # noqa: BLE001 - one job's trouble must not take the others along
        return replace(result, error=as_problems(result.path, error))


def refuse_shared_files(results: Sequence[JobResult]) -> list[JobResult]:
    """Refuse jobs whose files would overwrite those of a job before them."""
    first: dict[Path, Path] = {}
    checked = []
    for result in results:
        job = result.job
        if job is None:
            checked.append(result)
            continue
        stem = job.directory.resolve() / job.keys.certificate.number
        owner = first.setdefault(stem, result.path)
        if owner is not result.path:
            message = f"{owner} writes files of the number {job.keys.certificate.number} to the same folder"
            error = InputError.at(job.place_of("certificate.number"), message)
            checked.append(replace(result, job=None, error=error))
        else:
            checked.append(result)
    return checked


def _loaded(path: Path, registry: Registry, formats: tuple[str, ...]) -> JobResult:
    return JobResult(path, load(path, registry, formats))


def summary(results: Sequence[JobResult], exit_code: int) -> dict[str, Any]:
    """Return what became of all jobs; values in full precision, µm or ″, as in the results file."""
    return {
        "schema": SCHEMA,
        "zlmreport": __version__,
        "exit_code": exit_code,
        "jobs": [_job(result) for result in results],
    }


def _job(result: JobResult) -> dict[str, Any]:
    certificate = result.job.keys.certificate if result.job else None
    return {
        "job": str(result.path),
        "number": certificate.number if certificate else None,
        "kind": certificate.kind if certificate else None,
        "status": "failed" if result.error else "done",
        "conforms": result.conforms,
        "files": [str(path) for path in result.files],
        "evaluations": [_evaluation(evaluation) for evaluation in result.evaluations],
        "missing_readings": _missing_readings(result),
        "doubts": [each.in_language(Language.ENGLISH) for each in result.doubts],
        "evidence": [each.in_language(Language.ENGLISH) for each in result.evidence],
        "problems": [problem_values(problem) for problem in (result.error.problems if result.error else ())],
    }


def _in_unit(unit: Unit, value: float | None) -> float | None:
    return None if value is None else unit.from_si(value)


def _evaluation(evaluation: Evaluation) -> dict[str, Any]:
    usual = evaluation.measurements.axis.deviation_unit

    return {
        "standard": evaluation.standard,
        "parameters": [
            {
                "symbol": parameter.quantity.symbol,
                "name": parameter.quantity.name.in_language(Language.ENGLISH),
                "value": unit.from_si(parameter.value),
                "unit": unit.ascii,
                "expanded_uncertainty": _in_unit(unit, parameter.expanded_uncertainty),
                "coverage_factor": parameter.coverage_factor,
                "limit": _in_unit(unit, parameter.limit),
                "conforms": parameter.conforms,
            }
            for parameter in evaluation.parameters
            for unit in (parameter.quantity.unit_or(usual),)
        ],
        "requirements": [
            {
                "requirement": finding.requirement.in_language(Language.ENGLISH),
                "found": finding.found.in_language(Language.ENGLISH),
                "met": finding.met,
            }
            for finding in evaluation.findings
        ],
    }


def _missing_readings(result: JobResult) -> list[dict[str, Any]]:
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
        for name, measurements in _measured(result)
        for reading in measurements.missing()
    ]


def _measured(result: JobResult) -> Iterator[tuple[str, MeasurementSet]]:
    """Yield every set of readings with what it is called; with nothing, where there is only one."""
    sets = list({id(each.measurements): each.measurements for each in result.evaluations}.values())
    for measurements in sets:
        name = (measurements.axis.error or measurements.axis.name) if len(sets) > 1 else ""
        for line, readings in (measurements.tests or {"": measurements}).items():
            yield " ".join(filter(None, (name, line))), readings


def report(result: JobResult) -> Iterator[str]:
    """Yield the lines on a finished job."""
    job = result.job
    if job is None or not result.evaluations:
        return
    writer = Writer.of(result.evaluations[0].measurements, Language.ENGLISH)
    yield f"{Colour.BOLD.of(job.keys.certificate.number)}  {_subject(job)}"
    for path in result.files:
        yield f"  {shown_path(path)}"
    for evaluation in result.evaluations:
        measurements = evaluation.measurements
        yield ""
        if job.measurements:
            yield f"  {Colour.BOLD.of(measurements.axis.subject.in_language(Language.ENGLISH))}"
        yield from _parameters(evaluation, Writer.of(measurements, Language.ENGLISH))
    yield from _notices(result, writer)


def findings(result: JobResult) -> Iterator[str]:
    """Yield the lines on a checked job: each standard's requirements, met or not."""
    if not result.evaluations:
        return
    writer = Writer.of(result.evaluations[0].measurements, Language.ENGLISH)
    faults = [each for _, measurements in _measured(result) for each in _faults(measurements)]
    reserved = (*_incomplete(result, writer), *_unlikely(result, writer))
    sound = Colour.YELLOW.of("can be evaluated, with reservations") if reserved else _SOUND
    yield f"{Colour.BOLD.of(str(result.path))}  {Colour.RED.of('its data look wrong') if faults else sound}"
    for fault in faults:
        yield f"  {writer.say(fault.statement)}; {writer.say(fault.remedy)}"
    yield from reserved
    for evaluation in result.evaluations:
        yield from requirements(evaluation.designation, evaluation.findings, writer)
    yield from _missing(result, writer)
    yield from _model(result)


def _faults(measurements: MeasurementSet) -> tuple[DataFault, ...]:
    """Return what the rows of a file themselves show to be wrong; units are among the doubts."""
    import numpy as np  # noqa: PLC0415 - the same

    from zlmreport.model.diagnosis.faults import FaultKind, recorded_faults  # noqa: PLC0415 - only where data are checked
    from zlmreport.model.fitting.observations import observations_of  # noqa: PLC0415 - the same

    if np.all(np.isnan(measurements.deviation)):
        return ()
    observed = observations_of(measurements)
    found = recorded_faults(observed.design, observed.deviation)
    return tuple(each for each in found if each.is_sure and each.kind is not FaultKind.WRONG_UNIT)


def requirements(designation: str, found: Iterable[Finding], writer: Writer) -> Iterator[str]:
    """Yield the lines on what a standard asks of a test."""
    yield f"  {designation}"
    words = {True: "met", False: Colour.RED.of("not met"), None: Colour.YELLOW.of("open")}
    yield from table(
        (words[finding.met], f"{writer.say(finding.requirement)}: {writer.say(finding.found)}")
        for finding in found
    )


def _subject(job: Job) -> str:
    machine = job.keys.machine
    serial = f"serial {machine.serial}" if machine.serial else ""
    of = counted(len(job.measurements), "measurement") if job.measurements else _in_a_line(job.axis)
    return ", ".join(part for part in (of, machine.type, serial) if part)


def _in_a_line(axis: Axis) -> str:
    """Return what was measured of, within a line: ``axis X``, ``plane XY``."""
    heading = axis.heading.in_language(Language.ENGLISH)
    return heading[:1].lower() + heading[1:]


def _parameters(evaluation: Evaluation, writer: Writer) -> Iterator[str]:
    parameters = evaluation.parameters
    has_limits = any(each.limit is not None for each in parameters)
    has_uncertainty = any(each.expanded_uncertainty is not None for each in parameters)
    mixed = is_mixed(parameters, writer)
    values = (_value(each, writer, with_uncertainty=has_uncertainty) for each in parameters)
    columns = [
        [plain(each.quantity.notation) for each in parameters],
        *map(_on_the_point, zip(*values, strict=True)),
        *([[each.quantity.unit_or(writer.deviation_unit).symbol for each in parameters]] if mixed else []),
        [limit(each, writer) if has_limits else "" for each in parameters],
        [_verdict(each, writer) for each in parameters],
    ]
    headings = [
        *("", "" if mixed else writer.deviation_unit.symbol, *(["± U"] if has_uncertainty else [])),
        *([""] if mixed else []),
        *("limit" if has_limits else "", ""),
    ]
    without_names = table([headings, *zip(*columns, strict=True)])
    room = max(_SHORTEST_NAME, _terminal_width() - max(map(width_of, without_names)) - _GAP)
    names = [_name_lines(writer.say(each.quantity.name), room) for each in parameters]
    rows = [
        row
        for (symbol, *others), (name, *further) in zip(zip(*columns, strict=True), names, strict=True)
        for row in ((symbol, name, *others), *(("", line, *("" for _ in others)) for line in further))
    ]
    headings.insert(1, "")
    first, *below = table([headings, *rows], right=range(2, len(headings) - 1))
    start = len(first) - len(first.lstrip()) - 1
    yield f"  {evaluation.designation}".ljust(start) + first[start:]
    yield from below


def _terminal_width() -> int:
    return shutil.get_terminal_size((_USUAL_WIDTH, 0)).columns


def _value(parameter: Parameter, writer: Writer, *, with_uncertainty: bool) -> tuple[str, ...]:
    """Return a value, and with its uncertainty both as the certificate prints them."""
    return (
        written(parameter, writer)
        if with_uncertainty
        else (writer.of_quantity(parameter.quantity).deviation(parameter.printed_value),)
    )


def _on_the_point(numbers: Sequence[str]) -> list[str]:
    """Return numbers that stand with their decimal points below each other when they end alike."""
    decimals = [len(number) - number.find(".") if "." in number else 0 for number in numbers]
    return [number + " " * (max(decimals) - own) for number, own in zip(numbers, decimals, strict=True)]


def _verdict(parameter: Parameter, writer: Writer) -> str:
    if parameter.decision is None:
        return ""
    _, words = STATEMENTS[parameter.decision.conformity]
    return _COLOURS[parameter.conforms].of(writer.say(words))


def _notices(result: JobResult, writer: Writer) -> Iterator[str]:
    notices = [*_incomplete(result, writer), *_unlikely(result, writer), *_missing(result, writer)]
    for evaluation in result.evaluations:
        notices.extend(
            f"  {Colour.YELLOW.of('not met')}  {evaluation.designation}: "
            f"{writer.say(finding.requirement)}: {writer.say(finding.found)}"
            for finding in evaluation.findings
            if finding.met is False
        )
    notices.extend(_model(result))
    if notices:
        yield ""
        yield from notices


def _incomplete(result: JobResult, writer: Writer) -> Iterator[str]:
    """Yield what U leaves out, where there is one."""
    if isinstance(result.budget, Budget):
        for block in statement(result.budget, (), writer):
            if isinstance(block, Notice):
                yield f"  {Colour.YELLOW.of('open')}     {block.heading}"


def _unlikely(result: JobResult, writer: Writer) -> Iterator[str]:
    for doubt in result.doubts:
        yield f"  {Colour.YELLOW.of('unlikely')} {writer.say(doubt)}"
    for shown in result.evidence:
        yield f"  {Colour.YELLOW.of('doubtful')} {writer.say(shown)}"


def _missing(result: JobResult, writer: Writer) -> Iterator[str]:
    for name, measurements in _measured(result):
        own, before = Writer.of(measurements, writer.language), f"{name}: " if name else ""
        for notice in missing_readings(measurements, own):
            yield f"  {Colour.YELLOW.of('missing')}  {before}{notice.heading}"
            yield from (f"           {item}" for item in notice.items)
        for notice in exclusion_notice(measurements, own):
            yield f"  {Colour.YELLOW.of('aside')}    {before}{notice.heading}"
            yield from (f"           {item}" for item in notice.items)


def _model(result: JobResult) -> Iterator[str]:
    diagnosis = result.diagnosis
    if diagnosis is None:
        return
    from zlmreport.model.diagnosis.diagnosis import Verdict  # noqa: PLC0415 - brings the error model
    from zlmreport.model.diagnosis.report import verdict_statement  # noqa: PLC0415

    label = (Colour.GREEN if diagnosis.verdict is Verdict.ADEQUATE else Colour.YELLOW).of("model")
    yield f"  {label}  {verdict_statement(diagnosis).in_language(Language.ENGLISH)}"
    if diagnosis.verdict is not Verdict.ADEQUATE:
        yield f"         see: zlmreport model diagnose {shown_path(result.path)}"


def _name_lines(name: str, room: int) -> list[str]:
    """Return the lines of a name; its last part, a direction that the symbol shows, goes before it wraps."""
    return textwrap.wrap(name if len(name) <= room else name.rsplit(", ", 1)[0], room)
