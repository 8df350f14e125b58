"""What a model refuses, gathered by the value that it refuses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from zlmreport.errors import Place
from zlmreport.job.tree import Keys, Node, Step, key_place, place_of, walk

#: Kinds of mistakes that a value makes which is no text, no group, and so on.
TEXT_EXPECTED = frozenset({"string_type", "literal_error", "enum", "path_type", "value_error"})
GROUP_EXPECTED = frozenset({"model_type", "model_attributes_type", "dict_type", "mapping_type"})
#: The key itself is the mistake: it is not there, or should not be.
MISSING = "missing"
UNKNOWN = "extra_forbidden"


@dataclass(frozen=True, slots=True)
class Refusal:
    """One reason why a value does not fit: a kind in pydantic's naming, with its numbers or choices."""

    kind: str
    context: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Mistake:
    """A value that does not fit, a key that is missing, or one that is unknown.

    Attributes
    ----------
    path
        Keys and indices that lead to it.
    place
        Where it stands; of what is missing, the group that should have it.
    node
        The value; None where it is missing.
    refusals
        Why: several where a key takes several kinds of values, and this is none of them.
    """

    path: tuple[Step, ...]
    place: Place
    node: Node | None
    refusals: tuple[Refusal, ...]

    @property
    def kinds(self) -> frozenset[str]:
        """The kinds of all refusals."""
        return frozenset(refusal.kind for refusal in self.refusals)


def mistakes_in(error: ValidationError, keys: Keys) -> tuple[Mistake, ...]:
    """Return the mistakes that a model found in a group of keys."""
    gathered: dict[tuple[Step, ...], list[Refusal]] = {}
    for details in error.errors(include_url=False, include_input=False):
        refusal = Refusal(details["type"], details.get("ctx", {}))
        gathered.setdefault(_path(details, keys), []).append(refusal)
    return tuple(
        Mistake(path, _place(keys, path, refusals), _node(keys, path), tuple(refusals))
        for path, refusals in gathered.items()
        if not _explained_below(path, gathered)
    )


def _path(details: ErrorDetails, keys: Keys) -> tuple[Step, ...]:
    """Return a mistake's path in the job, without the names that pydantic gives to alternatives of a type."""
    path = tuple(_steps_that_exist(details["loc"], keys))
    return (*path, details["loc"][-1]) if details["type"] == MISSING else path


def _steps_that_exist(location: tuple[Step, ...], keys: Keys) -> Iterator[Step]:
    node: Node = keys
    for step in location:
        for existing, _, value in walk(node, (step,)):
            yield existing
            node = value


def _place(keys: Keys, path: tuple[Step, ...], refusals: list[Refusal]) -> Place:
    """Return the place of a value, or of an unknown key."""
    if any(refusal.kind == UNKNOWN for refusal in refusals):
        return key_place(keys, path)
    return place_of(keys, path)


def _node(keys: Keys, path: tuple[Step, ...]) -> Node | None:
    found = list(walk(keys, path))
    if len(found) < len(path):
        return None
    return found[-1][2] if found else keys


def _explained_below(path: tuple[Step, ...], gathered: dict[tuple[Step, ...], list[Refusal]]) -> bool:
    """Whether a part of the value has a mistake: then the value is right in kind, and only its part wrong."""
    return any(len(other) > len(path) and other[: len(path)] == path for other in gathered)
