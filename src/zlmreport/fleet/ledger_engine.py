"""Opening the database of a ledger, whichever it is."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sqlalchemy import URL, Connection, Engine, create_engine, event, insert, make_url, select
from sqlalchemy.exc import ArgumentError, IntegrityError, NoSuchModuleError, SQLAlchemyError
from sqlalchemy.pool import StaticPool

from zlmreport.errors import AccessError, InputError, Place, ZlmreportError
from zlmreport.fleet.ledger_tables import FORMAT, FORMATS, METADATA

_DATABASES = ("sqlite", "postgresql")
#: For which a program that also reads or writes the ledger may keep it, s.
_PATIENCE = 30


@dataclass(frozen=True, slots=True)
class Database:
    """The database of a ledger, open.

    Attributes
    ----------
    engine
        Of SQLAlchemy.
    address
        Path of an SQLite file, or a URL.
    """

    engine: Engine
    address: str

    @contextlib.contextmanager
    def transaction(self) -> Iterator[Connection]:
        """Yield a connection whose work is kept whole or not at all.

        Raises
        ------
        AccessError
            If the database cannot be used.
        IntegrityError
            If the work is against the rules of the tables.
        """
        try:
            with self.engine.begin() as connection:
                yield connection
        except IntegrityError:
            raise
        except SQLAlchemyError as error:
            raise no_access(self.address, error) from error


def open_database(address: str, *, create: bool) -> Database:
    """Open the database of a ledger, with its tables.

    Parameters
    ----------
    address
        Path of an SQLite file, or the URL of a database.
    create
        Whether a file that is not there is made; if not, the ledger is as if it were empty.

    Raises
    ------
    InputError
        If the address is none, or the ledger is of another version of the program.
    AccessError
        If the database cannot be opened.
    """
    url = url_of(address)
    is_new_file = url.get_backend_name() == "sqlite" and not Path(url.database or "").exists()
    if is_new_file and not create:
        url = URL.create("sqlite")
    database = Database(_engine(url, address), address)
    try:
        with database.transaction() as connection:
            METADATA.create_all(connection)
            _demand_format(connection, address)
    except ZlmreportError:
        database.engine.dispose()
        raise
    return database


def url_of(address: str) -> URL:
    """Return the URL of a ledger."""
    if "://" not in address:
        return URL.create("sqlite", database=address)
    try:
        url = make_url(address)
    except ArgumentError:
        raise InputError.at(Place("ledger"), f"{address!r} is no URL of a database") from None
    if url.get_backend_name() not in _DATABASES:
        raise InputError.at(
            Place("ledger"), f"a ledger is in SQLite or PostgreSQL, not in {url.get_backend_name()}"
        )
    return url


def shown(address: str) -> str:
    """Return the address without its password."""
    return url_of(address).render_as_string(hide_password=True) if "://" in address else address


def no_access(address: str, error: SQLAlchemyError) -> AccessError:
    """Return the error of a ledger that cannot be used."""
    reason = getattr(error, "orig", None) or error
    message = f"the ledger cannot be used: {' '.join(str(reason).split())[:300]}"
    return AccessError([*AccessError.at(Place(shown(address)), message).problems])


def _engine(url: URL, address: str) -> Engine:
    if url.get_backend_name() == "sqlite":
        if not url.database:
            return create_engine(url, poolclass=StaticPool)
        try:
            Path(url.database).parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            message = f"its folder cannot be made: {error.strerror or error}"
            raise AccessError.at(Place(address), message) from error
        engine = create_engine(url, connect_args={"timeout": _PATIENCE})
        event.listen(engine, "connect", _made_durable)
        return engine
    try:
        return create_engine(url, pool_pre_ping=True)
    except (NoSuchModuleError, ModuleNotFoundError) as error:
        message = f"{error}; install zlmreport[cluster], and write postgresql+psycopg://…"
        raise InputError.at(Place(shown(address)), message) from error


def _made_durable(connection: Any, _record: Any) -> None:
    """Let readers in while it is written, and lose nothing when the power fails."""
    for pragma in ("journal_mode = WAL", "synchronous = FULL", "foreign_keys = ON"):
        connection.execute(f"PRAGMA {pragma}")


def _demand_format(connection: Connection, address: str) -> None:
    """Refuse the tables of another version; new ones are stamped with this one's."""
    found = connection.scalars(select(FORMATS.c.format)).all()
    if not found:
        connection.execute(insert(FORMATS).values(format=FORMAT))
    elif list(found) != [FORMAT]:
        raise InputError.at(
            Place(shown(address)),
            f"is a ledger of format {found[0]}, and this program writes format {FORMAT}; "
            "use the version of zlmreport that wrote it",
        )
