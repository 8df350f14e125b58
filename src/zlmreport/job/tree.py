"""The values of a YAML file as a tree with places, before anything is checked; and how two are merged."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TypeAlias

from zlmreport.errors import Place

#: A key, or a place in a list, on the way to a value.
Step: TypeAlias = str | int

#: Groups in which each job has something of its own: what they lack is added to it, not to what it extends.
_OF_EACH_JOB = frozenset({"certificate", "axis", "measurement", "as_found", "source"})

_NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?", re.ASCII)


@dataclass(frozen=True, slots=True)
class Scalar:
    """A single value as it is spelt."""

    place: Place  #: Where it stands; where nothing stands, its key.
    text: str  #: The value's text, quotes and line folding resolved.
    plain: bool = True  #: Whether it stands without quotes: only then can it be empty, or a number.

    @property
    def is_nothing(self) -> bool:
        """Whether the key is there without a value."""
        return self.plain and self.text in {"", "~", "null"}

    @property
    def is_number(self) -> bool:
        """Whether it is written as a number of YAML 1.2; infinity and NaN are none here."""
        return self.plain and _NUMBER.fullmatch(self.text) is not None


@dataclass(frozen=True, slots=True)
class Items:
    """A list."""

    place: Place
    items: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class KeyEntry:
    """A key with its place, and its value."""

    key: str
    place: Place
    value: Node


@dataclass(frozen=True, slots=True)
class Keys:
    """A group of keys, in the order in which they stand."""

    place: Place  #: Where it begins; of one that a job takes over and adds to, where the job would have it.
    entries: Mapping[str, KeyEntry]

    def without(self, *keys: str) -> Keys:
        """Return the group without some of its keys."""
        kept = {key: entry for key, entry in self.entries.items() if key not in keys}
        return Keys(self.place, MappingProxyType(kept))


Node: TypeAlias = Scalar | Items | Keys


def make_keys_of(place: Place, entries: Iterator[KeyEntry] | tuple[KeyEntry, ...] = ()) -> Keys:
    """Return a group of entries."""
    return Keys(place, MappingProxyType({entry.key: entry for entry in entries}))


def walk(tree: Node, path: tuple[Step, ...]) -> Iterator[tuple[Step, Place, Node]]:
    """Follow a path as far as it exists: yield each step, the place that stands for it, and its value.

    A group or a list is where its key stands, for that is the line that a reader looks for; a single
    value is where it stands itself.
    """
    node = tree
    for step in path:
        if isinstance(node, Keys) and isinstance(step, str) and step in node.entries:
            entry = node.entries[step]
            node = entry.value
            place = node.place if isinstance(node, Scalar) else entry.place
        elif isinstance(node, Items) and isinstance(step, int) and 0 <= step < len(node.items):
            node = node.items[step]
            place = node.place
        else:
            return
        yield step, place, node


def place_of(tree: Node, path: tuple[Step, ...]) -> Place:
    """Return the place of a value; of a missing one, of its nearest parent in the file that lacks it."""
    found = [("", tree.place, tree), *walk(tree, path)]
    *_, (_, place, group) = found
    if len(found) > len(path) or not isinstance(group, Keys) or group.place.file == place.file:
        return place
    return next((each for _, each, _ in reversed(found) if each.file == group.place.file), group.place)


def find_key_place(tree: Node, path: tuple[Step, ...]) -> Place:
    """Return the place of a key, or of its nearest parent that exists."""
    node = tree
    for _, _, node in walk(tree, path[:-1]):  # noqa: B007 - the last group found is the answer
        pass
    if path and isinstance(node, Keys) and path[-1] in node.entries:
        return node.entries[str(path[-1])].place
    return place_of(tree, path)


def find_at(tree: Node, path: tuple[Step, ...]) -> Node | None:
    """Return the value at a path; None if there is none."""
    found = list(walk(tree, path))
    return found[-1][2] if len(found) == len(path) else None


def merge(base: Keys, own: Keys) -> Keys:
    """Return the keys of two files together: groups are merged, anything else of `own` replaces."""
    entries = {key: _take_over(entry, own.place) for key, entry in base.entries.items()}
    for key, entry in own.entries.items():
        value = entry.value
        inherited = entries.get(key)
        if inherited and isinstance(inherited.value, Keys) and isinstance(value, Keys):
            value = merge(inherited.value, value)
        entries[key] = KeyEntry(key, entry.place, value)
    return Keys(own.place, MappingProxyType(entries))


def _take_over(entry: KeyEntry, place: Place) -> KeyEntry:
    """Return a key of another file; a group to which each job adds is where the job would add to it."""
    group = entry.value
    if entry.key not in _OF_EACH_JOB or not isinstance(group, Keys):
        return entry
    within = (_take_over(each, place) for each in group.entries.values())
    return KeyEntry(entry.key, entry.place, make_keys_of(place, within))


def walk_scalars(tree: Node) -> Iterator[Scalar]:
    """Yield every single value."""
    if isinstance(tree, Scalar):
        yield tree
    else:
        parts = tree.items if isinstance(tree, Items) else (entry.value for entry in tree.entries.values())
        for part in parts:
            yield from walk_scalars(part)
