"""The keys of a fleet file, checked: jobs, output (names of its files), ledger, limits, log, notify."""

from __future__ import annotations

import fnmatch
import glob
import os.path
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, model_validator

from zlmreport.errors import InputError, Place, Problem, did_you_mean, quoted
from zlmreport.files import confine as confined, demand, say_outside
from zlmreport.job.contradictions import find_problems_in_part, validate
from zlmreport.job.extends import FLEET, Defaults, read_composition, refuse_other_format
from zlmreport.job.keys import JobKeys
from zlmreport.job.parse import LARGEST, parse
from zlmreport.job.tree import Items, Keys, Scalar, find_key_place, place_of, walk
from zlmreport.job.types import (
    JobPart,
    JobPath,
    LocatedText,
    Text,
    list_keys_in,
    optional,
    resolve_path_named,
)
from zlmreport.language import Language

if TYPE_CHECKING:
    from zlmreport.plugin.extending import Extension

#: What a layout can be made of.
PLACEHOLDERS = ("machine", "manufacturer", "model", "serial", "axis", "number")

_PLACEHOLDER = re.compile(r"\{([^{}]*)\}")
_DATABASES = ("postgresql", "sqlite")
_URL = re.compile(r"[a-z][a-z0-9+]*://")


def _check_layout(text: str) -> str:
    """Refuse a layout with a placeholder that there is not, or that leads out of the folder."""
    unknown = next((name for name in _PLACEHOLDER.findall(text) if name not in PLACEHOLDERS), None)
    if unknown is not None:
        raise ValueError(f"unknown placeholder {quoted(unknown)}; {did_you_mean(unknown, PLACEHOLDERS)}")
    if set("{}") & set(_PLACEHOLDER.sub("", text)):
        raise ValueError(f"{quoted(text)} has a brace too many or too few; write {{machine}}")
    if text.startswith("/") or ".." in text.split("/"):
        raise ValueError(f"{quoted(text)} leads out of the output folder; name folders in it")
    return text


def _take_address(value: Any) -> Any:
    """Take the URL of a database as it is, and anything else for a file beside the naming one."""
    if not isinstance(value, LocatedText):
        return value
    if not _URL.match(value):
        return str(resolve_path_named(str(value), Path(value.place.file)))
    if not value.startswith(_DATABASES):
        raise ValueError(
            f"{quoted(value)} is no ledger; write a file, or {_DATABASES[0]}+psycopg://server/fleet"
        )
    return value


class FleetOutput(JobPart):
    """The files of the fleet."""

    directory: JobPath | None = optional(
        "Folder of all files; `certificates` beside the fleet file without it.", example="certificates"
    )
    layout: Annotated[Text, AfterValidator(_check_layout)] = Field(
        "{machine}/{axis}",
        description="Folders in it, by what the job says: "
        + ", ".join(f"{{{name}}}" for name in PLACEHOLDERS)
        + ". A certificate stays where it was issued.",
        examples=["{machine}/{axis}"],
    )
    formats: list[Text] | None = optional(
        "Identifiers of installed renderers, instead of those that the jobs name.",
        example=["pdf", "json"],
        min_length=1,
    )


class ExecutorKeys(JobPart):
    """What makes the certificates."""

    kind: Literal["processes", "dask"] = Field(
        "processes", description="Processes on this machine, or the workers of a Dask scheduler."
    )
    workers: int | None = optional(
        "Number of processes; one a processor without it.", example=4, ge=1, le=1024
    )
    scheduler: Text | None = optional("Address of the Dask scheduler.", example="tcp://scheduler:8786")

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


class LimitKeys(JobPart):
    """What a single job may take, so that one that hangs or grows leaves the others alone."""

    seconds: float | None = optional(
        "Time for a job; 600 without it, or ten times the longest that this job ever took.", example=600, gt=0
    )
    megabytes: int = Field(2000, ge=100, description="Memory for a job's own data.", examples=[2000])


class LogKeys(JobPart):
    """What is kept of each night for people."""

    file: JobPath = Field(description="File that gets the lines of each night.", examples=["fleet.log"])
    format: Literal["text", "json"] = Field("text", description="Lines for people, or JSON lines.")


class NotifyKeys(BaseModel):
    """A way to tell people; the plugin's own keys follow."""

    model_config = ConfigDict(defer_build=True, extra="allow", frozen=True)

    plugin: Text = Field(description="Identifier of an installed notifier.", examples=["mail"])
    tells: list[Literal["digest", "certificate", "failure"]] = Field(
        ["digest"],
        min_length=1,
        description="What it tells: the digest of a night, each certificate issued, each job that fails.",
        examples=[["digest", "failure"]],
    )


class FleetKeys(JobPart):
    """A fleet file: the certificates of many axes."""

    schema_: Literal["zlmreport/fleet/1"] = Field(
        alias="schema", description="Version of this format.", examples=["zlmreport/fleet/1"]
    )
    name: Text | None = optional(
        "Name of the fleet, in its overview and in a ledger that several share; the file's stem without it.",
        example="Hall North",
    )
    language: Language = Field(
        Language.ENGLISH,
        description="Language of the overview and of the news; the certificates have those of their jobs.",
    )
    jobs: list[Text] | Text = Field(
        description="Job files relative to this file: paths, or with the wildcards `*`, `?`, `[…]` and `**`.",
        examples=[["machines/*/*.yaml"]],
    )
    defaults: dict[str, Any] = Field(
        {},
        description="Keys of a job that all jobs build on, as if they extended a file of them.",
        examples=[{"decision_rule": "guard-band"}],
    )
    output: FleetOutput = Field(default_factory=FleetOutput, description="The files of the fleet.")
    executor: ExecutorKeys = Field(default_factory=ExecutorKeys, description="What makes the certificates.")
    limits: LimitKeys = Field(default_factory=LimitKeys, description="What a single job may take.")
    interval: int | None = optional(
        "Days after which an axis is to be measured again; overdue ones are reported. A job may "
        "state its own as `fleet: {interval: …}`.",
        example=365,
        ge=1,
    )
    retired: list[Text] = Field(
        [],
        description="Jobs, as the ledger names them, and certificates, by their numbers, that are gone on "
        "purpose, with wildcards; any other that is gone is reported.",
        examples=[["machines/old-mill/*.yaml"]],
    )
    ledger: Annotated[str, BeforeValidator(_take_address)] | None = optional(
        "The ledger: an SQLite file, or the URL of a PostgreSQL database; the file's stem with "
        "`.ledger.db` without it.",
        example="postgresql+psycopg://zlmreport@server/fleet",
    )
    priors: JobPath | None = optional(
        "Folder for what the tests of the fleet teach: a file for `model.priors` of each type of "
        "machine, named after the last day of whose tests it knows. A file that was written stays as it is.",
        example="priors",
    )
    notify: list[NotifyKeys] = Field([], description="Who is told what is new after a night, and how.")
    log: LogKeys | None = optional("What is kept of each night for people.")
    confine: JobPath | None = optional(
        "Folder outside of which no job of the fleet reads or writes; that of this file is `.`.", example="."
    )


@dataclass(frozen=True, slots=True)
class FleetFile:
    """A checked fleet file."""

    path: Path  #: The file.
    content: bytes  #: Its bytes, as they were read.
    keys: FleetKeys  #: What it says.
    name: str  #: Of the fleet.
    output: Path  #: Folder of the certificates.
    ledger: str  #: Path of an SQLite file, or the URL of a database.
    defaults: Defaults | None  #: Keys that all jobs build on; None without any.
    tree: Keys  #: What it says, value by value, with the places.

    def place_of(self, *steps: str | int) -> Place:
        """Return where a key stands; of one that is missing, its nearest parent's place."""
        return place_of(self.tree, steps)

    @property
    def reports(self) -> tuple[str, str, str]:
        """The names of the overview, of the file for Prometheus, and of the calendar."""
        stem = self.path.stem
        return f"{stem}.html", f"{stem}.prom", f"{stem}.ics"

    @property
    def heartbeat(self) -> Path:
        """The file by which a night shows that it is alive, beside the ledger or the fleet file."""
        beside = self.path if _URL.match(self.ledger) else Path(self.ledger)
        return beside.with_name(f"{self.path.stem}.heartbeat.prom")

    @property
    def formats(self) -> tuple[tuple[str, Place], ...]:
        """The identifiers of renderers that stand instead of the jobs' own, each with its place."""
        return tuple(
            (name, self.place_of("output", "formats", index))
            for index, name in enumerate(self.keys.output.formats or ())
        )


def load_fleet(
    path: Path, content: bytes | None = None, extensions: Callable[[], Sequence[Extension]] = tuple
) -> FleetFile:
    """Read a fleet file and check all that can be checked without its jobs.

    `extensions`: Returns the groups of job keys that plugins add; asked only for what the core does not know.

    Raises `InputError` with every mistake, in the order of their places; `AccessError` if it cannot be read.
    """
    if content is None:
        content = demand(path, LARGEST)
    tree = parse(content, str(path))
    refuse_other_format(tree, FLEET, lambda: [each for offered in extensions() for each in offered.formats])
    problems: list[Problem] = []
    keys = validate(FleetKeys, tree, problems)
    entry = tree.entries.get("defaults")
    shared = entry.value if entry and isinstance(entry.value, Keys) else None
    if shared:
        problems.extend(_find_wrong_defaults(shared, extensions))
    if problems or keys is None:
        raise InputError(sorted(set(problems)))
    fleet = FleetFile(
        path=path,
        content=content,
        keys=keys,
        name=keys.name or path.stem,
        output=keys.output.directory or path.parent / "certificates",
        ledger=keys.ledger or str(path.with_suffix(".ledger.db")),
        defaults=Defaults(shared, path) if shared and shared.entries else None,
        tree=tree,
    )
    with confined(keys.confine):
        problems = list(_find_escaping(fleet))
    if problems:
        raise InputError(problems)
    return fleet


def _find_escaping(fleet: FleetFile) -> Iterator[Problem]:
    """Yield what of the fleet itself lies outside of the folder to which its jobs are confined."""
    paths = [("output", fleet.output)]
    paths += [] if _URL.match(fleet.ledger) else [("ledger", Path(fleet.ledger))]
    paths += [("log", fleet.keys.log.file)] if fleet.keys.log else []
    paths += [("priors", fleet.keys.priors)] if fleet.keys.priors else []
    for key, path in paths:
        if say_outside(path):
            yield Problem(fleet.place_of(key), f"{key}: {path}: {say_outside(path)}")


def list_job_files(fleet: FleetFile) -> tuple[Path, ...]:
    """Return the job files of a fleet, in the order of their names.

    Raises `InputError` for each pattern that matches no file.
    """
    found, problems = find_jobs(fleet)
    if problems:
        raise InputError(problems)
    return found


def find_jobs(fleet: FleetFile) -> tuple[tuple[Path, ...], Sequence[Problem]]:
    """Return the job files of a fleet as far as there are any, and what is wrong with its patterns.

    A file that is named in several ways (``jobs/../jobs/x.yaml``, a link) is one job, by its plainest name.
    """
    folder = fleet.path.parent.resolve()
    found: dict[Path, tuple[bool, Path]] = {}
    problems: list[Problem] = []
    for pattern, place in _list_patterns(fleet):
        matches = glob.glob(pattern, root_dir=fleet.path.parent, recursive=True)  # noqa: PTH207 - of a root
        named = {fleet.path.parent / match: folder / match for match in matches}
        files = {file: at for file, at in named.items() if file.is_file() and not _is(file, fleet.path)}
        problems += [
            Problem(place, f"jobs: {file}: {say_outside(file)}") for file in files if say_outside(file)
        ]
        if not files:
            message = f"jobs: no file is called {quoted(pattern)}; {_say_nearest(pattern, fleet)}"
            problems.append(Problem(place, message))
        for file, at in files.items():
            real = at.resolve()
            found[real] = min(found.get(real, (True, file)), (at != real, file))
    return tuple(sorted(file for _, file in found.values())), problems


def is_retired(job: str, fleet: FleetFile) -> bool:
    """Whether a job, as the ledger names it, or a certificate, by its number, is gone on purpose."""
    return any(fnmatch.fnmatchcase(job, pattern) for pattern in fleet.keys.retired)


def number_of(job: Path, defaults: Defaults | None) -> tuple[str, Place]:
    """Return the number of a job's certificate and where it stands; nothing else of the job is checked.

    Raises `InputError` if the job is no YAML; `AccessError` if it, or a file that it extends, cannot be read.
    """
    tree = read_composition(job, defaults=defaults).keys
    found = list(walk(tree, ("certificate", "number")))
    _, place, value = found[-1] if found else ("", tree.place, None)
    return (value.text.strip(), place) if isinstance(value, Scalar) else ("", place)


def _find_wrong_defaults(shared: Keys, extensions: Callable[[], Sequence[Extension]]) -> Iterator[Problem]:
    """Yield what is wrong with the defaults wherever the jobs put them."""
    others = extensions() if shared.entries.keys() - list_keys_in(JobKeys).keys() else ()
    own = shared.without(*(each.identifier for each in others))
    yield from find_problems_in_part(JobKeys, own, "defaults")
    number = ("certificate", "number")
    if len(list(walk(shared, number))) == len(number):
        place = find_key_place(shared, number)
        yield Problem(place, "defaults.certificate.number: each certificate has a number of its own")


def _list_patterns(fleet: FleetFile) -> Iterator[tuple[str, Place]]:
    stated = fleet.tree.entries["jobs"].value
    for item in stated.items if isinstance(stated, Items) else (stated,):
        if isinstance(item, Scalar):
            yield item.text, item.place


def _say_nearest(pattern: str, fleet: FleetFile) -> str:
    """Say how far the folders of a pattern are there, or that it is one itself."""
    here = fleet.path.parent
    if os.path.isdir(here / pattern):  # noqa: PTH112 - says no of a name that is too long
        return f"it is a folder; name the files in it, as in {pattern.rstrip('/')}/*.yaml"
    *folders, missing = Path(pattern).parts
    for part in folders:
        if glob.has_magic(part) or not os.path.isdir(here / part):  # noqa: PTH112 - likewise
            missing = part
            break
        here /= part
    return f"nothing matches {quoted(missing)} in {here.absolute()}"


def _is(file: Path, other: Path) -> bool:
    return file.name == other.name and file.samefile(other)
