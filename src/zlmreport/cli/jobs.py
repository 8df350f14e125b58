"""Doing the same with every job of a command line, and what became of each: ``zlmreport/summary/1``."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from zlmreport.cli.terminal import print_json, print_problems, problem_values
from zlmreport.errors import InputError, ZlmreportError, as_problems
from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.version import __version__

if TYPE_CHECKING:
    from zlmreport.evaluation.evaluation import Evaluation
    from zlmreport.job.job import Job
    from zlmreport.language import Words
    from zlmreport.model.diagnosis import Diagnosis
    from zlmreport.plugins import Registry
    from zlmreport.uncertainty.budget import Budget, NoBudget

_NOT_MET = 1
SCHEMA = "zlmreport/summary/1"


def do_all(
    loaded: Sequence[Result],
    work: Callable[[Result, Job], Result],
    lines: Callable[[Result], Iterable[str]],
    options: Namespace,
    *,
    fail_on_nonconformity: bool = False,
) -> int:
    """Work on every job that has no mistake so far, and return the worst exit code.

    Parameters
    ----------
    loaded
        The jobs of the command line.
    work
        What is done with one.
    lines
        What people read of one that is done.
    options
        Of the command line: ``quiet`` and ``json``.
    fail_on_nonconformity
        Whether a limit that is not met counts as a failure.
    """
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
    """What became of a job.

    Attributes
    ----------
    path
        The job file, as the user named it.
    job
        The checked job; None if it is wrong.
    evaluations
        By each of its standards.
    diagnosis
        Of its error model; None where the job names none.
    doubts
        Values that seem to be in another unit, in sentences.
    budget
        Of the uncertainty; None where nothing was evaluated.
    files
        That were written.
    error
        What ended the work; None if nothing did.
    """

    path: Path
    job: Job | None = None
    evaluations: tuple[Evaluation, ...] = ()
    diagnosis: Diagnosis | None = None
    doubts: tuple[Words, ...] = ()
    budget: Budget | NoBudget | None = None
    files: tuple[Path, ...] = ()
    error: ZlmreportError | None = None

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
            "direction": "+" if reading.approach > 0 else "-",
            "run": reading.run,
        }
        for reading in measurements.missing()
    ]
