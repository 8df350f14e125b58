"""Finds the plugins that a job names (source, effects, programs, control …) and checks their keys."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, Self, TypeAlias

from pydantic import BaseModel, ConfigDict, Field, create_model, model_validator

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.contradictions import validate
from zlmreport.job.formula import FormulaError
from zlmreport.job.formula_keys import FormulaKeys, ParameterName
from zlmreport.job.formula_parts import refuse_unsound
from zlmreport.job.installed import Installed, InstalledEffect, InstalledExtension, InstalledProgram, WithKeys
from zlmreport.job.keys import JobKeys
from zlmreport.job.sentences import show_value
from zlmreport.job.tree import Items, KeyEntry, Keys, Node, Scalar, find_at, find_key_place, make_keys_of
from zlmreport.job.types import Finite, JobPart, LiveInstrumentKeys, Options, find_model_in, list_keys_in


@dataclass(frozen=True, slots=True)
class Choice:
    """A plugin that a file names: its identifier, its own keys validated, and where the file names it."""

    identifier: str
    options: Options
    place: Place = field(compare=False)


@dataclass(frozen=True, slots=True)
class SourceChoice(Choice):
    """The data source that the job names; `instrument` is the live one that its keys name, None for most."""

    instrument: Choice | None = None


def _choose_in(
    group: Node | None,
    key: str,
    find: Callable[[str, Place], WithKeys],
    problems: list[Problem],
    *,
    within: str,
) -> Choice | None:
    """Return the plugin that a key of a group names, the group's other keys being its own.

    None where the group names none, or a wrong one, or has wrong keys: these mistakes are added.
    """
    named = group.entries.get(key) if isinstance(group, Keys) else None
    if not isinstance(group, Keys) or named is None or not isinstance(named.value, Scalar):
        return None
    if named.value.is_nothing:
        return None
    place = named.value.place
    try:
        plugin = find(named.value.text, place)
    except InputError as error:
        problems.extend(error.problems)
        return None
    own = replace(group.without(key), place=place)
    options = validate(plugin.options, own, problems, within=within, also_known=[key])
    return Choice(plugin.identifier, options, place) if options else None


def group_naming(key: str, item: Node) -> Keys:
    """Return the group of keys that an item of a list is; a bare identifier stands for a key alone."""
    return item if isinstance(item, Keys) else make_keys_of(item.place, (KeyEntry(key, item.place, item),))


def choose_source(
    tree: Keys, path: tuple[str, ...], registry: Installed, problems: list[Problem]
) -> SourceChoice | None:
    """Return the data source at a path, with its own keys; None where there is none, or a wrong one."""
    keys, within = find_at(tree, path), ".".join(path)
    plugin = find_at(tree, (*path, "plugin"))
    choice = _choose_in(keys, "plugin", registry.source, problems, within=within)
    instrument = None
    with suppress(InputError):  # a source that there is not was refused above
        if isinstance(keys, Keys) and isinstance(plugin, Scalar):
            known = registry.source(plugin.text).options
            instrument = _choose_instrument(known, keys, registry, problems, within=within)
    return SourceChoice(choice.identifier, choice.options, choice.place, instrument) if choice else None


def choose_sources_of_tests(
    keys: JobKeys, tree: Keys, registry: Installed, problems: list[Problem]
) -> dict[str, SourceChoice]:
    """Return the data source of each named test; one that several share is checked once."""
    found = {}
    checked: dict[Place, SourceChoice | None] = {}
    for name in keys.measurement.tests:
        path = ("measurement", "tests", name, "source")
        place = find_key_place(tree, path)
        if place not in checked:
            checked[place] = choose_source(tree, path, registry, problems)
        source = checked[place]
        if source:
            found[name] = source
    return found


def _choose_instrument(
    source: type[Options], keys: Keys, registry: Installed, problems: list[Problem], *, within: str
) -> Choice | None:
    """Return the live instrument that the keys of a data source name; None if they name none."""
    known = list_keys_in(source)
    for key, entry in keys.entries.items():
        is_group = isinstance(entry.value, Keys) and key in known
        if is_group and find_model_in(known[key].annotation) is LiveInstrumentKeys:
            return _choose_in(entry.value, "plugin", registry.instrument, problems, within=f"{within}.{key}")
    return None


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

    min: Finite | None = Field(None, description="The least value that it may take.")
    max: Finite | None = Field(None, description="The largest value that it may take.")
    equals: ParameterName | None = Field(
        None,
        description="The parameter of another effect that it is: both are estimated as one.",
        examples=["screw-pitch.period"],
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
    listed: Node | None, registry: Installed, problems: list[Problem], *, within: str
) -> tuple[EffectChoice, ...]:
    """Return the effects of a list.

    `listed`: The list; anything else has been refused before, and gives none.
    """
    items = listed.items if isinstance(listed, Items) else ()
    return tuple(_choose_effects(items, registry, problems, within))


def _choose_effects(
    items: Sequence[Node], registry: Installed, problems: list[Problem], within: str
) -> Iterator[EffectChoice]:
    found: list[EffectChoice] = []
    for item in items:
        if isinstance(item, Keys) and "formula" in item.entries:
            choice = _choose_formula(item, registry, problems, within)
            if choice:
                yield choice
            continue
        named = _name_effect(item)
        if named is None:
            problems.append(_report_no_effect(item, within))
            continue
        identifier, keys = named
        try:
            effect: InstalledEffect = registry.effect(identifier, item.place)
        except InputError as error:
            problems.extend(error.problems)
            continue
        choice = _choose_effect(effect, replace(keys, place=item.place), problems, f"{within}.{identifier}")
        if choice:
            taken = [each.identifier for each in found]
            if effect.several and choice.identifier in taken:
                choice = choice.renumber(find_next_number(choice.installed, found))
            found.append(choice)
            yield choice


def _report_no_effect(item: Node, within: str) -> Problem:
    """Say what is wrong with an item of a list of effects that names none."""
    if isinstance(item, Keys) and len(item.entries) == 1:
        (entry,) = item.entries.values()
        return Problem(
            entry.value.place, f"{within}.{entry.key}: {show_value(entry.value)} is not a group of keys"
        )
    return Problem(item.place, f"{within}: {show_value(item)} is no effect; {_SHAPE}")


def _choose_formula(
    item: Keys, registry: Installed, problems: list[Problem], within: str
) -> EffectChoice | None:
    """Return an effect that is written as a formula."""
    keys = validate(FormulaKeys, item, problems, within=within)
    if keys is None:
        return None
    try:
        refuse_unsound(keys)
    except FormulaError as error:
        sentence = f"{within}.formula: {keys.name}: {error}"
        problems.append(Problem(item.entries["formula"].value.place, sentence))
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
    listed: Node | None, registry: Installed, problems: list[Problem], *, within: str
) -> tuple[EffectChoice, ...]:
    """Return the formulas of a list of candidates; as `choose_effects_of`, and each must be a formula."""
    found = choose_effects_of(listed, registry, problems, within=within)
    for each in found:
        if not each.is_formula:
            sentence = f"{within}: {each.identifier} is installed, and tried in any case; list formulas here"
            problems.append(Problem(each.place, sentence))
    return found


def _name_effect(item: Node) -> tuple[str, Keys] | None:
    """Return an effect's name and its keys."""
    if isinstance(item, Scalar) and not item.is_nothing:
        return item.text, make_keys_of(item.place)
    if isinstance(item, Keys) and len(item.entries) == 1:
        (entry,) = item.entries.values()
        if isinstance(entry.value, Keys):
            return entry.key, entry.value
        if isinstance(entry.value, Scalar) and entry.value.is_nothing:
            return entry.key, make_keys_of(entry.place)
    return None


def _choose_effect(
    effect: InstalledEffect, keys: Keys, problems: list[Problem], within: str
) -> EffectChoice | None:
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
        name: (Finite | ParameterLimits | None, Field(None, description="The value of the parameter."))
        for name in names
    }
    return create_model("Parameters", __base__=Options, **fields)


#: Returns the writer of an identifier that is named at a place; raises `InputError` if there is none.
Find: TypeAlias = Callable[[str, Place | None], InstalledProgram]


def choose_programs_of(
    listed: Node | None, find: Find, problems: list[Problem], *, within: str
) -> tuple[Choice, ...]:
    """Return the programs of a list.

    `listed`: The list; anything else has been refused before, and gives none.
    `problems`: Where mistakes are added: two that would write the same file among them.
    """
    items = listed.items if isinstance(listed, Items) else ()
    choices = tuple(_choose_programs(items, find, problems, within))
    problems.extend(_find_clashes(choices, find))
    return choices


def _choose_programs(
    items: Sequence[Node], find: Find, problems: list[Problem], within: str
) -> Iterator[Choice]:
    for item in items:
        choice = _choose_in(group_naming("program", item), "program", find, problems, within=within)
        if choice:
            yield choice


def _find_clashes(choices: Sequence[Choice], find: Find) -> Iterator[Problem]:
    """Yield programs whose file would be that of one before them."""
    by_suffix: dict[str, str] = {}
    for choice in choices:
        suffix = find(choice.identifier, None).suffix
        other = by_suffix.get(suffix)
        if other is not None:
            clash = (
                f"{other} is listed twice"
                if other == choice.identifier
                else f"{other} and {choice.identifier} both write {suffix} files"
            )
            yield Problem(choice.place, f"{clash}; remove one of them")
        by_suffix[suffix] = choice.identifier


def choose_programs_by_name(
    names: Sequence[str], named_at: Place, stated: Sequence[Choice], find: Find
) -> tuple[Choice, ...]:
    """Return programs that somebody names instead of those of a job, with the keys that it states.

    Raises `InputError` for each that no plugin provides, and each that would write the same file as one
    before it.
    """
    problems: list[Problem] = []
    of_job = {choice.identifier: choice for choice in stated}
    items = [Scalar(named_at, name) for name in names]
    choices = [
        of_job[item.text] if item.text in of_job else next(_choose_programs([item], find, problems, ""), None)
        for item in items
    ]
    found = tuple(choice for choice in choices if choice)
    problems.extend(_find_clashes([replace(choice, place=named_at) for choice in found], find))
    if problems:
        raise InputError(problems)
    return found


@dataclass(frozen=True, slots=True)
class ControllerChoice(Choice):
    """A control that takes compensation tables, and its keys as stated."""

    stated: Keys


def choose_controller_of(
    stated: Node | None, registry: Installed, problems: list[Problem]
) -> ControllerChoice | None:
    """Return the control that a group of keys names; None if it names none, or a wrong one."""
    choice = _choose_in(stated, "controller", registry.controller, problems, within="compensation")
    if choice is None or not isinstance(stated, Keys):
        return None
    own = replace(stated.without("controller"), place=choice.place)
    return ControllerChoice(choice.identifier, choice.options, choice.place, own)


@dataclass(frozen=True, slots=True)
class ExtensionChoice:
    """A group of job keys that belongs to an extension: its name, its keys, and the part programs in it."""

    identifier: str
    options: Any
    programs: tuple[Choice, ...] = ()


def group_model(extension: InstalledExtension) -> type[BaseModel]:
    """Return a model whose one key is the group of an extension: as a job has it."""
    field: Any = Field(None, description=extension.description, examples=[dict(extension.example)])
    group: Any = (extension.options | None, field)
    model: type[BaseModel] = create_model(
        f"{extension.options.__name__}Group", __base__=JobPart, **{extension.identifier: group}
    )
    return model


def choose_extensions(tree: Keys, registry: Installed, problems: list[Problem]) -> Iterator[ExtensionChoice]:
    """Yield the groups of a job, each with its keys and its part programs; mistakes are added to problems."""
    for name in registry.extension_keys:
        entry = tree.entries.get(name)
        if entry is None:
            continue
        extension = registry.extension(name, entry.place)
        group = validate(group_model(extension), make_keys_of(tree.place, (entry,)), problems)
        path = (name, *extension.programs)
        programs = choose_programs_of(
            find_at(tree, path) if extension.programs else None,
            partial(registry.part_program, takes=extension.takes),
            problems,
            within=".".join(path),
        )
        options = getattr(group, name, None)
        if options is not None:
            yield ExtensionChoice(name, options, programs)
