"""The history of the workbench, in a file beside the job: what was clicked, undo and redo.

A line is never altered. An undo is a line of its own, and puts back the bytes that were replaced; so does
what takes an undo back. Either is offered only while the job is still as the last line left it.
"""

from __future__ import annotations

import base64
import datetime as dt
import hashlib
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from zlmreport.errors import AccessError, Place
from zlmreport.files import Appended, demand, make_unreadable, make_unwritable, rewrite
from zlmreport.job.parse import LARGEST

SUFFIX = ".history.jsonl"
SCHEMA = "zlmreport/workbench-history/1"
UNDO = "undo"
REDO = "redo"


@dataclass(frozen=True, slots=True)
class JournalStep:
    """One change of the job."""

    at: str  #: When, ISO 8601 with the offset of the local time.
    #: What was done: ``add``, ``remove``, ``fix``, ``free``, ``exclude``, ``include``, ``state``, ``undo`` or
    #: ``redo``.
    action: str
    #: To what: an effect, a parameter, a key of the job, a reading as ``target direction run``; of an undo or
    #: redo the step that it is about, ``add backlash``.
    subject: str
    #: before and after: SHA-256 of the job file.
    before: str
    after: str
    #: rms_before and rms_after: Error of the model, µm or ″.
    rms_before: float
    rms_after: float
    replaced: str  #: The job file as it was, base64.

    @property
    def content(self) -> bytes:
        """The job file as it was before."""
        return base64.b64decode(self.replaced)


@dataclass(frozen=True, slots=True)
class BenchJournal:
    """The record beside a job."""

    path: Path  #: Of the record.

    @classmethod
    def of(cls, job: Path) -> BenchJournal:
        """Return the record of a job: ``job.yaml`` has ``job.history.jsonl``."""
        return cls(job.with_suffix(SUFFIX))

    def read_entries(self) -> tuple[JournalStep, ...]:
        """Return all changes, the oldest first; lines that are none are passed over."""
        try:
            lines = self.path.read_text("utf-8").splitlines()
        except FileNotFoundError:
            return ()
        except UnicodeDecodeError as error:
            raise AccessError.at(Place(str(self.path)), f"cannot be read: {error}") from error
        except OSError as error:
            raise make_unreadable(self.path, error) from error
        return tuple(found for line in lines if (found := _read_entry(line)))

    def append(self, entry: JournalStep) -> None:
        """Write a change behind the others."""
        line = json.dumps({"schema": SCHEMA, **asdict(entry)}, ensure_ascii=False)
        try:
            with Appended(self.path) as file:
                file.append(f"{line}\n".encode())
        except OSError as error:
            raise make_unwritable(self.path, error) from error


def record_change(job: Path, entry: JournalStep) -> None:
    """Write a change of a job into its record; where that fails, the job is as it was before.

    Raises `AccessError` if the record cannot be written.
    """
    try:
        BenchJournal.of(job).append(entry)
    except AccessError:
        # Nobody could take back on the page what is not recorded. What somebody else wrote since stays.
        if hashlib.sha256(demand(job, LARGEST)).hexdigest() == entry.after:
            rewrite(job, entry.content, lambda _: None)
        raise


def make_entry(
    action: str, subject: str, contents: tuple[bytes, bytes], errors: tuple[float, float]
) -> JournalStep:
    """Return the record of a change made now: contents of the job and its errors, before and after."""
    before, after = contents
    return JournalStep(
        at=dt.datetime.now().astimezone().isoformat(timespec="seconds"),
        action=action,
        subject=subject,
        before=hashlib.sha256(before).hexdigest(),
        after=hashlib.sha256(after).hexdigest(),
        rms_before=errors[0],
        rms_after=errors[1],
        replaced=base64.b64encode(before).decode("ascii"),
    )


def find_undoable(entries: Sequence[JournalStep], digest: str) -> JournalStep | None:
    """Return the change that an undo would take back; None if the job is not as that change left it."""
    standing, _ = _split_stacks(entries)
    return standing[-1] if standing and standing[-1].after == digest else None


def find_redoable(entries: Sequence[JournalStep], digest: str) -> JournalStep | None:
    """Return the undo that a redo would take back; None if the job is not as that undo left it."""
    _, taken_back = _split_stacks(entries)
    return taken_back[-1] if taken_back and taken_back[-1].after == digest else None


def _split_stacks(entries: Sequence[JournalStep]) -> tuple[list[JournalStep], list[JournalStep]]:
    """Return the changes that stand, and the undos since the last change: the last of each can be undone."""
    standing: list[JournalStep] = []
    taken_back: list[JournalStep] = []
    for each in entries:
        if each.action == UNDO and standing:
            standing.pop()
            taken_back.append(each)
        elif each.action == REDO and taken_back:
            taken_back.pop()
            standing.append(each)
        elif each.action not in {UNDO, REDO}:
            standing.append(each)
            taken_back = []
    return standing, taken_back


def _read_entry(line: str) -> JournalStep | None:
    try:
        values = json.loads(line)
        if values.pop("schema") != SCHEMA:
            return None
        return JournalStep(**values)
    except (ValueError, TypeError, KeyError, AttributeError):
        return None
