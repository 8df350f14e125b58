"""What a certificate was made from (files, programs, by digest), and what has changed since."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.machinery import PathFinder
from pathlib import Path
from typing import Any, Self

from zlmreport.document.certificate.document import Certificate
from zlmreport.job.fleet import FleetFile
from zlmreport.job.job import Job
from zlmreport.job.types import list_values
from zlmreport.plugin import kinds
from zlmreport.plugin.registry import FILES, Registry
from zlmreport.plugin.registry.find import find_plugin_points

#: Files younger than this when a certificate is begun may change while it is made without looking different
#: afterwards, on file systems whose clock has a coarse tick; seconds.
_COARSEST_TICK = 2


@dataclass(frozen=True, slots=True)
class FileStamp:
    """How a file looks from outside: as long as it looks the same, nobody wrote to it."""

    size: int  #: In bytes.
    modified: int  #: When it was last written, ns.
    inode: int  #: Its number in the file system: a file that was put in its place has another.

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
    """A file whose content is known."""

    #: ``job``, ``readings``, ``logo`` …; ``templates`` of the folder of them; of a certificate's own file,
    #: its format's suffix.
    role: str
    #: Relative to the folder of the fleet file, or from the root; of a certificate's own file, relative to
    #: the folder of certificates.
    path: str
    sha256: str  #: Digest of its bytes, hexadecimal.
    look: FileStamp | None = None  #: When these bytes were in it; None where that is not sure.

    def as_json(self) -> list[Any]:
        """Return what a ledger keeps."""
        look = self.look
        return [self.role, self.path, self.sha256, *((look.size, look.modified, look.inode) if look else ())]

    @classmethod
    def from_json(cls, kept: list[Any]) -> Self:
        """Return what a ledger kept."""
        role, path, sha256, *look = kept
        return cls(role, path, sha256, FileStamp(*look) if look else None)


def is_intact(path: Path, file: KnownFile) -> bool:
    """Whether a file is as it was issued; a PDF that was only added to, as a signature is, counts as such."""
    if file.look is None or file.role != ".pdf":
        return compute_sha256(path) == file.sha256
    with path.open("rb") as opened:
        begin = opened.read(file.look.size)
    return hashlib.sha256(begin).hexdigest() == file.sha256


def compute_sha256(path: Path) -> str:
    """Return the digest of a file's bytes, hexadecimal; of a folder, that of its files with their names."""
    if path.is_dir():
        held = [each for each in sorted(path.iterdir()) if each.is_file() and not each.name.startswith(".")]
        return hashlib.sha256(repr([(each.name, compute_sha256(each)) for each in held]).encode()).hexdigest()
    with path.open("rb") as opened:
        return hashlib.file_digest(opened, "sha256").hexdigest()


@dataclass(frozen=True, slots=True)
class CertificateBasis:
    """Everything that a certificate depends on."""

    files: tuple[KnownFile, ...]  #: The job, what it extends, readings, tables, pictures.
    #: The program and the plugins that took part, with their versions, as `find_program_versions` says.
    programs: Mapping[str, str]
    formats: tuple[str, ...]  #: Identifiers of the renderers.
    defaults: str = ""  #: Digest of the defaults of the fleet; empty without any.

    @property
    def digest(self) -> str:
        """The digest of all of it: equal where nothing has changed."""
        files = sorted((file.role, file.path, file.sha256) for file in self.files)
        content = {**self.as_json(), "files": files}
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
    """Files as they are tonight; each is looked at, and read, once."""

    folder: Path  #: That relative paths are relative to.
    _looks: dict[str, FileStamp | None] = field(default_factory=dict)
    _digests: dict[str, str | None] = field(default_factory=dict)

    def has(self, file: KnownFile) -> bool:
        """Whether a file is there; it may be another by now."""
        return self._look(file.path) is not None

    def still_has(self, file: KnownFile) -> bool:
        """Whether a file still has the content that is known: by its look, or else by its digest."""
        look = self._look(file.path)
        if look is None:
            return False
        return look == file.look or self.compute_digest(file.path) == file.sha256

    def compute_digest(self, path: str) -> str | None:
        """Return the digest of a file; None if it cannot be read."""
        if path not in self._digests:
            self._digests[path] = None
            with contextlib.suppress(OSError):
                self._digests[path] = compute_sha256(self.folder / path)
        return self._digests[path]

    def _look(self, path: str) -> FileStamp | None:
        if path not in self._looks:
            self._looks[path] = None
            with contextlib.suppress(OSError):
                self._looks[path] = FileStamp.at(self.folder / path)
        return self._looks[path]


def say_changes(basis: CertificateBasis, disk: Disk, now: CertificateBasis) -> Iterator[str]:
    """Yield what has changed since a certificate was made, in words.

    `now`: The programs, formats and defaults of tonight; formats are empty where the job itself names them,
        and files are looked for on the disk.
    """
    for file in basis.files:
        if not disk.still_has(file):
            yield f"{file.role} {file.path} {'changed' if disk.has(file) else 'is gone'}"
    if basis.defaults != now.defaults:
        yield "the defaults of the fleet changed"
    for name, version in basis.programs.items():
        if now.programs.get(name) != version:
            yield _say_changed_program(name, version, now.programs.get(name))
    if now.formats and now.formats != basis.formats:
        yield f"formats changed from {', '.join(basis.formats)} to {', '.join(now.formats)}"


def _say_changed_program(name: str, before: str, now: str | None) -> str:
    if now is None:
        return f"{name} is not installed any more"
    version, version_now = before.partition(" ")[0], now.partition(" ")[0]
    if version == version_now:
        return f"the code of {name} {version} changed"
    return f"{name} changed from {version} to {version_now}"


def write_path_in(folder: Path, path: Path) -> str:
    """Return a path as a ledger keeps it: relative to a folder, or from the root."""
    return str(path.relative_to(folder) if path.is_relative_to(folder) else path.absolute())


OWN = "zlmreport"
#: The packages of the program itself: code, built-in plugins, templates and fonts.
_OWN_PACKAGES = (OWN, "zlmreport_plugins", "zlmreport_templates")
#: All plugins together: a diagnosis tries every effect that is installed.
_ALL = "the set of plugins"


def find_program_versions(
    environment: Mapping[str, str] = os.environ, files: Sequence[Path] = ()
) -> Mapping[str, str]:
    """Return the version of the program and of every plugin: its release, and a digest of its code.

    The digest is what tells a plugin that is still being written from what it was yesterday.
    """
    packages: dict[str, set[str]] = {OWN: set(_OWN_PACKAGES)}
    releases: dict[str, str] = {}
    for point, _ in find_plugin_points():
        name = point.dist.name if point.dist else point.name
        packages.setdefault(name, set()).add(point.module.partition(".")[0])
        releases[name] = point.dist.version if point.dist else ""
    found = {
        name: f"{releases.get(name, '')} {_compute_digest(_list_code_of(sorted(own)))}"
        for name, own in packages.items()
    }
    named = [Path(name) for name in environment.get(FILES, "").split(os.pathsep) if name]
    for path in dict.fromkeys(each.resolve() for each in (*named, *files)):
        found[str(path)] = f" {_compute_digest([path])}"
    combined = hashlib.sha256(repr(sorted(found.items())).encode()).hexdigest()
    return {**dict(sorted(found.items())), _ALL: f" {combined[:16]}"}


def release(version: str) -> str:
    """Return the release in a version; without one, that there is none."""
    return version.partition(" ")[0] or "of no release"


def name_programs_of(job: Job, formats: Iterable[str], registry: Registry) -> frozenset[str]:
    """Return the names of what takes part in a job, as `find_program_versions` has them."""
    keys: list[tuple[kinds.Kind[Any], str]] = [(kinds.SOURCE, each.identifier) for each in job.sources]
    keys.extend((kinds.STANDARD, choice.identifier) for part in job.parts for choice in part.standards)
    keys.extend((kinds.RENDERER, identifier) for identifier in formats)
    plugins = [registry.find_origin(kind, identifier) for kind, identifier in keys]
    names = {plugin.distribution or plugin.module for plugin in plugins}
    return frozenset(names | {OWN} | ({_ALL} if any(part.effects for part in job.parts) else set()))


def _list_code_of(packages: Iterable[str]) -> Iterator[Path]:
    """Yield the files of packages, in order, without importing any."""
    for package in packages:
        spec = PathFinder.find_spec(package)
        for folder in (spec.submodule_search_locations or ()) if spec else ():
            for root, folders, files in os.walk(folder):
                folders[:] = sorted(name for name in folders if name != "__pycache__")
                yield from (Path(root, name) for name in sorted(files))
        if spec and spec.origin and not spec.submodule_search_locations:
            yield Path(spec.origin)


def _compute_digest(files: Iterable[Path]) -> str:
    digest = hashlib.sha256()
    for path in files:
        digest.update(path.name.encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]


def digest_named_files(job: Job) -> dict[Path, str]:
    """Return the digests of the files and the folder of templates that a job names, as they are now.

    Whoever reads one may not say what it read. Taken before the work begins, a digest is at worst that of an
    older content than the one that was read: then the certificate is due again.
    """
    templates = job.keys.certificate.style.templates
    options = [each.options for part in job.parts for each in (*part.sources, *part.standards)]
    keys = [each.keys for each in (job, *job.parts)]
    named = [path for _, path in list_values([*keys, *options]) if isinstance(path, Path) and path.is_file()]
    return {path: compute_sha256(path) for path in (*named, *([templates] if templates else ()))}


def list_files_behind(
    certificate: Certificate, named: Mapping[Path, str], job: Job, fleet: FleetFile, begun: float
) -> Iterator[KnownFile]:
    """Yield every file that a certificate was made from, once; those that nobody wrote are none.

    `named`: Of `digest_named_files`, before the work on it began.
    `begun`: When the work on it began, s: a file written after that may be another than the one that was
        read.
    """
    folder = fleet.path.parent
    # With defaults the first file extends them, too, and nobody wrote it.
    own = job.files[1 if fleet.defaults else 0].path
    seen: set[str] = set()
    templates = job.keys.certificate.style.templates
    stated = [(each.role.value, each.file.path, each.file.sha256) for each in certificate.sources]
    for role, path, sha256 in (*stated, *(("file", *each) for each in named.items())):
        if path is None or not path.is_file() or write_path_in(folder, path) in seen:
            continue
        seen.add(write_path_in(folder, path))
        look = FileStamp.at(path)
        kind, settled = "job" if path == own else role, look if look.is_settled(begun) else None
        yield KnownFile(kind, write_path_in(folder, path), sha256, settled)
    if templates:
        yield KnownFile("templates", write_path_in(folder, templates), named[templates])
