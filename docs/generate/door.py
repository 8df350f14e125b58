"""Every name of the doors for plugins, with what it means, as the code says it."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import FunctionType, ModuleType

from markdown import code, table

from zlmreport import plugin
from zlmreport.language import Language, Words
from zlmreport.measurement.units import Scale, Unit

_COMMENT = re.compile(r"((?:^#:.*\n)+)^(\w+)\b[^\n=]*=", re.MULTILINE)


def text() -> str:
    """Return a table of names for each door."""
    doors = [plugin, *(import_module(f"{plugin.__name__}.{name}") for name in plugin.DOORS)]
    return "\n\n".join(part for door in doors for part in _door(door))


def homes_of(door: ModuleType) -> dict[str, tuple[str, str]]:
    """Return the module in which each name of a door lives, and its name there."""
    tree = ast.parse(inspect.getsource(door))
    return {
        alias.asname or alias.name: (node.module or "", alias.name)
        for node in tree.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
        if (alias.asname or alias.name) in door.__all__
    }


def _door(door: ModuleType) -> Iterator[str]:
    homes = homes_of(door)
    yield f"### `{door.__name__}`"
    yield inspect.getdoc(door) or ""
    names = sorted(homes, key=lambda name: (name.lower(), name))
    yield table(
        ("Name", "Meaning"), ((code(_written(door, name)), meaning(door, name, homes)) for name in names)
    )


def _written(door: ModuleType, name: str) -> str:
    """Return a name as it is used: a function with the names of what it takes."""
    value = getattr(door, name)
    if not (isinstance(value, FunctionType) or hasattr(value, "__wrapped__")):
        return name
    return f"{name}({', '.join(inspect.signature(value).parameters)})"


def meaning(door: ModuleType, name: str, homes: dict[str, tuple[str, str]]) -> str:
    """Return in a sentence what a name of a door stands for; empty if nobody says."""
    value = getattr(door, name)
    if isinstance(value, type | FunctionType) or hasattr(value, "__wrapped__"):
        said = (inspect.getdoc(value) or "").partition("\n\n")[0]
    elif isinstance(value, Words):
        said = f"“{value.in_language(Language.ENGLISH)}”"
    elif isinstance(value, Unit | Scale):
        said = f"The unit {value.symbol}."
    else:
        said = _commented(*homes[name])
    return re.sub(r"`+", "`", " ".join(said.split()))


def _commented(module: str, own: str) -> str:
    """Return the comment before a constant."""
    source = Path(import_module(module).__file__ or "").read_text(encoding="utf-8")
    for match in _COMMENT.finditer(source):
        if match[2] == own:
            return " ".join(line.removeprefix("#:").strip() for line in match[1].splitlines())
    return ""
