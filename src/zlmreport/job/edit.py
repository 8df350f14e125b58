"""Editing a job in place: effects are added to its error model and taken out of it, and nothing else changes.

An edit is made in memory first, so that what it would come to can be tried; it is written only if the file
is still the one that was read.
"""

from __future__ import annotations

import codecs
import contextlib
import hashlib
import os
import shutil
import tempfile
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from zlmreport.errors import AccessError, InputError, Place, Problem
from zlmreport.job.effect_list import (
    UneditableError,
    as_text,
    own_list,
    with_item,
    with_list,
    without_item,
)
from zlmreport.job.effects import EffectChoice, effect_choices
from zlmreport.job.extents import Written
from zlmreport.job.installed import Installed
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.job.parse import parse
from zlmreport.job.text import decoded
from zlmreport.job.tree import Items, Node, Scalar, walk

_KEY = "model.effects"
_PATH = ("model", "effects")


@dataclass(frozen=True, slots=True)
class NamedEffect:
    """An effect as somebody writes it: its name, or the name with keys; and what that means.

    Attributes
    ----------
    node
        As it is written into a job.
    choice
        As it is understood.
    """

    node: Node
    choice: EffectChoice


@dataclass(frozen=True, slots=True)
class Edit:
    """A change of a job file that has not been written yet.

    Attributes
    ----------
    path
        The file.
    digest
        SHA-256 of the bytes that the change was made from.
    content
        The bytes with the change.
    job
        The job with the change.
    inherited_from
        The file from which the job had its effects so far; empty if they stand in the job itself. The change
        writes all of them into the job.
    """

    path: Path
    digest: str
    content: bytes
    job: Job
    inherited_from: str = ""

    def write(self) -> None:
        """Write the file, whole or not at all.

        Raises
        ------
        InputError
            If the file is no longer the one that the change was made from.
        AccessError
            If it cannot be written.
        """
        place = Place(str(self.path))
        aside = None
        try:
            real = self.path.resolve(strict=True)
            handle, name = tempfile.mkstemp(dir=real.parent, prefix=f".{real.name}.")
            aside = Path(name)
            with os.fdopen(handle, "wb") as file:
                file.write(self.content)
                file.flush()
                os.fsync(file.fileno())
            shutil.copymode(real, aside)
            _refuse_changed(real.read_bytes(), self.digest, place)
            aside.replace(real)
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise AccessError.at(place, f"cannot be written: {reason}") from error
        finally:
            if aside is not None:
                with contextlib.suppress(OSError):
                    aside.unlink(missing_ok=True)


def named_effect(text: str, registry: Installed, place: Place) -> NamedEffect:
    """Return an effect that a person names: ``backlash``, or ``polynomial: {order: 5}`` as in a job.

    Raises
    ------
    InputError
        If there is no such effect, or it has no such key, with the nearest that there is.
    """
    node: Node
    node = parse(text.encode(), place.file) if ":" in text or "{" in text else Scalar(place, text.strip())
    problems: list[Problem] = []
    choices = effect_choices(Items(place, (node,)), registry, problems, within=_KEY)
    if problems:
        raise InputError(Problem(place, each.message) for each in problems)
    return NamedEffect(node, choices[0])


def edit_effects(
    path: Path,
    job: Job,
    registry: Installed,
    *,
    add: NamedEffect | None = None,
    remove: Collection[str] = (),
) -> Edit:
    """Return the change of a job that adds an effect at the end of its model, or takes effects out.

    Parameters
    ----------
    path
        The job file.
    job
        As it was loaded.
    registry
        The installed plugins.
    add
        The effect to add.
    remove
        Identifiers of effects to take out.

    Raises
    ------
    InputError
        If the file has changed since it was loaded, or its list of effects is written in a way in which
        nothing can be changed without changing more.
    AccessError
        If the file cannot be read.
    """
    content = _content(path)
    digest = job.files[0].sha256
    _refuse_changed(content, digest, Place(str(path)))
    listed = _listed(job)
    kept = [index for index, choice in enumerate(job.effects) if choice.identifier not in remove]
    wanted = [job.effects[index] for index in kept] + ([add.choice] if add else [])
    nodes = [listed[index] for index in kept] + ([add.node] if add else [])
    mark = codecs.BOM_UTF8 if content.startswith(codecs.BOM_UTF8) else b""
    text = decoded(content, str(path))
    is_own = own_list(Written.of(text)) is not None
    try:
        if is_own:
            text = text if add is None else with_item(text, add.node)
            for index in sorted(set(range(len(listed))) - set(kept), reverse=True):
                text = without_item(text, index)
        else:
            text = with_list(text, nodes)
        edited = mark + text.encode()
        after = _loaded(path, registry, edited)
    except UneditableError:
        after = None
    if after is None or not _differs_only_in_effects(job, after, wanted):
        written = ", ".join(as_text(node) for node in nodes)
        raise InputError.at(
            job.place_of(_KEY),
            f"cannot be changed here without changing more; write it by hand: effects: [{written}]",
        )
    return Edit(path, digest, edited, after, "" if is_own else _origin(listed))


def _content(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise AccessError.at(Place(str(path)), f"cannot be read: {reason}") from error


def _refuse_changed(content: bytes, digest: str, place: Place) -> None:
    if hashlib.sha256(content).hexdigest() != digest:
        raise InputError.at(
            place, "was changed by somebody else meanwhile, and was left as it is; give the command again"
        )


def _listed(job: Job) -> tuple[Node, ...]:
    """Return the effects of a job as they are written, its own or those of a file that it extends."""
    found = list(walk(job.tree, _PATH))
    listed = found[-1][2] if len(found) == len(_PATH) else None
    return listed.items if isinstance(listed, Items) else ()


def _origin(listed: Sequence[Node]) -> str:
    return listed[0].place.file if listed else ""


def _loaded(path: Path, registry: Installed, content: bytes) -> Job | None:
    try:
        return load(path, registry, content=content)
    except InputError:
        return None


def _differs_only_in_effects(before: Job, after: Job, wanted: Sequence[EffectChoice]) -> bool:
    return (
        _meaning(after.effects) == _meaning(wanted)
        and after.keys.model_copy(update={"model": None}) == before.keys.model_copy(update={"model": None})
        and after.source.options == before.source.options
        and after.standards == before.standards
        and after.axis == before.axis
    )


def _meaning(choices: Sequence[EffectChoice]) -> list[tuple[object, ...]]:
    """Return what effects are, without the places where they stand."""
    return [(choice.identifier, choice.settings, dict(choice.values)) for choice in choices]
