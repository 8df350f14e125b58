"""What a certificate was made from, and what of it has changed since."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Self

#: Files younger than this when a certificate is begun may change while it is made without looking different
#: afterwards, on file systems whose clock has a coarse tick; seconds.
_COARSEST_TICK = 2


@dataclass(frozen=True, slots=True)
class Look:
    """How a file looks from outside: as long as it looks the same, nobody wrote to it.

    Attributes
    ----------
    size
        In bytes.
    modified
        When it was last written, ns.
    inode
        Its number in the file system: a file that was put in its place has another.
    """

    size: int
    modified: int
    inode: int

    @classmethod
    def at(cls, path: Path) -> Self:
        """Look at a file; raise `OSError` if it is not there."""
        seen = path.stat()
        return cls(seen.st_size, seen.st_mtime_ns, seen.st_ino)

    def is_settled(self, begun: float) -> bool:
        """Whether a file was left alone long enough before a moment, s, that what was read then is this."""
        return self.modified < (begun - _COARSEST_TICK) * 1e9


@dataclass(frozen=True, slots=True)
class KnownFile:
    """A file whose content is known.

    Attributes
    ----------
    role
        ``job``, ``readings``, ``logo`` …; of a certificate's own file, its format's suffix.
    path
        Relative to the folder of the fleet file, or from the root; of a certificate's own file, relative to
        the folder of certificates.
    sha256
        Digest of its bytes, hexadecimal.
    look
        When these bytes were in it; None where that is not sure.
    """

    role: str
    path: str
    sha256: str
    look: Look | None = None

    def as_json(self) -> list[Any]:
        """Return what a ledger keeps."""
        look = self.look
        return [self.role, self.path, self.sha256, *((look.size, look.modified, look.inode) if look else ())]

    @classmethod
    def from_json(cls, kept: list[Any]) -> Self:
        """Return what a ledger kept."""
        role, path, sha256, *look = kept
        return cls(role, path, sha256, Look(*look) if look else None)


@dataclass(frozen=True, slots=True)
class Basis:
    """Everything that a certificate depends on.

    Attributes
    ----------
    files
        The job, what it extends, readings, tables, pictures.
    programs
        The program and the plugins that took part, with their versions, as `zlmreport.fleet.program` says.
    formats
        Identifiers of the renderers.
    defaults
        Digest of the defaults of the fleet; empty without any.
    """

    files: tuple[KnownFile, ...]
    programs: Mapping[str, str]
    formats: tuple[str, ...]
    defaults: str = ""

    @property
    def digest(self) -> str:
        """The digest of all of it: equal where nothing has changed."""
        content = {
            "files": sorted((file.role, file.path, file.sha256) for file in self.files),
            "programs": dict(self.programs),
            "formats": self.formats,
            "defaults": self.defaults,
        }
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()

    def as_json(self) -> dict[str, Any]:
        """Return what a ledger keeps."""
        return {
            "files": [file.as_json() for file in self.files],
            "programs": dict(self.programs),
            "formats": list(self.formats),
            "defaults": self.defaults,
        }

    @classmethod
    def from_json(cls, kept: Mapping[str, Any]) -> Self:
        """Return what a ledger kept."""
        files = tuple(map(KnownFile.from_json, kept["files"]))
        return cls(files, kept["programs"], tuple(kept["formats"]), kept["defaults"])


@dataclass(slots=True)
class Disk:
    """Files as they are tonight; each is looked at, and read, once.

    Attributes
    ----------
    folder
        That relative paths are relative to.
    """

    folder: Path
    _looks: dict[str, Look | None] = field(default_factory=dict)
    _digests: dict[str, str | None] = field(default_factory=dict)

    def has(self, file: KnownFile) -> bool:
        """Whether a file is there; it may be another by now."""
        return self._look(file.path) is not None

    def still_has(self, file: KnownFile) -> bool:
        """Whether a file still has the content that is known: by its look, or else by its digest."""
        look = self._look(file.path)
        if look is None:
            return False
        return look == file.look or self.digest(file.path) == file.sha256

    def digest(self, path: str) -> str | None:
        """Return the digest of a file; None if it cannot be read."""
        if path not in self._digests:
            try:
                with (self.folder / path).open("rb") as opened:
                    self._digests[path] = hashlib.file_digest(opened, "sha256").hexdigest()
            except OSError:
                self._digests[path] = None
        return self._digests[path]

    def _look(self, path: str) -> Look | None:
        if path not in self._looks:
            try:
                self._looks[path] = Look.at(self.folder / path)
            except OSError:
                self._looks[path] = None
        return self._looks[path]


def changes(basis: Basis, disk: Disk, now: Basis) -> Iterator[str]:
    """Yield what has changed since a certificate was made, in words.

    Parameters
    ----------
    basis
        What it was made from.
    disk
        The files of tonight.
    now
        The programs, formats and defaults of tonight; formats are empty where the job itself names them, and
        files are looked for on the disk.
    """
    for file in basis.files:
        if not disk.still_has(file):
            yield f"{file.role} {file.path} {'changed' if disk.has(file) else 'is gone'}"
    if basis.defaults != now.defaults:
        yield "the defaults of the fleet changed"
    for name, version in basis.programs.items():
        if now.programs.get(name) != version:
            yield _changed_program(name, version, now.programs.get(name))
    if now.formats and now.formats != basis.formats:
        yield f"formats changed from {', '.join(basis.formats)} to {', '.join(now.formats)}"


def _changed_program(name: str, before: str, now: str | None) -> str:
    if now is None:
        return f"{name} is not installed any more"
    version, version_now = before.partition(" ")[0], now.partition(" ")[0]
    if version == version_now:
        return f"the code of {name} {version} changed"
    return f"{name} changed from {version} to {version_now}"


def path_in(folder: Path, path: Path) -> str:
    """Return a path as a ledger keeps it: relative to a folder, or from the root."""
    return str(path.relative_to(folder) if path.is_relative_to(folder) else path.absolute())
