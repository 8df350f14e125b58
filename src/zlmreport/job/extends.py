"""Finds the files that ``extends`` names, and the defaults of a fleet's jobs; `tree` merges them."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from zlmreport.errors import InputError, Place, Problem, quoted
from zlmreport.files import demand
from zlmreport.job.parse import LARGEST, SUFFIXES, parse
from zlmreport.job.tree import Items, Keys, Scalar, make_keys_of, merge
from zlmreport.job.types import resolve_path_named
from zlmreport.job.yaml_text import write_lines
from zlmreport.measurement.provenance import SourceFile


@dataclass(frozen=True, slots=True)
class FileFormat:
    """A format of files: what their key `schema` says, what such a file is, and what takes it."""

    schema: str
    what: str
    taken_by: str


JOB = FileFormat("zlmreport/job/1", "a job", "zlmreport JOB.yaml")
SIMULATION = FileFormat("zlmreport/simulation/1", "the description of a simulated test", "zlmreport simulate")
FLEET = FileFormat("zlmreport/fleet/1", "a fleet of jobs", "zlmreport fleet FLEET.yaml")
MACHINE = FileFormat("zlmreport/machine/1", "a machine", "zlmreport machine")
PRIORS = FileFormat("zlmreport/priors/1", "what earlier tests taught", "model.priors of a job")


def refuse_other_format(
    tree: Keys, expected: FileFormat, others: Callable[[], Iterable[FileFormat]] = tuple
) -> None:
    """Refuse a file of another kind by one message, instead of by one for each of its keys.

    `others`: Returns formats that extensions add; asked only for a file of none that the core knows.

    Raises `InputError` if its schema is that of another command.
    """
    entry = tree.entries.get("schema")
    named = entry.value if entry else None
    if not isinstance(named, Scalar) or named.text == expected.schema:
        return
    own = (JOB, SIMULATION, FLEET, MACHINE, PRIORS)
    known = own if any(each.schema == named.text for each in own) else tuple(others())
    for each in known:
        if each.schema == named.text:
            raise InputError.at(
                named.place,
                f"this file is {each.what} ({named.text}), and {expected.what} is expected; {each.taken_by} "
                "takes it",
            )


@dataclass(frozen=True, slots=True)
class Defaults:
    """Default keys of jobs."""

    keys: Keys  #: With their places in the file that states them.
    path: Path  #: That file: relative paths among the keys are relative to its folder.

    def as_files(self, job: Path) -> tuple[SourceFile, SourceFile]:
        """Return two files that nobody wrote: a job that extends a job file and the defaults, and these."""
        folder = os.path.relpath(self.path.parent.absolute(), job.parent.absolute())
        shared = Path(folder) / f"{self.path.stem}.defaults.yaml"
        whole = job.with_name(f"{self.path.stem}.{job.name}")
        extended = json.dumps([shared.as_posix(), job.name], ensure_ascii=False)
        return (
            SourceFile.of(whole, f"extends: {extended}\n".encode()),
            SourceFile.of(job.parent / shared, self.as_yaml().encode()),
        )

    def as_yaml(self) -> str:
        """Return the keys as a file of their own."""
        return "".join(f"{line}\n" for line in write_lines(self.keys, ""))


#: How the name of a file ends that holds shared keys.
_ENDINGS = (*SUFFIXES, ".json")
#: Files that extend one another in a row.
LONGEST_CHAIN = 16


@dataclass(frozen=True, slots=True)
class Composition:
    """A job file's keys with those of the files it extends, and all files that took part."""

    keys: Keys
    files: tuple[SourceFile, ...]


def read_composition(
    path: Path, content: bytes | None = None, defaults: Defaults | None = None
) -> Composition:
    """Read a job file and every file that it extends.

    `defaults`: Keys that it builds on as if it extended a file of them.

    Raises `AccessError` if a file cannot be read; `InputError` if a file is no YAML, or files extend each
    other in a circle.
    """
    reader = _Reader({} if content is None else {os.path.realpath(path): content})
    keys = reader.read_keys(path, (), None)
    if defaults is None:
        return Composition(keys, tuple(reader.files.values()))
    together = merge(reader.read_defaults(defaults), keys)
    job, shared = defaults.as_files(path)
    return Composition(together, (job, *reader.files.values(), shared))


@dataclass(slots=True)
class _Reader:
    """Reads each file once; `files` has them by their real path, the job file first.

    `given` holds the content of files that are not read from the disk.
    """

    given: Mapping[str, bytes]
    files: dict[str, SourceFile] = field(default_factory=dict)
    _known: dict[str, Keys] = field(default_factory=dict)

    def read_keys(self, path: Path, chain: tuple[Path, ...], named_at: Place | None) -> Keys:
        """Return the keys of a file and of all that it extends.

        `chain` is the row of files by which it was come to, and `named_at` where the last of them names it.
        """
        identity = os.path.realpath(path)
        if named_at and identity in map(os.path.realpath, chain):
            circle = " → ".join(each.name for each in (*chain, path))
            raise InputError.at(named_at, f"these files extend each other in a circle: {circle}")
        if named_at and len(chain) == LONGEST_CHAIN:
            raise InputError.at(named_at, f"more than {LONGEST_CHAIN} files extend one another in a row")
        if identity not in self._known:
            content = self.given[identity] if identity in self.given else demand(path, LARGEST, named_at)
            self.files[identity] = SourceFile.of(path, content)
            self._known[identity] = self._add_bases(parse(content, str(path)), (*chain, path))
        return self._known[identity]

    def read_defaults(self, defaults: Defaults) -> Keys:
        """Return default keys and all that they extend."""
        return self._add_bases(defaults.keys, (defaults.path,)).without("extends")

    def _add_bases(self, own: Keys, chain: tuple[Path, ...]) -> Keys:
        bases = make_keys_of(own.place)
        for name in _list_extended(own):
            base = self.read_keys(_find_base(name, chain[-1]), chain, name.place)
            bases = merge(bases, base.without("extends"))
        return merge(bases, own)


def _list_extended(keys: Keys) -> tuple[Scalar, ...]:
    entry = keys.entries.get("extends")
    if entry is None or (isinstance(entry.value, Scalar) and entry.value.is_nothing):
        return ()
    names = entry.value.items if isinstance(entry.value, Items) else (entry.value,)
    found = tuple(name for name in names if isinstance(name, Scalar) and name.text)
    if found != names:
        raise InputError(
            Problem(name.place, "extends names a file, or a list of files: extends: ../laboratory.yaml")
            for name in names
            if name not in found
        )
    return found


def _find_base(name: Scalar, naming_file: Path) -> Path:
    """Return the path of a file that another extends: no other than YAML is read, and shown in messages."""
    if not name.text.casefold().endswith(_ENDINGS):
        raise InputError.at(
            name.place,
            f"extends: {quoted(name.text)} is no YAML file; its name ends in {', '.join(_ENDINGS)}",
        )
    try:
        return resolve_path_named(name.text, naming_file)
    except ValueError as error:
        raise InputError.at(name.place, f"extends: {error}") from error
