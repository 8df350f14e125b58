"""Whether what a plugin offers is what its hook asks for."""

from __future__ import annotations

import inspect
import re
from collections import Counter
from collections.abc import Iterator
from typing import Any

from zlmreport.errors import Place, Problem, did_you_mean
from zlmreport.job.fields import keys_in
from zlmreport.job.types import Options
from zlmreport.language import Words
from zlmreport.model.effect import Effect
from zlmreport.plugin import hookspecs
from zlmreport.plugins.kind import Kind
from zlmreport.plugins.origin import Plugin, UnfitError
from zlmreport.plugins.registry import DISABLE

_IDENTIFIER = re.compile(r"[A-Za-z0-9][A-Za-z0-9:._-]*")
_SUFFIX = re.compile(r"(\.[A-Za-z0-9]+)+")
_HOOKS = tuple(kind.hook for kind in Kind)


def check(kind: Kind, offered: Any) -> None:
    """Refuse what does not satisfy the protocol of its kind, naming what it lacks."""
    if isinstance(offered, type):
        raise UnfitError(f"{kind.hook} offers the class {offered.__name__}; offer an object of it")
    members = [*kind.protocol.__annotations__, *vars(kind.protocol)]
    lacking = [name for name in members if not name.startswith("_") and not hasattr(offered, name)]
    who = f"{kind.label} {getattr(offered, 'identifier', type(offered).__name__)!r}"
    if lacking:
        raise UnfitError(f"{who} lacks {', '.join(lacking)}")
    if not isinstance(offered.identifier, str) or not _IDENTIFIER.fullmatch(offered.identifier):
        raise UnfitError(f"{who} needs an identifier of letters, digits and the characters : . _ -")
    if not isinstance(offered.title, Words):
        raise UnfitError(f"{who} needs a title in Words")
    writes_files = {Kind.RENDERER: ".pdf", Kind.PART_PROGRAM: ".ngc", Kind.PROBING_PROGRAM: ".dmi"}
    if kind in writes_files and not (isinstance(offered.suffix, str) and _SUFFIX.fullmatch(offered.suffix)):
        raise UnfitError(f"{who} needs a suffix such as {writes_files[kind]!r}")
    if kind is Kind.RENDERER:
        return
    if not isinstance(offered.options, type) or not issubclass(offered.options, Options):
        raise UnfitError(f"{who} needs options that are a subclass of Options")
    taken = sorted(kind.reserved & keys_in(offered.options).keys())
    if taken:
        raise UnfitError(f"{who} cannot have the key {taken[0]!r} of its own: the job has one")
    if kind is Kind.EFFECT:
        _check_names(who, offered)


def _check_names(who: str, effect: Effect) -> None:
    """Refuse an effect whose job keys, names of parameters among them, mean two things."""
    names = [parameter.name for parameter in (*effect.linear, *effect.searched)]
    names.extend(keys_in(effect.options))
    twice = sorted(name for name, times in Counter(names).items() if times > 1)
    if twice:
        raise UnfitError(f"{who} has two parameters or keys called {twice[0]!r}")


def misspelt_hooks(plugin: Plugin, module: object) -> Iterator[Problem]:
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
