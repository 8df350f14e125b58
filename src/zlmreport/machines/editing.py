"""Adding an effect to a machine file, or taking one out, in place: comments and layout stay."""

from __future__ import annotations

import hashlib
from pathlib import Path

from zlmreport.errors import InputError, Place
from zlmreport.files import demanded, rewrite
from zlmreport.job.contradictions import validate
from zlmreport.job.extents import Written
from zlmreport.job.list_edits import (
    ListKey,
    UneditableError,
    own_list,
    with_item,
    with_list,
    without_item,
)
from zlmreport.job.parse import LARGEST, decoded, parse
from zlmreport.job.tree import Scalar
from zlmreport.machines.keys import MachineKeys
from zlmreport.machines.reading import MachineFile

_EFFECTS = ListKey("model", "effects")


def edit_effects(machine: MachineFile, effects: tuple[str, ...]) -> None:
    """Write a list of effects into a machine file that has one effect more or less than before.

    Raises `InputError` if the file has changed since it was read, or its list cannot be changed without
    changing more; `AccessError` if it cannot be written.
    """
    path, before = machine.path, machine.effect_names
    content = demanded(path, LARGEST)
    _refuse_changed(path, content, machine)
    text = decoded(content, str(path))
    place = machine.file.place_of("model", "effects")
    try:
        edited = _edited(text, before, effects, place)
    except UneditableError:
        edited = text
    found = validate(MachineKeys, parse(edited.encode(), str(path)), [])
    if found is None or tuple(found.model.effects) != effects:
        written = ", ".join(effects)
        raise InputError.at(
            place, f"cannot be changed here without changing more; write it by hand: effects: [{written}]"
        )
    rewrite(path, edited.encode(), lambda latest: _refuse_changed(path, latest, machine))


def _edited(text: str, before: tuple[str, ...], effects: tuple[str, ...], place: Place) -> str:
    if own_list(Written.of(text), _EFFECTS) is None:
        return with_list(text, _EFFECTS, [Scalar(place, each) for each in effects])
    for name in (each for each in effects if each not in before):
        text = with_item(text, _EFFECTS, Scalar(place, name))
    for index in sorted((i for i, each in enumerate(before) if each not in effects), reverse=True):
        text = without_item(text, _EFFECTS, index)
    return text


def _refuse_changed(path: Path, content: bytes, machine: MachineFile) -> None:
    if hashlib.sha256(content).hexdigest() != machine.file.file.sha256:
        raise InputError.at(
            Place(str(path)),
            "was changed by somebody else meanwhile, and was left as it is; give the command again",
        )
