"""What installed plugins offered when they were loaded, remembered in the user's cache folder.

So a plugin that a job does not name need not be loaded to know that. Only finished installations are
remembered, and only as long as no file of theirs changes: an editable one is being written, and a plugin
that failed may work the next time. A cache that cannot be read or written is not used.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
from collections.abc import Collection, Mapping
from importlib.machinery import PathFinder
from importlib.metadata import EntryPoint
from pathlib import Path

from zlmreport.errors import AccessError
from zlmreport.files import Document, cache_folder, write
from zlmreport.plugins.candidate import Candidate, Key
from zlmreport.version import __version__

_FILE = "plugins.json"


class Memory:
    """What plugins offered before.

    Parameters
    ----------
    path
        The file; None for none.
    """

    def __init__(self, path: Path | None) -> None:
        self._path = path
        self._known = _read(path) if path else {}
        self._watched: dict[str, Candidate] = {}

    @classmethod
    def of_user(cls, environment: Mapping[str, str] = os.environ) -> Memory:
        """Return the memory in the folder that the user's system keeps for such files."""
        folder = cache_folder(environment)
        return cls(folder / _FILE if folder else None)

    def recall(self, point: EntryPoint) -> Collection[Key] | None:
        """Return what a plugin offered; None if that is not known of this very installation."""
        if not self._known:
            return None
        known = self._known.get(_installation(point) or "")
        return None if known is None else frozenset((kind, identifier) for kind, identifier in known)

    def watch(self, point: EntryPoint, candidate: Candidate) -> None:
        """Remember what a plugin turns out to offer, once `keep` is called."""
        installation = _installation(point) if self._path else None
        if installation:
            self._watched[installation] = candidate

    def keep(self) -> None:
        """Write what is known of the installations there are; those that are gone are forgotten."""
        known = {
            installation: sorted(candidate.keys)
            for installation, candidate in self._watched.items()
            if not (candidate.failure or candidate.misspelt)
        }
        if self._path is None or {**known} == self._known:
            return
        with contextlib.suppress(AccessError):
            write([Document(self._path, json.dumps(known).encode())])


def _read(path: Path) -> dict[str, list[Key]]:
    """Return what is remembered; nothing where the file is not what was written."""
    try:
        known = json.loads(path.read_text(encoding="utf-8"))
        return {
            str(installation): [(str(kind), str(identifier)) for kind, identifier in offers]
            for installation, offers in known.items()
        }
    except (OSError, ValueError, TypeError, AttributeError):
        return {}


def _installation(point: EntryPoint) -> str | None:
    """Return what tells one installation of a plugin from another; None for one that is being written."""
    if point.dist is None:
        return None
    package = point.module.partition(".")[0]
    spec = PathFinder.find_spec(package)
    if spec is None or not spec.origin:
        return None
    origin = Path(spec.origin)
    installed_in = Path(str(point.dist.locate_file(""))).resolve()
    if not origin.resolve().is_relative_to(installed_in):
        return None  # editable: its code stands elsewhere
    files = sorted(origin.parent.rglob("*.py")) if spec.submodule_search_locations else [origin]
    try:
        stats = [(path.stat().st_mtime_ns, path.stat().st_size) for path in files]
    except OSError:
        return None
    made = (sys.version_info[:2], __version__, point.dist.name, point.dist.version, point.name, point.value)
    return repr((*made, str(origin), len(stats), max(stats), sum(size for _, size in stats)))
