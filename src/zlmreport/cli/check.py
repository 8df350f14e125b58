"""``zlmreport check``: whether jobs and their data are sound, and what their tests fall short of."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from zlmreport import pipeline
from zlmreport.cli.job_lines import findings
from zlmreport.cli.jobs import Result, do_all, load_all
from zlmreport.plugins import find_plugins

if TYPE_CHECKING:
    from zlmreport.job.job import Job


def run(options: Namespace) -> int:
    """Check all jobs and return the worst exit code; nothing is written."""
    registry = find_plugins(files=options.plugin)

    def evaluated(result: Result, job: Job) -> Result:
        if "instrument" in type(job.source.options).model_fields:
            from zlmreport.cli.capture import awaits_capture, demand_capturable  # noqa: PLC0415 - only for live readings

            if awaits_capture(job):
                demand_capturable(job, registry)
                return result
        certificate = pipeline.compose(job, registry)
        return replace(
            result,
            evaluations=certificate.evaluations,
            diagnosis=certificate.diagnosis,
            doubts=certificate.doubts,
            budget=certificate.budget,
        )

    def lines(result: Result) -> Iterator[str]:
        if result.job is None or result.evaluations:
            return findings(result)
        from zlmreport.cli.capture import planned  # noqa: PLC0415 - only for live readings

        return planned(result.path, result.job, registry)

    return do_all(load_all(options.jobs, registry), evaluated, lines, options)
