"""The ledger of a fleet, read and written: certificates, nights, what was told; waits for another's lock."""

from __future__ import annotations

import contextlib
import datetime as dt
import itertools
import os
import signal
import socket
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any, Self

from sqlalchemy import Connection, Insert, Row, func, insert, select, update
from sqlalchemy.exc import IntegrityError

from zlmreport.files import Closable
from zlmreport.fleet.basis import CertificateBasis, KnownFile
from zlmreport.fleet.database import (
    CERTIFICATES,
    ENTRIES,
    NEWS,
    NIGHTS,
    PARAMETERS,
    Database,
    TakenError,
    copy,
    lock,
    open_database,
)
from zlmreport.fleet.records import (
    SILENT,
    About,
    LedgerEntry,
    News,
    NewsKind,
    NightNotice,
    PastNight,
    RecordedParameter,
    State,
    Subject,
)
from zlmreport.language import Language, Words

#: How often, and how many seconds apart, the lock of a night that was killed is tried.
_ATTEMPTS, _PAUSE = 50, 0.1
#: So long a night is watched before it is held for stuck, s: three times the usual between signs of life.
WATCHED = 15.0
#: What the table of entries keeps of an entry as it is.
_OWN = (*(each.name for each in fields(Subject)), "job", "digest", "state", "message", "seconds")


class NumberTakenError(Exception):
    """The number of a certificate is another's."""


@dataclass(frozen=True, slots=True)
class Night:
    """A night at work."""

    database: Database  #: Of the ledger.
    fleet: str  #: Name of the fleet.
    identity: int  #: Of the night in the ledger.
    began: str  #: Date and time, ISO 8601 in UTC.
    before: PastNight | None  #: The night before of this fleet, as it was when this one began.
    took_over: str = ""  #: When the night began that was stuck, and was killed for this one; empty for none.

    @property
    def was_interrupted(self) -> bool:
        """Whether the night before never came to its end."""
        return self.before is not None and self.before.ended is None

    def add(
        self, entry: LedgerEntry, files: Sequence[KnownFile] = (), basis: CertificateBasis | None = None
    ) -> None:
        """Add an entry that issues nothing: a draft or a failure."""
        with self.database.begin_transaction() as connection:
            self._insert(connection, entry, files, basis)

    def issue(
        self,
        entry: LedgerEntry,
        files: Sequence[KnownFile],
        basis: CertificateBasis | None,
        lesson: Mapping[str, Any] | None = None,
    ) -> None:
        """Add the entry of a certificate, and in the same transaction its number and its files.

        A number that this fleet gave before keeps its first entry, and its files are those of now. The lesson
        is what its readings teach other tests, as `zlmreport.model.fitting.priors.Lesson` gives it.

        Raises `NumberTakenError` if the number is that of another certificate, or differs from it in case
        alone.
        """
        kept = [file.as_json() for file in files]
        own = select(ENTRIES.c.id).where(ENTRIES.c.fleet == self.fleet)
        renewal = (
            update(CERTIFICATES)
            .where(CERTIFICATES.c.number == entry.number, CERTIFICATES.c.entry.in_(own))
            .values(files=kept)
        )
        try:
            with self.database.begin_transaction() as connection:
                identity = self._insert(connection, entry, files, basis, lesson)
                if not connection.execute(renewal).rowcount:
                    _refuse_taken(connection, entry.number)
                    first = insert(CERTIFICATES).values(number=entry.number, entry=identity, files=kept)
                    connection.execute(first)
        except IntegrityError as error:
            raise NumberTakenError(_say_taken(entry.number, entry.number)) from error

    def find_stated_parameters(self, job: str) -> tuple[RecordedParameter, ...]:
        """Return what the latest certificate of a job states."""
        own = (ENTRIES.c.fleet == self.fleet, ENTRIES.c.job == job, ENTRIES.c.state == State.MADE.value)
        latest = select(func.max(ENTRIES.c.id)).where(*own).scalar_subquery()
        query = select(PARAMETERS).where(PARAMETERS.c.entry == latest).order_by(PARAMETERS.c.row)
        with self.database.begin_transaction() as connection:
            return tuple(map(_read_parameter, connection.execute(query)))

    def beat(self, now: str) -> None:
        """Give a sign of life."""
        self._note(beat=now)

    def notice(self, notices: Sequence[NightNotice]) -> None:
        """Note what concerns the whole night."""
        self._note(notices=[[each.about.value, *_write_words(each.text)] for each in notices])

    def leave(self, jobs: Sequence[str]) -> None:
        """Note the jobs that the night had no time for."""
        self._note(untried=list(jobs))

    def report(self, news: Sequence[News], *, is_all: bool = True) -> None:
        """Note what is new: what is not known yet, or had ended.

        `is_all`: Whether a condition that is not among them has ended.
        """
        with self.database.begin_transaction() as connection:
            rows = connection.execute(select(NEWS).where(NEWS.c.fleet == self.fleet)).all()
            known = {(row.kind, row.subject): row for row in rows if row.ended is None}
            now = {(each.kind.value, each.subject): each for each in news}
            over = [
                row.id
                for key, row in known.items()
                if is_all and key not in now and NewsKind(row.kind).is_condition
            ]
            if over:
                connection.execute(update(NEWS).where(NEWS.c.id.in_(over)).values(ended=self.identity))
            new: list[dict[str, Any]] = [
                {
                    "fleet": self.fleet,
                    "night": self.identity,
                    "kind": each.kind.value,
                    "subject": each.subject,
                    "text": each.text,
                    "told": [],
                }
                for key, each in now.items()
                if key not in known
            ]
            if new:
                connection.execute(insert(NEWS), new)

    def list_subjects(self, kind: NewsKind) -> frozenset[str]:
        """Return the subjects of all news of a kind that there ever was."""
        query = select(NEWS.c.subject).where(NEWS.c.fleet == self.fleet, NEWS.c.kind == kind.value)
        with self.database.begin_transaction() as connection:
            return frozenset(connection.scalars(query))

    def list_untold(self, way: str, *, was_tried: bool) -> tuple[News, ...]:
        """Return what nobody heard of by a way, oldest first; by a new one, what is new or still so.

        `was_tried`: Whether nobody was reached by it in the night before.
        """
        query = select(NEWS).where(NEWS.c.fleet == self.fleet).order_by(NEWS.c.id)
        ended = select(func.max(NIGHTS.c.id)).where(NIGHTS.c.fleet == self.fleet, NIGHTS.c.ended.is_not(None))
        with self.database.begin_transaction() as connection:
            rows = connection.execute(query).all()
            last_ended = connection.scalar(ended) or 0
        if not was_tried and not any(way in row.told for row in rows):
            rows = [row for row in rows if row.night > last_ended or _is_still_so(row)]
        return tuple(News(NewsKind(row.kind), row.subject, row.text) for row in rows if way not in row.told)

    def tell(self, way: str) -> None:
        """Note that all news was told by a way."""
        with self.database.begin_transaction() as connection:
            rows = connection.execute(select(NEWS).where(NEWS.c.fleet == self.fleet)).all()
            for row in rows:
                if way not in row.told:
                    told = [*row.told, way]
                    connection.execute(update(NEWS).where(NEWS.c.id == row.id).values(told=told))

    def end(self, ended: str) -> None:
        """Note that the night has come to its end."""
        self._note(ended=ended)

    def _note(self, **values: object) -> None:
        with self.database.begin_transaction() as connection:
            connection.execute(update(NIGHTS).where(NIGHTS.c.id == self.identity).values(**values))

    def _insert(
        self,
        connection: Connection,
        entry: LedgerEntry,
        files: Sequence[KnownFile],
        basis: CertificateBasis | None,
        lesson: Mapping[str, Any] | None = None,
    ) -> int:
        identity = _add_row(
            connection,
            insert(ENTRIES).values(
                fleet=self.fleet,
                night=self.identity,
                files=[file.as_json() for file in files],
                basis=basis.as_json() if basis else None,
                lesson=lesson,
                doubts=[_write_words(each) for each in entry.doubts] or None,
                **{name: getattr(entry, name) for name in _OWN},
            ),
        )
        if entry.parameters:
            rows = [
                {"entry": identity, "row": row, **asdict(parameter)}
                for row, parameter in enumerate(entry.parameters)
            ]
            connection.execute(insert(PARAMETERS), rows)
        return identity


def _is_still_so(news: Row[Any]) -> bool:
    return news.ended is None and NewsKind(news.kind).is_condition


def _add_row(connection: Connection, row: Insert) -> int:
    """Add a row and return its key."""
    key = connection.execute(row).inserted_primary_key
    if key is None:
        raise TypeError("an insert of one row has a key")
    identity: int = key[0]
    return identity


@dataclass(frozen=True, slots=True)
class Standing:
    """What the ledger knows of a job: the last that became of it."""

    #: number, state, night and message: As `LedgerEntry` has them.
    number: str
    state: State
    night: str
    message: str
    files: tuple[KnownFile, ...]  #: Its certificate's, or its draft's.
    basis: CertificateBasis | None  #: What they were made from; None of a job that failed.
    digest: str = ""  #: Of its inputs, where it was stopped.
    subject: Subject = field(default_factory=Subject)  #: Machine, axis, and date of the measurement.


@dataclass(frozen=True, slots=True)
class Issued:
    """A certificate that was issued, whichever fleet it belongs to."""

    #: fleet and job: For which it was made.
    fleet: str
    job: str
    night: str  #: In which it was made.
    files: tuple[KnownFile, ...]


@dataclass(frozen=True, slots=True)
class Taught:
    """What a certificate teaches other tests."""

    subject: Subject  #: What it is about.
    readings: frozenset[str]  #: Digests of its readings: two certificates of the same teach once.
    lesson: Mapping[str, Any]  #: As `zlmreport.model.fitting.priors.Lesson` gives it.


class Ledger(Closable):
    """The ledger of one fleet, open; it is left as a context manager, which closes the database."""

    def __init__(self, database: Database, fleet: str) -> None:
        self._database = database
        self._fleet = fleet

    @classmethod
    def open(cls, address: str, fleet: str, *, create: bool = True) -> Self:
        """Open a ledger.

        `fleet`: Name of the fleet: several may share one ledger.
        `create`: Whether a ledger that is not there is made; if not, it is as if it were empty.

        Raises `InputError` if the address is none, or the ledger is of another version of the program;
        `AccessError` if the database cannot be opened.
        """
        return cls(open_database(address, create=create), fleet)

    def close(self) -> None:
        """Close the database."""
        self._database.engine.dispose()

    def write_backup(self, to: Path) -> None:
        """Copy the whole ledger into an SQLite file; raise `OSError` if that cannot be written."""
        copy(self._database, to)

    def list_entries(self) -> Iterator[LedgerEntry]:
        """Yield the whole history of the fleet with parameters, oldest first; drafts and failures too."""
        own = ENTRIES.c.fleet == self._fleet
        entries = (
            select(ENTRIES, NIGHTS.c.began)
            .join(NIGHTS, ENTRIES.c.night == NIGHTS.c.id)
            .where(own)
            .order_by(ENTRIES.c.id)
        )
        parameters = (
            select(PARAMETERS)
            .join(ENTRIES, PARAMETERS.c.entry == ENTRIES.c.id)
            .where(own)
            .order_by(PARAMETERS.c.entry, PARAMETERS.c.row)
        )
        with self._database.begin_reading() as connection:
            stated = {
                entry: tuple(map(_read_parameter, rows))
                for entry, rows in itertools.groupby(connection.execute(parameters), lambda row: row.entry)
            }
            found = [_make_entry(row, stated.get(row.id, ())) for row in connection.execute(entries)]
        yield from found

    def find_last_night(self) -> PastNight | None:
        """Return the last night of the fleet; None before the first."""
        query = select(NIGHTS).where(NIGHTS.c.fleet == self._fleet).order_by(NIGHTS.c.id.desc()).limit(1)
        with self._database.begin_reading() as connection:
            night = connection.execute(query).one_or_none()
            if night is None:
                return None
            states = select(ENTRIES.c.state, func.count()).where(ENTRIES.c.night == night.id)
            came_to = {State(row[0]): row[1] for row in connection.execute(states.group_by(ENTRIES.c.state))}
            notices = tuple(
                NightNotice(About(about), _read_words(*texts)) for about, *texts in night.notices or ()
            )
            ended, beat = (dt.datetime.fromisoformat(at) if at else None for at in (night.ended, night.beat))
            began, untried = dt.datetime.fromisoformat(night.began), tuple(night.untried or ())
        return PastNight(began, ended, notices, came_to, beat, untried=untried)

    def list_standings(self) -> Mapping[str, Standing]:
        """Return what the ledger knows of each job, by its path."""
        latest = select(func.max(ENTRIES.c.id)).where(ENTRIES.c.fleet == self._fleet).group_by(ENTRIES.c.job)
        query = (
            select(ENTRIES, NIGHTS.c.began)
            .join(NIGHTS, ENTRIES.c.night == NIGHTS.c.id)
            .where(ENTRIES.c.id.in_(latest))
        )
        with self._database.begin_reading() as connection:
            return {
                row.job: Standing(
                    row.number,
                    State(row.state),
                    row.began,
                    row.message,
                    _read_files(row.files),
                    CertificateBasis.from_json(row.basis) if row.basis else None,
                    row.digest,
                    Subject(**_read_subject(row)),
                )
                for row in connection.execute(query)
            }

    def list_longest_times(self) -> Mapping[str, float]:
        """Return the longest time that each job ever took, s."""
        query = (
            select(ENTRIES.c.job, func.max(ENTRIES.c.seconds))
            .where(ENTRIES.c.fleet == self._fleet, ENTRIES.c.seconds.is_not(None))
            .group_by(ENTRIES.c.job)
        )
        with self._database.begin_transaction() as connection:
            return {row[0]: row[1] for row in connection.execute(query)}

    def list_certificates(self) -> Mapping[str, Issued]:
        """Return every certificate that was issued by its number, those of other fleets too."""
        query = (
            select(CERTIFICATES, ENTRIES.c.fleet, ENTRIES.c.job, NIGHTS.c.began)
            .join(ENTRIES, CERTIFICATES.c.entry == ENTRIES.c.id)
            .join(NIGHTS, ENTRIES.c.night == NIGHTS.c.id)
        )
        with self._database.begin_reading() as connection:
            return {
                row.number: Issued(row.fleet, row.job, row.began, _read_files(row.files))
                for row in connection.execute(query)
            }

    def list_lessons(self) -> Iterator[Taught]:
        """Yield what certificates teach, in the order of measurement: of each job the latest of a test."""
        made = (ENTRIES.c.fleet == self._fleet, ENTRIES.c.state == State.MADE.value)
        latest = select(func.max(ENTRIES.c.id)).where(*made).group_by(ENTRIES.c.job, ENTRIES.c.measured)
        query = (
            select(ENTRIES)
            .where(ENTRIES.c.id.in_(latest), ENTRIES.c.lesson.is_not(None))
            .order_by(ENTRIES.c.measured, ENTRIES.c.number)
        )
        with self._database.begin_transaction() as connection:
            for row in connection.execute(query):
                files = CertificateBasis.from_json(row.basis).files if row.basis else ()
                readings = frozenset(file.sha256 for file in files if file.role == "readings")
                yield Taught(Subject(**_read_subject(row)), readings, row.lesson)

    @contextlib.contextmanager
    def hold_night(self, began: str, fleet_file: str) -> Iterator[Night]:
        """Let one night at a time write to the ledger, whichever fleet it is.

        `began`: Date and time, ISO 8601 in UTC.

        Raises `AccessError` if another is at work on it.

        One of this host that has given no sign of life for `SILENT`, and gives none while it is watched, is
        killed, and this one takes its place.
        """
        holder = f"{fleet_file} on {socket.gethostname()}, since {began}"
        with contextlib.ExitStack() as stack:
            try:
                stack.enter_context(lock(self._database, holder))
                stuck = None
            except TakenError:
                stuck = self._find_stuck(began)
                if stuck is None:
                    raise
                _kill(stuck.process)
                _enter_soon(stack, self._database, holder)
            yield self._begin(began, stuck.began if stuck else "")

    def _begin(self, began: str, took_over: str) -> Night:
        """Begin a night; whoever does holds the lock of the ledger."""
        before = self.find_last_night()
        own = {"fleet": self._fleet, "began": began, "host": socket.gethostname(), "process": os.getpid()}
        with self._database.begin_transaction() as connection:
            identity = _add_row(connection, insert(NIGHTS).values(beat=began, **own))
        return Night(self._database, self._fleet, identity, began, before, took_over)

    def _find_stuck(self, now: str) -> Row[Any] | None:
        """Return the night at work if it is of this host, and has been silent for too long."""
        night = self._find_latest()
        if night is None or night.ended or night.host != socket.gethostname() or not night.beat:
            return None
        # A beat that is to come is of a clock that was set back since.
        silent = abs(dt.datetime.fromisoformat(now) - dt.datetime.fromisoformat(night.beat))
        if silent < SILENT or night.process == os.getpid():
            return None
        # The clock may have been set a moment ago, or the computer have slept: whoever lives soon says so.
        for _ in range(round(WATCHED / _PAUSE)):
            time.sleep(_PAUSE)
            if self._find_latest() != night:
                return None
        return night

    def _find_latest(self) -> Row[Any] | None:
        """Return the latest night of all fleets."""
        query = select(NIGHTS).order_by(NIGHTS.c.id.desc()).limit(1)
        with self._database.begin_transaction() as connection:
            return connection.execute(query).one_or_none()


def _refuse_taken(connection: Connection, number: str) -> None:
    """Refuse a number that is given, also in other case: on some systems both name the same files."""
    is_alike = func.lower(CERTIFICATES.c.number) == func.lower(number)  # a number has letters A to Z
    taken = connection.scalar(select(CERTIFICATES.c.number).where(is_alike).limit(1))
    if taken is not None:
        raise NumberTakenError(_say_taken(number, taken))


def _say_taken(number: str, taken: str) -> str:
    alike = "" if taken == number else f"differs in case alone from {taken}, which "
    return f"the number {number} {alike}was given to another certificate"


def _kill(process: int) -> None:
    """Kill a night; its workers end when they find nobody at the other end of their lines."""
    with contextlib.suppress(ProcessLookupError):
        os.kill(process, signal.SIGKILL)


def _enter_soon(stack: contextlib.ExitStack, database: Database, holder: str) -> None:
    """Hold the lock that one who was killed gives up as the system clears it away."""
    for _ in range(_ATTEMPTS):
        with contextlib.suppress(TakenError):
            stack.enter_context(lock(database, holder))
            return
        time.sleep(_PAUSE)
    stack.enter_context(lock(database, holder))


def _make_entry(row: Row[Any], parameters: tuple[RecordedParameter, ...]) -> LedgerEntry:
    return LedgerEntry(
        **_read_subject(row),
        job=row.job,
        night=row.began,
        digest=row.digest,
        state=State(row.state),
        message=row.message,
        files=tuple(file.path for file in _read_files(row.files)),
        parameters=parameters,
        doubts=tuple(_read_words(*texts) for texts in row.doubts or ()),
        seconds=row.seconds,
    )


def _read_subject(row: Row[Any]) -> dict[str, Any]:
    """Return what an entry is about; what an older program did not note is empty."""
    kept = {each.name: getattr(row, each.name) for each in fields(Subject)}
    if kept["measured"]:
        dt.date.fromisoformat(kept["measured"])  # raises ValueError for what no night wrote
    return {name: value if name == "interval" else value or "" for name, value in kept.items()}


def _read_parameter(row: Row[Any]) -> RecordedParameter:
    return RecordedParameter(
        row.standard, row.symbol, row.value, row.unit, row.expanded_uncertainty, row.limit, row.conforms
    )


def _write_words(text: Words) -> list[str]:
    """Return a sentence as it is kept: in each language."""
    return [text.in_language(language) for language in Language]


def _read_words(*texts: str) -> Words:
    """Return a sentence as it was kept in each language; an older program kept fewer."""
    return Words.of({language.value: text for language, text in zip(Language, texts, strict=False)})


def _read_files(kept: list[list[Any]]) -> tuple[KnownFile, ...]:
    return tuple(map(KnownFile.from_json, kept))
