"""Writes and reads the journal of a capture: each record on the disk at once, check sums, resuming.

Read again: what is whole in it, what was torn off at its end, and what is damaged.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from zlmreport.errors import AccessError, Place, count_in_words
from zlmreport.files import Closable, JournalFile, is_locked, make_unreadable, read
from zlmreport.live.capture.events import Event, Order, Recorded, Unclear
from zlmreport.live.capture.progress import Progress
from zlmreport.live.capture.records import (
    MOMENTARY,
    SCHEMA,
    Header,
    Record,
    from_record,
    require_finite,
    to_record,
)
from zlmreport.live.ports.reading import LiveReading
from zlmreport.measurement.provenance import SourceFile
from zlmreport.measurement.text_file import LARGEST

if TYPE_CHECKING:
    from zlmreport.live.capture.follower import Follower

_SUM = re.compile(rb',"sum":"([0-9a-f]{16})"\}')
_DIGITS = 16
#: Of every journal; what begins otherwise is a file of somebody else.
_BEGINNING = f'{{"schema":"{SCHEMA}"'.encode()
_IS_WRITTEN = "is being written by another capture; end that first, or name another journal"
_UNSOUND = (KeyError, TypeError, ValueError, IndexError, RecursionError, OverflowError)


@dataclass(frozen=True, slots=True)
class JournalEntry:
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
    entries: tuple[JournalEntry, ...]
    last_sum: str
    sound: int
    file: SourceFile

    @property
    def has_readings(self) -> bool:
        """Whether anything was read: also in a part of the test that is to be taken again."""
        return any(isinstance(entry.event, Recorded) for entry in self.entries)

    @property
    def is_being_written(self) -> bool:
        """Whether a capture is at work on it."""
        return self.file.path is not None and is_locked(self.file.path)

    @property
    def progress(self) -> Progress:
        """How far the capture has come."""
        progress = Progress.begin(self.header.visits, self.header.datum)
        for entry in self.entries:
            progress = progress.take_event(entry.event)
        return progress


def seal(record: Record, before: str) -> tuple[bytes, str]:
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
    content = _read_content(path)
    place = str(path)
    lines = content.split(b"\n")[:-1]
    last_sum = ""
    records: list[Record] = []
    while len(records) < len(lines) and (found := _unseal(lines[len(records)], last_sum)):
        record, last_sum = found
        records.append(record)
    if len(records) < len(lines) - 1 or (len(records) < len(lines) and not records):
        raise AccessError.at(Place(place, len(records) + 1), _say_damaged(len(records)))
    if not records:
        if not _BEGINNING.startswith(content[: len(_BEGINNING)].rstrip(b"\0")):
            raise AccessError.at(Place(place), _say_damaged(0))
        return None
    header, entries = _understand_records(records, place)
    sound = sum(len(line) + 1 for line in lines[: len(records)])
    return History(header, entries, last_sum, sound, SourceFile.of(path, content))


def _read_content(path: Path) -> bytes:
    place = Place(str(path))
    try:
        if not path.exists():
            raise AccessError.at(
                place,
                "there is no such journal: nothing was captured yet; 'zlmreport capture JOB.yaml' does it",
            )
        content = read(path, LARGEST)
    except OSError as error:
        raise make_unreadable(path, error) from error
    if len(content) > LARGEST:
        raise AccessError.at(place, f"is larger than {LARGEST} bytes; it is no journal of a test")
    return content


def _unseal(line: bytes, before: str) -> tuple[Record, str] | None:
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


def _understand_records(records: list[Record], place: str) -> tuple[Header, tuple[JournalEntry, ...]]:
    line = 1
    try:
        header = Header.from_record(records[0])
        entries = []
        for line, record in enumerate(records[1:], start=2):
            entries.append(
                JournalEntry(line, require_finite(record["elapsed"]), from_record(record, header.visits))
            )
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


def _say_damaged(sound: int) -> str:
    if not sound:
        return "is no journal of 'zlmreport capture'; name another file in measurement.source.journal"
    return (
        "the journal was altered or damaged from this line on; bring back a copy of it, or keep the "
        f"{count_in_words(sound, 'line')} before (head -n {sound}) and go on with --resume"
    )


def _sum(body: bytes, before: str) -> str:
    return hashlib.sha256(before.encode() + body).hexdigest()[:_DIGITS]


class Journal(Closable):
    """A journal that is open for records; only one capture can have it.

    Make one by `begin` or `resume`, and leave it as a context manager.
    """

    def __init__(self, file: JournalFile, header: Header, last_sum: str) -> None:
        self.header = header  #: Its first line.
        #: How far the capture has come, by what is in it.
        self.progress = Progress.begin(header.visits, header.datum)
        #: elapsed: Of its last record, s from the start of the capture.
        #: asked: When the question that is open was asked, s from the start of the capture.
        self.elapsed = self.asked = 0.0
        #: When the last reading was, s from the start of the capture; None before.
        self.visited: float | None = None
        self._file = file
        self._sum = last_sum

    @classmethod
    def begin(cls, path: Path, header: Header) -> Self:
        """Begin a journal.

        Raises `AccessError` if there is one of this name that holds a capture, or it cannot be written.
        """
        with _close_on_error(_open_journal(path)) as file:
            demand_nothing_captured(path)
            file.cut(0)
            journal = cls(file, header, "")
            journal._write(header.to_record())
            return journal

    @classmethod
    def resume(cls, path: Path) -> Self:
        """Go on with a journal; what was torn off at its end is cut away.

        Raises `AccessError` if there is none, it is damaged or being written, or it cannot be written.
        """
        read_history(path)  # before it is opened, which would make one
        with _close_on_error(_open_journal(path)) as file:
            history = read_history(path)
            if history is None:
                raise AccessError.at(
                    Place(str(path)),
                    "holds nothing yet: not even its first line is whole; leave --resume out",
                )
            file.cut(history.sound)
            journal = cls(file, history.header, history.last_sum)
            journal.progress = history.progress
            for entry in history.entries:
                journal._remember(entry.event, entry.elapsed)
            return journal

    def close(self) -> None:
        """Close it, and let others have it."""
        self._file.close()

    def append(self, event: Event, elapsed: float) -> None:
        """Write an event; when this returns, a power cut cannot take it away.

        `elapsed`: When, s from the start of the capture; a clock that was set back does not let time go back.

        Raises `AccessError` if it cannot be written.
        """
        self.elapsed = max(self.elapsed, elapsed)
        self._write({"elapsed": round(self.elapsed, 4), **to_record(event)})
        self._remember(event, self.elapsed)
        self.progress = self.progress.take_event(event)

    def _remember(self, event: Event, elapsed: float) -> None:
        self.elapsed = elapsed
        if isinstance(event, Recorded):
            self.visited = elapsed - event.late
        elif isinstance(event, Unclear):
            self.asked = elapsed

    def _write(self, record: Record) -> None:
        line, self._sum = seal(record, self._sum)
        self._file.append(line)


def demand_at_rest(path: Path) -> None:
    """Refuse a journal that a capture is writing.

    Raises `AccessError` at the journal.
    """
    if is_locked(path):
        raise AccessError.at(Place(str(path)), _IS_WRITTEN)


def demand_nothing_captured(path: Path) -> None:
    """Refuse to begin a journal where there is one with readings in it, or a file of somebody else.

    Raises `AccessError` at the journal, with how to go on.
    """
    if not path.exists() or (path.is_file() and not path.stat().st_size):
        return
    history = read_history(path)
    if history is not None and history.has_readings:
        raise AccessError.at(Place(str(path)), _is_there(history))


@contextlib.contextmanager
def _close_on_error(file: JournalFile) -> Iterator[JournalFile]:
    try:
        yield file
    except BaseException:
        file.close()
        raise


def _open_journal(path: Path) -> JournalFile:
    return JournalFile(
        path,
        _IS_WRITTEN,
        "; what happened last is not in it: see to the disk, then go on with --resume",
    )


def _is_there(history: History) -> str:
    progress = history.progress
    number = history.header.number
    if progress.is_over:
        return f"holds the finished capture of {number}; name another journal for a new one"
    return (
        f"holds a capture of {number} that is not finished: {progress.taken} of "
        f"{count_in_words(len(progress.visits), 'visit')}; go on with --resume, or name another journal"
    )


def capture(
    readings: Iterable[LiveReading],
    follower: Follower,
    journal: Journal,
    elapsed: Callable[[float], float],
    *,
    show: Callable[[LiveReading], Iterable[Order]] = lambda _reading: (),
) -> Iterator[Event]:
    """Follow readings, write down what happens, and yield it; end when nothing more is taken.

    `follower`: It begins with the progress of the journal.
    `elapsed`: From the time of a reading to s from the start of the capture.
    `show`: Is called with each reading, when all that happened with it is on the disk; returns what the
        operator orders then.
    """

    def keep(events: Iterable[Event], time: float) -> Iterator[Event]:
        for event in events:
            if not isinstance(event, MOMENTARY):
                journal.append(event, elapsed(time))
            yield event

    for reading in readings:
        yield from keep(follower.feed(reading), reading.time)
        for order in show(reading):
            yield from keep(follower.take_order(order), reading.time)
        if follower.is_halted:
            return
