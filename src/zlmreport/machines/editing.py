"""Adding an effect to a machine file, or taking one out, in place: comments and layout stay."""

from __future__ import annotations

from collections.abc import Sequence

from zlmreport.errors import InputError, Place, did_you_mean, quoted
from zlmreport.files import demand, rewrite
from zlmreport.job.contradictions import validate
from zlmreport.job.edit import refuse_changed
from zlmreport.job.extents import Written
from zlmreport.job.list_edits import ListKey, UneditableError, add_item, add_list, drop_item, find_own_list
from zlmreport.job.parse import LARGEST, decode, parse
from zlmreport.job.tree import Scalar
from zlmreport.machines.keys import MachineFileKeys
from zlmreport.machines.reading import MachineFile, is_always_there
from zlmreport.model.effects.circle_effect import CircleEffect
from zlmreport.plugin.registry import Registry

_EFFECTS = ListKey("model", "effects")
#: Said of an effect that cannot be taken out.
BELONGS_INTO_EVERY_MODEL = (
    "belongs into every model: where a bar stands, and how long it is, are no errors of the machine"
)


def list_effects_with(
    machine: MachineFile, name: str, registry: Registry, place: Place
) -> tuple[CircleEffect, ...]:
    """Return the effects of a machine's model with one more.

    Raises `InputError` at `place` if there is no such effect, or it stands in the model already.
    """
    effect = registry.circle_effect(name, place)
    if name in machine.effect_names:
        raise InputError.at(place, f"{name} stands in the model already")
    return (*machine.effects, effect)


def list_effects_without(machine: MachineFile, name: str) -> tuple[CircleEffect, ...]:
    """Return the effects of a machine's model without one.

    Raises `InputError` if it does not stand in the model.
    """
    if name not in machine.effect_names:
        raise InputError.at(
            machine.file.place_of("model", "effects"),
            f"{quoted(name)} does not stand in the model; {did_you_mean(name, machine.effect_names)}",
        )
    left = tuple(each for each in machine.effects if each.identifier != name)
    if any(is_always_there(each, machine.circles) for each in machine.effects if each.identifier == name):
        raise InputError.at(
            machine.file.place_of("model", "effects"),
            f"{name} {BELONGS_INTO_EVERY_MODEL}",
        )
    return left


def put_back(machine: MachineFile, content: bytes) -> None:
    """Write a machine file as it was before a change.

    Raises as `edit_effects`.
    """
    place = Place(str(machine.path))
    rewrite(machine.path, content, lambda latest: refuse_changed(latest, machine.file.file.sha256, place))


def edit_effects(machine: MachineFile, effects: tuple[str, ...]) -> None:
    """Write a list of effects into a machine file.

    Raises `InputError` if the file has changed since it was read, or its list cannot be changed without
    changing more; `AccessError` if it cannot be written.
    """
    path, before = machine.path, machine.file.keys.model.effects
    digest, whole = machine.file.file.sha256, Place(str(path))
    content = demand(path, LARGEST)
    refuse_changed(content, digest, whole)
    text = decode(content, str(path))
    place = machine.file.place_of("model", "effects")
    try:
        edited = _edit_text(text, before, effects, place)
    except UneditableError:
        edited = text
    found = validate(MachineFileKeys, parse(edited.encode(), str(path)), [])
    if found is None or tuple(found.model.effects) != effects:
        written = ", ".join(effects)
        raise InputError.at(
            place, f"cannot be changed here without changing more; write it by hand: effects: [{written}]"
        )
    rewrite(path, edited.encode(), lambda latest: refuse_changed(latest, digest, whole))


def _edit_text(text: str, before: Sequence[str], effects: tuple[str, ...], place: Place) -> str:
    if find_own_list(Written.of(text), _EFFECTS) is None:
        return add_list(text, _EFFECTS, [Scalar(place, each) for each in effects])
    for name in (each for each in effects if each not in before):
        text = add_item(text, _EFFECTS, Scalar(place, name))
    for index in sorted((i for i, each in enumerate(before) if each not in effects), reverse=True):
        text = drop_item(text, _EFFECTS, index)
    return text
