"""The ledger of a fleet: every certificate with what it states, in SQLite or PostgreSQL."""

from __future__ import annotations

import contextlib
import itertools
import socket
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Self

from sqlalchemy import Row, Select, func, select

from zlmreport.fleet.basis import Basis, KnownFile
from zlmreport.fleet.ledger_engine import Database, open_database
from zlmreport.fleet.ledger_lock import locked
from zlmreport.fleet.ledger_night import Night, begin
from zlmreport.fleet.ledger_tables import CERTIFICATES, ENTRIES, NIGHTS, PARAMETERS
from zlmreport.fleet.records import Entry, RecordedParameter, State


@dataclass(frozen=True, slots=True)
class Standing:
    """What the ledger knows of a job: the last that became of it.

    Attributes
    ----------
    number, state, night, message
        As `Entry` has them.
    files
        Its certificate's, or its draft's.
    basis
        What they were made from; None of a job that failed.
    """

    number: str
    state: State
    night: str
    message: str
    files: tuple[KnownFile, ...]
    basis: Basis | None


@dataclass(frozen=True, slots=True)
class Issued:
    """A certificate that was issued, whichever fleet it belongs to.

    Attributes
    ----------
    fleet, job
        For which it was made.
    night
        In which it was made.
    files
        Its files.
    """

    fleet: str
    job: str
    night: str
    files: tuple[KnownFile, ...]


class Ledger:
    """The ledger of one fleet, open; it is left as a context manager, which closes the database."""

    def __init__(self, database: Database, fleet: str) -> None:
        self._database = database
        self._fleet = fleet

    @classmethod
    def open(cls, address: str, fleet: str, *, create: bool = True) -> Self:
        """Open a ledger.

        Parameters
        ----------
        address
            Path of an SQLite file, or the URL of a database.
        fleet
            Name of the fleet: several may share one ledger.
        create
            Whether a ledger that is not there is made; if not, it is as if it were empty.

        Raises
        ------
        InputError
            If the address is none, or the ledger is of another version of the program.
        AccessError
            If the database cannot be opened.
        """
        return cls(open_database(address, create=create), fleet)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close the database."""
        self._database.engine.dispose()

    def entries(self) -> Iterator[Entry]:
        """Yield the whole history of the fleet with parameters, oldest first; drafts and failures too."""
        yield from self._read(select(ENTRIES.c.id))

    def latest(self) -> tuple[Entry, ...]:
        """Return the latest entry of every job, in the order of job files."""
        latest = select(func.max(ENTRIES.c.id)).where(ENTRIES.c.fleet == self._fleet).group_by(ENTRIES.c.job)
        return tuple(sorted(self._read(latest), key=lambda entry: entry.job))

    def issued(self) -> tuple[Entry, ...]:
        """Return the entries by which certificates were issued, one a number, oldest first."""
        return tuple(self._read(select(CERTIFICATES.c.entry)))

    def last_night(self) -> tuple[str, str | None] | None:
        """Return when the last night of the fleet began and ended, ISO 8601 in UTC; None before the first.

        One that is at work, or was interrupted, has not ended.
        """
        query = select(NIGHTS).where(NIGHTS.c.fleet == self._fleet).order_by(NIGHTS.c.id.desc()).limit(1)
        with self._database.transaction() as connection:
            night = connection.execute(query).one_or_none()
        return (night.began, night.ended) if night else None

    def standings(self) -> Mapping[str, Standing]:
        """Return what the ledger knows of each job, by its path."""
        latest = select(func.max(ENTRIES.c.id)).where(ENTRIES.c.fleet == self._fleet).group_by(ENTRIES.c.job)
        query = (
            select(ENTRIES, NIGHTS.c.began)
            .join(NIGHTS, ENTRIES.c.night == NIGHTS.c.id)
            .where(ENTRIES.c.id.in_(latest))
        )
        with self._database.transaction() as connection:
            return {
                row.job: Standing(
                    row.number,
                    State(row.state),
                    row.began,
                    row.message,
                    _files(row.files),
                    Basis.from_json(row.basis) if row.basis else None,
                )
                for row in connection.execute(query)
            }

    def certificates(self) -> Mapping[str, Issued]:
        """Return every certificate that was issued by its number, those of other fleets too."""
        query = (
            select(CERTIFICATES, ENTRIES.c.fleet, ENTRIES.c.job, NIGHTS.c.began)
            .join(ENTRIES, CERTIFICATES.c.entry == ENTRIES.c.id)
            .join(NIGHTS, ENTRIES.c.night == NIGHTS.c.id)
        )
        with self._database.transaction() as connection:
            return {
                row.number: Issued(row.fleet, row.job, row.began, _files(row.files))
                for row in connection.execute(query)
            }

    @contextlib.contextmanager
    def night(self, began: str, fleet_file: str) -> Iterator[Night]:
        """Let one night at a time write to the ledger, whichever fleet it is.

        Parameters
        ----------
        began
            Date and time, ISO 8601 in UTC.
        fleet_file
            For the message to whoever comes second.

        Raises
        ------
        AccessError
            If another is at work on it.
        """
        holder = f"{fleet_file} on {socket.gethostname()}, since {began}"
        with locked(self._database, holder):
            yield begin(self._database, self._fleet, began)

    def _read(self, chosen: Select[Any]) -> Iterator[Entry]:
        """Yield some entries with their parameters, oldest first."""
        own = (ENTRIES.c.fleet == self._fleet, ENTRIES.c.id.in_(chosen))
        entries = (
            select(ENTRIES, NIGHTS.c.began)
            .join(NIGHTS, ENTRIES.c.night == NIGHTS.c.id)
            .where(*own)
            .order_by(ENTRIES.c.id)
        )
        parameters = (
            select(PARAMETERS)
            .join(ENTRIES, PARAMETERS.c.entry == ENTRIES.c.id)
            .where(*own)
            .order_by(PARAMETERS.c.entry, PARAMETERS.c.row)
        )
        with self._database.transaction() as connection:
            stated = {
                entry: tuple(map(_parameter, rows))
                for entry, rows in itertools.groupby(connection.execute(parameters), lambda row: row.entry)
            }
            rows = connection.execute(entries).all()
        for row in rows:
            yield _entry(row, stated.get(row.id, ()))


def _entry(row: Row[Any], parameters: tuple[RecordedParameter, ...]) -> Entry:
    return Entry(
        job=row.job,
        number=row.number,
        machine=row.machine,
        axis=row.axis,
        measured=row.measured,
        night=row.began,
        digest=row.digest,
        state=State(row.state),
        message=row.message,
        files=tuple(file.path for file in _files(row.files)),
        parameters=parameters,
    )


def _parameter(row: Row[Any]) -> RecordedParameter:
    return RecordedParameter(
        row.standard, row.symbol, row.value, row.unit, row.expanded_uncertainty, row.limit, row.conforms
    )


def _files(kept: list[list[Any]]) -> tuple[KnownFile, ...]:
    return tuple(map(KnownFile.from_json, kept))
