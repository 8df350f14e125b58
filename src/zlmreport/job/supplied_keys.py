"""Keys that a job names because others supplied their values: the customer, or an external provider."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import BaseModel

from zlmreport.errors import Problem, did_you_mean
from zlmreport.job.fields import keys_in, model_at
from zlmreport.job.model import JobKeys
from zlmreport.job.text import quoted
from zlmreport.job.tree import Items, Keys, Node, Step, place_of

#: The parts of a job in which others may supply a value; the laboratory answers for the rest itself.
_PARTS = frozenset(
    {
        "customer",
        "machine",
        "axis",
        "location",
        "dates",
        "sampling",
        "measurement",
        "as_found",
        "instrument",
        "environment",
        "corrections",
        "uncertainty",
        "evaluate",
    }
)


def markable_keys() -> tuple[str, ...]:
    """Return the dotted names of all keys whose values may come from others; lists have no index in them."""
    return tuple(key for key in _names(JobKeys, "") if key.partition(".")[0] in _PARTS)


def supplied_problems(keys: JobKeys, tree: Keys) -> Iterator[Problem]:
    """Yield every key that is said to be somebody else's and is unknown, or not stated by the job."""
    known = markable_keys()
    for key, path in _named(keys):
        where = ".".join(step for step in path if isinstance(step, str))
        place = place_of(tree, path)
        if key not in known:
            near = did_you_mean(key, _neighbours(key, known))
            yield Problem(place, f"{where}: {quoted(key)} is no key whose value others can supply; {near}")
        elif not _is_stated(tree, key.split(".")):
            yield Problem(place, f"{where}: this job does not state {key}; state it, or do not list it")


def _named(keys: JobKeys) -> Iterator[tuple[str, tuple[Step, ...]]]:
    """Yield the keys that a job names as others', each with the path at which it does."""
    for index, key in enumerate(keys.provided_by_customer):
        yield key, ("provided_by_customer", index)
    for number, external in enumerate(keys.external):
        for index, key in enumerate(external.keys):
            yield key, ("external", number, "keys", index)


def _names(model: type[BaseModel], within: str) -> Iterator[str]:
    for name in keys_in(model):
        yield f"{within}{name}"
        part = model_at(model, (name,)) or model_at(model, (name, 0))
        if part:
            yield from _names(part, f"{within}{name}.")


def _neighbours(key: str, known: tuple[str, ...]) -> list[str]:
    """Return the keys among which a misspelt one belongs: those of its group, if there is such a group."""
    group = key.rpartition(".")[0]
    return [each for each in known if each.rpartition(".")[0] == group] or list(known)


def _is_stated(node: Node, steps: list[str]) -> bool:
    """Whether a key stands in the job; a key of a list's items, if any of them has it."""
    if not steps:
        return True
    if isinstance(node, Items):
        return any(_is_stated(item, steps) for item in node.items)
    if isinstance(node, Keys) and steps[0] in node.entries:
        return _is_stated(node.entries[steps[0]].value, steps[1:])
    return False
