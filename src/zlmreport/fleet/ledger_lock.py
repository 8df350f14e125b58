"""One night at a time on one ledger; a lock that is gone when its holder is, however that ended."""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
from collections.abc import Iterator
from pathlib import Path

from sqlalchemy import func, select
from sqlalchemy.exc import SQLAlchemyError

from zlmreport.errors import AccessError, Place
from zlmreport.fleet.ledger_engine import Database, no_access, shown

#: Of the lock among all locks of a PostgreSQL database.
_KEY = int.from_bytes(hashlib.sha256(b"zlmreport fleet").digest()[:8], "big", signed=True)


@contextlib.contextmanager
def locked(database: Database, holder: str) -> Iterator[None]:
    """Hold the lock of a ledger.

    Parameters
    ----------
    database
        The ledger's.
    holder
        Who holds it, for the message to whoever comes second.

    Raises
    ------
    AccessError
        If another holds it.
    """
    if database.engine.url.get_backend_name() == "sqlite":
        with _locked_file(Path(f"{database.engine.url.database}.lock"), database.address, holder):
            yield
    else:
        with _locked_database(database):
            yield


@contextlib.contextmanager
def _locked_file(path: Path, address: str, holder: str) -> Iterator[None]:
    with path.open("a+", encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            file.seek(0)
            raise _taken(address, file.read().strip()) from None
        file.truncate(0)
        file.write(holder)
        file.flush()
        yield


@contextlib.contextmanager
def _locked_database(database: Database) -> Iterator[None]:
    """Hold a lock of a session of its own, which ends with the connection."""
    with database.engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
        try:
            has_it = connection.scalar(select(func.pg_try_advisory_lock(_KEY)))
        except SQLAlchemyError as error:
            raise no_access(database.address, error) from error
        if not has_it:
            raise _taken(database.address, "")
        yield


def _taken(address: str, holder: str) -> AccessError:
    by = f" ({holder})" if holder else ""
    message = f"another night is at work on this ledger{by}; this one does nothing"
    return AccessError([*AccessError.at(Place(shown(address)), message).problems])
