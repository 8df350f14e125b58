"""What people read of a job that is done, or checked."""

from __future__ import annotations

import shutil
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from zlmreport.certificate.conformity import STATEMENTS
from zlmreport.certificate.document import Notice
from zlmreport.certificate.readings import missing_readings
from zlmreport.certificate.statements import exclusion_notice
from zlmreport.certificate.uncertainty import statement
from zlmreport.certificate.values import limit
from zlmreport.cli.terminal import Colour, shown_path, table
from zlmreport.language import Language
from zlmreport.presenting.writer import Writer, written
from zlmreport.quantities.formatting import plain
from zlmreport.uncertainty.budget import Budget

if TYPE_CHECKING:
    from zlmreport.cli.jobs import Result
    from zlmreport.evaluation.evaluation import Evaluation, Finding, Parameter
    from zlmreport.job.job import Job
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.model.faults import Fault

#: Of a terminal, in letters: its width where it has none, what a table needs beside the names of
#: parameters, and how much of a name is always shown; what the column of uncertainties needs.
_USUAL_WIDTH, _OTHER_COLUMNS, _SHORTEST_NAME = 120, 44, 24
_UNCERTAINTY_COLUMN = 7
_SOUND = "the job and its data are sound"


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
    named = " ".join(part for part in (machine.manufacturer, machine.model) if part)
    serial = f"serial {machine.serial}" if machine.serial else ""
    return ", ".join(part for part in (f"axis {job.axis.name}", named, serial) if part)


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


_COLOURS = {True: Colour.GREEN, False: Colour.RED, None: Colour.YELLOW}


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
