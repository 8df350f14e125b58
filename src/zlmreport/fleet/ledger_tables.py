"""The tables of the ledger: one schema for SQLite and PostgreSQL."""

from __future__ import annotations

from sqlalchemy import (
    JSON,
    Boolean,
    Column,
    Double,
    ForeignKey,
    Index,
    Integer,
    MetaData,
    String,
    Table,
    Text,
)

#: Of these tables; a program that knows another refuses the ledger.
FORMAT = 1

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
