"""A plugin, loaded when asked; where it comes from, why it fails; the variables ``ZLMREPORT_…PLUGINS``."""

from __future__ import annotations

import inspect
import re
import traceback
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

import pluggy

from zlmreport.errors import Place, Problem, ZlmreportError, did_you_mean
from zlmreport.plugin.boundary import guard
from zlmreport.plugin.hooks import PROJECT
from zlmreport.plugin.kinds import KINDS, Kind
from zlmreport.plugin.registry.members import find_unlike
from zlmreport.presence import PRESENCE

#: Environment variable that switches plugins off.
DISABLE = "ZLMREPORT_DISABLE_PLUGINS"
#: Names files that are plugins, parted as in PATH.
FILES = "ZLMREPORT_PLUGINS"

_LONGEST_REASON = 300


@dataclass(frozen=True, slots=True)
class Plugin:
    """Where a plugin comes from."""

    name: str  #: Of its entry point; of a plugin in a file of its own, the file's without its suffix.
    module: str = ""  #: That the entry point names, or the file.
    #: distribution and version: What was installed; empty for a file.
    distribution: str = ""
    version: str = ""

    @property
    def release(self) -> str:
        """Distribution and version: ``zlmreport 0.1.0``."""
        return f"{self.distribution} {self.version}".strip()

    @property
    def in_words(self) -> str:
        """As messages call it: ``plugin house (zlmreport-house 1.0)``, or the file."""
        where = self.release or self.module
        return f"plugin {self.name} ({where})" if where else f"plugin {self.name}"


@dataclass(frozen=True, slots=True)
class FailedPlugin:
    """A plugin that could not be loaded, and why."""

    plugin: Plugin
    reason: str


class UnfitError(Exception):
    """A plugin offers something that is not what its hook asks for."""


def say_reason_of(error: BaseException) -> str:
    """Return in one line why a plugin fails, with the line of it that does."""
    message = " ".join(str(error).split())[:_LONGEST_REASON]
    if isinstance(
        error, UnfitError | ImportError | SyntaxError | pluggy.PluginValidationError | ZlmreportError
    ):
        return message
    if isinstance(error, OSError):
        return message or type(error).__name__
    frames = traceback.extract_tb(error.__traceback__)
    where = f" ({Path(frames[-1].filename).name}, line {frames[-1].lineno})" if frames else ""
    return f"{type(error).__name__}{f': {message}' if message else ''}{where}"


#: Name of a kind, and an identifier.
Key: TypeAlias = tuple[str, str]


class PluginCandidate:
    """A plugin that is loaded when somebody asks for what it offers.

    `load`: Returns its module, or any object that has hooks.
    `named`: Kind and identifier of the one object that its entry point names; None where it names a module
        of which nobody knows what it offers before it is loaded.
    """

    def __init__(
        self, plugin: Plugin, load: Callable[[], object], named: tuple[Kind[Any], str] | None = None
    ) -> None:
        self.plugin = plugin
        self.failure: FailedPlugin | None = None
        self.misspelt: tuple[Problem, ...] = ()
        self._load = load
        self._named = named
        self._said = frozenset({(named[0].name, named[1])}) if named else None
        self._offered: Mapping[Key, Any] | None = None

    @property
    def keys(self) -> Collection[Key]:
        """What it offers: as its entry point says, or as it says itself."""
        return self.offered if self._said is None or self.failure else self._said

    @property
    def offered(self) -> Mapping[Key, Any]:
        """What it offers; nothing where it does not work: then `failure` says why."""
        if self._offered is None:
            self._offered = {}
            before = PRESENCE.begin(f"{self.plugin.in_words}: loading")
            try:
                module = self._load()
                self.misspelt = tuple(find_misspelt_hooks(self.plugin, module))
                self._offered = _checked(self.plugin, module, self._named)
            except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever a plugin does, the others work
                self.failure = FailedPlugin(self.plugin, say_reason_of(error))
            wrong = PRESENCE.end(before)
            if wrong:
                self._offered, self.failure = {}, FailedPlugin(self.plugin, wrong)
        return self._offered


def _checked(plugin: Plugin, module: object, named: tuple[Kind[Any], str] | None) -> Mapping[Key, Any]:
    """Return what one plugin offers, each checked to be what it should be, and behind the boundary.

    A manager for each plugin: so one that raises does not keep the others from being asked, and a module
    whose objects have an entry point each can be registered for each.
    """
    manager = pluggy.PluginManager(PROJECT)
    manager.add_hookspecs(_HOOK_SPECS)
    manager.register(module, plugin.name)
    found: dict[Key, Any] = {}
    others: list[str] = []
    for kind in (named[0],) if named else KINDS:
        for offered in _list_answers(manager, kind):
            identifier = getattr(offered, "identifier", None)
            if named and identifier != named[1]:
                others.append(str(identifier))
                continue
            check(kind, offered)
            if (kind.name, identifier) in found:
                raise UnfitError(f"offers {kind.label} {identifier!r} twice")
            found[kind.name, offered.identifier] = guard(kind, offered, plugin.in_words)
    if named and not found:
        kind, identifier = named
        nearest = f" of that name; {did_you_mean(identifier, others)}" if others else ""
        raise UnfitError(
            f"its entry point names {kind.label} {identifier!r}, and {kind.hook} offers none{nearest}"
        )
    return found


def _list_answers(manager: pluggy.PluginManager, kind: Kind[Any]) -> Iterator[Any]:
    """Yield what a plugin answers to the hook of a kind."""
    hook = getattr(manager.hook, kind.hook)
    answers = hook()
    if len(answers) < len(hook.get_hookimpls()):  # pluggy leaves out what forgets to return
        raise UnfitError(f"{kind.hook} returns nothing; return a list")
    for answer in answers:
        if not isinstance(answer, Iterable) or isinstance(answer, str):
            raise UnfitError(f"{kind.hook} returns an object of type {type(answer).__name__}; return a list")
        yield from answer


_IDENTIFIER = re.compile(r"[A-Za-z0-9][A-Za-z0-9:._-]*")
_SUFFIX = re.compile(r"(\.[A-Za-z0-9]+)+")
_HOOKS = tuple(kind.hook for kind in KINDS)
_specified = pluggy.HookspecMarker(PROJECT)
#: What every plugin can be asked, whether or not it answers.
_HOOK_SPECS = type("HookSpecs", (), {hook: _specified(lambda: ()) for hook in _HOOKS})


def check(kind: Kind[Any], offered: Any) -> None:
    """Refuse what does not satisfy the interface of its kind, naming what it lacks."""
    if isinstance(offered, type):
        raise UnfitError(f"{kind.hook} offers the class {offered.__name__}; offer an object of it")
    lacking = [name for name in kind.members if not hasattr(offered, name)]
    who = f"{kind.label} {getattr(offered, 'identifier', type(offered).__name__)!r}"
    if lacking:
        raise UnfitError(f"{who} lacks {', '.join(lacking)}")
    if not isinstance(offered.identifier, str) or not _IDENTIFIER.fullmatch(offered.identifier):
        raise UnfitError(f"{who} needs an identifier of letters, digits and the characters : . _ -")
    from zlmreport.language import Words  # noqa: PLC0415 - a listing of names needs no phrases

    if not isinstance(offered.title, Words):
        raise UnfitError(f"{who} needs a title in Words")
    if kind.suffix and not (isinstance(offered.suffix, str) and _SUFFIX.fullmatch(offered.suffix)):
        raise UnfitError(f"{who} needs a suffix such as {kind.suffix!r}")
    if kind.has_keys:
        _check_keys(kind, who, offered.options)
    if unlike := list(find_unlike(kind.protocol, offered)):
        raise UnfitError(f"{who} needs {'; '.join(unlike)}")
    if reason := kind.lacks(offered):
        raise UnfitError(f"{who} {reason}")


def _check_keys(kind: Kind[Any], who: str, options: object) -> None:
    """Refuse job keys that are none, or that the job has itself."""
    from pydantic import PydanticUndefinedAnnotation, PydanticUserError  # noqa: PLC0415 - a renderer has no keys

    from zlmreport.job.types import Options, list_keys_in  # noqa: PLC0415 - the same

    if not isinstance(options, type) or not issubclass(options, Options):
        raise UnfitError(f"{who} needs options that are a subclass of Options")
    try:
        options.model_rebuild()
    except (PydanticUserError, PydanticUndefinedAnnotation) as error:  # a name that nobody knows
        reason = f"{options.__name__}: {error.message}"
        raise UnfitError(f"{who} has options that cannot be used, {reason}") from None
    taken = sorted(kind.reserved & list_keys_in(options).keys())
    if taken:
        raise UnfitError(f"{who} cannot have the key {taken[0]!r} of its own: the job has one")


def find_misspelt_hooks(plugin: Plugin, module: object) -> Iterator[Problem]:
    """Yield functions that look like hooks and would never be called."""
    way_out = f"(or switch the plugin off: {DISABLE}={plugin.name})"
    place = Place(f"plugin {plugin.name}")
    for name in dir(module):
        if not name.startswith(f"{PROJECT}_") or not inspect.isroutine(getattr(module, name, None)):
            continue
        if name not in _HOOKS:
            yield Problem(place, f"{name} is no hook; {did_you_mean(name, _HOOKS)} {way_out}")
        elif not hasattr(getattr(module, name), f"{PROJECT}_impl"):
            yield Problem(place, f"{name} is not marked as a hook; put @hookimpl above it {way_out}")
