"""Changes a list in a job file, such as its effects, in place: comments and layout stay.

An edit is made in memory first, so that what it would come to can be tried; it is written only if the file
is still the one that was read.
"""

from __future__ import annotations

import codecs
import hashlib
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from zlmreport.errors import InputError, Place, Problem
from zlmreport.files import demand, rewrite
from zlmreport.job.effect_choices import EffectChoice, choose_effects_of
from zlmreport.job.extents import Written
from zlmreport.job.job import Job
from zlmreport.job.keys import JobKeys
from zlmreport.job.list_edits import (
    ListKey,
    UneditableError,
    add_item,
    add_list,
    change_item,
    drop_item,
    find_own_list,
)
from zlmreport.job.loading import load
from zlmreport.job.parse import LARGEST, decode, parse
from zlmreport.job.tree import Items, Node, Scalar, find_at
from zlmreport.job.yaml_text import write_as_text

if TYPE_CHECKING:
    from zlmreport.plugin.registry import Registry

#: The list of a model.
EFFECTS, CANDIDATES = ListKey("model", "effects"), ListKey("model", "candidates")


@dataclass(frozen=True, slots=True)
class WrittenEffect:
    """An effect as somebody writes it: its name, or the name with keys; and what that means."""

    node: Node  #: As it is written into a job.
    choice: EffectChoice  #: As it is understood.


@dataclass(frozen=True, slots=True)
class Edit:
    """A change of a job file that has not been written yet."""

    path: Path  #: The file.
    digest: str  #: SHA-256 of the bytes that the change was made from.
    content: bytes  #: The bytes with the change.
    job: Job  #: The job with the change.
    #: The file from which the job had the list so far; empty if it stands in the job itself. The change
    #: writes all of it into the job.
    inherited_from: str = ""

    def write(self) -> None:
        """Write the file, whole or not at all.

        Raises `InputError` if the file is no longer the one that the change was made from; `AccessError` if
        it cannot be written.
        """
        place = Place(str(self.path))
        rewrite(self.path, self.content, lambda found: refuse_changed(found, self.digest, place))


def read_named_effect(text: str, registry: Registry, place: Place) -> WrittenEffect:
    """Return an effect that a person names: ``backlash``, or ``polynomial: {order: 5}`` as in a job.

    Raises `InputError` if there is no such effect, or it has no such key, with the nearest that there is.
    """
    node: Node
    node = parse(text.encode(), place.file) if ":" in text or "{" in text else Scalar(place, text.strip())
    problems: list[Problem] = []
    choices = choose_effects_of(Items(place, (node,)), registry, problems, within=str(EFFECTS))
    if problems:
        raise InputError(Problem(place, each.message) for each in problems)
    return WrittenEffect(node, choices[0])


@dataclass(frozen=True, slots=True)
class ListChange:
    """What becomes of a list of a job."""

    where: ListKey  #: The list.
    removed: Collection[int] = ()  #: Indices of items that go out.
    #: Items that are written anew, by their indices.
    changed: Mapping[int, Node] = field(default_factory=dict)
    added: Sequence[Node] = ()  #: Items that come at the end.


def edit_effects(
    path: Path,
    job: Job,
    registry: Registry,
    *,
    add: Sequence[WrittenEffect] = (),
    remove: Collection[str] = (),
) -> Edit:
    """Return the change of a job that adds effects at the end of its model, and takes effects out.

    Raises `InputError` if the file has changed since it was loaded, or its list of effects is written in a
    way in which nothing can be changed without changing more; `AccessError` if the file cannot be read.
    """
    removed = [index for index, choice in enumerate(job.effects) if choice.identifier in remove]
    kept = [choice for choice in job.effects if choice.identifier not in remove]
    wanted = state_meaning([*kept, *(each.choice for each in add)])
    change = ListChange(EFFECTS, removed, added=[each.node for each in add])
    return edit_list(path, job, registry, change, lambda after: state_meaning(after.effects) == wanted)


def edit_list(
    path: Path, job: Job, registry: Registry, change: ListChange, is_meant: Callable[[Job], bool]
) -> Edit:
    """Return the change of one list of a job.

    `is_meant`: Whether a job with the change says in that list what is meant; in all else it must be as
        before.

    Raises `InputError` if the file has changed since it was loaded, or the list is written in a way in which
    nothing can be changed without changing more; `AccessError` if the file cannot be read.
    """
    content = read_content_of(path, job)
    where, listed = change.where, list_items_written(job, change.where)
    nodes = [
        *(
            change.changed.get(index, item)
            for index, item in enumerate(listed)
            if index not in change.removed
        ),
        *change.added,
    ]
    mark = codecs.BOM_UTF8 if content.startswith(codecs.BOM_UTF8) else b""
    text = decode(content, str(path))
    is_own = find_own_list(Written.of(text), where) is not None
    try:
        edited = mark + (_edit_list(text, change) if is_own else add_list(text, where, nodes)).encode()
        after = _load_content(path, registry, edited)
    except UneditableError:
        after = None
    is_alike = (
        after is not None
        and is_meant(after)
        and after.axis == job.axis
        and (where == EFFECTS or state_meaning(after.effects) == state_meaning(job.effects))
        and _is_alike_elsewhere(job, after, where.group, where.key)
    )
    if after is None or not is_alike:
        written = ", ".join(write_as_text(node) for node in nodes)
        raise InputError.at(
            job.place_of(str(where)),
            f"cannot be changed here without changing more; write it by hand: {where.key}: [{written}]",
        )
    inherited = "" if is_own or not listed else listed[0].place.file
    return Edit(path, job.files[0].sha256, edited, after, inherited)


def list_items_written(job: Job, where: ListKey) -> tuple[Node, ...]:
    """Return the items of a list as they are written, in the job itself or in a file that it extends."""
    listed = find_at(job.tree, where.path)
    return listed.items if isinstance(listed, Items) else ()


def _edit_list(text: str, change: ListChange) -> str:
    """Return the text with the changes of a list of its own, the last item first: so indices stay true."""
    for item in change.added:
        text = add_item(text, change.where, item)
    for index in sorted({*change.removed, *change.changed}, reverse=True):
        if index in change.removed:
            text = drop_item(text, change.where, index)
        else:
            text = change_item(text, change.where, index, change.changed[index])
    return text


def read_content_of(path: Path, job: Job) -> bytes:
    """Return what a job file holds; refuse one that is no longer what was loaded."""
    content = demand(path, LARGEST)
    refuse_changed(content, job.files[0].sha256, Place(str(path)))
    return content


def refuse_changed(content: bytes, digest: str, place: Place) -> None:
    """Refuse to write a file that no longer holds what was read."""
    if hashlib.sha256(content).hexdigest() != digest:
        raise InputError.at(
            place, "was changed by somebody else meanwhile, and was left as it is; give the command again"
        )


def _load_content(path: Path, registry: Registry, content: bytes) -> Job | None:
    """Return the job that a file would be with another content; None for one that makes no sense."""
    try:
        return load(path, registry, content=content)
    except InputError:
        return None


def _is_alike_elsewhere(before: Job, after: Job, group: str, key: str) -> bool:
    """Return whether two jobs mean the same but for a key; effects and axis are for the caller to hold."""
    return (
        _drop_key(before.keys, group, key) == _drop_key(after.keys, group, key)
        and after.source.options == before.source.options
        and after.standards == before.standards
        and [each.options for each in after.extensions] == [each.options for each in before.extensions]
    )


def _drop_key(keys: JobKeys, group: str, key: str) -> dict[str, Any]:
    """Return what a job says but for a key; an empty list or nothing beside it says nothing."""
    stated = keys.model_dump()
    kept = {**(stated[group] or {})}
    kept.pop(key, None)
    return {**stated, group: {name: value for name, value in kept.items() if value not in ([], None)}}


def state_meaning(choices: Sequence[EffectChoice]) -> list[tuple[object, ...]]:
    """Return what effects are, without the places where they stand."""
    return [(choice.identifier, choice.settings, dict(choice.values)) for choice in choices]
