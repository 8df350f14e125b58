"""Where results of workers become files and entries of the ledger."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from zlmreport.errors import Place, Problem, as_problems
from zlmreport.fleet.basis import KnownFile, Look
from zlmreport.fleet.ledger import Standing
from zlmreport.fleet.ledger_night import Night, NumberTakenError
from zlmreport.fleet.plan import Planned
from zlmreport.fleet.records import Entry, State
from zlmreport.fleet.shelf import Finished, laid
from zlmreport.fleet.stated import Subject
from zlmreport.fleet.work import Failed, Made
from zlmreport.job.fleet import FleetFile

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


@dataclass(frozen=True, slots=True)
class Happened:
    """What happened to a job in a night.

    Attributes
    ----------
    what
        In a word.
    job, number
        As the ledger has them.
    why
        Why it was due.
    files
        That were written, relative to the folder of certificates.
    problems
        Why it failed.
    conforms
        Whether every stated limit is met; None without limits, where one is not decided, or not looked at.
    """

    what: What
    job: str
    number: str
    why: str = ""
    files: tuple[str, ...] = ()
    problems: tuple[Problem, ...] = ()
    conforms: bool | None = None


@dataclass(frozen=True, slots=True)
class Desk:
    """Where results become files and entries."""

    fleet: FleetFile
    night: Night
    standings: Mapping[str, Standing]

    def kept(self, planned: Planned, result: Made | Failed) -> Happened:
        """Keep what a job came to."""
        if isinstance(result, Failed):
            return self.failed(planned, result)
        try:
            return self._draft(planned, result) if result.is_draft else self._issued(planned, result)
        except NumberTakenError:
            message = f"the number {result.subject.number} was given to another certificate tonight"
            problem = Problem(Place(str(planned.path)), message)
            return self.failed(planned, Failed((problem,), result.subject))
        except OSError as error:
            return self.failed(planned, Failed(as_problems(planned.path, error).problems, result.subject))

    def failed(self, planned: Planned, result: Failed) -> Happened:
        """Note that a job came to nothing."""
        subject = replace(result.subject, number=result.subject.number or planned.number)
        message = "\n".join(map(str, result.problems))
        self.night.add(self._entry(planned, subject, State.FAILED, message))
        return Happened(What.FAILED, planned.job, subject.number, planned.why, problems=result.problems)

    def _draft(self, planned: Planned, made: Made) -> Happened:
        message = planned.why if planned.issued else _UNKNOWN
        with laid(self.fleet.output, made.files) as files:
            entry = self._entry(planned, made.subject, State.DRAFT, message, made)
            self.night.add(entry, files.known, made.basis)
            files.name()
        return _happened(What.DRAFT, planned, made, made.files)

    def _issued(self, planned: Planned, made: Made) -> Happened:
        output = self.fleet.output
        missing = [file for file in made.files if not (output / file.path).exists()]
        known = {file.path: file for file in (planned.issued.files if planned.issued else ())}
        for file in made.files:
            if file not in missing and file.path not in known:
                look = Look.at(output / file.path)
                known[file.path] = KnownFile(file.role, file.path, file.sha256, look)
        with laid(output, missing) as files:
            known |= {file.path: file for file in files.known}
            entry = self._entry(planned, made.subject, State.MADE, "", made)
            self.night.issue(entry, tuple(known.values()), made.basis)
            files.name()
        self._forget_draft(planned)
        what = What.ISSUED if not planned.issued else What.RESTORED if missing else What.CONFIRMED
        return _happened(what, planned, made, missing)

    def _forget_draft(self, planned: Planned) -> None:
        """Remove a draft that says nothing else any more than the certificate."""
        standing = self.standings.get(planned.job)
        if standing and standing.state is State.DRAFT and standing.number == planned.number:
            for file in standing.files:
                with contextlib.suppress(OSError):
                    (self.fleet.output / file.path).unlink(missing_ok=True)

    def _entry(
        self, planned: Planned, subject: Subject, state: State, message: str, made: Made | None = None
    ) -> Entry:
        return Entry(
            job=planned.job,
            number=subject.number,
            machine=subject.machine,
            axis=subject.axis,
            measured=subject.measured,
            night=self.night.began,
            digest=made.basis.digest if made else "",
            state=state,
            message=message,
            files=tuple(file.path for file in made.files) if made else (),
            parameters=made.parameters if made else (),
        )


def _happened(what: What, planned: Planned, made: Made, written: Sequence[Finished]) -> Happened:
    verdicts = [each.conforms for each in made.parameters if each.limit is not None]
    conforms = False if False in verdicts else True if verdicts and None not in verdicts else None
    files = tuple(file.path for file in written)
    return Happened(what, planned.job, made.subject.number, planned.why, files, conforms=conforms)
