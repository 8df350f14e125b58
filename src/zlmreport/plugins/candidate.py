"""A plugin that is loaded when somebody asks for it: where it comes from, and why it does not work."""

from __future__ import annotations

import inspect
import re
import traceback
from collections.abc import Callable, Collection, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeAlias

import pluggy

from zlmreport.boundary import guarded
from zlmreport.errors import Place, Problem, did_you_mean
from zlmreport.plugin.kinds import KINDS, PROJECT, Kind, specifications
from zlmreport.values import dataclass

#: Environment variable that switches plugins off.
DISABLE = "ZLMREPORT_DISABLE_PLUGINS"

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


def reason_of(error: BaseException) -> str:
    """Return in one line why a plugin fails, with the line of it that does."""
    message = " ".join(str(error).split())[:_LONGEST_REASON]
    if isinstance(error, UnfitError | ImportError | SyntaxError | pluggy.PluginValidationError):
        return message
    if isinstance(error, OSError):
        return message or type(error).__name__
    frames = traceback.extract_tb(error.__traceback__)
    where = f" ({Path(frames[-1].filename).name}, line {frames[-1].lineno})" if frames else ""
    return f"{type(error).__name__}{f': {message}' if message else ''}{where}"


#: Name of a kind, and an identifier.
Key: TypeAlias = tuple[str, str]


class Candidate:
    """A plugin that is loaded when somebody asks for what it offers.

    `load`: Returns its module, or any object that has hooks.
    `declared`: What it is known to offer before it is loaded; None if nobody knows.
    """

    def __init__(
        self, plugin: Plugin, load: Callable[[], object], declared: Collection[Key] | None = None
    ) -> None:
        self.plugin = plugin
        self.failure: FailedPlugin | None = None
        self.misspelt: tuple[Problem, ...] = ()
        self._load = load
        self._declared = declared
        self._offered: Mapping[Key, Any] | None = None

    @property
    def keys(self) -> Collection[Key]:
        """What it offers: as declared, or as it says itself."""
        return self.offered if self._declared is None or self.failure else self._declared

    @property
    def offered(self) -> Mapping[Key, Any]:
        """What it offers; nothing where it does not work: then `failure` says why."""
        if self._offered is None:
            self._offered = {}
            try:
                module = self._load()
                self.misspelt = tuple(misspelt_hooks(self.plugin, module))
                self._offered = self._as_declared(_offers(self.plugin, module))
            except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever a plugin does, the others work
                self.failure = FailedPlugin(self.plugin, reason_of(error))
        return self._offered

    def _as_declared(self, offered: Mapping[Key, Any]) -> Mapping[Key, Any]:
        """Refuse another offer than the declared one: it would be found on one day and not on the next."""
        if self._declared is not None and set(self._declared) != offered.keys():
            different = sorted(set(self._declared) ^ offered.keys())
            named = ", ".join(f"{kind} {identifier!r}" for kind, identifier in different)
            raise UnfitError(f"offers other things than its distribution declares: {named}")
        return offered


def _offers(plugin: Plugin, module: object) -> Mapping[Key, Any]:
    """Return what one plugin offers, each checked to be what it should be, and behind the boundary."""
    manager = pluggy.PluginManager(PROJECT)
    manager.add_hookspecs(specifications())
    manager.register(module, plugin.name)
    found: dict[Key, Any] = {}
    for kind in KINDS:
        for hook in getattr(manager.hook, kind.hook).get_hookimpls():
            offers = hook.function()  # not by pluggy's call, which leaves out what forgets to return
            if offers is None:
                raise UnfitError(f"{kind.hook} returns nothing; return a list")
            for offered in offers:
                check(kind, offered)
                if (kind.name, offered.identifier) in found:
                    raise UnfitError(f"offers {kind.label} {offered.identifier!r} twice")
                found[kind.name, offered.identifier] = guarded(kind, offered, plugin.in_words)
    return found


_IDENTIFIER = re.compile(r"[A-Za-z0-9][A-Za-z0-9:._-]*")
_SUFFIX = re.compile(r"(\.[A-Za-z0-9]+)+")
_HOOKS = tuple(kind.hook for kind in KINDS)


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
    if reason := kind.lacks(offered):
        raise UnfitError(f"{who} {reason}")


def _check_keys(kind: Kind[Any], who: str, options: object) -> None:
    """Refuse job keys that are none, or that the job has itself."""
    from zlmreport.job.types import Options, keys_in  # noqa: PLC0415 - brings pydantic: a renderer has no keys

    if not isinstance(options, type) or not issubclass(options, Options):
        raise UnfitError(f"{who} needs options that are a subclass of Options")
    taken = sorted(kind.reserved & keys_in(options).keys())
    if taken:
        raise UnfitError(f"{who} cannot have the key {taken[0]!r} of its own: the job has one")


def misspelt_hooks(plugin: Plugin, module: object) -> Iterator[Problem]:
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
