"""From a fleet file to what it describes, checked."""

from __future__ import annotations

import glob
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from zlmreport.errors import InputError, Place, Problem
from zlmreport.files import unreadable
from zlmreport.job.defaults import Defaults
from zlmreport.job.extends import compose
from zlmreport.job.fleet_keys import FleetKeys
from zlmreport.job.formats import FLEET, refuse_other_format
from zlmreport.job.model import JobKeys
from zlmreport.job.parse import parse
from zlmreport.job.text import quoted
from zlmreport.job.tree import Items, Keys, Scalar, key_place, place_of, walk
from zlmreport.job.validate import problems_in_part, validate


@dataclass(frozen=True, slots=True)
class FleetFile:
    """A checked fleet file.

    Attributes
    ----------
    path
        The file.
    content
        Its bytes, as they were read.
    keys
        What it says.
    name
        Of the fleet.
    output
        Folder of the certificates.
    ledger
        Path of an SQLite file, or the URL of a database.
    defaults
        Keys that all jobs build on; None without any.
    tree
        What it says, value by value, with the places.
    """

    path: Path
    content: bytes
    keys: FleetKeys
    name: str
    output: Path
    ledger: str
    defaults: Defaults | None
    tree: Keys

    def place_of(self, *steps: str | int) -> Place:
        """Return where a key stands; of one that is missing, its nearest parent's place."""
        return place_of(self.tree, steps)

    @property
    def formats(self) -> tuple[tuple[str, Place], ...]:
        """The identifiers of renderers that stand instead of the jobs' own, each with its place."""
        return tuple(
            (name, self.place_of("output", "formats", index))
            for index, name in enumerate(self.keys.output.formats or ())
        )


def load_fleet(path: Path, content: bytes | None = None) -> FleetFile:
    """Read a fleet file and check all that can be checked without its jobs.

    Parameters
    ----------
    path
        The file.
    content
        Its bytes, where they were read already.

    Raises
    ------
    InputError
        With every mistake, in the order of their places.
    AccessError
        If it cannot be read.
    """
    if content is None:
        content = _content(path)
    tree = parse(content, str(path))
    refuse_other_format(tree, FLEET)
    problems: list[Problem] = []
    keys = validate(FleetKeys, tree, problems)
    entry = tree.entries.get("defaults")
    shared = entry.value if entry and isinstance(entry.value, Keys) else None
    if shared:
        problems.extend(_wrong_defaults(shared))
    if problems or keys is None:
        raise InputError(sorted(set(problems)))
    return FleetFile(
        path=path,
        content=content,
        keys=keys,
        name=keys.name or path.stem,
        output=keys.output.directory or path.parent / "certificates",
        ledger=keys.ledger or str(path.with_suffix(".ledger.db")),
        defaults=Defaults(shared, path) if shared and shared.entries else None,
        tree=tree,
    )


def job_files(fleet: FleetFile) -> tuple[Path, ...]:
    """Return the job files of a fleet, in the order of their names.

    Raises
    ------
    InputError
        For each pattern that matches no file.
    """
    found: set[Path] = set()
    problems = []
    for pattern, place in _patterns(fleet):
        matches = glob.glob(pattern, root_dir=fleet.path.parent, recursive=True)  # noqa: PTH207 - of a root
        files = {fleet.path.parent / match for match in matches}
        files = {file for file in files if file.is_file() and not _is(file, fleet.path)}
        if not files:
            message = f"jobs: no file is called {quoted(pattern)}; {_nearest(pattern, fleet)}"
            problems.append(Problem(place, message))
        found |= files
    if problems:
        raise InputError(problems)
    return tuple(sorted(found))


def number_of(job: Path, defaults: Defaults | None) -> tuple[str, Place]:
    """Return the number of a job's certificate and where it stands; nothing else of the job is checked.

    Raises
    ------
    InputError
        If the job is no YAML.
    AccessError
        If it, or a file that it extends, cannot be read.
    """
    tree = compose(job, defaults=defaults).keys
    found = list(walk(tree, ("certificate", "number")))
    _, place, value = found[-1] if found else ("", tree.place, None)
    return (value.text, place) if isinstance(value, Scalar) else ("", place)


def _wrong_defaults(shared: Keys) -> Iterator[Problem]:
    """Yield what is wrong with the defaults wherever the jobs put them."""
    yield from problems_in_part(JobKeys, shared, "defaults")
    number = ("certificate", "number")
    if len(list(walk(shared, number))) == len(number):
        place = key_place(shared, number)
        yield Problem(place, "defaults.certificate.number: each certificate has a number of its own")


def _patterns(fleet: FleetFile) -> Iterator[tuple[str, Place]]:
    stated = fleet.tree.entries["jobs"].value
    for item in stated.items if isinstance(stated, Items) else (stated,):
        if isinstance(item, Scalar):
            yield item.text, item.place


def _nearest(pattern: str, fleet: FleetFile) -> str:
    """Say how far the folders of a pattern are there."""
    here = fleet.path.parent
    for part in Path(pattern).parent.parts:
        if glob.has_magic(part) or not (here / part).is_dir():
            break
        here /= part
    missing = Path(pattern).parts[len(here.relative_to(fleet.path.parent).parts)]
    return f"nothing matches {quoted(missing)} in {here.absolute()}"


def _is(file: Path, other: Path) -> bool:
    return file.name == other.name and file.samefile(other)


def _content(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise unreadable(path, error) from error
