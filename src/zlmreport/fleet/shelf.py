"""The folder of certificates: files that appear whole, and are never replaced once they are issued.

A file is written under a hidden name and pushed to the disk; then the ledger takes it over; then it gets its
name. Whenever the program ends in between, the next night finds the hidden file, and the ledger says
whether it is to have its name or never was issued.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from zlmreport.files import beside, take_names
from zlmreport.fleet.basis import KnownFile, Look

#: Of a file that the ledger has not taken over yet.
_SUFFIX = ".zlmreport-new"


@dataclass(frozen=True, slots=True)
class Finished:
    """A file that is to be on the disk.

    Attributes
    ----------
    role
        Suffix of its format: ``.pdf``.
    path
        Relative to the folder of certificates.
    content
        Its bytes.
    """

    role: str
    path: str
    content: bytes

    @property
    def sha256(self) -> str:
        """Digest of its bytes, hexadecimal."""
        return hashlib.sha256(self.content).hexdigest()


@dataclass(frozen=True, slots=True)
class Laid:
    """Files that are on the disk under hidden names.

    Attributes
    ----------
    names
        The hidden file of each, by the file that it becomes.
    known
        What the ledger keeps of them.
    """

    names: Mapping[Path, Path]
    known: tuple[KnownFile, ...]

    def name(self) -> None:
        """Give the files their names."""
        take_names(self.names)


@contextlib.contextmanager
def laid(folder: Path, files: Iterable[Finished]) -> Iterator[Laid]:
    """Write files under hidden names, and push them to the disk; what gets no name within is removed.

    Parameters
    ----------
    folder
        Of certificates.
    files
        To be written.

    Raises
    ------
    OSError
        If one cannot be written.
    """
    files = tuple(files)
    digests = {folder / file.path: file.sha256 for file in files}

    def hidden(path: Path) -> Path:
        return path.with_name(f".{path.name}.{digests[path][:16]}{_SUFFIX}")

    with beside({folder / file.path: file.content for file in files}, hidden) as names:
        known = [
            KnownFile(file.role, file.path, file.sha256, Look.at(names[folder / file.path])) for file in files
        ]
        yield Laid(names, tuple(known))


def tidy(folder: Path, known: Iterable[KnownFile]) -> int:
    """End what an interrupted night left half done, and return the number of files that got their names.

    Parameters
    ----------
    folder
        Of certificates.
    known
        The files that the ledger has taken over.
    """
    digests = {file.path: file.sha256 for file in known}
    named = 0
    for hidden in _hidden(folder):
        name, _, begin = hidden.name.removesuffix(_SUFFIX)[1:].rpartition(".")
        path = hidden.with_name(name)
        sha256 = digests.get(str(path.relative_to(folder)), "")
        if sha256.startswith(begin) and _digest(hidden) == sha256:
            hidden.replace(path)
            named += 1
        else:
            hidden.unlink()
    return named


def is_intact(path: Path, file: KnownFile) -> bool:
    """Whether a file is as it was issued; one that was only added to, as a signature is, counts as such."""
    if file.look is None:
        return _digest(path) == file.sha256
    with path.open("rb") as opened:
        begin = opened.read(file.look.size)
    return hashlib.sha256(begin).hexdigest() == file.sha256


def _hidden(folder: Path) -> Iterator[Path]:
    for root, _, files in os.walk(folder):
        yield from (Path(root, name) for name in sorted(files) if name.endswith(_SUFFIX))


def _digest(path: Path) -> str:
    with path.open("rb") as opened:
        return hashlib.file_digest(opened, "sha256").hexdigest()
