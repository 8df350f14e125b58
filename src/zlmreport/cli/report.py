"""``zlmreport JOB.yaml``: makes certificates, asks for the password; ``check``: no files, fewer trials."""

from __future__ import annotations

import os
import sys
from argparse import Namespace
from collections.abc import Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from zlmreport.cli.arguments.documents import SIGN_PASSWORD
from zlmreport.cli.jobs import JobResult, do_all, load_all, tell_findings, tell_result
from zlmreport.cli.terminal import show_progress
from zlmreport.errors import InputError, Place
from zlmreport.evaluation.uncertainty.monte_carlo import TRIALS
from zlmreport.files import write
from zlmreport.job.days import demand_days_past
from zlmreport.job.loading import choose_formats_once
from zlmreport.pipeline import PDF, Showing, compose, run as make_documents
from zlmreport.plugin.registry import Registry, find_plugins

if TYPE_CHECKING:
    from zlmreport.document.signing.signer import Signer
    from zlmreport.job.job import Job


_PLACE = Place("zlmreport --sign")
#: Tests that `check` simulates: it composes the document for what may be wrong with it, and prints no U.
_FEW_TRIALS = 200


def run(options: Namespace) -> int:
    """Make the certificates of all jobs and return the worst exit code."""
    registry = find_plugins(files=options.plugin)
    formats = _choose_formats(options.format, registry)
    with open_signer_of(options) as signer:
        return _make(options, registry, formats, signer)


def _make(options: Namespace, registry: Registry, formats: tuple[str, ...], signer: Signer | None) -> int:
    def make_job(result: JobResult, job: Job) -> JobResult:
        if signer:
            _demand_something_to_sign(job, registry)
        if job.source.instrument and not (options.quiet or options.json):
            from zlmreport.cli.capture import capture_if_watched  # noqa: PLC0415 - only for live readings

            capture_if_watched(job, registry, result.path)
        outcome = make_documents(job, registry, signer, _make_showing(options))
        files = write(outcome.documents)
        made = outcome.certificate
        return replace(
            result,
            evaluations=made.evaluations,
            diagnosis=made.diagnosis,
            doubts=made.doubts,
            evidence=made.evidence,
            budget=made.budget,
            files=files,
        )

    loaded = [
        replace(result, job=replace(result.job, directory=options.output))
        if result.job and options.output
        else result
        for result in load_all(options.jobs, registry, formats)
    ]
    return do_all(loaded, make_job, tell_result, options, fail_on_nonconformity=options.fail_on_nonconformity)


def _make_showing(options: Namespace) -> Showing:
    """Return what shows how far a diagnosis is: nothing where nothing is to be printed."""
    return partial(show_progress, is_wanted=not options.quiet)


def _choose_formats(named: str | None, registry: Registry) -> tuple[str, ...]:
    """Return the formats that the command line names, instead of those of the jobs."""
    if named is None:
        return ()
    place = Place("zlmreport --format")
    return choose_formats_once([(name.strip(), place) for name in named.split(",")], registry)


def open_signer_of(options: Namespace) -> AbstractContextManager[Signer | None]:
    """Return who signs, if anybody is asked to."""
    if not options.sign:
        return nullcontext()
    from zlmreport.document.signing.signer import open_signer  # noqa: PLC0415 - only to sign
    from zlmreport.document.signing.state import find_trusted_by_user, read_trusted_certificates  # noqa: PLC0415

    named = find_trusted_by_user()
    return open_signer(
        options.sign, _ask_password, _PLACE, read_trusted_certificates(named, _PLACE) if named else ()
    )


def _demand_something_to_sign(job: Job, registry: Registry) -> None:
    """Refuse a job that writes no PDF, rather than leave its user to believe that it is signed."""
    if not any(registry.renderer(identifier).suffix == PDF for identifier in job.formats):
        raise InputError.at(
            job.place_of("output.formats"),
            f"there is nothing to sign: {', '.join(job.formats)} is no PDF; add pdf to the formats",
        )


def _ask_password(of: str) -> str:
    stated = os.environ.get(SIGN_PASSWORD)
    if stated is not None:
        return stated
    if not sys.stdin.isatty():
        raise InputError.at(
            _PLACE,
            f"the password of {of} is asked for at a terminal or stands in {SIGN_PASSWORD}: here is neither",
        )
    from getpass import getpass  # noqa: PLC0415 - only at a terminal

    return getpass(f"Password of {of}: ", stream=sys.stderr)


def check(options: Namespace) -> int:
    """Check all jobs and return the worst exit code; nothing is written."""
    registry = find_plugins(files=options.plugin)
    trials = TRIALS if options.json else _FEW_TRIALS

    def evaluate_job(result: JobResult, job: Job) -> JobResult:
        if "instrument" in type(job.source.options).model_fields:
            from zlmreport.cli.capture import awaits_capture, demand_capturable  # noqa: PLC0415 - only for live readings

            if awaits_capture(job):
                demand_capturable(job, registry)
                return result
        demand_days_past(job)
        certificate = compose(job, registry, showing=_make_showing(options), trials=trials)
        return replace(
            result,
            evaluations=certificate.evaluations,
            diagnosis=certificate.diagnosis,
            doubts=certificate.doubts,
            evidence=certificate.evidence,
            budget=certificate.budget,
        )

    def tell_job(result: JobResult) -> Iterator[str]:
        if result.job is None or result.evaluations:
            return tell_findings(result)
        from zlmreport.cli.capture import tell_planned  # noqa: PLC0415 - only for live readings

        return tell_planned(result.path, result.job, registry)

    return do_all(load_all(options.jobs, registry), evaluate_job, tell_job, options)
