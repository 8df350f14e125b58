"""Members of a set: effects at values that are known, and each by the first number that is free."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from zlmreport.job.effect_choices import number_effect, part_number
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.effect_set import EffectSet, SetMember, find_installed_name
from zlmreport.model.diagnosis.families import Family, make_orthonormal
from zlmreport.model.effects.effect import Effect


def make_members_of(contest: Contest, effects: Sequence[tuple[Effect, FloatArray]]) -> list[SetMember]:
    """Return effects of a contest at values of their searched parameters as members of a set.

    Each costs what had to be searched for, as if it had been found.
    """
    members = [_make_member_at(contest, effect, theta) for effect, theta in effects]
    for number, each in enumerate(members):
        rest = [other.columns for place, other in enumerate(members) if place != number]
        own = next(place for place, other in enumerate(contest.families) if other is each.family)
        spread = contest.scan(contest.quiet, rest, [own]).spread[own]
        members[number] = replace(each, spread=float(spread))
    return members


def _make_member_at(contest: Contest, effect: Effect, theta: FloatArray) -> SetMember:
    family = next(_list_families(contest, effect.identifier, effect))
    blocks, ranks, _ = make_orthonormal(
        contest.space, contest.design, effect, theta[np.newaxis], contest.least_visible
    )
    return SetMember(family, theta, contest.columns.add(blocks[:, 0, : ranks[0]]))


def renumber(contest: Contest, found: EffectSet) -> EffectSet:
    """Return a set in which no effect stands for the second time that does not stand there once."""
    members = list(found.members)
    for place, each in enumerate(members):
        name, number = find_installed_name(each.effect), part_number(each.identifier)[1]
        if not each.effect.several or number == 1:
            continue
        taken = {other.identifier for other in members}
        lower = (number_effect(name, other) for other in range(1, number))
        free = (
            family
            for own in lower
            if own not in taken
            for family in _list_families(contest, own, each.effect)
        )
        members[place] = replace(each, family=next(free, each.family))
    return replace(found, members=tuple(members))


def _list_families(contest: Contest, identifier: str, form: Effect) -> Iterator[Family]:
    """Yield the families under a name that are of the form that an effect has; there is one at most."""
    for each in contest.families:
        if each.identifier == identifier and each.effect.settings == form.settings:
            yield each
