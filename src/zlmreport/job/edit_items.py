"""Editing what a job lists: an effect's parameter is given or left free, a reading is set aside or back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

from zlmreport.errors import InputError, Place
from zlmreport.job.edit import EFFECTS, Edit, ListChange, edit_list, listed_items, meaning
from zlmreport.job.installed import Installed
from zlmreport.job.job import Job
from zlmreport.job.list_edits import ListKey
from zlmreport.job.measurement_keys import ExclusionKeys
from zlmreport.job.tree import Entry, Items, Keys, Node, Scalar, keys_of


@dataclass(frozen=True, slots=True)
class ParameterChoice:
    """What somebody wants of a parameter of the model.

    Attributes
    ----------
    effect, name
        Which.
    value
        To fix it at, in the users' unit; None to leave it to the readings.
    """

    effect: str
    name: str
    value: float | None


def edit_parameter(path: Path, job: Job, registry: Installed, wanted: ParameterChoice) -> Edit:
    """Return the change of a job that fixes a parameter of its model, or frees it.

    Raises
    ------
    InputError
        If the model has no such effect, or that no such parameter; if the file has changed, or the list is
        written in a way in which nothing can be changed without changing more.
    AccessError
        If the file cannot be read.
    """
    effect, parameter, value = wanted.effect, wanted.name, wanted.value
    found = [index for index, choice in enumerate(job.effects) if choice.identifier == effect]
    if found and job.effects[found[0]].is_formula:
        place = job.effects[found[0]].place
        raise InputError.at(
            place, f"{effect} is a formula; write the value of {parameter} among its parameters"
        )
    installed = registry.effect(effect, job.place_of(str(EFFECTS)))
    form = installed.with_settings(job.effects[found[0]].settings) if found else installed
    if not found or parameter not in {each.name for each in (*form.linear, *form.searched)}:
        raise InputError.at(
            job.place_of(str(EFFECTS)), f"the model has no parameter {f'{effect}.{parameter}'[:80]!r}"
        )
    index = found[0]
    choice = job.effects[index]
    values = {name: each for name, each in choice.values.items() if name != parameter}
    if value is not None:
        values[parameter] = value
    changed = {index: _effect_node(listed_items(job, EFFECTS)[index], effect, parameter, value)}

    def is_meant(after: Job) -> bool:
        effects = [*job.effects]
        effects[index] = replace(choice, values=values)
        return meaning(after.effects) == meaning(effects)

    return edit_list(path, job, registry, ListChange(EFFECTS, changed=changed), is_meant)


def _effect_node(item: Node, effect: str, parameter: str, value: float | None) -> Node:
    """Return an effect as it is written, with another value of a parameter, or without one."""
    place = item.place
    entries: dict[str, Entry] = {}
    if isinstance(item, Keys) and effect in item.entries and isinstance(item.entries[effect].value, Keys):
        entries = dict(_keys(item.entries[effect].value))
    entries.pop(parameter, None)
    if value is not None:
        entries[parameter] = Entry(parameter, place, Scalar(place, _number(value)))
    if not entries:
        return Scalar(place, effect)
    return keys_of(place, (Entry(effect, place, keys_of(place, tuple(entries.values()))),))


def _keys(node: Node) -> Mapping[str, Entry]:
    return MappingProxyType({}) if isinstance(node, Scalar | Items) else node.entries


def _number(value: float) -> str:
    """Write a value as people would: ``4.2``, and ``10`` for 10.0."""
    return f"{value:.10g}"


#: The list of readings that a job sets aside.
EXCLUDED = ListKey("measurement", "excluded")


def exclude(path: Path, job: Job, registry: Installed, exclusions: Sequence[ExclusionKeys]) -> Edit:
    """Return the change of a job that sets readings aside.

    Raises
    ------
    InputError
        If the file has changed since it was loaded, or is written in a way in which nothing can be changed
        without changing more.
    AccessError
        If the file cannot be read.
    """
    wanted = [*job.keys.measurement.excluded, *exclusions]
    change = ListChange(EXCLUDED, added=[_exclusion_node(each) for each in exclusions])
    return edit_list(path, job, registry, change, lambda after: after.keys.measurement.excluded == wanted)


def include(path: Path, job: Job, registry: Installed, index: int) -> Edit:
    """Return the change of a job that brings a reading back: the one that the list names at an index.

    Raises
    ------
    InputError, AccessError
        As for `exclude`.
    """
    wanted = [each for number, each in enumerate(job.keys.measurement.excluded) if number != index]
    change = ListChange(EXCLUDED, removed=[index])
    return edit_list(path, job, registry, change, lambda after: after.keys.measurement.excluded == wanted)


def _exclusion_node(exclusion: ExclusionKeys) -> Node:
    place = Place("")
    values = {
        "target": Scalar(place, f"{exclusion.target:.10g}"),
        "direction": Scalar(place, exclusion.direction, plain=False),
        "run": Scalar(place, str(exclusion.run)),
        "reason": Scalar(place, exclusion.reason, plain=False),
    }
    return keys_of(place, tuple(Entry(key, place, value) for key, value in values.items()))
