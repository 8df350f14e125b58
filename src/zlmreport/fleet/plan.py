"""What is due tonight, and why: decided from the ledger and the disk, before anything is made."""

from __future__ import annotations

import contextlib
import hashlib
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path

from zlmreport.errors import Place, Problem, ZlmreportError
from zlmreport.fleet.basis import (
    CertificateBasis,
    Disk,
    KnownFile,
    compute_sha256,
    is_intact,
    say_changes,
    write_path_in,
)
from zlmreport.fleet.ledger import Issued, Standing
from zlmreport.fleet.records import State
from zlmreport.job.extends import read_composition
from zlmreport.job.fleet import FleetFile, number_of
from zlmreport.job.tree import find_at, walk_scalars


class Due(Enum):
    """What a night is to do about a job."""

    NOTHING = "unchanged"
    CERTIFICATE = "certificate"
    #: Made, and then compared with what its number was issued with.
    COMPARISON = "comparison"
    REFUSAL = "refused"
    #: Stopped twice with the same inputs: not tried until they change.
    SET_ASIDE = "set aside"


@dataclass(frozen=True, slots=True)
class PlannedJob:
    """A job of tonight."""

    path: Path  #: The job file.
    job: str  #: The same, as the ledger names it.
    due: Due  #: What is to be done.
    why: str = ""  #: In words; empty if nothing is due.
    number: str = ""  #: Of its certificate, as far as it is known.
    issued: Issued | None = None  #: The certificate that has the number already.
    problems: tuple[Problem, ...] = ()  #: Why it is refused.


@dataclass(frozen=True, slots=True)
class Evening:
    """What is known before a night."""

    fleet: FleetFile  #: The fleet file.
    jobs: Sequence[Path]  #: Its job files.
    standings: Mapping[str, Standing]  #: What the ledger knows of jobs, by their paths.
    certificates: Mapping[str, Issued]  #: Every certificate that was issued, by its number.
    now: CertificateBasis  #: Programs, formats and defaults of tonight.

    def name_job(self, path: Path) -> str:
        """Return a job file as the ledger names it."""
        return write_path_in(self.fleet.path.parent, path)


def find_reasons(evening: Evening) -> Mapping[Path, str]:
    """Return why each job is due; nothing for one that is not. No job is read that is as it was."""
    sources, shelf = Disk(evening.fleet.path.parent), Disk(evening.fleet.output)
    return {
        path: _say_why(evening.standings.get(evening.name_job(path)), evening, sources, shelf)
        for path in evening.jobs
    }


def plan(evening: Evening, why: Mapping[Path, str]) -> tuple[PlannedJob, ...]:
    """Return every job with what is due about it, in the order of job files."""
    planned = [_plan_job(path, why[path], evening) for path in evening.jobs]
    return tuple(_refuse_shared_numbers(planned, evening))


_OF_ITS_OWN = "each certificate has one of its own"
_NOT_BY_CASE = f"{_OF_ITS_OWN}, and case alone makes no other"
#: What became of a job, before the day.
_ENDED = {
    State.MADE: "the ledger was made again on",
    State.DRAFT: "was a draft on",
    State.FAILED: "failed on",
    State.STOPPED: "was stopped on",
    State.SET_ASIDE: "was set aside on",
    State.VANISHED: "is there again; was gone on",
}


def _say_why(standing: Standing | None, evening: Evening, sources: Disk, shelf: Disk) -> str:
    """Say why a job is due; nothing if it is not."""
    if standing is None:
        return "new"
    if standing.basis is None:
        return f"{_ENDED[standing.state]} {_read_day(standing.night)}"
    found = list(say_changes(standing.basis, sources, evening.now))
    if found:
        return f"{'; '.join(found)} since {_read_day(standing.night)}"
    certificate = evening.certificates.get(standing.number)
    files = certificate.files if certificate and standing.state is State.MADE else standing.files
    return "; ".join(find_damage(evening.fleet.output, files, shelf))


def find_damage(folder: Path, files: Sequence[KnownFile], shelf: Disk) -> Iterator[str]:
    """Yield what has become of a certificate's own files."""
    for file in files:
        if not shelf.has(file):
            yield f"{file.path} is gone"
        elif not shelf.still_has(file) and not is_intact(folder / file.path, file):
            yield f"{file.path} is not as it was issued"


def _plan_job(path: Path, why: str, evening: Evening) -> PlannedJob:
    """Return what is due about a job, with what its number means."""
    job = evening.name_job(path)
    standing = evening.standings.get(job)
    if not why and standing:
        return PlannedJob(path, job, Due.NOTHING, number=standing.number)
    if standing and standing.state is State.SET_ASIDE and standing.digest == digest_inputs(path, evening):
        return PlannedJob(path, job, Due.SET_ASIDE, why, standing.number)
    try:
        number, place = number_of(path, evening.fleet.defaults)
    except ZlmreportError as error:
        return PlannedJob(path, job, Due.REFUSAL, why, problems=error.problems)
    issued = evening.certificates.get(number)
    if issued and issued.job != job:
        why = f"{why}; {number} was issued on {_read_day(issued.night)} for {issued.job}"
    planned = PlannedJob(path, job, Due.COMPARISON if issued else Due.CERTIFICATE, why, number, issued)
    refusal = _say_refusal(issued, evening) if issued else _say_twin(number, evening)
    return _refuse_job(planned, Problem(place, refusal)) if refusal else planned


def digest_inputs(path: Path, evening: Evening) -> str:
    """Return the digest of all that a job states and of every file that it names, with tonight's programs.

    It is formed without reading the job's data as data: what stopped a worker must not stop the night.
    """
    digest = hashlib.sha256(repr((sorted(evening.now.programs.items()), evening.now.defaults)).encode())
    try:
        composed = read_composition(path, defaults=evening.fleet.defaults)
    except ZlmreportError as error:
        digest.update(str(error).encode())
        return digest.hexdigest()
    for file in composed.files:
        digest.update(file.sha256.encode())
    templates = find_at(composed.keys, ("certificate", "style", "templates"))
    for scalar in walk_scalars(composed.keys):
        named = Path(scalar.place.file).parent / scalar.text
        with contextlib.suppress(OSError, ValueError):
            if named.is_file() or scalar is templates:
                digest.update(compute_sha256(named).encode())
    return digest.hexdigest()


def _say_refusal(issued: Issued, evening: Evening) -> str:
    """Say why nothing is made under the number of a certificate; nothing if there is no reason."""
    if issued.fleet != evening.fleet.name:
        return f"its number was issued for {issued.job} of the fleet {issued.fleet!r}"
    for file in issued.files:
        path = evening.fleet.output / file.path
        if path.is_file() and not is_intact(path, file):
            return (
                f"{path} is not as it was issued on {_read_day(issued.night)}; move it away, "
                "and the next night restores it"
            )
    return ""


def _say_twin(number: str, evening: Evening) -> str:
    """Say that a number was issued in other letters: the files of both are one where case is ignored."""
    for taken, issued in evening.certificates.items():
        if taken.casefold() == number.casefold():
            return (
                f"the number {number} differs in case alone from {taken}, which was issued on "
                f"{_read_day(issued.night)} for {issued.job}; {_NOT_BY_CASE}"
            )
    return ""


def _refuse_shared_numbers(planned: Sequence[PlannedJob], evening: Evening) -> Iterator[PlannedJob]:
    """Yield the jobs, refusing those that have another's number; the one issued with it keeps it."""
    by_number: dict[str, list[PlannedJob]] = defaultdict(list)
    for each in planned:
        by_number[each.number.casefold()].append(each)
    for each in planned:
        others = [other for other in by_number[each.number.casefold()] if other is not each]
        if not each.number or not others or _is_rightly_held(each) or each.due is Due.REFUSAL:
            yield each
            continue
        place, *places = (_number_place(one.path, evening.fleet) for one in (each, *others))
        named = [
            str(where) if other.number == each.number else f"{where} (as {other.number})"
            for other, where in zip(others, places, strict=True)
        ]
        is_by_case = any(other.number != each.number for other in others)
        message = (
            f"the number {each.number} stands in {', '.join(named)} too; "
            f"{_NOT_BY_CASE if is_by_case else _OF_ITS_OWN}"
        )
        yield _refuse_job(each, Problem(place, message))


def _number_place(path: Path, fleet: FleetFile) -> Place:
    """Return where a job has its number; of one that cannot be read any more, the file."""
    try:
        _, place = number_of(path, fleet.defaults)
    except ZlmreportError:
        return Place(str(path))
    return place


def _refuse_job(planned: PlannedJob, problem: Problem) -> PlannedJob:
    return replace(planned, due=Due.REFUSAL, problems=(problem,))


def _is_rightly_held(each: PlannedJob) -> bool:
    """Whether a number is rightly this job's, whoever else states it."""
    return each.due is Due.NOTHING or (each.issued is not None and each.issued.job == each.job)


def _read_day(night: str) -> str:
    return night[:10]
