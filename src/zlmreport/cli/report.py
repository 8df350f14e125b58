"""The main job: from job files to certificates."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace

from zlmreport import pipeline
from zlmreport.cli.capture_awaited import capture_if_watched
from zlmreport.cli.job_lines import report
from zlmreport.cli.jobs import do_all
from zlmreport.cli.results import Result, load_all
from zlmreport.cli.signature import demand_something_to_sign, signer_of
from zlmreport.errors import Place
from zlmreport.files import write
from zlmreport.job.job import Job
from zlmreport.job.loading import chosen_formats
from zlmreport.plugins import Registry, find_plugins
from zlmreport.signing.signer import Signer


def run(options: Namespace) -> int:
    """Make the certificates of all jobs and return the worst exit code."""
    registry = find_plugins(files=options.plugin)
    formats = _formats(options.format, registry)
    with signer_of(options) as signer:
        return _make(options, registry, formats, signer)


def _make(options: Namespace, registry: Registry, formats: tuple[str, ...], signer: Signer | None) -> int:
    def made(result: Result, job: Job) -> Result:
        if signer:
            demand_something_to_sign(job, registry)
        if not (options.quiet or options.json):
            capture_if_watched(job, registry, result.path)
        outcome = pipeline.run(job, registry, signer)
        files = write(outcome.documents)
        made = outcome.certificate
        return replace(result, evaluations=made.evaluations, diagnosis=made.diagnosis, files=files)

    loaded = [
        replace(result, job=replace(result.job, directory=options.output))
        if result.job and options.output
        else result
        for result in load_all(options.jobs, registry, formats)
    ]
    return do_all(loaded, made, report, options, fail_on_nonconformity=options.fail_on_nonconformity)


def _formats(named: str | None, registry: Registry) -> tuple[str, ...]:
    """Return the formats that the command line names, instead of those of the jobs."""
    if named is None:
        return ()
    place = Place("zlmreport --format")
    return chosen_formats([(name.strip(), place) for name in named.split(",")], registry)
