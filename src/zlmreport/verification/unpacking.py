"""The files that a certificate carries, laid out so that its job finds them, and no others."""

from __future__ import annotations

import contextlib
import os
import posixpath
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from zlmreport.errors import Place, Problem, ZlmreportError
from zlmreport.files import confined
from zlmreport.job.types import Enclosure, enclosed
from zlmreport.verification.carrier import Carried
from zlmreport.verification.stated import StatedSource

#: Of a file system, in bytes.
_LONGEST_NAME = 255


@dataclass(frozen=True, slots=True)
class Layout:
    """Files in a folder that is gone when the work is done.

    Attributes
    ----------
    job
        The job file.
    names
        What each file is called in messages, by where it lies.
    """

    job: Path
    names: Mapping[str, str]

    def problems(self, error: ZlmreportError) -> tuple[Problem, ...]:
        """Return what went wrong with the files by their own names."""
        return tuple(
            Problem(
                Place(self.names.get(problem.place.file, problem.place.file), *_position(problem.place)),
                self._named(problem.message),
            )
            for problem in error.problems
        )

    def _named(self, message: str) -> str:
        for path, name in self.names.items():
            message = message.replace(path, name)
        return message


@contextlib.contextmanager
def laid_out(sources: Sequence[StatedSource], carried: Mapping[str, Carried]) -> Iterator[Layout]:
    """Write each attached source into a folder of its own; jobs name these files only while it lasts.

    Parameters
    ----------
    sources
        The files that a certificate states, the job first.
    carried
        The attachments, by name: each is a name and no path.
    """
    with tempfile.TemporaryDirectory(prefix="zlmreport-verify-") as folder:
        files: dict[str, Path] = {}
        names: dict[str, str] = {}
        for number, source in enumerate(sources):
            path = Path(folder, str(number), _file_name(source))
            path.parent.mkdir()
            names[str(path)] = source.name
            files.setdefault(posixpath.normpath(source.path), path)
            if source.name in carried:
                path.write_bytes(carried[source.name].content)
        nowhere = Path(folder, "not attached")
        names[f"{nowhere}/"] = ""
        with confined(Path(folder)), enclosed(Enclosure(files, nowhere)):
            yield Layout(next(iter(files.values())), names)


def _file_name(source: StatedSource) -> str:
    """Return the name that a file had, for documents print it; another where no file can have that name."""
    name = posixpath.basename(source.path)
    try:
        is_possible = len(os.fsencode(name)) <= _LONGEST_NAME and "\0" not in name
    except UnicodeEncodeError:
        is_possible = False
    return name if is_possible and name not in {"", ".", ".."} else "file"


def _position(place: Place) -> tuple[int, int]:
    return place.line, place.column
