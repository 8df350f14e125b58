"""What became of each job of a command line, mistakes included."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from zlmreport.errors import InputError, ZlmreportError, as_problems
from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.model.diagnosis import Diagnosis
from zlmreport.plugins import Registry

_NOT_MET = 1


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
    files
        That were written.
    error
        What ended the work; None if nothing did.
    """

    path: Path
    job: Job | None = None
    evaluations: tuple[Evaluation, ...] = ()
    diagnosis: Diagnosis | None = None
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
