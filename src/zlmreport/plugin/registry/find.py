"""Finds plugins: installed ones by entry points, others in files that the user names.

An entry point for each object, in the group of its kind and named by its identifier (``"iso230-2:2014" =
"zlmreport_plugins.standards.iso230_2"``): so a run loads what it names, and a listing all.
"""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Iterable, Mapping, Sequence
from importlib.metadata import EntryPoint, entry_points
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import TYPE_CHECKING, Any

from zlmreport.errors import AccessError, InputError, Place, Problem, ZlmreportError
from zlmreport.plugin.hooks import hookimpl
from zlmreport.plugin.kinds import KINDS, Kind
from zlmreport.plugin.registry.candidate import DISABLE, FILES, Plugin, PluginCandidate, say_reason_of
from zlmreport.plugin.registry.registry import Registry

if TYPE_CHECKING:
    from zlmreport.model.effects.effect import Effect

#: Entry points of this group name modules that offer several things, and are loaded to know what.
GROUP = "zlmreport"


def find_plugins(
    environment: Mapping[str, str] = os.environ, files: Sequence[Path] = (), *, lenient: bool = False
) -> Registry:
    """Find every installed plugin, and those in files that the user names.

    No job names such a file: a job comes from elsewhere, and a plugin is a program. An installed plugin is
    loaded here only if its entry point does not say what it offers: one of the group ``zlmreport``.

    `environment`: Its variable ``ZLMREPORT_DISABLE_PLUGINS`` names entry points, parted by commas, that stay
        off; ``ZLMREPORT_PLUGINS`` names files that are plugins, parted as in ``PATH``.
    `files`: More of them, from the command line.
    `lenient`: Whether what would be raised is kept as `Registry.refused`: for a listing of what does work.

    Raises `AccessError` if there is no such file; `InputError` if a file that is named does not work; if a
    plugin has a misspelt hook: what it offers would be missing in silence.
    """
    off = {name.strip() for name in environment.get(DISABLE, "").split(",")}
    points = find_plugin_points()
    releases = _read_releases(point for point, _ in points)
    candidates: list[PluginCandidate] = []
    disabled: list[str] = []
    for point, kind in points:
        if point.name in off:
            disabled.append(point.name)
            continue
        plugin = Plugin(point.name, point.module, *releases.get(id(point.dist), ("", "")))
        candidates.append(PluginCandidate(plugin, point.load, (kind, point.name) if kind else None))
    named = [Path(name) for name in environment.get(FILES, "").split(os.pathsep) if name]
    from_files: list[PluginCandidate] = []
    refused: list[ZlmreportError] = []
    for path in dict.fromkeys(each.resolve() for each in (*named, *files)):
        try:
            from_files.append(_find_in_file(path))
        except ZlmreportError as error:
            refused.append(error)
    registry = Registry([*candidates, *from_files], disabled)
    for candidate in (*candidates, *from_files):
        _ = candidate.keys  # loads it, if nobody knows what it offers
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


def _read_releases(points: Iterable[EntryPoint]) -> dict[int, tuple[str, str]]:
    """Return names and versions of distributions by their `id`: each is read once, which takes its time."""
    distributions = {id(point.dist): point.dist for point in points if point.dist}
    read = {key: each.metadata for key, each in distributions.items()}
    return {key: (metadata["Name"], metadata["Version"]) for key, metadata in read.items()}


def find_plugin_points() -> list[tuple[EntryPoint, Kind[Any] | None]]:
    """Return the entry points of plugins in the order of their names, each with the kind that it says."""
    installed = entry_points()
    found: list[tuple[EntryPoint, Kind[Any] | None]] = [
        (point, None) for point in installed.select(group=GROUP)
    ]
    found += [(point, kind) for kind in KINDS for point in installed.select(group=kind.group)]
    return sorted(found, key=lambda each: (each[0].name, each[0].value, each[0].group))


def _find_in_file(path: Path) -> PluginCandidate:
    """Return the plugin in a file; its name in the interpreter is one that no import finds."""
    from zlmreport.job.parse import is_named_as_yaml  # noqa: PLC0415 - reads YAML, which a run without files may not need

    if not path.is_file():
        raise AccessError.at(Place(str(path)), "there is no such plugin file")
    if is_named_as_yaml(path):
        catalogue = _Catalogue(path)
        return PluginCandidate(Plugin(path.stem, str(path)), lambda: catalogue)
    spec = spec_from_file_location(f"zlmreport plugin {path}", path)
    if spec is None or spec.loader is None:
        raise InputError.at(
            Place(str(path)),
            "is no Python file and no catalogue of effects; a plugin is one, such as my_effect.yaml",
        )
    module = module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look their module up
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        raise InputError.at(Place(str(path), _find_line_in(path, error)), say_reason_of(error)) from error
    return PluginCandidate(Plugin(path.stem, str(path)), lambda: module)


class _Catalogue:
    """A catalogue of effects as a plugin: what a module with the hook is."""

    def __init__(self, path: Path) -> None:
        from zlmreport.model.effects.catalogue import read_effects_in  # noqa: PLC0415 - brings pydantic

        self._effects = read_effects_in(path)

    @hookimpl
    def zlmreport_effects(self) -> Iterable[Effect]:
        """Return the effects of the file."""
        return self._effects


def _find_line_in(path: Path, error: BaseException) -> int:
    """Return the last line of a file that an error came through; 0 if it never was there."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        return error.lineno or 0
    frames = traceback.extract_tb(error.__traceback__)
    return next((frame.lineno or 0 for frame in reversed(frames) if frame.filename == str(path)), 0)
