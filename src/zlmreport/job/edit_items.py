"""Changes single items of a job file in place: a parameter, an excluded reading, a value not stated yet."""

from __future__ import annotations

import codecs
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import yaml

from zlmreport.errors import InputError, Place
from zlmreport.job.edit import (
    EFFECTS,
    Edit,
    ListChange,
    edit_list,
    list_items_written,
    read_content_of,
    state_meaning,
)
from zlmreport.job.extents import ValueForm, Written
from zlmreport.job.job import Job
from zlmreport.job.list_edits import ListKey, UneditableError, add_member, find_members, insert
from zlmreport.job.loading import load
from zlmreport.job.measurement_keys import ExclusionKeys
from zlmreport.job.parse import decode
from zlmreport.job.tree import Items, KeyEntry, Keys, Node, Scalar, make_keys_of
from zlmreport.job.yaml_text import write_as_text

if TYPE_CHECKING:
    from zlmreport.plugin.registry import Registry

#: What means the same with and without quotes, and is written without.
_DATE = re.compile(r"\d{4}-\d\d-\d\d", re.ASCII)


@dataclass(frozen=True, slots=True)
class ParameterChoice:
    """What somebody wants of a parameter of the model."""

    #: effect and name: Which.
    effect: str
    name: str
    value: float | None  #: To fix it at, in the users' unit; None to leave it to the readings.


def edit_parameter(path: Path, job: Job, registry: Registry, wanted: ParameterChoice) -> Edit:
    """Return the change of a job that fixes a parameter of its model, or frees it.

    Raises `InputError` if the model has no such effect, or that no such parameter; if the file has changed,
    or the list is written in a way in which nothing can be changed without changing more. Raises
    `AccessError` if the file cannot be read.
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
    changed = {index: _make_effect_node(list_items_written(job, EFFECTS)[index], effect, parameter, value)}

    def is_meant(after: Job) -> bool:
        effects = [*job.effects]
        effects[index] = replace(choice, values=values)
        return state_meaning(after.effects) == state_meaning(effects)

    return edit_list(path, job, registry, ListChange(EFFECTS, changed=changed), is_meant)


def _make_effect_node(item: Node, effect: str, parameter: str, value: float | None) -> Node:
    """Return an effect as it is written, with another value of a parameter, or without one."""
    place = item.place
    entries: dict[str, KeyEntry] = {}
    if isinstance(item, Keys) and effect in item.entries and isinstance(item.entries[effect].value, Keys):
        entries = dict(_list_keys(item.entries[effect].value))
    entries.pop(parameter, None)
    if value is not None:
        entries[parameter] = KeyEntry(parameter, place, Scalar(place, _write_number(value)))
    if not entries:
        return Scalar(place, effect)
    return make_keys_of(place, (KeyEntry(effect, place, make_keys_of(place, tuple(entries.values()))),))


def _list_keys(node: Node) -> Mapping[str, KeyEntry]:
    return MappingProxyType({}) if isinstance(node, Scalar | Items) else node.entries


def _write_number(value: float) -> str:
    """Write a value as people would, ``4.2``, and ``10`` for 10.0, with every digit that it has."""
    return repr(float(value)).removesuffix(".0")


#: The list of readings that a job sets aside.
EXCLUDED = ListKey("measurement", "excluded")


def exclude(path: Path, job: Job, registry: Registry, exclusions: Sequence[ExclusionKeys]) -> Edit:
    """Return the change of a job that sets readings aside.

    Raises `InputError` if the file has changed since it was loaded, or is written in a way in which nothing
    can be changed without changing more; `AccessError` if the file cannot be read.
    """
    wanted = [*job.keys.measurement.excluded, *exclusions]
    change = ListChange(EXCLUDED, added=[_make_exclusion_node(each) for each in exclusions])
    return edit_list(path, job, registry, change, lambda after: after.keys.measurement.excluded == wanted)


def include(path: Path, job: Job, registry: Registry, index: int) -> Edit:
    """Return the change of a job that brings a reading back: the one that the list names at an index.

    Raises `InputError` or `AccessError` as for `exclude`.
    """
    wanted = [each for number, each in enumerate(job.keys.measurement.excluded) if number != index]
    change = ListChange(EXCLUDED, removed=[index])
    return edit_list(path, job, registry, change, lambda after: after.keys.measurement.excluded == wanted)


def _make_exclusion_node(exclusion: ExclusionKeys) -> Node:
    place = Place("")
    values = {
        "target": Scalar(place, _write_number(exclusion.target)),
        "direction": Scalar(place, exclusion.direction, plain=False),
        "run": Scalar(place, str(exclusion.run)),
        "reason": Scalar(place, exclusion.reason, plain=False),
    }
    return make_keys_of(place, tuple(KeyEntry(key, place, value) for key, value in values.items()))


def edit_keys(
    path: Path, job: Job, registry: Registry, stated: Mapping[str, float | str], units: Mapping[str, str]
) -> Edit:
    """Return the change of a job that states keys which it does not state yet; nothing else changes.

    `stated`: The values by their keys, as ``customer.name``; numbers in the units of the job.
    `units`: Symbols by key, for the remark beside a number that has a line of its own.

    Raises `InputError` if the file has changed since it was loaded, or is written in a way in which nothing
    can be added without changing more; or with what is wrong with the job as it would be. Raises
    `AccessError` if the file cannot be read.
    """
    content = read_content_of(path, job)
    mark = codecs.BOM_UTF8 if content.startswith(codecs.BOM_UTF8) else b""
    before = text = decode(content, str(path))
    for key, value in stated.items():
        names = key.split(".")
        wanted = _add_to_meaning(_read_meaning(text), names, value)
        try:
            text = _add_key(text, names, _spell(value), units.get(key, ""))
        except UneditableError:
            text = ""
        if not text or _read_meaning(text) != wanted:
            raise InputError.at(
                job.place_of(key),
                f"nothing can be added here without changing more; write by hand: "
                f"{_write_in_braces(names, _spell(value))}",
            )
    edited = content if text == before else mark + text.encode()
    return Edit(path, job.files[0].sha256, edited, load(path, registry, content=edited))


def _spell(value: float | str) -> str:
    """Write a value as people would: ``10``, ``2026-11-20``, text with quotes only where it needs them."""
    if isinstance(value, str):
        return value if _DATE.fullmatch(value) else write_as_text(Scalar(Place(""), value, plain=False))
    return _write_number(value)


def _read_meaning(text: str) -> Any:
    """Return what a text says, value by value."""
    return yaml.load(text, Loader=yaml.BaseLoader)  # noqa: S506 - it makes text, lists and groups of text


def _add_to_meaning(stated: Any, names: Sequence[str], value: float | str) -> Any:
    """Return what a text is to say: what it says, and one key more."""
    if not names:
        return value if isinstance(value, str) else _write_number(value)
    group = stated if isinstance(stated, dict) else {}
    return {**group, names[0]: _add_to_meaning(group.get(names[0]), names[1:], value)}


def _write_in_braces(names: Sequence[str], spelt: str) -> str:
    """Return a pair of key and value, the value of a key within others in their braces."""
    *outer, last = names
    pair = f"{last}: {spelt}"
    for name in reversed(outer):
        pair = f"{name}: {{{pair}}}"
    return pair


def _add_key(text: str, names: Sequence[str], spelt: str, unit: str) -> str:
    """Return the text with a key more in the innermost of its groups that there is."""
    written = Written.of(text)
    group, rest = written.root, list(names)
    while len(rest) > 1 and (entry := group.find_entry(rest[0])) is not None:
        group = entry[1]
        rest.pop(0)
    if group.find_entry(rest[0]) is not None:
        raise UneditableError
    pair = _write_in_braces(rest, spelt)
    if group.form is ValueForm.BRACES:
        return add_member(written, group, find_members(group.parts, 2), pair)
    if group.form is not ValueForm.INDENTED or group.parts[-1].form is ValueForm.ALIAS:
        raise UneditableError
    end = written.line_end(group.parts[-1].end)
    indent = " " * written.find_column(group.parts[0].start)
    remark = f" # {unit}" if unit and len(rest) == 1 else ""
    return insert(text, end, f"{written.break_at(end)}{indent}{pair}{remark}")
