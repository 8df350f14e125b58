"""Versions of the program and of its plugins, found without loading any of them."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib.machinery import PathFinder
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any

from zlmreport.job.job import Job
from zlmreport.plugin import kinds
from zlmreport.plugins import FILES, Registry
from zlmreport.plugins.find import GROUP

OWN = "zlmreport"
#: The packages of the program itself: code, built-in plugins, templates and fonts.
_OWN_PACKAGES = (OWN, "zlmreport_plugins", "zlmreport_templates")
#: All plugins together: a diagnosis tries every effect that is installed.
_ALL = "the set of plugins"


def versions(environment: Mapping[str, str] = os.environ, files: Sequence[Path] = ()) -> Mapping[str, str]:
    """Return the version of the program and of every plugin: its release, and a digest of its code.

    The digest is what tells a plugin that is still being written from what it was yesterday.

    Parameters
    ----------
    environment
        As `zlmreport.plugins.find_plugins` reads it.
    files
        Plugins in files of their own.
    """
    packages: dict[str, set[str]] = {OWN: set(_OWN_PACKAGES)}
    releases: dict[str, str] = {}
    for point in entry_points(group=GROUP):
        name = point.dist.name if point.dist else point.name
        packages.setdefault(name, set()).add(point.module.partition(".")[0])
        releases[name] = point.dist.version if point.dist else ""
    found = {
        name: f"{releases.get(name, '')} {_digest(_code_of(sorted(own)))}" for name, own in packages.items()
    }
    named = [Path(name) for name in environment.get(FILES, "").split(os.pathsep) if name]
    for path in dict.fromkeys(each.resolve() for each in (*named, *files)):
        found[str(path)] = f" {_digest([path])}"
    combined = hashlib.sha256(repr(sorted(found.items())).encode()).hexdigest()
    return {**dict(sorted(found.items())), _ALL: f" {combined[:16]}"}


def release(version: str) -> str:
    """Return the release in a version; without one, that there is none."""
    return version.partition(" ")[0] or "of no release"


def used(job: Job, formats: Iterable[str], registry: Registry) -> frozenset[str]:
    """Return the names of what takes part in a job, as `versions` has them."""
    keys: list[tuple[kinds.Kind[Any], str]] = [
        (kinds.SOURCE, each.identifier) for each in (job.source, job.source_as_found) if each
    ]
    keys.extend((kinds.STANDARD, choice.identifier) for choice in job.standards)
    keys.extend((kinds.RENDERER, identifier) for identifier in formats)
    plugins = [registry.origin(kind, identifier) for kind, identifier in keys]
    names = {plugin.distribution or plugin.module for plugin in plugins}
    return frozenset(names | {OWN} | ({_ALL} if job.effects else set()))


def _code_of(packages: Iterable[str]) -> Iterator[Path]:
    """Yield the files of packages, in order, without importing any."""
    for package in packages:
        spec = PathFinder.find_spec(package)
        for folder in (spec.submodule_search_locations or ()) if spec else ():
            for root, folders, files in os.walk(folder):
                folders[:] = sorted(name for name in folders if name != "__pycache__")
                yield from (Path(root, name) for name in sorted(files))
        if spec and spec.origin and not spec.submodule_search_locations:
            yield Path(spec.origin)


def _digest(files: Iterable[Path]) -> str:
    digest = hashlib.sha256()
    for path in files:
        digest.update(path.name.encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]
