"""Finds the effects that a list names, installed or written as formulas; checks keys and parameters."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Self

from pydantic import ConfigDict, create_model, model_validator

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.contradictions import validate
from zlmreport.job.formula import FormulaError
from zlmreport.job.formula_keys import FormulaKeys, ParameterName
from zlmreport.job.formula_parts import refuse_unsound
from zlmreport.job.sentences import show_value
from zlmreport.job.tree import Items, Keys, Node, Scalar, make_keys_of, place_of
from zlmreport.job.types import Finite, JobPart, Options, list_keys_in, optional

if TYPE_CHECKING:
    from zlmreport.model.effects.effect import Effect
    from zlmreport.plugin.registry import Registry

_SHAPE = (
    "an effect is its name, or {name: {parameter: value}} for one whose parameters are given, or "
    "{name: …, formula: …, parameters: …}"
)


class ParameterLimits(JobPart):
    """What is known of a parameter that is estimated."""

    model_config = ConfigDict(
        json_schema_extra={
            "oneOf": [{"anyOf": [{"required": ["min"]}, {"required": ["max"]}]}, {"required": ["equals"]}]
        }
    )

    min: Finite | None = optional("The least value that it may take.")
    max: Finite | None = optional("The largest value that it may take.")
    equals: ParameterName | None = optional(
        "The parameter of another effect that it is: both are estimated as one.", example="screw-pitch.period"
    )

    @model_validator(mode="after")
    def _says_one_thing(self) -> Self:
        bounded = self.min is not None or self.max is not None
        if bounded == (self.equals is not None):
            raise ValueError("either min or max or both, or equals: other-effect.parameter")
        if self.min is not None and self.max is not None and not self.min < self.max:
            raise ValueError("min must be less than max; to give the value, write the number alone")
        return self


@dataclass(frozen=True, slots=True)
class EffectChoice:
    """An effect that a file names."""

    identifier: str  #: Of an installed effect, or of one that is written as a formula.
    settings: Options  #: Its own keys, validated by its options class; `FormulaKeys` of a formula.
    #: Parameters that are given, by name, in the users' units: of a model they are fixed.
    values: Mapping[str, float]
    place: Place  #: Where the file names the effect.
    #: What else is known of parameters, by name, in the users' units.
    limits: Mapping[str, ParameterLimits] = field(default_factory=dict)
    number: int = 1  #: For which time the effect stands in the list.

    @property
    def installed(self) -> str:
        """The identifier of the installed effect: that of ``scale-joint-2`` is ``scale-joint``."""
        return self.identifier.removesuffix(f"-{self.number}") if self.number > 1 else self.identifier

    def renumber(self, number: int) -> EffectChoice:
        """Return the same effect for another time in a list."""
        return replace(self, identifier=number_effect(self.installed, number), number=number)

    @property
    def is_formula(self) -> bool:
        """Whether no plugin provides it."""
        return isinstance(self.settings, FormulaKeys)


def number_effect(identifier: str, number: int) -> str:
    """Return what an effect is called that stands in a list for the n-th time.

    >>> number_effect("scale-joint", 1), number_effect("scale-joint", 2)
    ('scale-joint', 'scale-joint-2')
    """
    return identifier if number == 1 else f"{identifier}-{number}"


_NUMBER = re.compile("[0-9]{1,9}")


def part_number(identifier: str) -> tuple[str, int]:
    """Return the effect and the number of a name such as ``scale-joint-2``; 1 where it has none.

    >>> part_number("scale-joint-2"), part_number("scale-joint"), part_number("scale-joint-1")
    (('scale-joint', 2), ('scale-joint', 1), ('scale-joint-1', 1))
    """
    name, _, number = identifier.rpartition("-")
    is_numbered = name and _NUMBER.fullmatch(number) and int(number) > 1
    return (name, int(number)) if is_numbered else (identifier, 1)


def find_next_number(identifier: str, choices: Iterable[EffectChoice]) -> int:
    """Return the number of an installed effect that is added to a list of others."""
    return max((each.number for each in choices if each.installed == identifier), default=0) + 1


def choose_effects_of(
    listed: Node | None, registry: Registry, problems: list[Problem], *, within: str
) -> tuple[EffectChoice, ...]:
    """Return the effects of a list.

    `listed`: The list; anything else has been refused before, and gives none.
    """
    found: list[EffectChoice] = []
    for item in listed.items if isinstance(listed, Items) else ():
        if isinstance(item, Keys) and "formula" in item.entries:
            choice = _choose_formula(item, registry, problems, within)
            if choice:
                found.append(choice)
            continue
        named = _name_effect(item)
        if named is None:
            problems.append(_report_no_effect(item, within))
            continue
        identifier, keys = named
        try:
            effect = registry.effect(identifier, item.place)
        except InputError as error:
            problems.extend(error.problems)
            continue
        choice = _choose_effect(effect, replace(keys, place=item.place), problems, f"{within}.{identifier}")
        if choice:
            taken = [each.identifier for each in found]
            if effect.several and choice.identifier in taken:
                choice = choice.renumber(find_next_number(choice.installed, found))
            found.append(choice)
    return tuple(found)


def _report_no_effect(item: Node, within: str) -> Problem:
    """Say what is wrong with an item of a list of effects that names none."""
    if isinstance(item, Keys) and len(item.entries) == 1:
        (entry,) = item.entries.values()
        return Problem(
            entry.value.place, f"{within}.{entry.key}: {show_value(entry.value)} is not a group of keys"
        )
    return Problem(item.place, f"{within}: {show_value(item)} is no effect; {_SHAPE}")


def _choose_formula(
    item: Keys, registry: Registry, problems: list[Problem], within: str
) -> EffectChoice | None:
    keys = validate(FormulaKeys, item, problems, within=within)
    if keys is None:
        return None
    try:
        refuse_unsound(keys)
    except FormulaError as error:
        sentence = f"{'.'.join((within, *error.key))}: {keys.name}: {error}"
        problems.append(Problem(place_of(item, error.key), sentence))
        return None
    if keys.name in {effect.identifier for effect in registry.effects}:
        sentence = f"{within}.name: {keys.name} is an installed effect; call the formula otherwise"
        problems.append(Problem(item.entries["name"].value.place, sentence))
        return None
    values = {name: each.value for name, each in keys.parameters.items() if each.value is not None}
    equal = {name: each.equals for name, each in keys.parameters.items() if each.equals is not None}
    limits = {name: ParameterLimits(equals=other) for name, other in equal.items()}
    return EffectChoice(keys.name, keys, values, item.place, limits)


def choose_candidates(
    listed: Node | None, registry: Registry, problems: list[Problem], *, within: str
) -> tuple[EffectChoice, ...]:
    """Return the formulas of a list of candidates; as `choose_effects_of`, and each must be a formula."""
    found = choose_effects_of(listed, registry, problems, within=within)
    for each in found:
        if not each.is_formula:
            sentence = f"{within}: {each.identifier} is installed, and tried in any case; list formulas here"
            problems.append(Problem(each.place, sentence))
    return found


def _name_effect(item: Node) -> tuple[str, Keys] | None:
    if isinstance(item, Scalar) and not item.is_nothing:
        return item.text, make_keys_of(item.place)
    if isinstance(item, Keys) and len(item.entries) == 1:
        (entry,) = item.entries.values()
        if isinstance(entry.value, Keys):
            return entry.key, entry.value
        if isinstance(entry.value, Scalar) and entry.value.is_nothing:
            return entry.key, make_keys_of(entry.place)
    return None


def _choose_effect(effect: Effect, keys: Keys, problems: list[Problem], within: str) -> EffectChoice | None:
    own = list_keys_in(effect.options)
    settings_keys = keys.without(*(key for key in keys.entries if key not in own))
    settings = validate(effect.options, settings_keys, problems, within=within)
    if settings is None:
        return None
    form = effect.with_settings(settings)
    model = _make_model_of_parameters([each.name for each in (*form.linear, *form.searched)])
    values = validate(model, keys.without(*own), problems, within=within, also_known=own)
    if values is None:
        return None
    stated = {name: value for name, value in values if value is not None}
    limits = {name: value for name, value in stated.items() if isinstance(value, ParameterLimits)}
    given = {name: value for name, value in stated.items() if name not in limits}
    number = part_number(effect.identifier)[1] if effect.several else 1
    return EffectChoice(effect.identifier, settings, given, keys.place, limits, number)


def _make_model_of_parameters(names: Sequence[str]) -> type[Options]:
    """Return the model of a group of keys that may give each parameter a value."""
    fields: dict[str, Any] = {
        name: (Finite | ParameterLimits | None, optional("The value of the parameter.")) for name in names
    }
    return create_model("Parameters", __base__=Options, **fields)
