"""Jobs whose readings are still to be captured: for the commands that need readings."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from zlmreport import pipeline
from zlmreport.capture.history import History, read_history
from zlmreport.capture.of_job import Assignment, assignment_of, instrument_of, options_of
from zlmreport.certificate.clauses import demand_mandatory_items
from zlmreport.cli.capture_display import LiveDisplay, is_watched
from zlmreport.cli.capture_sitting import capture
from zlmreport.cli.job_lines import requirements
from zlmreport.cli.terminal import Colour, shown_path
from zlmreport.job.job import Job
from zlmreport.language import Language
from zlmreport.planning.plan import as_measured, propose
from zlmreport.plugins import Registry
from zlmreport.presenting.writer import Writer


def assignment(job: Job, registry: Registry) -> Assignment:
    """Return what a job asks to be captured; raise `InputError` if it is nothing, or makes no sense."""
    return assignment_of(job, propose(job, pipeline.standards(job, registry)).plan)


def awaits_capture(job: Job) -> bool:
    """Tell whether the readings of a job are captured live, and are not all there yet."""
    if options_of(job) is None:
        return False
    history = _history(job)
    return history is None or not history.progress.is_over


def demand_capturable(job: Job, registry: Registry) -> None:
    """Refuse a job whose certificate would lack something, or whose capture makes no sense."""
    demand_mandatory_items(job)
    assignment(job, registry)
    instrument_of(job)


def planned(path: Path, job: Job, registry: Registry) -> Iterator[str]:
    """Yield the lines on a job that awaits its capture: what its standards ask of the test as planned."""
    plan = assignment(job, registry).plan
    test = as_measured(job.axis, plan.method, plan.targets, plan.runs)
    writer = Writer.of(test, Language.ENGLISH)
    yield f"{Colour.BOLD.of(str(path))}  the job is sound; its readings are still to be captured"
    for standard, options in pipeline.standards(job, registry):
        yield from requirements(standard.designation, standard.requirements(test, options), writer)
    yield f"  next: zlmreport capture {shown_path(path)}{' --resume' if _has_begun(job) else ''}"


def capture_if_watched(job: Job, registry: Registry, path: Path) -> None:
    """Capture what a job awaits if somebody sits at the terminal; if not, its data source says what to do."""
    if not is_watched() or job.source.instrument is None or not awaits_capture(job):
        return
    asked = assignment(job, registry)
    capture(job, asked, registry, LiveDisplay(job, asked), path, resume=_has_begun(job))


def _has_begun(job: Job) -> bool:
    history = _history(job)
    return history is not None and history.has_readings


def _history(job: Job) -> History | None:
    """Return what was captured so far; None for nothing."""
    options = options_of(job)
    if options is None or not options.journal.exists():
        return None
    return read_history(options.journal)
