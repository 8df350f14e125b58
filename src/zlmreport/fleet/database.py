"""The database of a ledger, in SQLite or PostgreSQL: its tables, its format, the lock of a night.

The lock is gone when its holder is, however that ended.
"""

from __future__ import annotations

import contextlib
import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from sqlalchemy import (
    JSON,
    URL,
    Boolean,
    Column,
    Connection,
    Double,
    Engine,
    ForeignKey,
    Index,
    Integer,
    MetaData,
    String,
    Table,
    Text,
    create_engine,
    event,
    func,
    insert,
    make_url,
    select,
    text,
    update,
)
from sqlalchemy.exc import ArgumentError, IntegrityError, NoSuchModuleError, SQLAlchemyError
from sqlalchemy.pool import StaticPool

from zlmreport.errors import AccessError, InputError, Place, ZlmreportError

#: Of these tables; a program that knows another refuses the ledger.
FORMAT = 7

METADATA = MetaData()

FORMATS = Table("ledger_format", METADATA, Column("format", Integer, primary_key=True, autoincrement=False))

#: Each run of a fleet; one that never ended was interrupted.
NIGHTS = Table(
    "nights",
    METADATA,
    Column("id", Integer, primary_key=True),
    Column("fleet", String, nullable=False),
    Column("began", String, nullable=False),
    Column("ended", String),
    Column("host", String, nullable=False),
    Column("process", Integer, nullable=False),
    Column("beat", String),
    Column("notices", JSON),
    Column("untried", JSON),
)

#: What became of a job in a night in which something became of it; rows are only ever added.
ENTRIES = Table(
    "entries",
    METADATA,
    Column("id", Integer, primary_key=True),
    Column("fleet", String, nullable=False),
    Column("night", ForeignKey("nights.id"), nullable=False),
    Column("job", String, nullable=False),
    Column("number", String, nullable=False),
    Column("machine", String, nullable=False),
    Column("axis", String, nullable=False),
    Column("measured", String, nullable=False),
    Column("digest", String, nullable=False),
    Column("state", String, nullable=False),
    Column("message", Text, nullable=False),
    Column("files", JSON, nullable=False),
    Column("basis", JSON),
    Column("seconds", Double),
    Column("interval", Integer),
    Column("instrument", String),
    Column("type", String),
    Column("lesson", JSON(none_as_null=True)),
    Column("doubts", JSON(none_as_null=True)),
    Index("entries_of_jobs", "fleet", "job", "id"),
)

#: What a certificate states.
PARAMETERS = Table(
    "parameters",
    METADATA,
    Column("entry", ForeignKey("entries.id"), primary_key=True),
    Column("row", Integer, primary_key=True),
    Column("standard", String, nullable=False),
    Column("symbol", String, nullable=False),
    Column("value", Double, nullable=False),
    Column("unit", String, nullable=False),
    Column("expanded_uncertainty", Double),
    Column("limit", Double),
    Column("conforms", Boolean),
)

#: The certificates that were issued. The key is what keeps a number from being given twice, whatever program
#: writes here.
CERTIFICATES = Table(
    "certificates",
    METADATA,
    Column("number", String, primary_key=True),
    Column("entry", ForeignKey("entries.id"), nullable=False),
    Column("files", JSON, nullable=False),
)

#: What was new in a night; `told` has the ways by which people heard of it, and `ended` the night in which a
#: condition was over.
NEWS = Table(
    "news",
    METADATA,
    Column("id", Integer, primary_key=True),
    Column("fleet", String, nullable=False),
    Column("night", ForeignKey("nights.id"), nullable=False),
    Column("kind", String, nullable=False),
    Column("subject", String, nullable=False),
    Column("text", Text, nullable=False),
    Column("told", JSON, nullable=False),
    Column("ended", Integer),
)


#: That are copied at a time.
_ROWS = 1000
_DATABASES = ("sqlite", "postgresql")
#: For which a program that also reads or writes the ledger may keep it, s.
_PATIENCE = 30


@dataclass(frozen=True, slots=True)
class Database:
    """The database of a ledger, open."""

    engine: Engine  #: Of SQLAlchemy.
    address: str  #: Path of an SQLite file, or a URL.

    @contextlib.contextmanager
    def begin_transaction(self) -> Iterator[Connection]:
        """Yield a connection whose work is kept whole or not at all.

        Raises `AccessError` if the database cannot be used; `IntegrityError` if the work is against the rules
        of the tables.
        """
        try:
            with self.engine.begin() as connection:
                yield connection
        except IntegrityError:
            raise
        except SQLAlchemyError as error:
            raise _make_no_access(self.address, error) from error

    @contextlib.contextmanager
    def begin_reading(self) -> Iterator[Connection]:
        """Yield a connection to read by; raise `AccessError`, too, for what no night wrote."""
        with self.begin_transaction() as connection:
            try:
                yield connection
            except (ValueError, TypeError, LookupError) as error:
                what = " ".join(str(error).split())[:300]
                raise AccessError.at(
                    Place(_show_address(self.address)),
                    f"the ledger holds what no night wrote: {what}; move it away, and put its backup back or "
                    "make it again (zlmreport fleet rebuild)",
                ) from error


def open_database(address: str, *, create: bool) -> Database:
    """Open the database of a ledger, with its tables.

    `address`: Path of an SQLite file, or the URL of a database.
    `create`: Whether a file that is not there is made; if not, the ledger is as if it were empty.

    Raises `InputError` if the address is none, or the ledger is of another version of the program;
    `AccessError` if the database cannot be opened.
    """
    url = _make_url_of(address)
    is_new_file = url.get_backend_name() == "sqlite" and not Path(url.database or "").exists()
    if is_new_file and not create:
        url = URL.create("sqlite")
    database = Database(_make_engine(url, address), address)
    try:
        for _ in METADATA.sorted_tables:  # each may be made by the other just before
            with contextlib.suppress(_MadeMeanwhileError):
                _lay_out_tables(database)
                return database
        _lay_out_tables(database)
    except ZlmreportError:
        database.engine.dispose()
        raise
    return database


class _MadeMeanwhileError(AccessError):
    """Another night makes the same tables at this moment."""


def _lay_out_tables(database: Database) -> None:
    try:
        with database.begin_transaction() as connection:
            METADATA.create_all(connection)
            _demand_format(connection, database.address)
    except IntegrityError as error:
        raise _MadeMeanwhileError(_make_no_access(database.address, error).problems) from error
    except AccessError as error:
        if "already exists" in str(error):
            raise _MadeMeanwhileError(error.problems) from error
        raise


def copy(database: Database, to: Path) -> None:
    """Copy a ledger into an SQLite file that appears whole or not at all."""
    with TemporaryDirectory(dir=to.parent, prefix=f".{to.name}.") as folder:
        file = Path(folder) / to.name
        made = create_engine(URL.create("sqlite", database=str(file)))
        with database.begin_transaction() as source, made.begin() as target:
            METADATA.create_all(target)
            for table in METADATA.sorted_tables:
                for rows in source.execute(select(table)).mappings().partitions(_ROWS):
                    target.execute(insert(table), [dict(row) for row in rows])
        made.dispose()
        file.replace(to)


def _make_url_of(address: str) -> URL:
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


def _show_address(address: str) -> str:
    """Return the address without its password."""
    return _make_url_of(address).render_as_string(hide_password=True) if "://" in address else address


def _make_no_access(address: str, error: SQLAlchemyError) -> AccessError:
    reason = getattr(error, "orig", None) or error
    message = f"the ledger cannot be used: {' '.join(str(reason).split())[:300]}"
    return AccessError([*AccessError.at(Place(_show_address(address)), message).problems])


def _make_engine(url: URL, address: str) -> Engine:
    if url.get_backend_name() == "sqlite":
        if not url.database:
            return create_engine(url, poolclass=StaticPool)
        try:
            Path(url.database).parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            message = f"its folder cannot be made: {error.strerror or error}"
            raise AccessError.at(Place(address), message) from error
        engine = create_engine(url, connect_args={"timeout": _PATIENCE})
        event.listen(engine, "connect", _make_durable)
        return engine
    try:
        return create_engine(url, pool_pre_ping=True)
    except (NoSuchModuleError, ModuleNotFoundError) as error:
        message = f"{error}; install zlmreport[cluster], and write postgresql+psycopg://…"
        raise InputError.at(Place(_show_address(address)), message) from error


def _make_durable(connection: Any, _record: Any) -> None:
    """Let readers in while it is written, and lose nothing when the power fails."""
    for pragma in ("journal_mode = WAL", "synchronous = FULL", "foreign_keys = ON"):
        connection.execute(f"PRAGMA {pragma}")


#: What makes tables of each older format those of the next.
_SINCE = {
    1: (
        "ALTER TABLE nights ADD COLUMN beat VARCHAR",
        "ALTER TABLE entries ADD COLUMN seconds DOUBLE PRECISION",
        "ALTER TABLE entries ADD COLUMN interval INTEGER",
    ),
    2: (
        "ALTER TABLE nights ADD COLUMN notices JSON",
        "ALTER TABLE entries ADD COLUMN instrument VARCHAR",
    ),
    3: ("ALTER TABLE entries ADD COLUMN type VARCHAR",),
    4: ("ALTER TABLE entries ADD COLUMN lesson JSON",),
    5: ("ALTER TABLE nights ADD COLUMN untried JSON",),
    6: ("ALTER TABLE entries ADD COLUMN doubts JSON",),
}


def _demand_format(connection: Connection, address: str) -> None:
    """Bring older tables up to date, and refuse those of a newer version; new ones get this one's stamp."""
    found = connection.scalar(select(FORMATS.c.format))
    if found is None:
        connection.execute(insert(FORMATS).values(format=FORMAT))
    elif found in _SINCE:
        for older in range(found, FORMAT):
            for addition in _SINCE[older]:
                connection.execute(text(addition))
        connection.execute(update(FORMATS).values(format=FORMAT))
    elif found != FORMAT:
        raise InputError.at(
            Place(_show_address(address)),
            f"is a ledger of format {found}, and this program writes format {FORMAT}; "
            "use the version of zlmreport that wrote it",
        )


#: Of the lock among all locks of a PostgreSQL database.
_KEY = int.from_bytes(hashlib.sha256(b"zlmreport fleet").digest()[:8], "big", signed=True)


@contextlib.contextmanager
def lock(database: Database, holder: str) -> Iterator[None]:
    """Hold the lock of a ledger.

    Raises `AccessError` if another holds it.
    """
    if database.engine.url.get_backend_name() == "sqlite":
        with _lock_file(Path(f"{database.engine.url.database}.lock"), database.address, holder):
            yield
    else:
        with _lock_database(database):
            yield


@contextlib.contextmanager
def _lock_file(path: Path, address: str, holder: str) -> Iterator[None]:
    try:
        import fcntl  # noqa: PLC0415 - not on every system
    except ImportError as error:
        message = "a ledger in a file needs Linux or macOS; state one in a PostgreSQL database"
        raise AccessError.at(Place(address), message) from error
    with path.open("a+", encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            file.seek(0)
            raise _raise_taken(address, file.read().strip()) from None
        file.truncate(0)
        file.write(holder)
        file.flush()
        yield


@contextlib.contextmanager
def _lock_database(database: Database) -> Iterator[None]:
    """Hold a lock of a session of its own, which ends with the connection."""
    with database.engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
        try:
            has_it = connection.scalar(select(func.pg_try_advisory_lock(_KEY)))
        except SQLAlchemyError as error:
            raise _make_no_access(database.address, error) from error
        if not has_it:
            raise _raise_taken(database.address, "")
        yield


class TakenError(AccessError):
    """Another holds the lock of a ledger."""


def _raise_taken(address: str, holder: str) -> TakenError:
    by = f" ({holder})" if holder else ""
    message = f"another night is at work on this ledger{by}; this one does nothing"
    return TakenError([*AccessError.at(Place(_show_address(address)), message).problems])
