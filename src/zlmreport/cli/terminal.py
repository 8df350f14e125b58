"""What people read of a job that is done: tables that line up, and colours where a terminal shows them."""

from __future__ import annotations

import os
import shutil
import sys
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from enum import Enum
from pathlib import Path

from zlmreport.certificate import exclusions
from zlmreport.certificate.conformity import STATEMENTS
from zlmreport.certificate.readings import missing_readings
from zlmreport.certificate.rounding import written
from zlmreport.certificate.scribe import Scribe
from zlmreport.certificate.values import limit
from zlmreport.cli.messages import visible
from zlmreport.cli.results import Result
from zlmreport.evaluation.evaluation import Evaluation, Parameter
from zlmreport.evaluation.requirements import Finding
from zlmreport.job.job import Job
from zlmreport.language import Language
from zlmreport.model.diagnosis import Verdict
from zlmreport.model.report import verdict_statement
from zlmreport.quantities.notation import plain

#: Of a terminal, in letters: its width where it has none, what a table needs beside the names of
#: parameters, and how much of a name is always shown; what the column of uncertainties needs.
_USUAL_WIDTH, _OTHER_COLUMNS, _SHORTEST_NAME = 120, 44, 24
_UNCERTAINTY_COLUMN = 7


class Colour(Enum):
    """A colour, as a terminal is told to take it."""

    RED = "31"
    GREEN = "32"
    YELLOW = "33"
    BOLD = "1"

    def of(self, text: str) -> str:
        """Return a text in this colour where somebody sees it."""
        if not text or os.environ.get("NO_COLOR") or not sys.stdout.isatty():
            return text
        return f"\x1b[{self.value}m{text}\x1b[0m"


def report(result: Result) -> Iterator[str]:
    """Yield the lines on a finished job."""
    job = result.job
    if job is None or not result.evaluations:
        return
    scribe = Scribe.of(result.evaluations[0].measurements, Language.ENGLISH)
    yield f"{Colour.BOLD.of(job.keys.certificate.number)}  {_subject(job)}"
    for path in result.files:
        yield f"  {shown_path(path)}"
    for evaluation in result.evaluations:
        yield ""
        yield from _parameters(evaluation, scribe)
    yield from _notices(result, scribe)


def findings(result: Result) -> Iterator[str]:
    """Yield the lines on a checked job: each standard's requirements, met or not."""
    if not result.evaluations:
        return
    scribe = Scribe.of(result.evaluations[0].measurements, Language.ENGLISH)
    yield f"{Colour.BOLD.of(str(result.path))}  the job and its data are sound"
    for evaluation in result.evaluations:
        yield from requirements(evaluation.designation, evaluation.findings, scribe)
    yield from _missing(result, scribe)
    yield from _model(result)


def requirements(designation: str, found: Iterable[Finding], scribe: Scribe) -> Iterator[str]:
    """Yield the lines on what a standard asks of a test."""
    yield f"  {designation}"
    words = {True: "met", False: Colour.RED.of("not met"), None: Colour.YELLOW.of("open")}
    yield from table(
        (words[finding.met], f"{scribe.say(finding.requirement)}: {scribe.say(finding.found)}")
        for finding in found
    )


def table(rows: Iterable[Sequence[str]], right: Sequence[int] = (), indent: str = "    ") -> Iterator[str]:
    """Yield rows whose columns line up; `right` lists the columns that stand on their last letter."""
    rows = [tuple(row) for row in rows]
    widths = [max(map(_width, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = []
        for number, (cell, width) in enumerate(zip(row, widths, strict=True)):
            space = " " * (width - _width(cell))
            cells.append(space + cell if number in right else cell + space)
        yield indent + "  ".join(cells).rstrip()


def shown_path(path: Path) -> str:
    """Return a path as the user would type it: from the current folder, if it lies below that."""
    absolute = path.resolve()
    here = Path.cwd()
    return visible(str(absolute.relative_to(here) if absolute.is_relative_to(here) else absolute))


def _subject(job: Job) -> str:
    machine = job.keys.machine
    named = " ".join(part for part in (machine.manufacturer, machine.model) if part)
    serial = f"serial {machine.serial}" if machine.serial else ""
    return ", ".join(part for part in (f"axis {job.axis.name}", named, serial) if part)


def _parameters(evaluation: Evaluation, scribe: Scribe) -> Iterator[str]:
    has_limits = any(parameter.limit is not None for parameter in evaluation.parameters)
    has_uncertainty = any(parameter.expanded_uncertainty is not None for parameter in evaluation.parameters)
    other_columns = _OTHER_COLUMNS + (_UNCERTAINTY_COLUMN if has_uncertainty else 0)
    longest_name = max(_SHORTEST_NAME, shutil.get_terminal_size((_USUAL_WIDTH, 0)).columns - other_columns)
    names = [_shortened(scribe.say(each.quantity.name), longest_name) for each in evaluation.parameters]
    values = zip(
        *(_value(each, scribe, with_uncertainty=has_uncertainty) for each in evaluation.parameters),
        strict=True,
    )
    rows = zip(
        (plain(each.quantity.notation) for each in evaluation.parameters),
        names,
        *map(_on_the_point, values),
        (limit(each, scribe) if has_limits else "" for each in evaluation.parameters),
        (_verdict(each, scribe) for each in evaluation.parameters),
        strict=True,
    )
    unit = scribe.deviation_unit.symbol
    headings = ("", "", unit, *(["± U"] if has_uncertainty else []), "limit" if has_limits else "", "")
    first, *others = table([headings, *rows], right=range(2, len(headings) - 1))
    room = len(first) - len(first.lstrip()) - 1
    yield f"  {evaluation.designation}".ljust(room) + first[room:]
    yield from others


def _value(parameter: Parameter, scribe: Scribe, *, with_uncertainty: bool) -> tuple[str, ...]:
    """Return a value, and with its uncertainty both as the certificate prints them."""
    return written(parameter, scribe) if with_uncertainty else (scribe.deviation(parameter.printed_value),)


def _on_the_point(numbers: Sequence[str]) -> list[str]:
    """Return numbers that stand with their decimal points below each other when they end alike."""
    decimals = [len(number) - number.find(".") if "." in number else 0 for number in numbers]
    return [number + " " * (max(decimals) - own) for number, own in zip(numbers, decimals, strict=True)]


_COLOURS = {True: Colour.GREEN, False: Colour.RED, None: Colour.YELLOW}


def _verdict(parameter: Parameter, scribe: Scribe) -> str:
    if parameter.decision is None:
        return ""
    _, words = STATEMENTS[parameter.decision.conformity]
    return _COLOURS[parameter.conforms].of(scribe.say(words))


def _notices(result: Result, scribe: Scribe) -> Iterator[str]:
    notices = list(_missing(result, scribe))
    for evaluation in result.evaluations:
        notices.extend(
            f"  {Colour.YELLOW.of('not met')}  {evaluation.designation}: "
            f"{scribe.say(finding.requirement)}: {scribe.say(finding.found)}"
            for finding in evaluation.findings
            if finding.met is False
        )
    notices.extend(_model(result))
    if notices:
        yield ""
        yield from notices


def _missing(result: Result, scribe: Scribe) -> Iterator[str]:
    for notice in missing_readings(result.evaluations[0].measurements, scribe):
        yield f"  {Colour.YELLOW.of('missing')}  {notice.heading}"
        yield from (f"           {item}" for item in notice.items)
    for notice in exclusions.notice(result.evaluations[0].measurements, scribe):
        yield f"  {Colour.YELLOW.of('aside')}    {notice.heading}"
        yield from (f"           {item}" for item in notice.items)


def _model(result: Result) -> Iterator[str]:
    diagnosis = result.diagnosis
    if diagnosis is None:
        return
    label = (Colour.GREEN if diagnosis.verdict is Verdict.ADEQUATE else Colour.YELLOW).of("model")
    yield f"  {label}  {verdict_statement(diagnosis).in_language(Language.ENGLISH)}"
    if diagnosis.verdict is not Verdict.ADEQUATE:
        yield f"         see: zlmreport model diagnose {shown_path(result.path)}"


def _shortened(name: str, longest: int) -> str:
    """Return as much of a name as has room; its last part, a direction that the symbol shows, goes first."""
    if len(name) > longest:
        name = name.rsplit(", ", 1)[0]
    return name if len(name) <= longest else f"{name[: longest - 1].rstrip()}…"


def _width(cell: str) -> int:
    """Return how wide a cell is printed: colours and combining marks take no room."""
    width = 0
    in_colour = False
    for character in cell:
        if character == "\x1b":
            in_colour = True
        elif in_colour:
            in_colour = character != "m"
        elif not unicodedata.combining(character):
            width += 1
    return width
