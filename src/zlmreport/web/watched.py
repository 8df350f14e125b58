"""A file that is worked on: read again whenever it, or a file that it names, has changed."""

from __future__ import annotations

import hashlib
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from threading import RLock
from typing import Generic, Protocol, TypeVar

from zlmreport.errors import ZlmreportError
from zlmreport.language import Language
from zlmreport.plugin.registry import Registry


class LoadedFile(Protocol):
    """A file on the bench as it was read."""

    @property
    def stamp(self) -> str:
        """Names the state of all files behind it: another state, another stamp."""

    @property
    def content(self) -> str:
        """Names what stands in all files behind it, wherever and whenever they were written."""

    @property
    def language(self) -> Language:
        """Of its document."""


LoadedT_co = TypeVar("LoadedT_co", bound=LoadedFile, covariant=True)


@dataclass(slots=True)
class WatchedFile(ABC, Generic[LoadedT_co]):
    """A file that is worked on, as pages ask for it."""

    path: Path  #: The file.
    registry: Registry  #: The installed plugins.
    #: Held while the file is read or changed: pages ask from several threads.
    lock: RLock = field(default_factory=RLock)
    _loaded: LoadedT_co | None = None
    _watched: tuple[Path, ...] = ()

    def make_stamp(self) -> str:
        """Return the name of the state in which the files are now, without reading them."""
        return make_stamp_of([self.path, *self._watched])

    def load(self) -> LoadedT_co:
        """Return the file as it and all that it names are now.

        Raises `InputError` or `AccessError` with every mistake that somebody has written into them.
        """
        with self.lock:
            if self._loaded is not None and self._loaded.stamp == self.make_stamp():
                return self._loaded
            self._loaded = None
            try:
                with_stamp, paths = self.read()
            except ZlmreportError as error:
                # Which of them will be mended nobody knows: those of before, and those that are named.
                named = (Path(each.place.file) for each in error.problems)
                self._watched = tuple(dict.fromkeys((*self._watched, *named)))
                raise
            self._watched = tuple(dict.fromkeys(each for each in paths if each is not None))
            self._loaded = with_stamp(self.make_stamp())
            return self._loaded

    @abstractmethod
    def read(self) -> tuple[Callable[[str], LoadedT_co], Iterable[Path | None]]:
        """Read the file, and return it but for its stamp, and where all that it names lies."""


def make_stamp_of(paths: Iterable[Path]) -> str:
    """Return a name of the state of files, from what the file system says of them."""
    states = []
    for path in paths:
        try:
            found = path.resolve().stat()
        except OSError:
            states.append(f"{path.name} is gone")
        else:
            states.append(f"{path.name} {found.st_mtime_ns} {found.st_size} {found.st_ino}")
    return hashlib.sha256("\n".join(states).encode()).hexdigest()[:16]
