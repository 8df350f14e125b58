"""Finds the plugins that a job names (source, programs, control …) and checks their keys."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

from pydantic import BaseModel, create_model

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.contradictions import validate
from zlmreport.job.keys import JobKeys
from zlmreport.job.tree import Items, KeyEntry, Keys, Node, Scalar, find_at, find_key_place, make_keys_of
from zlmreport.job.types import JobPart, LiveInstrumentKeys, Options, find_model_in, list_keys_in, optional

if TYPE_CHECKING:
    from zlmreport.plugin.extending import Extension
    from zlmreport.plugin.protocols import Controller, DataSource, Instrument, PartProgram
    from zlmreport.plugin.registry import Registry


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
    lacking = place if place.file == group.place.file else group.place
    own = replace(group.without(key), place=lacking)
    options = validate(plugin.options, own, problems, within=within, also_known=[key])
    return Choice(plugin.identifier, options, place) if options else None


def group_naming(key: str, item: Node) -> Keys:
    """Return the group of keys that an item of a list is; a bare identifier stands for a key alone."""
    return item if isinstance(item, Keys) else make_keys_of(item.place, (KeyEntry(key, item.place, item),))


def choose_source(
    tree: Keys, path: tuple[str, ...], registry: Registry, problems: list[Problem]
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
    keys: JobKeys, tree: Keys, registry: Registry, problems: list[Problem]
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
    source: type[Options], keys: Keys, registry: Registry, problems: list[Problem], *, within: str
) -> Choice | None:
    """Return the live instrument that the keys of a data source name; None if they name none."""
    known = list_keys_in(source)
    for key, entry in keys.entries.items():
        is_group = isinstance(entry.value, Keys) and key in known
        if is_group and find_model_in(known[key].annotation) is LiveInstrumentKeys:
            return _choose_in(entry.value, "plugin", registry.instrument, problems, within=f"{within}.{key}")
    return None


#: A plugin with keys of its own beside the one that names it.
WithKeys: TypeAlias = "Controller | DataSource | Instrument | PartProgram"
#: Returns the writer of an identifier that is named at a place; raises `InputError` if there is none.
Find: TypeAlias = "Callable[[str, Place | None], PartProgram]"


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
    stated: Node | None, registry: Registry, problems: list[Problem]
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


def group_model(extension: Extension) -> type[BaseModel]:
    """Return a model whose one key is the group of an extension: as a job has it."""
    field: Any = optional(extension.description, example=dict(extension.example))
    group: Any = (extension.options | None, field)
    model: type[BaseModel] = create_model(
        f"{extension.options.__name__}Group", __base__=JobPart, **{extension.identifier: group}
    )
    return model


def choose_extensions(tree: Keys, registry: Registry, problems: list[Problem]) -> Iterator[ExtensionChoice]:
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
