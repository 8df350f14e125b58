"""Finds plugins: the installed ones by their entry points, others in files that the user names.

What installed plugins provide is remembered in the user's cache folder, so that one that a job does not
name need not be loaded to know that. Only finished installations are
remembered, and only as long as no file of theirs changes: an editable one is being written, and a plugin
that failed may work the next time. A cache that cannot be read or written is not used.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
import traceback
from collections.abc import Collection, Mapping, Sequence
from importlib.machinery import PathFinder
from importlib.metadata import EntryPoint, entry_points
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

from zlmreport.errors import AccessError, InputError, Place, Problem, ZlmreportError
from zlmreport.files import Document, cache_folder, write
from zlmreport.plugins.candidate import DISABLE, Candidate, Key, Plugin, reason_of
from zlmreport.plugins.registry import Registry
from zlmreport.version import __version__

_FILE = "plugins.json"


class Memory:
    """What plugins offered before."""

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


GROUP = "zlmreport"
#: Entry points of this group name what a distribution declares: plugin, kind, identifiers.
DECLARED = "zlmreport.offers"
#: Names files that are plugins, parted as in PATH.
FILES = "ZLMREPORT_PLUGINS"


def find_plugins(
    environment: Mapping[str, str] = os.environ, files: Sequence[Path] = (), *, lenient: bool = False
) -> Registry:
    """Find every installed plugin, and those in files that the user names.

    No job names such a file: a job comes from elsewhere, and a plugin is a program. An installed plugin is
    loaded here only if nobody knows what it offers: its distribution declares nothing (entry points of the
    group ``zlmreport.offers`` do), and it was not asked before.

    `environment`: Its variable ``ZLMREPORT_DISABLE_PLUGINS`` names entry points, parted by commas, that stay
        off; ``ZLMREPORT_PLUGINS`` names files that are plugins, parted as in ``PATH``.
    `files`: More of them, from the command line.
    `lenient`: Whether what would be raised is kept as `Registry.refused`: for a listing of what does work.

    Raises `AccessError` if there is no such file; `InputError` if a file that is named does not work; if a
    plugin has a misspelt hook: what it offers would be missing in silence.
    """
    off = {name.strip() for name in environment.get(DISABLE, "").split(",")}
    installed = entry_points()
    releases = _Releases()
    declared = _declared(installed.select(group=DECLARED), releases)
    memory = Memory.of_user(environment)
    candidates: list[Candidate] = []
    disabled: list[str] = []
    for point in sorted(installed.select(group=GROUP), key=lambda point: (point.name, point.value)):
        if point.name in off:
            disabled.append(point.name)
            continue
        release = releases.of(point)
        known = declared.get((release[0], point.name))
        offers = known if known is not None else memory.recall(point)
        candidate = Candidate(Plugin(point.name, point.module, *release), point.load, offers)
        if known is None:
            memory.watch(point, candidate)
        candidates.append(candidate)
    named = [Path(name) for name in environment.get(FILES, "").split(os.pathsep) if name]
    from_files: list[Candidate] = []
    refused: list[ZlmreportError] = []
    for path in dict.fromkeys(each.resolve() for each in (*named, *files)):
        try:
            from_files.append(_in_file(path))
        except ZlmreportError as error:
            refused.append(error)
    registry = Registry([*candidates, *from_files], disabled)
    for candidate in (*candidates, *from_files):
        _ = candidate.keys  # loads it, if nobody knows what it offers
    memory.keep()
    problems = [
        Problem(Place(each.plugin.module), each.failure.reason) for each in from_files if each.failure
    ]
    problems += registry.misspelt
    if problems:
        refused.append(InputError(problems))
    if refused and not lenient:
        raise refused[0]
    registry.refused = refused[0] if refused else None
    return registry


class _Releases:
    """Names and versions of distributions: each is read from its metadata once, which takes its time."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[str, str]] = {}

    def of(self, point: EntryPoint) -> tuple[str, str]:
        """Return the distribution of an entry point and its version."""
        if point.dist is None:
            return "", ""
        key = id(point.dist)  # all of them live as long as the entry points
        if key not in self._known:
            metadata = point.dist.metadata
            self._known[key] = (metadata["Name"], metadata["Version"])
        return self._known[key]


def _declared(
    points: Collection[EntryPoint], releases: _Releases
) -> Mapping[tuple[str, str], Collection[Key]]:
    """Return what distributions declare, by distribution and name of the plugin.

    Such a declaration is a mapping of names of entry points to mappings of kinds to identifiers. One that
    cannot be read is none: the plugin itself will say what is wrong.
    """
    found = {}
    for point in points:
        try:
            for name, offers in point.load().items():
                found[releases.of(point)[0], name] = frozenset(
                    (kind, identifier) for kind, identifiers in offers.items() for identifier in identifiers
                )
        except (Exception, SystemExit):  # noqa: BLE001, S112 - whatever it is, the plugin is asked instead
            continue
    return found


def _in_file(path: Path) -> Candidate:
    """Return the plugin in a file; its name in the interpreter is one that no import finds."""
    if not path.is_file():
        raise AccessError.at(Place(str(path)), "there is no such plugin file")
    spec = spec_from_file_location(f"zlmreport plugin {path}", path)
    if spec is None or spec.loader is None:
        raise InputError.at(Place(str(path)), "is no Python file; a plugin is one, such as my_effect.py")
    module = module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look their module up
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        raise InputError.at(Place(str(path), _line_in(path, error)), reason_of(error)) from error
    return Candidate(Plugin(path.stem, str(path)), lambda: module)


def _line_in(path: Path, error: BaseException) -> int:
    """Return the last line of a file that an error came through; 0 if it never was there."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        return error.lineno or 0
    frames = traceback.extract_tb(error.__traceback__)
    return next((frame.lineno or 0 for frame in reversed(frames) if frame.filename == str(path)), 0)
