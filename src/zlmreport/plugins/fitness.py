"""Whether what a plugin offers is what its hook asks for."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from typing import Any

from zlmreport.errors import Place, Problem, did_you_mean
from zlmreport.plugin.kinds import KINDS, PROJECT, Kind
from zlmreport.plugins.origin import DISABLE, Plugin, UnfitError

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
    from zlmreport.job.fields import keys_in  # noqa: PLC0415 - brings pydantic, which a renderer may not need
    from zlmreport.job.types import Options  # noqa: PLC0415

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
