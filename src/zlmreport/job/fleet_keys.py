"""The keys of a fleet file."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator, Field, model_validator

from zlmreport.errors import did_you_mean
from zlmreport.job.located import LocatedText
from zlmreport.job.options import JobPath
from zlmreport.job.part import JobPart
from zlmreport.job.references import path_named
from zlmreport.job.text import quoted
from zlmreport.job.types import Text

#: What a layout can be made of.
PLACEHOLDERS = ("machine", "manufacturer", "model", "serial", "axis", "number")

_PLACEHOLDER = re.compile(r"\{([^{}]*)\}")
_DATABASES = ("postgresql", "sqlite")
_URL = re.compile(r"[a-z][a-z0-9+]*://")


def _layout(text: str) -> str:
    """Refuse a layout with a placeholder that there is not, or that leads out of the folder."""
    unknown = next((name for name in _PLACEHOLDER.findall(text) if name not in PLACEHOLDERS), None)
    if unknown is not None:
        raise ValueError(f"unknown placeholder {quoted(unknown)}; {did_you_mean(unknown, PLACEHOLDERS)}")
    if set("{}") & set(_PLACEHOLDER.sub("", text)):
        raise ValueError(f"{quoted(text)} has a brace too many or too few; write {{machine}}")
    if text.startswith("/") or ".." in text.split("/"):
        raise ValueError(f"{quoted(text)} leads out of the output folder; name folders in it")
    return text


def _address(value: Any) -> Any:
    """Take the URL of a database as it is, and anything else for a file beside the naming one."""
    if not isinstance(value, LocatedText):
        return value
    if not _URL.match(value):
        return str(path_named(str(value), Path(value.place.file)))
    if not value.startswith(_DATABASES):
        raise ValueError(
            f"{quoted(value)} is no ledger; write a file, or {_DATABASES[0]}+psycopg://server/fleet"
        )
    return value


class FleetOutput(JobPart):
    """The files of the fleet."""

    directory: JobPath | None = Field(
        None,
        description="Folder of all files; `certificates` beside the fleet file without it.",
        examples=["certificates"],
    )
    layout: Annotated[Text, AfterValidator(_layout)] = Field(
        "{machine}/{axis}",
        description="Folders in it, by what the job says: "
        + ", ".join(f"{{{name}}}" for name in PLACEHOLDERS)
        + ". A certificate stays where it was issued.",
        examples=["{machine}/{axis}"],
    )
    formats: list[Text] | None = Field(
        None,
        min_length=1,
        description="Identifiers of installed renderers, instead of those that the jobs name.",
        examples=[["pdf", "json"]],
    )


class ExecutorKeys(JobPart):
    """What makes the certificates."""

    kind: Literal["processes", "dask"] = Field(
        "processes", description="Processes on this machine, or the workers of a Dask scheduler."
    )
    workers: int | None = Field(
        None, ge=1, le=1024, description="Number of processes; one a processor without it.", examples=[4]
    )
    scheduler: Text | None = Field(
        None, description="Address of the Dask scheduler.", examples=["tcp://scheduler:8786"]
    )

    @model_validator(mode="after")
    def _one_or_the_other(self) -> ExecutorKeys:
        """Refuse keys that belong to the other kind."""
        if self.kind == "dask" and self.scheduler is None:
            raise ValueError("dask needs its scheduler's address, such as scheduler: tcp://scheduler:8786")
        if self.kind == "dask" and self.workers is not None:
            raise ValueError("the scheduler knows its workers; remove workers")
        if self.kind == "processes" and self.scheduler is not None:
            raise ValueError("processes have no scheduler; write kind: dask")
        return self


class LogKeys(JobPart):
    """What is kept of each night for people."""

    file: JobPath = Field(description="File that gets the lines of each night.", examples=["fleet.log"])
    format: Literal["text", "json"] = Field("text", description="Lines for people, or JSON lines.")


class FleetKeys(JobPart):
    """A fleet file: the certificates of many axes."""

    schema_: Literal["zlmreport/fleet/1"] = Field(
        alias="schema", description="Version of this format.", examples=["zlmreport/fleet/1"]
    )
    name: Text | None = Field(
        None,
        description="Name of the fleet, in its overview and in a ledger that several share; the file's stem "
        "without it.",
        examples=["Hall North"],
    )
    language: Literal["en", "de"] = Field(
        "en", description="Language of the overview; the certificates have those of their jobs."
    )
    jobs: list[Text] | Text = Field(
        description="Job files relative to this file: paths, or with the wildcards `*`, `?`, `[…]` and `**`.",
        examples=[["machines/*/*.yaml"]],
    )
    defaults: dict[str, Any] = Field(
        default_factory=dict,
        description="Keys of a job that all jobs build on, as if they extended a file of them.",
        examples=[{"decision_rule": "guard-band"}],
    )
    output: FleetOutput = Field(default_factory=FleetOutput, description="The files of the fleet.")
    executor: ExecutorKeys = Field(default_factory=ExecutorKeys, description="What makes the certificates.")
    ledger: Annotated[str, BeforeValidator(_address)] | None = Field(
        None,
        description="The ledger: an SQLite file, or the URL of a PostgreSQL database; the file's stem with "
        "`.ledger.db` without it.",
        examples=["postgresql+psycopg://zlmreport@server/fleet"],
    )
    log: LogKeys | None = Field(None, description="What is kept of each night for people.")
