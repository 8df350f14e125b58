"""Reading a journal: what is whole in it, what was torn off at its end, and what is damaged."""

from __future__ import annotations

import hashlib
import json
import re
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from zlmreport.capture.events import Event, Recorded
from zlmreport.capture.progress import Progress
from zlmreport.capture.records import SCHEMA, Header, Record, finite, from_record
from zlmreport.errors import AccessError, Place
from zlmreport.files import read, unreadable
from zlmreport.measurement.provenance import SourceFile
from zlmreport.measurement.text_file import LARGEST

_SUM = re.compile(rb',"sum":"([0-9a-f]{16})"\}')
_DIGITS = 16
#: Of every journal; what begins otherwise is a file of somebody else.
_BEGINNING = f'{{"schema":"{SCHEMA}"'.encode()
_UNSOUND = (KeyError, TypeError, ValueError, IndexError, RecursionError, OverflowError)


@dataclass(frozen=True, slots=True)
class Entry:
    """An event in a journal.

    Attributes
    ----------
    line
        Where it stands, from 1.
    elapsed
        When it happened, s from the start of the capture.
    event
        What happened.
    """

    line: int
    elapsed: float
    event: Event


@dataclass(frozen=True, slots=True)
class History:
    """What a journal tells.

    Attributes
    ----------
    header
        Its first line.
    entries
        The others.
    last_sum
        The check sum of the last sound line, to go on from.
    sound
        How many bytes are sound; what follows was torn off while it was written.
    file
        The journal.
    """

    header: Header
    entries: tuple[Entry, ...]
    last_sum: str
    sound: int
    file: SourceFile

    @property
    def torn(self) -> int:
        """How many bytes at the end are no whole record."""
        return self.file.size - self.sound

    @property
    def has_readings(self) -> bool:
        """Whether anything was read: also in a part of the test that is to be taken again."""
        return any(isinstance(entry.event, Recorded) for entry in self.entries)

    @property
    def progress(self) -> Progress:
        """How far the capture has come."""
        progress = Progress.begin(self.header.visits, self.header.datum)
        for entry in self.entries:
            progress = progress.after(entry.event)
        return progress


def sealed(record: Record, before: str) -> tuple[bytes, str]:
    """Return a record as a line of a journal, and its check sum, which covers the one before, too."""
    body = json.dumps(record, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode()
    own = _sum(body, before)
    return body[:-1] + f',"sum":"{own}"}}\n'.encode(), own


def read_history(path: Path) -> History | None:
    """Read a journal.

    A last line that is not whole is left out: it was being written when the power went, and nobody was told
    of its reading.

    Parameters
    ----------
    path
        The journal.

    Returns
    -------
    History or None
        None if not even the first line is whole.

    Raises
    ------
    AccessError
        If there is no such journal, it cannot be read, it is none, or it is damaged.
    """
    content = _content(path)
    place = str(path)
    lines = content.split(b"\n")[:-1]
    last_sum = ""
    records: list[Record] = []
    while len(records) < len(lines) and (found := _unsealed(lines[len(records)], last_sum)):
        record, last_sum = found
        records.append(record)
    if len(records) < len(lines) - 1 or (len(records) < len(lines) and not records):
        raise AccessError.at(Place(place, len(records) + 1), _damaged(len(records)))
    if not records:
        if not _BEGINNING.startswith(content[: len(_BEGINNING)].rstrip(b"\0")):
            raise AccessError.at(Place(place), _damaged(0))
        return None
    header, entries = _understood(records, place)
    sound = sum(len(line) + 1 for line in lines[: len(records)])
    return History(header, entries, last_sum, sound, SourceFile.of(path, content))


def _content(path: Path) -> bytes:
    place = Place(str(path))
    try:
        if not path.exists():
            raise AccessError.at(
                place,
                "there is no such journal: nothing was captured yet; 'zlmreport capture JOB.yaml' does it",
            )
        content = read(path, LARGEST)
    except OSError as error:
        raise unreadable(path, error) from error
    if len(content) > LARGEST:
        raise AccessError.at(place, f"is larger than {LARGEST} bytes; it is no journal of a test")
    return content


def _unsealed(line: bytes, before: str) -> tuple[Record, str] | None:
    """Return the record of a line with its check sum; None if it is not as it was written."""
    found = _SUM.search(line, max(0, len(line) - _DIGITS - 10))
    if found is None or found.end() != len(line):
        return None
    body, own = line[: found.start()] + b"}", found[1].decode()
    if _sum(body, before) != own:
        return None
    try:
        record: Any = json.loads(body)
    except (ValueError, RecursionError):
        return None
    return (record, own) if isinstance(record, dict) else None


def _understood(records: list[Record], place: str) -> tuple[Header, tuple[Entry, ...]]:
    line = 1
    try:
        header = Header.from_record(records[0])
        entries = []
        for line, record in enumerate(records[1:], start=2):
            entries.append(Entry(line, finite(record["elapsed"]), from_record(record, header.visits)))
        line = next(
            (later.line for earlier, later in pairwise(entries) if later.elapsed < earlier.elapsed), 0
        )
        if line:
            raise ValueError("its time lies before that of the record above")
    except _UNSOUND as error:
        raise AccessError.at(
            Place(place, line), f"is no record of a journal of this version of zlmreport ({error})"
        ) from error
    return header, tuple(entries)


def _damaged(sound: int) -> str:
    if not sound:
        return "is no journal of 'zlmreport capture'; name another file in measurement.source.journal"
    return (
        "the journal was altered or damaged from this line on; bring back a copy of it, or keep the "
        f"{sound} lines before (head -n {sound}) and go on with --resume"
    )


def _sum(body: bytes, before: str) -> str:
    return hashlib.sha256(before.encode() + body).hexdigest()[:_DIGITS]
