"""How a file that names another finds it: beside itself, or among the files that it may use."""

from __future__ import annotations

import contextlib
import posixpath
from collections.abc import Iterator, Mapping
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from zlmreport.errors import Place, quoted
from zlmreport.files import outside


@dataclass(frozen=True, slots=True)
class Enclosure:
    """The only files that jobs can name: those that came with a document.

    Attributes
    ----------
    files
        Where each lies, by its path from the folder of the job as it was, ``../laboratory.yaml``, or from
        the root.
    nowhere
        A folder that is not there: where every other reference leads.
    """

    files: Mapping[str, Path]
    nowhere: Path

    def path_of(self, file: Path) -> str | None:
        """Return the path of one of the files from the job's folder."""
        return next((path for path, where in self.files.items() if where == file), None)

    def path_named(self, reference: str, naming_file: Path) -> Path:
        """Return the file that a reference means; one that leads past the folder's files leads nowhere.

        A reference to a file whose path is not known is answered by the file's name, if only one has it.
        """
        folder = posixpath.dirname(self.path_of(naming_file) or "")
        found = self.files.get(posixpath.normpath(posixpath.join(folder, reference)))
        if found:
            return found
        name = posixpath.basename(reference)
        alike = [path for path in self.files.values() if path.name == name]
        return alike[0] if len(alike) == 1 else self.nowhere / name


_ENCLOSURE: ContextVar[Enclosure | None] = ContextVar("enclosure", default=None)


def path_named(reference: str, naming_file: Path) -> Path:
    """Return the path that a file names: relative to its own folder, or from the root.

    Raises
    ------
    ValueError
        If it lies outside of the folder to which the program is confined.
    """
    enclosure = _ENCLOSURE.get()
    path = enclosure.path_named(reference, naming_file) if enclosure else naming_file.parent / reference
    reason = "\0" not in reference and outside(path)
    if reason:
        raise ValueError(f"{quoted(reference)} must not be used: {reason}")
    return path


def path_from_job(file: Path, job: Path, from_root: str | None = None) -> str | None:
    """Return the path by which a job comes to a file: from its folder, or None if the file lies elsewhere.

    Parameters
    ----------
    file, job
        As they were read.
    from_root
        How the job names the file, if it does so from the root of the file system.
    """
    enclosure = _ENCLOSURE.get()
    if enclosure:
        return enclosure.path_of(file)
    if from_root:
        return posixpath.normpath(from_root)
    if not file.is_relative_to(job.parent):
        return None
    return posixpath.normpath(file.relative_to(job.parent).as_posix())


@contextlib.contextmanager
def enclosed(enclosure: Enclosure) -> Iterator[None]:
    """Let jobs name the files of an enclosure and no others: for a job from a document that anyone sent."""
    token = _ENCLOSURE.set(enclosure)
    try:
        yield
    finally:
        _ENCLOSURE.reset(token)


class LocatedText(str):
    """A string from a job file, with its place, so that a path can be read beside the file that names it."""

    __slots__ = ("place",)
    place: Place

    def __new__(cls, text: str, place: Place) -> Self:
        """Return the text with its place."""
        located = super().__new__(cls, text)
        located.place = place
        return located
