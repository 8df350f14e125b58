"""Finds plugins by their entry points and in files that the user names; answers by name, or says why not.

Every plugin is asked by itself, in the order of names: so one that fails neither ends the program nor
vanishes, and nothing depends on the order in which plugins were installed.
"""

from __future__ import annotations

import inspect
import os
import re
import sys
import traceback
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from importlib.metadata import entry_points
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeVar, cast

import pluggy

from zlmreport import hookspecs
from zlmreport.errors import AccessError, InputError, Place, Problem, did_you_mean
from zlmreport.job.fields import keys_in
from zlmreport.job.job import Job
from zlmreport.job.options import Options
from zlmreport.language import Words
from zlmreport.protocols import DataSource, Effect, Instrument, PartProgram, Renderer, Standard

GROUP = "zlmreport"
DISABLE = "ZLMREPORT_DISABLE_PLUGINS"
#: Names files that are plugins, parted as in PATH.
FILES = "ZLMREPORT_PLUGINS"

_IDENTIFIER = re.compile(r"[A-Za-z0-9][A-Za-z0-9:._-]*")
_SUFFIX = re.compile(r"(\.[A-Za-z0-9]+)+")
_LONGEST_REASON = 300

Offered = TypeVar("Offered", Standard, DataSource, Renderer, Effect, PartProgram, Instrument)


class Kind(Enum):
    """What a plugin may offer: its label in messages, hook and protocol, and keys that it must not have."""

    STANDARD = ("standard", "zlmreport_standards", Standard, frozenset({"standard", "tolerances"}))
    SOURCE = ("data source", "zlmreport_sources", DataSource, frozenset({"plugin"}))
    RENDERER = ("format", "zlmreport_renderers", Renderer, frozenset[str]())
    EFFECT = ("effect", "zlmreport_effects", Effect, frozenset[str]())
    PART_PROGRAM = ("part program", "zlmreport_part_programs", PartProgram, frozenset({"program"}))
    INSTRUMENT = ("instrument", "zlmreport_instruments", Instrument, frozenset({"plugin"}))

    def __init__(self, label: str, hook: str, protocol: type, reserved: frozenset[str]) -> None:
        self.label = label
        self.hook = hook
        self.protocol = protocol
        self.reserved = reserved


_HOOKS = tuple(kind.hook for kind in Kind)


@dataclass(frozen=True, slots=True)
class Plugin:
    """Where a plugin comes from.

    Attributes
    ----------
    name
        Of its entry point; of a plugin in a file of its own, the file's without its suffix.
    module
        That the entry point names, or the file.
    distribution, version
        What was installed; empty for a file.
    """

    name: str
    module: str = ""
    distribution: str = ""
    version: str = ""

    @property
    def release(self) -> str:
        """Distribution and version: ``zlmreport 0.1.0``."""
        return f"{self.distribution} {self.version}".strip()


@dataclass(frozen=True, slots=True)
class FailedPlugin:
    """A plugin that could not be loaded, and why."""

    plugin: Plugin
    reason: str


@dataclass(frozen=True, slots=True)
class Registry:
    """The plugins there are.

    Attributes
    ----------
    standards, sources, renderers, effects, part_programs, instruments
        What they offer, in the order of identifiers.
    origins
        The plugin that offers each, by kind and identifier.
    failed
        Plugins that could not be loaded.
    disabled
        Names of plugins that the environment switches off.
    """

    standards: tuple[Standard, ...] = ()
    sources: tuple[DataSource, ...] = ()
    renderers: tuple[Renderer, ...] = ()
    effects: tuple[Effect, ...] = ()
    origins: Mapping[tuple[Kind, str], Plugin] = field(default_factory=lambda: MappingProxyType({}))
    failed: tuple[FailedPlugin, ...] = ()
    disabled: tuple[str, ...] = ()
    part_programs: tuple[PartProgram, ...] = ()
    instruments: tuple[Instrument, ...] = ()

    def standard(self, identifier: str, named_at: Place | None = None) -> Standard:
        """Return a standard; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.STANDARD, self.standards, identifier, named_at)

    def source(self, identifier: str, named_at: Place | None = None) -> DataSource:
        """Return a data source; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.SOURCE, self.sources, identifier, named_at)

    def renderer(self, identifier: str, named_at: Place | None = None) -> Renderer:
        """Return a renderer; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.RENDERER, self.renderers, identifier, named_at)

    def effect(self, identifier: str, named_at: Place | None = None) -> Effect:
        """Return an effect; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.EFFECT, self.effects, identifier, named_at)

    def part_program(self, identifier: str, named_at: Place | None = None) -> PartProgram:
        """Return a part program; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.PART_PROGRAM, self.part_programs, identifier, named_at)

    def instrument(self, identifier: str, named_at: Place | None = None) -> Instrument:
        """Return a live instrument; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.INSTRUMENT, self.instruments, identifier, named_at)

    def versions(self, job: Job) -> dict[str, str]:
        """Return the release of every plugin that a job's results come from, by its identifier."""
        used = [(Kind.SOURCE, each.identifier) for each in (job.source, job.source_as_found) if each]
        used.extend((Kind.STANDARD, choice.identifier) for choice in job.standards)
        used.extend((Kind.EFFECT, choice.identifier) for choice in job.effects)
        return {key[1]: self.origins[key].release for key in used}

    def _find(
        self, kind: Kind, offered: tuple[Offered, ...], identifier: str, named_at: Place | None
    ) -> Offered:
        for each in offered:
            if each.identifier == identifier:
                return each
        known = [each.identifier for each in offered]
        lines = [f"no plugin provides {kind.label} {identifier[:60]!r}; {did_you_mean(identifier, known)}"]
        lines.extend(f"plugin {each.plugin.name} was not loaded: {each.reason}" for each in self.failed)
        lines.extend(f"plugin {name} is switched off by {DISABLE}" for name in self.disabled)
        raise InputError.at(named_at or Place("zlmreport"), "\n  ".join(lines))


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
            failed.append(FailedPlugin(plugin, _reason(error)))
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
        raise InputError.at(Place(str(path), _line_in(path, error)), _reason(error)) from error
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


def collect(
    loaded: Iterable[tuple[Plugin, object]],
    failed: Iterable[FailedPlugin] = (),
    disabled: Iterable[str] = (),
) -> Registry:
    """Ask loaded plugins for what they offer.

    Parameters
    ----------
    loaded
        Plugins with their modules, or any objects that have hooks.
    failed, disabled
        Plugins that are known not to work, and those that are switched off.

    Raises
    ------
    InputError
        If two plugins offer the same, or one has a misspelt hook.
    """
    loaded = tuple(loaded)
    problems = [problem for plugin, module in loaded for problem in _misspelt_hooks(plugin, module)]
    failures = list(failed)
    found: dict[tuple[Kind, str], tuple[Plugin, Any]] = {}
    for plugin, module in loaded:
        try:
            offers = _offers(plugin, module)
        except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever a plugin does, the others work
            failures.append(FailedPlugin(plugin, _reason(error)))
            continue
        for key, offered in offers:
            if key in found:
                problems.append(_clash(key, found[key][0], plugin))
            found[key] = (plugin, offered)
    if problems:
        raise InputError(problems)
    in_order = sorted(found.items(), key=lambda item: (item[0][0].label, item[0][1]))

    def of_kind(kind: Kind) -> tuple[Any, ...]:
        return tuple(offered for key, (_, offered) in in_order if key[0] is kind)

    return Registry(
        cast("tuple[Standard, ...]", of_kind(Kind.STANDARD)),
        cast("tuple[DataSource, ...]", of_kind(Kind.SOURCE)),
        cast("tuple[Renderer, ...]", of_kind(Kind.RENDERER)),
        cast("tuple[Effect, ...]", of_kind(Kind.EFFECT)),
        MappingProxyType({key: plugin for key, (plugin, _) in in_order}),
        tuple(sorted(failures, key=lambda each: each.plugin.name)),
        tuple(disabled),
        cast("tuple[PartProgram, ...]", of_kind(Kind.PART_PROGRAM)),
        cast("tuple[Instrument, ...]", of_kind(Kind.INSTRUMENT)),
    )


class _UnfitError(Exception):
    """A plugin offers something that is not what its hook asks for."""


def _offers(plugin: Plugin, module: object) -> list[tuple[tuple[Kind, str], object]]:
    """Return what one plugin offers, each checked to be what it should be."""
    manager = pluggy.PluginManager(hookspecs.PROJECT)
    manager.add_hookspecs(hookspecs)
    manager.register(module, plugin.name)
    found = []
    for kind in Kind:
        for hook in getattr(manager.hook, kind.hook).get_hookimpls():
            offers = hook.function()  # not by pluggy's call, which leaves out what forgets to return
            if offers is None:
                raise _UnfitError(f"{kind.hook} returns nothing; return a list")
            for offered in offers:
                _check(kind, offered)
                found.append(((kind, offered.identifier), offered))
    return found


def _check(kind: Kind, offered: Any) -> None:
    """Refuse what does not satisfy the protocol of its kind, naming what it lacks."""
    if isinstance(offered, type):
        raise _UnfitError(f"{kind.hook} offers the class {offered.__name__}; offer an object of it")
    members = [*kind.protocol.__annotations__, *vars(kind.protocol)]
    lacking = [name for name in members if not name.startswith("_") and not hasattr(offered, name)]
    who = f"{kind.label} {getattr(offered, 'identifier', type(offered).__name__)!r}"
    if lacking:
        raise _UnfitError(f"{who} lacks {', '.join(lacking)}")
    if not isinstance(offered.identifier, str) or not _IDENTIFIER.fullmatch(offered.identifier):
        raise _UnfitError(f"{who} needs an identifier of letters, digits and the characters : . _ -")
    if not isinstance(offered.title, Words):
        raise _UnfitError(f"{who} needs a title in Words")
    writes_files = {Kind.RENDERER: ".pdf", Kind.PART_PROGRAM: ".ngc"}
    if kind in writes_files and not (isinstance(offered.suffix, str) and _SUFFIX.fullmatch(offered.suffix)):
        raise _UnfitError(f"{who} needs a suffix such as {writes_files[kind]!r}")
    if kind is Kind.RENDERER:
        return
    if not isinstance(offered.options, type) or not issubclass(offered.options, Options):
        raise _UnfitError(f"{who} needs options that are a subclass of Options")
    taken = sorted(kind.reserved & keys_in(offered.options).keys())
    if taken:
        raise _UnfitError(f"{who} cannot have the key {taken[0]!r} of its own: the job has one")
    if kind is Kind.EFFECT:
        _check_names(who, offered)


def _check_names(who: str, effect: Effect) -> None:
    """Refuse an effect whose job keys, names of parameters among them, mean two things."""
    names = [parameter.name for parameter in (*effect.linear, *effect.searched)]
    names.extend(keys_in(effect.options))
    twice = sorted(name for name, times in Counter(names).items() if times > 1)
    if twice:
        raise _UnfitError(f"{who} has two parameters or keys called {twice[0]!r}")


def _misspelt_hooks(plugin: Plugin, module: object) -> Iterator[Problem]:
    """Yield functions that look like hooks and would never be called."""
    way_out = f"(or switch the plugin off: {DISABLE}={plugin.name})"
    place = Place(f"plugin {plugin.name}")
    for name in dir(module):
        if not name.startswith(f"{hookspecs.PROJECT}_") or not inspect.isroutine(getattr(module, name, None)):
            continue
        if name not in _HOOKS:
            yield Problem(place, f"{name} is no hook; {did_you_mean(name, _HOOKS)} {way_out}")
        elif not hasattr(getattr(module, name), f"{hookspecs.PROJECT}_impl"):
            yield Problem(place, f"{name} is not marked as a hook; put @hookimpl above it {way_out}")


def _clash(key: tuple[Kind, str], first: Plugin, second: Plugin) -> Problem:
    kind, identifier = key
    return Problem(
        Place(f"plugin {second.name}"),
        f"two plugins provide {kind.label} {identifier!r}: {first.module or first.name} and "
        f"{second.module or second.name}; switch one off: {DISABLE}={second.name}",
    )


def _reason(error: BaseException) -> str:
    """Return in one line why a plugin fails, with the line of it that does."""
    message = " ".join(str(error).split())[:_LONGEST_REASON]
    if isinstance(error, _UnfitError | ImportError | SyntaxError | pluggy.PluginValidationError):
        return message
    if isinstance(error, OSError):
        return message or type(error).__name__
    frames = traceback.extract_tb(error.__traceback__)
    where = f" ({Path(frames[-1].filename).name}, line {frames[-1].lineno})" if frames else ""
    return f"{type(error).__name__}{f': {message}' if message else ''}{where}"
