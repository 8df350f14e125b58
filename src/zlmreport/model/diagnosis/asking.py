"""Lengths of an axis that nobody stated, and that let more effects be tried."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

from zlmreport.language import Words
from zlmreport.measurement.axis import AxisKind
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect

#: The lengths by their keys: what they are called, and a usual part of the travel, with which is tried
#: whether an effect needs nothing else.
_LENGTHS = MappingProxyType(
    {
        "screw_pitch": (Words("Screw pitch"), 1 / 20),
        "signal_period": (Words("Signal period of the scale"), 1 / 2000),
        "scale_element": (Words("Length of a scale's element"), 1 / 5),
    }
)
_OF_ROTARY = MappingProxyType({"screw_pitch": Words("Pitch of the gear")})


@dataclass(frozen=True, slots=True)
class AskedLength:
    """A length that the job does not state."""

    key: str  #: Its key in the job's `axis`.
    name: Words  #: What people call it.
    unit: str  #: Symbol of its unit in the job: mm or degrees.
    effects: tuple[str, ...]  #: Identifiers of the effects that can be tried once it is stated.


def name_length(key: str) -> Words | None:
    """Return what people call a length of the job's `axis`; None if it is none that is asked for."""
    return _LENGTHS[key][0] if key in _LENGTHS else None


def list_lengths_asked(
    design: Design, present: Sequence[str], effects: Sequence[Effect]
) -> tuple[AskedLength, ...]:
    """Return the lengths that would let more effects be tried, the most effects first.

    `present`: Identifiers of the effects that are in the model.
    """
    axis = design.axis
    waiting = [each for each in effects if each.identifier not in present and each.untestable(design)]
    found = []
    for key, (name, share) in _LENGTHS.items():
        if getattr(axis, key) is not None:
            continue
        with_it = replace(design, axis=design.axis.with_length(key, share * design.length))
        tried = tuple(each.identifier for each in waiting if each.untestable(with_it) is None)
        if tried:
            called = _OF_ROTARY.get(key, name) if axis.kind is AxisKind.ROTARY else name
            found.append(AskedLength(key, called, axis.position_unit.symbol, tried))
    return tuple(sorted(found, key=lambda each: -len(each.effects)))
