"""Every name of the door for plugins, with what it means, as the code says it."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import FunctionType

from markdown import code, table

from zlmreport import plugin as door
from zlmreport.language import Language, Words
from zlmreport.quantities.units import Scale, Unit

#: Rooms of the house and what their names are for, in the order of the page.
_TOPICS = {
    "plugin": "What a plugin is",
    "language": "Words in all languages",
    "errors": "Messages",
    "job": "Job keys",
    "measurement": "Readings",
    "quantities": "Units and numbers",
    "evaluation": "Standards",
    "figures": "Graphs",
    "certificate": "The document",
    "presenting": "The document in words",
    "typesetting": "Pages in HTML",
    "uncertainty": "Uncertainty",
    "model": "Effects",
    "correction": "Air and temperature",
    "planning": "Plans and part programs",
    "live": "Live instruments",
    "emulation": "Emulated instruments",
    "capture": "Journals of live captures",
}
_COMMENT = re.compile(r"((?:^#:.*\n)+)^(\w+)\b[^\n=]*=", re.MULTILINE)


def text() -> str:
    """Return a table of names for each topic."""
    by_room: dict[str, list[str]] = {}
    for name in sorted(door.__all__, key=lambda name: (name.lower(), name)):
        module, _ = door.home_of(name)
        by_room.setdefault(module.split(".")[1], []).append(name)
    order = [*_TOPICS, *sorted(by_room.keys() - _TOPICS.keys())]
    return "\n\n".join(part for room in order if room in by_room for part in _topic(room, by_room[room]))


def stub() -> str:
    """Return what a type checker reads of the door: its names, by the modules that they come from."""
    by_module: dict[str, list[str]] = {}
    for name in sorted(door.__all__):
        module, own = door.home_of(name)
        by_module.setdefault(module, []).append(name if own == name else f"{own} as {name}")
    return "\n".join(
        (
            '"""The door for type checkers; ``python docs/generate`` writes it."""\n',
            *(f"from {module} import {', '.join(names)}" for module, names in sorted(by_module.items())),
            f"\n__all__ = {sorted(door.__all__)}\n".replace("'", '"'),
            "def home_of(name: str) -> tuple[str, str]: ...\n",
        )
    )


def _topic(room: str, names: list[str]) -> Iterator[str]:
    yield f"### {_TOPICS.get(room, room.replace('_', ' ').capitalize())}"
    yield table(("Name", "Meaning"), ((code(_written(name)), meaning(name)) for name in names))


def _written(name: str) -> str:
    """Return a name as it is used: a function with the names of what it takes."""
    value = getattr(door, name)
    if not (isinstance(value, FunctionType) or hasattr(value, "__wrapped__")):
        return name
    return f"{name}({', '.join(inspect.signature(value).parameters)})"


def meaning(name: str) -> str:
    """Return in a sentence what a name of the door stands for; empty if nobody says."""
    value = getattr(door, name)
    if isinstance(value, type | FunctionType) or hasattr(value, "__wrapped__"):
        said = (inspect.getdoc(value) or "").partition("\n\n")[0]
    elif isinstance(value, Words):
        said = f"“{value.in_language(Language.ENGLISH)}”"
    elif isinstance(value, Unit | Scale):
        said = f"The unit {value.symbol}."
    else:
        said = _commented(name)
    return re.sub(r"`+", "`", " ".join(said.split()))


def _commented(name: str) -> str:
    """Return the comment before a constant."""
    module, own = door.home_of(name)
    source = Path(import_module(module).__file__ or "").read_text(encoding="utf-8")
    for match in _COMMENT.finditer(source):
        if match[2] == own:
            return " ".join(line.removeprefix("#:").strip() for line in match[1].splitlines())
    return ""
