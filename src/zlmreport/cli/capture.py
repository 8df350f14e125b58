"""``zlmreport capture``: readings from a live instrument, along the plan, into a journal."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace
from pathlib import Path

from zlmreport.capture.events import Ended
from zlmreport.capture.journal import Journal
from zlmreport.capture.of_job import Assignment, options_of
from zlmreport.cli import capture_probing
from zlmreport.cli.capture_awaited import assignment
from zlmreport.cli.capture_display import JsonLines, LiveDisplay, PlainLines, is_watched
from zlmreport.cli.capture_sitting import capture, demand_own_journal
from zlmreport.cli.terminal import shown_path
from zlmreport.errors import InputError, Place
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.plugins import find_plugins
from zlmreport.probing.run import live_probing


def run(options: Namespace) -> int:
    """Capture the test of a job, go on with it, or close it."""
    if options.end and options.resume:
        raise InputError.at(
            Place("zlmreport capture"), "--resume goes on and --end closes the capture: take one of them"
        )
    if options.answer and not options.resume:
        raise InputError.at(Place("zlmreport capture"), "--answer belongs to --resume: state both")
    registry = find_plugins(files=options.plugin)
    job = load(options.job, registry)
    live = live_probing(job)
    if live is not None:
        return capture_probing.run(live, options)
    if options.journal:
        job = _with_journal(job, options.journal)
    asked = assignment(job, registry)
    if options.end:
        _close(job, asked, options.job)
        return 0
    shown = JsonLines if options.json else LiveDisplay if is_watched() else PlainLines
    display = shown(job, asked)
    capture(job, asked, registry, display, options.job, resume=options.resume, answer=options.answer)
    if not options.json:
        print(f"next: zlmreport {shown_path(options.job)}")
    return 0


def _with_journal(job: Job, journal: Path) -> Job:
    """Return a job with another journal; the data source says later if it has none."""
    options = options_of(job)
    if options is None:
        return job
    named = options.model_copy(update={"journal": journal})
    return replace(job, source=replace(job.source, options=named))


def _close(job: Job, asked: Assignment, path: Path) -> None:
    """Close the journal of a job; its instrument is not needed for that."""
    demand_own_journal(job, asked)
    with Journal.continued(asked.options.journal) as journal:
        taken, visits = journal.progress.taken, len(journal.progress.visits)
        journal.append(Ended(), journal.elapsed)
    print(f"closed after {taken} of {visits} visits; what was not taken is missing")
    print(f"next: zlmreport {shown_path(path)}")
