"""A night at work: all that is ever written to a ledger."""

from __future__ import annotations

import os
import socket
from collections.abc import Sequence
from dataclasses import asdict, dataclass

from sqlalchemy import Connection, Insert, insert, select, update
from sqlalchemy.exc import IntegrityError

from zlmreport.fleet.basis import Basis, KnownFile
from zlmreport.fleet.ledger_engine import Database
from zlmreport.fleet.ledger_tables import CERTIFICATES, ENTRIES, NIGHTS, PARAMETERS
from zlmreport.fleet.records import Entry


class NumberTakenError(Exception):
    """The number of a certificate is another's."""


@dataclass(frozen=True, slots=True)
class Night:
    """A night at work.

    Attributes
    ----------
    database
        Of the ledger.
    fleet
        Name of the fleet.
    identity
        Of the night in the ledger.
    began
        Date and time, ISO 8601 in UTC.
    was_interrupted
        Whether the night before never came to its end.
    """

    database: Database
    fleet: str
    identity: int
    began: str
    was_interrupted: bool

    def add(self, entry: Entry, files: Sequence[KnownFile] = (), basis: Basis | None = None) -> None:
        """Add an entry that issues nothing: a draft or a failure."""
        with self.database.transaction() as connection:
            self._insert(connection, entry, files, basis)

    def issue(self, entry: Entry, files: Sequence[KnownFile], basis: Basis) -> None:
        """Add the entry of a certificate, and in the same transaction its number and its files.

        A number that this fleet gave before keeps its first entry, and its files are those of now.

        Raises
        ------
        NumberTakenError
            If the number is that of another fleet's certificate.
        """
        kept = [file.as_json() for file in files]
        own = select(ENTRIES.c.id).where(ENTRIES.c.fleet == self.fleet)
        renewal = (
            update(CERTIFICATES)
            .where(CERTIFICATES.c.number == entry.number, CERTIFICATES.c.entry.in_(own))
            .values(files=kept)
        )
        try:
            with self.database.transaction() as connection:
                identity = self._insert(connection, entry, files, basis)
                if not connection.execute(renewal).rowcount:
                    first = insert(CERTIFICATES).values(number=entry.number, entry=identity, files=kept)
                    connection.execute(first)
        except IntegrityError as error:
            raise NumberTakenError(entry.number) from error

    def end(self, ended: str) -> None:
        """Note that the night has come to its end."""
        with self.database.transaction() as connection:
            connection.execute(update(NIGHTS).where(NIGHTS.c.id == self.identity).values(ended=ended))

    def _insert(
        self, connection: Connection, entry: Entry, files: Sequence[KnownFile], basis: Basis | None
    ) -> int:
        identity = _added(
            connection,
            insert(ENTRIES).values(
                fleet=self.fleet,
                night=self.identity,
                job=entry.job,
                number=entry.number,
                machine=entry.machine,
                axis=entry.axis,
                measured=entry.measured,
                digest=entry.digest,
                state=str(entry.state),
                message=entry.message,
                files=[file.as_json() for file in files],
                basis=basis.as_json() if basis else None,
            ),
        )
        if entry.parameters:
            rows = [
                {"entry": identity, "row": row, **asdict(parameter)}
                for row, parameter in enumerate(entry.parameters)
            ]
            connection.execute(insert(PARAMETERS), rows)
        return identity


def begin(database: Database, fleet: str, began: str) -> Night:
    """Begin a night; whoever does holds the lock of the ledger.

    Parameters
    ----------
    database
        Of the ledger.
    fleet
        Name of the fleet.
    began
        Date and time, ISO 8601 in UTC.
    """
    last = select(NIGHTS.c.ended).where(NIGHTS.c.fleet == fleet).order_by(NIGHTS.c.id.desc()).limit(1)
    own = insert(NIGHTS).values(fleet=fleet, began=began, host=socket.gethostname(), process=os.getpid())
    with database.transaction() as connection:
        before = connection.execute(last).first()
        identity = _added(connection, own)
    was_interrupted = before is not None and before.ended is None
    return Night(database, fleet, identity, began, was_interrupted)


def _added(connection: Connection, row: Insert) -> int:
    """Add a row and return its key."""
    key = connection.execute(row).inserted_primary_key
    if key is None:
        raise TypeError("an insert of one row has a key")
    identity: int = key[0]
    return identity
