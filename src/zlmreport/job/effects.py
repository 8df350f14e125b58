"""The effects that a file names, each with the keys that choose its form and the parameters that it gives."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from pydantic import Field, create_model

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.fields import keys_in
from zlmreport.job.installed import Installed, InstalledEffect
from zlmreport.job.options import Options
from zlmreport.job.sentences import shown
from zlmreport.job.tree import Items, Keys, Node, Scalar, keys_of
from zlmreport.job.types import Finite
from zlmreport.job.validate import validate

_SHAPE = "an effect is its name, or {name: {parameter: value}} for one whose parameters are given"


@dataclass(frozen=True, slots=True)
class EffectChoice:
    """An effect that a file names.

    Attributes
    ----------
    identifier
        Of an installed effect.
    settings
        Its own keys, validated by its options class.
    values
        Parameters that are given, by name, in the users' units: of a model they are fixed.
    place
        Where the file names the effect.
    """

    identifier: str
    settings: Options
    values: Mapping[str, float]
    place: Place


def effect_choices(
    listed: Node | None, registry: Installed, problems: list[Problem], *, within: str
) -> tuple[EffectChoice, ...]:
    """Return the effects of a list.

    Parameters
    ----------
    listed
        The list; anything else has been refused before, and gives none.
    registry
        The installed plugins.
    problems
        Where mistakes are added.
    within
        The dotted path of the list, for messages.
    """
    items = listed.items if isinstance(listed, Items) else ()
    return tuple(_choices(items, registry, problems, within))


def _choices(
    items: Sequence[Node], registry: Installed, problems: list[Problem], within: str
) -> Iterator[EffectChoice]:
    for item in items:
        named = _named(item)
        if named is None:
            problems.append(Problem(item.place, f"{within}: {shown(item)} is no effect; {_SHAPE}"))
            continue
        identifier, keys = named
        try:
            effect: InstalledEffect = registry.effect(identifier, item.place)
        except InputError as error:
            problems.extend(error.problems)
            continue
        choice = _choice(effect, replace(keys, place=item.place), problems, f"{within}.{identifier}")
        if choice:
            yield choice


def _named(item: Node) -> tuple[str, Keys] | None:
    """Return an effect's name and its keys."""
    if isinstance(item, Scalar) and not item.is_nothing:
        return item.text, keys_of(item.place)
    if isinstance(item, Keys) and len(item.entries) == 1:
        (entry,) = item.entries.values()
        if isinstance(entry.value, Keys):
            return entry.key, entry.value
        if isinstance(entry.value, Scalar) and entry.value.is_nothing:
            return entry.key, keys_of(entry.place)
    return None


def _choice(effect: InstalledEffect, keys: Keys, problems: list[Problem], within: str) -> EffectChoice | None:
    own = keys_in(effect.options)
    given = keys.without(*(key for key in keys.entries if key not in own))
    settings = validate(effect.options, given, problems, within=within)
    if settings is None:
        return None
    form = effect.with_settings(settings)
    model = _model_of_parameters([each.name for each in (*form.linear, *form.searched)])
    values = validate(model, keys.without(*own), problems, within=within, also_known=own)
    if values is None:
        return None
    stated = values.model_dump(exclude_none=True)
    return EffectChoice(effect.identifier, settings, stated, keys.place)


def _model_of_parameters(names: Sequence[str]) -> type[Options]:
    """Return the model of a group of keys that may give each parameter a value."""
    fields: dict[str, Any] = {
        name: (Finite | None, Field(None, description="The value of the parameter.")) for name in names
    }
    return create_model("Parameters", __base__=Options, **fields)
