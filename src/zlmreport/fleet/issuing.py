"""Puts results into files and ledger: what stopped twice is set aside, nothing that is issued is replaced.

A file is written under a hidden name and pushed to the disk; then the ledger takes it over; then it gets its
name. Whenever the program ends in between, the next night finds the hidden file, and the ledger says
whether it is to have its name or never was issued.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from enum import Enum
from pathlib import Path

from zlmreport.errors import Place, Problem, as_problems
from zlmreport.files import take_names, write_beside
from zlmreport.fleet.basis import FileStamp, KnownFile, compute_sha256
from zlmreport.fleet.ledger import Night, NumberTakenError
from zlmreport.fleet.making import Failed, FinishedFile, MadeCertificate
from zlmreport.fleet.plan import Evening, PlannedJob, digest_inputs
from zlmreport.fleet.records import LedgerEntry, State, Subject
from zlmreport.job.fleet import FleetFile
from zlmreport.language import Words

#: Of a file that the ledger has not taken over yet.
_SUFFIX = ".zlmreport-new"


@dataclass(frozen=True, slots=True)
class Laid:
    """Files that are on the disk under hidden names."""

    names: Mapping[Path, Path]  #: The hidden file of each, by the file that it becomes.
    known: tuple[KnownFile, ...]  #: What the ledger keeps of them.

    def name_files(self) -> None:
        """Give the files their names."""
        take_names(self.names)


@contextlib.contextmanager
def lay(folder: Path, files: Iterable[FinishedFile]) -> Iterator[Laid]:
    """Write files under hidden names, and push them to the disk; what gets no name within is removed.

    Raises `OSError` if one cannot be written.
    """
    files = tuple(files)
    digests = {folder / file.path: file.sha256 for file in files}

    def hidden(path: Path) -> Path:
        return path.with_name(f".{path.name}.{digests[path][:16]}{_SUFFIX}")

    with write_beside({folder / file.path: file.content for file in files}, hidden) as names:
        known = [
            KnownFile(file.role, file.path, file.sha256, FileStamp.at(names[folder / file.path]))
            for file in files
        ]
        yield Laid(names, tuple(known))


def tidy(folder: Path, known: Iterable[KnownFile]) -> int:
    """End what an interrupted night left half done, and return the number of files that got their names."""
    digests = {file.path: file.sha256 for file in known}
    named = 0
    for hidden in _list_hidden(folder):
        name, _, begin = hidden.name.removesuffix(_SUFFIX)[1:].rpartition(".")
        path = hidden.with_name(name)
        sha256 = digests.get(str(path.relative_to(folder)), "")
        if sha256.startswith(begin) and compute_sha256(hidden) == sha256:
            hidden.replace(path)
            named += 1
        else:
            hidden.unlink()
    return named


def _list_hidden(folder: Path) -> Iterator[Path]:
    for root, _, files in os.walk(folder):
        yield from (Path(root, name) for name in sorted(files) if name.endswith(_SUFFIX))


_ASIDE = "; it is set aside until the job, a file that it names, or a program changes"
_GONE = "the job is gone; put it back, or name it under retired in the fleet file"
_RENAMED = "the job is gone, and {heir} has its number {number}; name the old one under retired"
_RENUMBERED = "its number was {before} when the night began, and was changed since; the next night makes it"
_UNKNOWN = "a file of this number with another content is there, and the ledger does not know it"


class What(Enum):
    """What happened to a job in a night."""

    UNCHANGED = "unchanged"
    ISSUED = "issued"
    #: Issued earlier; files that were gone are there again.
    RESTORED = "restored"
    #: Made anew, and nothing in it differs from what was issued.
    CONFIRMED = "confirmed"
    DRAFT = "draft"
    FAILED = "failed"
    #: Stopped again in an earlier night, and nothing about it has changed.
    SET_ASIDE = "set aside"
    #: The ledger knows it, and its file is gone.
    VANISHED = "vanished"
    #: The night's time was over before it.
    LEFT = "left"
    #: Its axis should have been measured again; said once.
    OVERDUE = "overdue"


@dataclass(frozen=True, slots=True)
class Happened:
    """What happened to a job in a night."""

    what: What  #: In a word.
    #: job and number: As the ledger has them.
    job: str
    number: str
    why: str = ""  #: Why it was due.
    files: tuple[str, ...] = ()  #: That were written, relative to the folder of certificates.
    problems: tuple[Problem, ...] = ()  #: Why it failed.
    #: Whether every stated limit is met; None without limits, where one is not decided, or not looked at.
    conforms: bool | None = None
    doubts: tuple[Words, ...] = ()  #: Sentences on what it leaves doubtful.
    #: Whether it was made again for new programs alone, and states the same values: that is counted, and no
    #: news.
    is_upgrade: bool = False


@dataclass(frozen=True, slots=True)
class Desk:
    """Where results become files and entries."""

    known: Evening
    night: Night

    @property
    def fleet(self) -> FleetFile:
        """The fleet file."""
        return self.known.fleet

    def keep(self, planned: PlannedJob, result: MadeCertificate | Failed) -> Happened:
        """Keep what a job came to."""
        if isinstance(result, Failed):
            return self.note_failure(planned, result)
        if result.subject.number != planned.number:  # what was refused, or allowed, was the number before
            problem = Problem(Place(str(planned.path)), _RENUMBERED.format(before=planned.number))
            return self.note_failure(planned, Failed((problem,), result.subject))
        try:
            return self._keep_draft(planned, result) if result.is_draft else self._issue(planned, result)
        except NumberTakenError as error:
            problem = Problem(Place(str(planned.path)), f"{error} tonight")
            return self.note_failure(planned, Failed((problem,), result.subject))
        except OSError as error:
            return self.note_failure(
                planned, Failed(as_problems(planned.path, error).problems, result.subject)
            )

    def note_failure(self, planned: PlannedJob, result: Failed) -> Happened:
        """Note that a job came to nothing."""
        subject = replace(result.subject, number=result.subject.number or planned.number)
        message = "\n".join(map(str, result.problems))
        state, hint, digest = State.FAILED, "", ""
        if result.is_stopped:
            before, digest = self.known.standings.get(planned.job), digest_inputs(planned.path, self.known)
            is_again = before and before.state in {State.STOPPED, State.SET_ASIDE} and before.digest == digest
            state, hint = (State.SET_ASIDE, _ASIDE) if is_again else (State.STOPPED, "")
        self.night.add(replace(self._make_entry(planned, subject, state, message + hint), digest=digest))
        problems = tuple(replace(each, message=each.message + hint) for each in result.problems)
        return Happened(What.FAILED, planned.job, subject.number, planned.why, problems=problems)

    def note_vanished(self, job: str, heirs: Mapping[str, str]) -> Happened:
        """Note that the file of a job is gone; `heirs`: the job of tonight that has each number."""
        standing = self.known.standings[job]
        heir = heirs.get(standing.number)
        message = _RENAMED.format(heir=heir, number=standing.number) if heir else _GONE
        if standing.state is not State.VANISHED:
            subject = asdict(replace(standing.subject, number=standing.number))
            began, state = self.night.began, State.VANISHED
            self.night.add(LedgerEntry(**subject, job=job, night=began, state=state, message=message))
        problem = Problem(Place(str(self.fleet.path)), f"{job}: {message}")
        return Happened(What.VANISHED, job, standing.number, "", problems=(problem,))

    def _keep_draft(self, planned: PlannedJob, made: MadeCertificate) -> Happened:
        before = self.known.standings.get(planned.job)
        if before and before.state is State.DRAFT and before.number == planned.number:
            message = before.message  # made again for another reason, it still differs for the first
        else:
            message = planned.why if planned.issued else _UNKNOWN
        with lay(self.fleet.output, made.files) as files:
            entry = self._make_entry(planned, made.subject, State.DRAFT, message, made)
            self.night.add(entry, files.known, made.basis)
            files.name_files()
        return _record_happened(What.DRAFT, planned, made, made.files)

    def _issue(self, planned: PlannedJob, made: MadeCertificate) -> Happened:
        output = self.fleet.output
        missing = [file for file in made.files if not (output / file.path).exists()]
        known = {file.path: file for file in (planned.issued.files if planned.issued else ())}
        for file in made.files:
            if file not in missing and file.path not in known:
                look = FileStamp.at(output / file.path)
                known[file.path] = KnownFile(file.role, file.path, file.sha256, look)
        with lay(output, missing) as files:
            known |= {file.path: file for file in files.known}
            entry = self._make_entry(planned, made.subject, State.MADE, "", made)
            self.night.issue(entry, tuple(known.values()), made.basis, made.lesson)
            files.name_files()
        self._forget_draft(planned)
        what = What.ISSUED if not planned.issued else What.RESTORED if missing else What.CONFIRMED
        return _record_happened(what, planned, made, missing)

    def _forget_draft(self, planned: PlannedJob) -> None:
        """Remove a draft that says nothing else any more than the certificate."""
        standing = self.known.standings.get(planned.job)
        if standing and standing.state is State.DRAFT and standing.number == planned.number:
            for file in standing.files:
                with contextlib.suppress(OSError):
                    (self.fleet.output / file.path).unlink(missing_ok=True)

    def _make_entry(
        self,
        planned: PlannedJob,
        subject: Subject,
        state: State,
        message: str,
        made: MadeCertificate | None = None,
    ) -> LedgerEntry:
        return LedgerEntry(
            **asdict(subject),
            job=planned.job,
            night=self.night.began,
            digest=made.basis.digest if made else "",
            state=state,
            message=message,
            files=tuple(file.path for file in made.files) if made else (),
            parameters=made.parameters if made else (),
            doubts=made.doubts if made else (),
            seconds=made.seconds if made else None,
        )


def _record_happened(
    what: What, planned: PlannedJob, made: MadeCertificate, written: Sequence[FinishedFile]
) -> Happened:
    files = tuple(file.path for file in written)
    of = made.subject.number, planned.why, files
    return Happened(what, planned.job, *of, conforms=made.conforms, doubts=made.doubts)
