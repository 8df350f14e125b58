"""``zlmreport check``: whether jobs and their data are sound, and what their tests fall short of."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from dataclasses import replace

from zlmreport import pipeline
from zlmreport.cli.capture import awaits_capture, demand_capturable, planned
from zlmreport.cli.job_lines import findings
from zlmreport.cli.jobs import Result, do_all, load_all
from zlmreport.job.job import Job
from zlmreport.plugins import find_plugins


def run(options: Namespace) -> int:
    """Check all jobs and return the worst exit code; nothing is written."""
    registry = find_plugins(files=options.plugin)

    def evaluated(result: Result, job: Job) -> Result:
        if awaits_capture(job):
            demand_capturable(job, registry)
            return result
        certificate = pipeline.compose(job, registry)
        return replace(result, evaluations=certificate.evaluations, diagnosis=certificate.diagnosis)

    def lines(result: Result) -> Iterator[str]:
        if result.job is None or result.evaluations:
            return findings(result)
        return planned(result.path, result.job, registry)

    return do_all(load_all(options.jobs, registry), evaluated, lines, options)
