"""``zlmreport check``: whether jobs and their data are sound, and what their tests fall short of."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace

from zlmreport import pipeline
from zlmreport.cli.jobs import do_all
from zlmreport.cli.results import Result, load_all
from zlmreport.cli.terminal import findings
from zlmreport.job.job import Job
from zlmreport.plugins import find_plugins


def run(options: Namespace) -> int:
    """Check all jobs and return the worst exit code; nothing is written."""
    registry = find_plugins(files=options.plugin)

    def evaluated(result: Result, job: Job) -> Result:
        certificate = pipeline.compose(job, registry)
        return replace(result, evaluations=certificate.evaluations, diagnosis=certificate.diagnosis)

    return do_all(load_all(options.jobs, registry), evaluated, findings, options)
