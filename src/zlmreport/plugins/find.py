"""Loads plugins: the installed ones by their entry points, others from files that the user names."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Iterable, Mapping, Sequence
from importlib.metadata import entry_points
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

from zlmreport.errors import AccessError, InputError, Place, Problem
from zlmreport.plugins.collect import collect
from zlmreport.plugins.origin import FailedPlugin, Plugin, reason_of
from zlmreport.plugins.registry import DISABLE, Registry

GROUP = "zlmreport"
#: Names files that are plugins, parted as in PATH.
FILES = "ZLMREPORT_PLUGINS"


def find_plugins(environment: Mapping[str, str] = os.environ, files: Sequence[Path] = ()) -> Registry:
    """Load every installed plugin, and those in files that the user names.

    No job names such a file: a job comes from elsewhere, and a plugin is a program.

    Parameters
    ----------
    environment
        Its variable ``ZLMREPORT_DISABLE_PLUGINS`` names entry points, parted by commas, that stay off;
        ``ZLMREPORT_PLUGINS`` names files that are plugins, parted as in ``PATH``.
    files
        More of them, from the command line.

    Raises
    ------
    AccessError
        If there is no such file.
    InputError
        If a file that is named does not work; if two plugins offer the same, or one has a misspelt hook:
        then no answer could be trusted.
    """
    off = {name.strip() for name in environment.get(DISABLE, "").split(",")}
    loaded: list[tuple[Plugin, object]] = []
    failed: list[FailedPlugin] = []
    disabled: list[str] = []
    for point in sorted(entry_points(group=GROUP), key=lambda point: (point.name, point.value)):
        if point.name in off:
            disabled.append(point.name)
            continue
        release = (point.dist.name, point.dist.version) if point.dist else ("", "")
        plugin = Plugin(point.name, point.module, *release)
        try:
            loaded.append((plugin, point.load()))
        except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever a plugin does, the others work
            failed.append(FailedPlugin(plugin, reason_of(error)))
    named = [Path(name) for name in environment.get(FILES, "").split(os.pathsep) if name]
    from_files = [_loaded_file(path) for path in dict.fromkeys(each.resolve() for each in (*named, *files))]
    registry = collect([*loaded, *from_files], failed, disabled)
    own = {plugin for plugin, _ in from_files}
    _demand(each for each in registry.failed if each.plugin in own)
    return registry


def _loaded_file(path: Path) -> tuple[Plugin, object]:
    """Return the module in a file; its name in the interpreter is one that no import finds."""
    plugin = Plugin(path.stem, str(path))
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
    return plugin, module


def _line_in(path: Path, error: BaseException) -> int:
    """Return the last line of a file that an error came through; 0 if it never was there."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        return error.lineno or 0
    frames = traceback.extract_tb(error.__traceback__)
    return next((frame.lineno or 0 for frame in reversed(frames) if frame.filename == str(path)), 0)


def _demand(failed: Iterable[FailedPlugin]) -> None:
    """Refuse to go on without the plugins that the user named."""
    problems = [Problem(Place(each.plugin.module), each.reason) for each in failed]
    if problems:
        raise InputError(problems)
