"""Asks loaded plugins for what they offer, and refuses contradictions between them."""

from __future__ import annotations

from collections.abc import Iterable
from types import MappingProxyType
from typing import Any, cast

import pluggy

from zlmreport.errors import InputError, Place, Problem
from zlmreport.model.effect import Effect
from zlmreport.plugin import hookspecs
from zlmreport.plugin.protocols import (
    DataSource,
    Instrument,
    PartProgram,
    ProbingProgram,
    Renderer,
    Standard,
)
from zlmreport.plugins.fitness import check, misspelt_hooks
from zlmreport.plugins.kind import Kind
from zlmreport.plugins.origin import FailedPlugin, Plugin, UnfitError, reason_of
from zlmreport.plugins.registry import DISABLE, Registry


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
    problems = [problem for plugin, module in loaded for problem in misspelt_hooks(plugin, module)]
    failures = list(failed)
    found: dict[tuple[Kind, str], tuple[Plugin, Any]] = {}
    for plugin, module in loaded:
        try:
            offers = _offers(plugin, module)
        except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever a plugin does, the others work
            failures.append(FailedPlugin(plugin, reason_of(error)))
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
        cast("tuple[ProbingProgram, ...]", of_kind(Kind.PROBING_PROGRAM)),
    )


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
                raise UnfitError(f"{kind.hook} returns nothing; return a list")
            for offered in offers:
                check(kind, offered)
                found.append(((kind, offered.identifier), offered))
    return found


def _clash(key: tuple[Kind, str], first: Plugin, second: Plugin) -> Problem:
    kind, identifier = key
    return Problem(
        Place(f"plugin {second.name}"),
        f"two plugins provide {kind.label} {identifier!r}: {first.module or first.name} and "
        f"{second.module or second.name}; switch one off: {DISABLE}={second.name}",
    )
