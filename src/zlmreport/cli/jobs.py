"""The same done with every job of a command line, and what is read of it: lines, ``zlmreport/summary/1``."""

from __future__ import annotations

import shutil
from argparse import Namespace
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from zlmreport.certificate.conformity import STATEMENTS
from zlmreport.certificate.document import Notice
from zlmreport.certificate.readings import missing_readings
from zlmreport.certificate.statements import exclusion_notice
from zlmreport.certificate.uncertainty import statement
from zlmreport.certificate.values import limit
from zlmreport.cli.terminal import Colour, print_json, print_problems, problem_values, shown_path, table
from zlmreport.errors import InputError, ZlmreportError, as_problems
from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.presenting.writer import Writer, written
from zlmreport.quantities.formatting import plain
from zlmreport.uncertainty.budget import Budget
from zlmreport.values import dataclass
from zlmreport.version import __version__

if TYPE_CHECKING:
    from zlmreport.evaluation.evaluation import Evaluation, Finding, Parameter
    from zlmreport.job.job import Job
    from zlmreport.language import Words
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.model.diagnosis import Diagnosis
    from zlmreport.model.faults import Fault
    from zlmreport.plugins import Registry
    from zlmreport.uncertainty.budget import Budget, NoBudget


_NOT_MET = 1
SCHEMA = "zlmreport/summary/1"

#: Of a terminal, in letters: its width where it has none, what a table needs beside the names of
#: parameters, and how much of a name is always shown; what the column of uncertainties needs.
_USUAL_WIDTH, _OTHER_COLUMNS, _SHORTEST_NAME = 120, 44, 24
_UNCERTAINTY_COLUMN = 7
_SOUND = "the job and its data are sound"


_COLOURS = {True: Colour.GREEN, False: Colour.RED, None: Colour.YELLOW}


def do_all(
    loaded: Sequence[Result],
    work: Callable[[Result, Job], Result],
    lines: Callable[[Result], Iterable[str]],
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
class Result:
    """What became of a job."""

    path: Path  #: The job file, as the user named it.
    job: Job | None = None  #: The checked job; None if it is wrong.
    evaluations: tuple[Evaluation, ...] = ()  #: By each of its standards.
    diagnosis: Diagnosis | None = None  #: Of its error model; None where the job names none.
    doubts: tuple[Words, ...] = ()  #: Values that seem to be in another unit, in sentences.
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


def load_all(paths: Sequence[Path], registry: Registry, formats: tuple[str, ...] = ()) -> list[Result]:
    """Load every job before any is run, so that a mistake in one hides none in another.

    `formats` stand instead of those that the jobs name.
    """
    return [attempt(Result(path), partial(_loaded, path, registry, formats)) for path in paths]


def attempt(result: Result, step: Callable[[], Result]) -> Result:
    """Return what a step makes of a result, or the result with the error that ended the step."""
    try:
        return step()
    except Exception as error:  # noqa: BLE001 - one job's trouble must not take the others along
        return replace(result, error=as_problems(result.path, error))


def refuse_shared_files(results: Sequence[Result]) -> list[Result]:
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


def _loaded(path: Path, registry: Registry, formats: tuple[str, ...]) -> Result:
    return Result(path, load(path, registry, formats))


def summary(results: Sequence[Result], exit_code: int) -> dict[str, Any]:
    """Return what became of all jobs; values in full precision, µm or ″, as in the results file."""
    return {
        "schema": SCHEMA,
        "zlmreport": __version__,
        "exit_code": exit_code,
        "jobs": [_job(result) for result in results],
    }


def _job(result: Result) -> dict[str, Any]:
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
        "problems": [problem_values(problem) for problem in (result.error.problems if result.error else ())],
    }


def _evaluation(evaluation: Evaluation) -> dict[str, Any]:
    unit = evaluation.measurements.axis.deviation_unit

    def in_unit(value: float | None) -> float | None:
        return None if value is None else unit.from_si(value)

    return {
        "standard": evaluation.standard,
        "parameters": [
            {
                "symbol": parameter.quantity.symbol,
                "name": parameter.quantity.name.in_language(Language.ENGLISH),
                "value": in_unit(parameter.value),
                "unit": unit.ascii,
                "expanded_uncertainty": in_unit(parameter.expanded_uncertainty),
                "coverage_factor": parameter.coverage_factor,
                "limit": in_unit(parameter.limit),
                "conforms": parameter.conforms,
            }
            for parameter in evaluation.parameters
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


def _missing_readings(result: Result) -> list[dict[str, Any]]:
    if not result.evaluations:
        return []
    measurements = result.evaluations[0].measurements
    unit = measurements.axis.position_unit
    return [
        {
            "target": unit.from_si(reading.target_position),
            "unit": unit.ascii,
            "direction": reading.approach.sign,
            "run": reading.run,
        }
        for reading in measurements.missing()
    ]


def report(result: Result) -> Iterator[str]:
    """Yield the lines on a finished job."""
    job = result.job
    if job is None or not result.evaluations:
        return
    writer = Writer.of(result.evaluations[0].measurements, Language.ENGLISH)
    yield f"{Colour.BOLD.of(job.keys.certificate.number)}  {_subject(job)}"
    for path in result.files:
        yield f"  {shown_path(path)}"
    for evaluation in result.evaluations:
        yield ""
        yield from _parameters(evaluation, writer)
    yield from _notices(result, writer)


def findings(result: Result) -> Iterator[str]:
    """Yield the lines on a checked job: each standard's requirements, met or not."""
    if not result.evaluations:
        return
    writer = Writer.of(result.evaluations[0].measurements, Language.ENGLISH)
    faults = _faults(result.evaluations[0].measurements)
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


def _faults(measurements: MeasurementSet) -> tuple[Fault, ...]:
    """Return what the rows of a file themselves show to be wrong; units are among the doubts."""
    import numpy as np  # noqa: PLC0415 - the same

    from zlmreport.model.faults import FaultKind, recorded_faults  # noqa: PLC0415 - only where data are checked
    from zlmreport.model.observations import observations_of  # noqa: PLC0415 - the same

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
    return ", ".join(part for part in (f"axis {job.axis.name}", machine.type, serial) if part)


def _parameters(evaluation: Evaluation, writer: Writer) -> Iterator[str]:
    has_limits = any(parameter.limit is not None for parameter in evaluation.parameters)
    has_uncertainty = any(parameter.expanded_uncertainty is not None for parameter in evaluation.parameters)
    other_columns = _OTHER_COLUMNS + (_UNCERTAINTY_COLUMN if has_uncertainty else 0)
    longest_name = max(_SHORTEST_NAME, shutil.get_terminal_size((_USUAL_WIDTH, 0)).columns - other_columns)
    names = [_shortened(writer.say(each.quantity.name), longest_name) for each in evaluation.parameters]
    values = zip(
        *(_value(each, writer, with_uncertainty=has_uncertainty) for each in evaluation.parameters),
        strict=True,
    )
    rows = zip(
        (plain(each.quantity.notation) for each in evaluation.parameters),
        names,
        *map(_on_the_point, values),
        (limit(each, writer) if has_limits else "" for each in evaluation.parameters),
        (_verdict(each, writer) for each in evaluation.parameters),
        strict=True,
    )
    unit = writer.deviation_unit.symbol
    headings = ("", "", unit, *(["± U"] if has_uncertainty else []), "limit" if has_limits else "", "")
    first, *others = table([headings, *rows], right=range(2, len(headings) - 1))
    room = len(first) - len(first.lstrip()) - 1
    yield f"  {evaluation.designation}".ljust(room) + first[room:]
    yield from others


def _value(parameter: Parameter, writer: Writer, *, with_uncertainty: bool) -> tuple[str, ...]:
    """Return a value, and with its uncertainty both as the certificate prints them."""
    return written(parameter, writer) if with_uncertainty else (writer.deviation(parameter.printed_value),)


def _on_the_point(numbers: Sequence[str]) -> list[str]:
    """Return numbers that stand with their decimal points below each other when they end alike."""
    decimals = [len(number) - number.find(".") if "." in number else 0 for number in numbers]
    return [number + " " * (max(decimals) - own) for number, own in zip(numbers, decimals, strict=True)]


def _verdict(parameter: Parameter, writer: Writer) -> str:
    if parameter.decision is None:
        return ""
    _, words = STATEMENTS[parameter.decision.conformity]
    return _COLOURS[parameter.conforms].of(writer.say(words))


def _notices(result: Result, writer: Writer) -> Iterator[str]:
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


def _incomplete(result: Result, writer: Writer) -> Iterator[str]:
    """Yield what U leaves out, where there is one."""
    if isinstance(result.budget, Budget):
        for block in statement(result.budget, writer):
            if isinstance(block, Notice):
                yield f"  {Colour.YELLOW.of('open')}     {block.heading}"


def _unlikely(result: Result, writer: Writer) -> Iterator[str]:
    for doubt in result.doubts:
        yield f"  {Colour.YELLOW.of('unlikely')} {writer.say(doubt)}"


def _missing(result: Result, writer: Writer) -> Iterator[str]:
    for notice in missing_readings(result.evaluations[0].measurements, writer):
        yield f"  {Colour.YELLOW.of('missing')}  {notice.heading}"
        yield from (f"           {item}" for item in notice.items)
    for notice in exclusion_notice(result.evaluations[0].measurements, writer):
        yield f"  {Colour.YELLOW.of('aside')}    {notice.heading}"
        yield from (f"           {item}" for item in notice.items)


def _model(result: Result) -> Iterator[str]:
    diagnosis = result.diagnosis
    if diagnosis is None:
        return
    from zlmreport.model.diagnosis import Verdict  # noqa: PLC0415 - brings the error model
    from zlmreport.model.report import verdict_statement  # noqa: PLC0415

    label = (Colour.GREEN if diagnosis.verdict is Verdict.ADEQUATE else Colour.YELLOW).of("model")
    yield f"  {label}  {verdict_statement(diagnosis).in_language(Language.ENGLISH)}"
    if diagnosis.verdict is not Verdict.ADEQUATE:
        yield f"         see: zlmreport model diagnose {shown_path(result.path)}"


def _shortened(name: str, longest: int) -> str:
    """Return as much of a name as has room; its last part, a direction that the symbol shows, goes first."""
    if len(name) > longest:
        name = name.rsplit(", ", 1)[0]
    return name if len(name) <= longest else f"{name[: longest - 1].rstrip()}…"
