"""Writing a journal: each record is on the disk before anything else happens."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from types import TracebackType
from typing import Self

from zlmreport.capture.events import Event, Order, Recorded, Unclear
from zlmreport.capture.follower import Follower
from zlmreport.capture.history import History, read_history, sealed
from zlmreport.capture.progress import Progress
from zlmreport.capture.records import MOMENTARY, Header, Record, to_record
from zlmreport.errors import AccessError, Place
from zlmreport.files import Appended, unwritable
from zlmreport.live.reading import LiveReading


class Journal:
    """A journal that is open for records; only one capture can have it.

    Make one by `begun` or `continued`, and leave it as a context manager.

    Attributes
    ----------
    header
        Its first line.
    progress
        How far the capture has come, by what is in it.
    elapsed
        Of its last record, s from the start of the capture.
    visited
        When the last reading was, s from the start of the capture; None before.
    asked
        When the question that is open was asked, s from the start of the capture.
    """

    def __init__(self, path: Path, file: Appended, header: Header, last_sum: str) -> None:
        self.header = header
        self.progress = Progress.begin(header.visits, header.datum)
        self.elapsed = self.asked = 0.0
        self.visited: float | None = None
        self._path = path
        self._file = file
        self._sum = last_sum

    @classmethod
    def begun(cls, path: Path, header: Header) -> Self:
        """Begin a journal.

        Raises
        ------
        AccessError
            If there is one of this name that holds a capture, or it cannot be written.
        """
        with _closed_on_error(_opened(path)) as file:
            demand_nothing_captured(path)
            file.cut(0)
            journal = cls(path, file, header, "")
            journal._write(header.to_record())
            return journal

    @classmethod
    def continued(cls, path: Path) -> Self:
        """Go on with a journal; what was torn off at its end is cut away.

        Raises
        ------
        AccessError
            If there is none, it is damaged or being written, or it cannot be written.
        """
        read_history(path)  # before it is opened, which would make one
        with _closed_on_error(_opened(path)) as file:
            history = read_history(path)
            if history is None:
                raise AccessError.at(
                    Place(str(path)),
                    "holds nothing yet: not even its first line is whole; leave --resume out",
                )
            file.cut(history.sound)
            journal = cls(path, file, history.header, history.last_sum)
            journal.progress = history.progress
            for entry in history.entries:
                journal._remember(entry.event, entry.elapsed)
            return journal

    def __enter__(self) -> Self:
        """Return the journal."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close it, and let others have it."""
        self._file.close()

    def append(self, event: Event, elapsed: float) -> None:
        """Write an event; when this returns, a power cut cannot take it away.

        Parameters
        ----------
        event
            What happened.
        elapsed
            When, s from the start of the capture; a clock that was set back does not let time go back.

        Raises
        ------
        AccessError
            If it cannot be written.
        """
        self.elapsed = max(self.elapsed, elapsed)
        self._write({"elapsed": round(self.elapsed, 4), **to_record(event)})
        self._remember(event, self.elapsed)
        self.progress = self.progress.after(event)

    def _remember(self, event: Event, elapsed: float) -> None:
        self.elapsed = elapsed
        if isinstance(event, Recorded):
            self.visited = elapsed - event.late
        elif isinstance(event, Unclear):
            self.asked = elapsed

    def _write(self, record: Record) -> None:
        line, self._sum = sealed(record, self._sum)
        try:
            self._file.append(line)
        except OSError as error:
            raise unwritable(
                self._path,
                error,
                "; what happened last is not in it: see to the disk, then go on with --resume",
            ) from error


def demand_nothing_captured(path: Path) -> None:
    """Refuse to begin a journal where there is one with readings in it, or a file of somebody else.

    Raises
    ------
    AccessError
        At the journal, with how to go on.
    """
    if not path.exists() or (path.is_file() and not path.stat().st_size):
        return
    history = read_history(path)
    if history is not None and history.has_readings:
        raise AccessError.at(Place(str(path)), _is_there(history))


@contextlib.contextmanager
def _closed_on_error(file: Appended) -> Iterator[Appended]:
    try:
        yield file
    except BaseException:
        file.close()
        raise


def _opened(path: Path) -> Appended:
    """Open a journal, make it if there is none, and keep others from writing it."""
    try:
        file = Appended(path)
    except OSError as error:
        raise unwritable(path, error) from error
    try:
        file.lock()
    except OSError as error:
        file.close()
        raise AccessError.at(
            Place(str(path)), "is being written by another capture; end that first, or name another journal"
        ) from error
    return file


def _is_there(history: History) -> str:
    progress = history.progress
    number = history.header.number
    if progress.is_over:
        return f"holds the finished capture of {number}; name another journal for a new one"
    return (
        f"holds a capture of {number} that is not finished: {progress.taken} of {len(progress.visits)} "
        "visits; go on with --resume, or name another journal"
    )


def captured(
    readings: Iterable[LiveReading],
    follower: Follower,
    journal: Journal,
    elapsed: Callable[[float], float],
    *,
    show: Callable[[LiveReading], Iterable[Order]] = lambda _reading: (),
) -> Iterator[Event]:
    """Follow readings, write down what happens, and yield it; end when nothing more is taken.

    Parameters
    ----------
    readings
        Of the instrument.
    follower
        It begins with the progress of the journal.
    journal
        Where it is written down.
    elapsed
        From the time of a reading to s from the start of the capture.
    show
        Is called with each reading, when all that happened with it is on the disk; returns what the operator
        orders then.
    """

    def kept(events: Iterable[Event], time: float) -> Iterator[Event]:
        for event in events:
            if not isinstance(event, MOMENTARY):
                journal.append(event, elapsed(time))
            yield event

    for reading in readings:
        yield from kept(follower.feed(reading), reading.time)
        for order in show(reading):
            yield from kept(follower.ordered(order), reading.time)
        if follower.is_halted:
            return
