"""Holding a group of keys against the model that describes it."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from zlmreport.errors import Problem
from zlmreport.job.references import LocatedText
from zlmreport.job.sentences import GROUP_EXPECTED, MISSING, TEXT_EXPECTED, Mistake, mistakes_in, problem
from zlmreport.job.tree import Items, Keys, Node, Scalar, Step

Model = TypeVar("Model", bound=BaseModel)
Path = tuple[Step, ...]

_NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?", re.ASCII)
_NO_NUMBER = re.compile(r"[-+]?\.(inf|nan)", re.IGNORECASE)
_MOST_DIGITS = 400


def validate(
    model: type[Model],
    keys: Keys,
    problems: list[Problem],
    *,
    within: str = "",
    also_known: Collection[str] = (),
) -> Model | None:
    """Return a group of keys as its model, or None and all that is wrong with it.

    Parameters
    ----------
    model
        The keys that there are, with types and descriptions.
    keys
        What the job says.
    problems
        Where mistakes are added.
    within
        The dotted path of the group in the job, for messages.
    also_known
        Keys that belong to the group and are not the model's, for messages.
    """
    found, mistakes = _read(model, keys)
    problems.extend(problem(mistake, model, within, also_known) for mistake in mistakes)
    return found


def problems_in_part(model: type[BaseModel], keys: Keys, within: str) -> list[Problem]:
    """Return what is wrong with some keys of a group, the rest of which stands elsewhere."""
    _, mistakes = _read(model, keys)
    return [problem(mistake, model, within, ()) for mistake in mistakes if mistake.kinds != {MISSING}]


def _read(model: type[Model], keys: Keys) -> tuple[Model | None, tuple[Mistake, ...]]:
    """Return a group of keys as its model, or None and the mistakes in it."""
    readings: dict[Path, Callable[[Scalar], Any]] = {}
    try:
        return model.model_validate(_values(keys, (), readings)), ()
    except ValidationError as error:
        mistakes = mistakes_in(error, keys)
    readings = {mistake.path: reading for mistake in mistakes if (reading := _other_reading(mistake))}
    if readings:
        try:
            return model.model_validate(_values(keys, (), readings)), ()
        except ValidationError as error:
            mistakes = mistakes_in(error, keys)
    return None, mistakes


def _other_reading(mistake: Mistake) -> Callable[[Scalar], Any] | None:
    """Return how a value that its key does not take may be read too.

    What looks like a number is text where only text is asked for, as it is spelt; and a group of which
    nothing is left but its key is an empty group.
    """
    node = mistake.node
    if not isinstance(node, Scalar):
        return None
    if node.is_nothing:
        return (lambda _: {}) if mistake.kinds & GROUP_EXPECTED else None
    return _spelling if mistake.kinds <= TEXT_EXPECTED else None


def _values(node: Node, path: Path, readings: Mapping[Path, Callable[[Scalar], Any]]) -> Any:
    """Return a tree as plain values; `readings` says which of them are read otherwise than they look."""
    if isinstance(node, Keys):
        return {key: _values(entry.value, (*path, key), readings) for key, entry in node.entries.items()}
    if isinstance(node, Items):
        return [_values(item, (*path, index), readings) for index, item in enumerate(node.items)]
    return readings.get(path, _resolved)(node)


def _spelling(scalar: Scalar) -> LocatedText:
    return LocatedText(scalar.text, scalar.place)


def _resolved(scalar: Scalar) -> float | LocatedText | None:
    """Read a value as YAML 1.2 does, but for the truth values, which the keys that take them read."""
    if scalar.is_nothing:
        return None
    if scalar.plain and len(scalar.text) <= _MOST_DIGITS:
        if re.fullmatch(r"[-+]?\d+", scalar.text, re.ASCII):
            return int(scalar.text)
        if _NUMBER.fullmatch(scalar.text):
            return float(scalar.text)
        if _NO_NUMBER.fullmatch(scalar.text):
            return float(scalar.text.replace(".", ""))
    return _spelling(scalar)
