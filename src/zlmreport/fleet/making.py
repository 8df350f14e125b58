"""Makes one certificate in a worker, as bytes and as the ledger's entry; its limits, drafts.

This is what runs in a worker: a process of this machine, or of another.
"""

from __future__ import annotations

import functools
import hashlib
import threading
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePosixPath
from typing import Any

from zlmreport import pipeline
from zlmreport.document.certificate.document import Certificate
from zlmreport.errors import InputError, Place, Problem, as_problems
from zlmreport.evaluation import traceability
from zlmreport.evaluation.evaluation import judge_together
from zlmreport.files import confine as confined
from zlmreport.fleet.basis import (
    CertificateBasis,
    digest_named_files,
    find_program_versions,
    list_files_behind,
    name_programs_of,
    release,
)
from zlmreport.fleet.records import RecordedParameter, Subject, find_folder_of, list_parameters_of
from zlmreport.job.fleet import FleetFile, load_fleet
from zlmreport.job.job import Job
from zlmreport.job.loading import choose_formats_once, load
from zlmreport.language import Words
from zlmreport.model.effects.effect import Effect
from zlmreport.plugin.protocols import Renderer
from zlmreport.plugin.registry import Registry, find_plugins

#: The longest time between two signs of life of a night, s.
BEAT = 5.0
#: Before the suffix of a draft's file.
MARK = ".draft"

_TITLE = Words("Draft, not issued: {title}")


def _make_draft(certificate: Certificate) -> Certificate:
    """Return a certificate as a draft: its number stands already for a document with another content."""

    def marked(title: str) -> str:
        return _TITLE.given(title=title).in_language(certificate.language)

    words = certificate.page_words
    return replace(
        certificate,
        title=marked(certificate.title),
        page_words=replace(words, number=marked(words.number)),
    )


@dataclass(frozen=True, slots=True)
class Limits:
    """What a job may take: time, s, and memory for its data, MB."""

    seconds: float
    megabytes: int


@dataclass(frozen=True, slots=True)
class Task:
    """A certificate that is to be made."""

    #: fleet and content: The fleet file as it was read when the night began.
    fleet: Path
    content: bytes
    job: Path  #: The job file.
    #: Digests of the files of the certificate that has this number already, by their suffixes; empty if none
    #: has it.
    issued: Mapping[str, str]
    folder: str  #: Where these are, relative to the folder of certificates.
    plugins: tuple[Path, ...]  #: Plugins in files of their own.
    programs: Mapping[str, str]  #: Versions of the program and of all plugins, as the night began with them.
    limits: Limits  #: What it may take.
    #: What the certificate states that has this number, where nothing but programs changed since; else None.
    stated: tuple[RecordedParameter, ...] | None = None
    confine: Path | None = None  #: The folder outside of which nothing is read or written; None without one.


@dataclass(frozen=True, slots=True)
class FinishedFile:
    """A file that is to be on the disk."""

    role: str  #: Suffix of its format: ``.pdf``.
    path: str  #: Relative to the folder of certificates.
    content: bytes  #: Its bytes.

    @property
    def sha256(self) -> str:
        """Digest of its bytes, hexadecimal."""
        return hashlib.sha256(self.content).hexdigest()


@dataclass(frozen=True, slots=True)
class MadeCertificate:
    """A certificate, or its draft."""

    subject: Subject  #: What it is about.
    basis: CertificateBasis  #: What it was made from.
    files: tuple[FinishedFile, ...]
    parameters: tuple[RecordedParameter, ...]  #: What it states.
    is_draft: bool  #: Whether its number was issued with another content.
    seconds: float = 0.0  #: How long it took.
    #: What its readings teach other tests, for the ledger; None without a model that describes them.
    lesson: Mapping[str, Any] | None = None
    conforms: bool | None = None  #: Whether every stated limit is met; None where nothing is decided on one.
    #: Sentences on values in an unlikely unit, and on what its readings show to be wrong.
    doubts: tuple[Words, ...] = ()


@dataclass(frozen=True, slots=True)
class Failed:
    """A job that came to nothing, and why; one that is stopped exceeded a limit, or ended its worker."""

    problems: tuple[Problem, ...]
    subject: Subject = field(default_factory=Subject)
    is_stopped: bool = False


def report_late(task: Task) -> Failed:
    """Return the answer of a task that was stopped because its time was over."""
    message = f"was stopped: it was not made within {task.limits.seconds:g} s, the limit of a job"
    return Failed((Problem(Place(str(task.job)), message),), is_stopped=True)


#: A worker of Dask may have several threads, and no library that lays out pages has been asked about that.
_ONE_AT_A_TIME = threading.Lock()


def make_certificate(task: Task) -> MadeCertificate | Failed:
    """Make a certificate; whatever goes wrong is the answer and no exception."""
    with _ONE_AT_A_TIME, confined(task.confine):
        subject = Subject()
        try:
            begun, start = time.time(), time.monotonic()
            registry = find_plugins_once(task.plugins)
            fleet = _read_fleet(task.fleet, task.content, task.plugins)
            job = load(
                task.job, registry, choose_formats_once(fleet.formats, registry), defaults=fleet.defaults
            )
            subject = Subject.of(job)
            return replace(_make(task, job, fleet, begun), seconds=time.monotonic() - start)
        except MemoryError:
            message = f"was stopped: it needs more than {task.limits.megabytes} MB, the limit of a job"
            return Failed((Problem(Place(str(task.job)), message),), subject, is_stopped=True)
        except Exception as error:  # noqa: BLE001 - one job's trouble must not take the others along
            return Failed(as_problems(task.job, error).problems, subject)


def warm(plugins: tuple[Path, ...]) -> None:
    """Load the plugins, so that the first certificate need not."""
    find_plugins_once(plugins)


def _make(task: Task, job: Job, fleet: FleetFile, begun: float) -> MadeCertificate:
    registry = find_plugins_once(task.plugins)
    programs = _find_programs(task, job, registry)
    named = digest_named_files(job)
    renderers = [registry.renderer(identifier) for identifier in job.formats]
    _demand_one_of_a_suffix(task.job, renderers)
    outcome = pipeline.run(job, registry)
    certificate = outcome.certificate
    suffixes = [each.suffix for each in renderers]
    contents = [each.content for each in outcome.documents]
    folder = PurePosixPath(task.folder or find_folder_of(job.keys, fleet.keys.output.layout))
    # Files that have the number already, though no ledger may know them.
    paths = {suffix: fleet.output / folder / f"{certificate.number}{suffix}" for suffix in suffixes}
    there = {suffix: path.read_bytes() for suffix, path in paths.items() if path.is_file()}
    digests = {suffix: _compute_digest(content) for suffix, content in there.items()}
    issued = {**digests, **task.issued}
    is_draft = any(
        issued.get(suffix, digest) != digest
        for suffix, digest in zip(suffixes, map(_compute_digest, contents), strict=True)
    )
    parameters = tuple(list_parameters_of(certificate))
    is_whole = all(task.issued.get(suffix, "") == digests.get(suffix) for suffix in suffixes)
    if is_draft and is_whole and task.stated is not None and _are_alike(task.stated, parameters):
        is_draft, contents = False, [there[suffix] for suffix in suffixes]
    if is_draft:
        rendered = pipeline.render(_make_draft(certificate), renderers, registry)
        contents = [rendered[each.identifier] for each in renderers]
    stem = certificate.number + (MARK if is_draft else "")
    files = tuple(list_files_behind(certificate, named, job, fleet, begun))
    return MadeCertificate(
        subject=Subject.of(job),
        basis=CertificateBasis(files, programs, job.formats, digest_defaults(fleet)),
        files=tuple(
            FinishedFile(suffix, str(folder / f"{stem}{suffix}"), content)
            for suffix, content in zip(suffixes, contents, strict=True)
        ),
        parameters=parameters,
        is_draft=is_draft,
        lesson=None if is_draft else _find_lesson(certificate, job, registry.effects),
        conforms=judge_together(certificate.evaluations),
        doubts=tuple(_list_doubts(certificate, job)),
    )


def _list_doubts(certificate: Certificate, job: Job) -> Iterator[Words]:
    """Yield what is doubtful about the values of a certificate.

    What is open of calibrations is so every night; the certificate says it.
    """
    tests = (each.measurements for each in certificate.evaluations)
    known = [doubt for each in tests for doubt in traceability.find_doubts(job, each)]
    yield from certificate.doubts
    yield from (each for each in certificate.evidence if each not in known)


def _demand_one_of_a_suffix(job: Path, renderers: Sequence[Renderer]) -> None:
    """Refuse formats of one suffix: the ledger knows the files of a certificate by theirs."""
    known: dict[str, str] = {}
    for each in renderers:
        other = known.setdefault(each.suffix, each.identifier)
        if other != each.identifier:
            raise InputError.at(
                Place(str(job)),
                f"a fleet keeps one {each.suffix} file of a certificate; choose {other} or {each.identifier} "
                "(output.formats)",
            )


def _find_lesson(certificate: Certificate, job: Job, effects: Sequence[Effect]) -> Mapping[str, Any] | None:
    """Return what the readings of a certificate teach; None without a model that describes them.

    A job that knows of earlier tests, or of further ones, is diagnosed once more without them: each test
    teaches by its own readings, or what one taught would come back with the next.
    """
    diagnosis = certificate.diagnosis
    if diagnosis is None:
        return None
    from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict  # noqa: PLC0415 - only where there is a model
    from zlmreport.model.diagnosis.study import Study  # noqa: PLC0415
    from zlmreport.model.fitting.priors import Lesson  # noqa: PLC0415

    if job.sessions or job.priors:
        alone = replace(job, sessions=(), priors=None)
        diagnosis = Study.of(alone, certificate.measurements, effects).diagnose(effects)
    return Lesson.of(diagnosis.fit).as_json() if diagnosis.verdict is DiagnosisVerdict.ADEQUATE else None


def _are_alike(before: Iterable[RecordedParameter], now: Iterable[RecordedParameter]) -> bool:
    """Whether two certificates state the same values, to the rounding of doubles."""
    return sorted(map(_round_parameter, before)) == sorted(map(_round_parameter, now))


def _round_parameter(parameter: RecordedParameter) -> str:
    numbers = (parameter.value, parameter.expanded_uncertainty, parameter.limit)
    shown = ("" if number is None else f"{number:.9g}" for number in numbers)
    return repr((parameter.standard, parameter.symbol, parameter.unit, *shown, parameter.conforms))


def digest_defaults(fleet: FleetFile) -> str:
    """Return the digest of a fleet's defaults; empty without any."""
    return _compute_digest(fleet.defaults.as_yaml().encode()) if fleet.defaults else ""


def _compute_digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def _find_programs(task: Task, job: Job, registry: Registry) -> dict[str, str]:
    """Return the versions of what takes part; refuse to work with other releases than the night's."""
    here = find_versions_once(task.plugins)
    names = sorted(name_programs_of(job, job.formats, registry))
    for name in names:
        own, begun_with = (release(each.get(name, "")) for each in (here, task.programs))
        if own != begun_with:
            raise InputError.at(
                Place(str(task.job)),
                f"this worker has {name} {own}, and the night began with {begun_with}; install the same "
                "version everywhere",
            )
    return {name: task.programs[name] for name in names}


@functools.cache
def find_plugins_once(plugins: tuple[Path, ...]) -> Registry:
    """Return the plugins, with those in files of their own: a worker finds them once."""
    return find_plugins(files=plugins)


@functools.cache
def find_versions_once(plugins: tuple[Path, ...]) -> Mapping[str, str]:
    """Return the versions of the program and of its plugins; these do not change under a worker."""
    return find_program_versions(files=plugins)


@functools.lru_cache(maxsize=4)
def _read_fleet(path: Path, content: bytes, plugins: tuple[Path, ...]) -> FleetFile:
    return load_fleet(path, content, lambda: find_plugins_once(plugins).extensions)
