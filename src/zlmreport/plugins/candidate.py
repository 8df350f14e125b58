"""A plugin that is loaded when somebody asks for what it offers."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import Any, TypeAlias

import pluggy

from zlmreport.boundary.guard import guarded
from zlmreport.errors import Problem
from zlmreport.plugin.kinds import KINDS, PROJECT, specifications
from zlmreport.plugins.fitness import check, misspelt_hooks
from zlmreport.plugins.origin import FailedPlugin, Plugin, UnfitError, reason_of

#: Name of a kind, and an identifier.
Key: TypeAlias = tuple[str, str]


class Candidate:
    """A plugin that is loaded when somebody asks for what it offers.

    Parameters
    ----------
    plugin
        Where it comes from.
    load
        Returns its module, or any object that has hooks.
    declared
        What it is known to offer before it is loaded; None if nobody knows.
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
