"""What of a set that was found is believed: effects with evidence of their own, told from all that could be.

Names go before forms and curves that do the same; what is irregular from target to target goes before names
that pass through a few targets by chance; and an effect that some other set does without is not told.
"""

from __future__ import annotations

from collections import Counter
from itertools import chain

import numpy as np

from zlmreport.model.diagnosis.effect_set import (
    EffectSet,
    SetMember,
    compute_fit,
    find_installed_name,
    has_nameless,
    is_only_from_run_to_run,
)
from zlmreport.model.diagnosis.sets import SetSearch

# Of evidence, 2·ln of a Bayes factor, less than 2 is "not worth more than a bare mention", 2 to 6 positive, 6
# to 10 strong (R. E. Kass and A. E. Raftery, Journal of the American Statistical Association 90 (1995) 773).

#: Evidence that anything must have to be worth a mention.
MENTION = 2.0
#: Evidence of its own, prior odds counted, that an effect needs to be named; and beside others, where without
#: it there is nothing but noise: chance is asked about the first, of those beside it nobody asks (9 to 1).
NAMED, NAMED_BESIDE = 1.4, 4.4
#: The same that one name, and several, need against what is irregular from target to target in their place:
#: of many names one or two pass through a few targets by chance.
_IRREGULAR = (NAMED_BESIDE, 2 * NAMED_BESIDE)
#: Evidence within which two effects are not told apart: odds of 20 to 1.
TOLD_APART = 6.0
#: What a rival may lack that is told of.
BEHIND = 40.0
#: Evidence that decides nothing: odds of 5 to 3.
_TOSS_UP = 1.0
#: How many names one curve without a name replaces, and what evidence the set with it may lack, that they are
#: not told: of many at odds up to 20 to 1, of two where it is a toss-up.
_REPLACED = ((3, TOLD_APART), (2, _TOSS_UP))


def believe_set(search: SetSearch, found: EffectSet, standing: frozenset[str]) -> EffectSet:
    """Return a set without those that have no evidence of their own.

    `standing`: The effects of the model that may go.
    """
    return _keep_what_stands(search, _believe_own_evidence(search, found), standing)


def _believe_own_evidence(search: SetSearch, found: EffectSet) -> EffectSet:
    kept = _drop_needless(search, found)
    # What is unusual, or took long to be found, costs evidence, but makes the same shape no other thing.
    while (alike := search.seen.find_named_alike(kept, BEHIND, MENTION, _TOSS_UP)) is not None:
        kept = _drop_needless(search, alike)
    irregular = search.seen.find_irregular_instead(kept, _IRREGULAR)
    if irregular is not None:
        kept = _drop_needless(search, irregular)
        # Beside a few names it may be needless: what then explains all is as sure as any set of names.
        return _keep_sure(search, kept) if has_nameless(search.contest, kept) else kept
    if has_nameless(search.contest, found):
        alone = search.seen.find_names_alone(kept, _find_least_lead(search, kept)) if kept.named else None
        if alone is None or search.seen.find_irregular_instead(alone, _IRREGULAR) is not None:
            return _keep_sure(search, kept)
        kept = _drop_needless(search, alone)
    # With enough names any curve is described: several that one curve replaces are not told.
    for names, within in _REPLACED:
        if not has_nameless(search.contest, kept):
            fewer = search.seen.find_fewer_beside_curve(kept, names, within)
            kept = kept if fewer is None else _drop_needless(search, fewer)
    # Where names alone explain all, a curve in the place of one of them makes the others no less sure.
    return kept


def _find_least_lead(search: SetSearch, found: EffectSet) -> float:
    """Return by what evidence a set must be better than one with a name for each form and curve in it.

    They have to be better than a toss-up. That every run is another has to be sure: one that stands off is
    the rule, by a knock, a new zero, a cold start.
    """
    return TOLD_APART if is_only_from_run_to_run(search.contest, found) else MENTION


def _keep_what_stands(search: SetSearch, found: EffectSet, standing: frozenset[str]) -> EffectSet:
    """Return a set in which no effect of the model gives way to one that is no better.

    `standing`: As of `believe_set`.
    """
    gone = standing - {each.identifier for each in found.named}
    for number, each in enumerate(found.members if gone else ()):
        if each.family.is_named and each.identifier not in standing:
            rivals = search.list_rivals(found, search.without(found, number), MENTION)
            back = [other for other in rivals if gone > standing - {own.identifier for own in other.named}]
            if back:
                return _keep_what_stands(search, back[0], standing)
    return found


def _drop_needless(search: SetSearch, found: EffectSet) -> EffectSet:
    """Return a set without those that the readings do not ask for, one after another.

    Where several could stand in a place, it is their evidence together that something stands there.
    """
    while found.members:
        without = [_leave_out(search, found, number) for number in range(len(found.members))]
        order = sorted(
            range(len(without)), key=lambda each: _compute_lost(search, found, each, without[each])
        )
        needless = next((each for each in order if not _is_needed(search, found, each, without[each])), None)
        if needless is None:
            break
        # Beside it other names may have been the best: the rest is the best that does with as little.
        found = search.seen.find_best_as_small(without[needless])
    return found


def _leave_out(search: SetSearch, found: EffectSet, number: int) -> EffectSet:
    """Return a set without one of its members, beside a curve only where noise alone does not do.

    Where names explain all, a curve in the place of one of them may gain next to nothing. That none is better
    than the other says little for the name: the readings ask for neither.
    """
    rest = search.without(found, number)
    if has_nameless(search.contest, rest) and not has_nameless(search.contest, found):
        quiet = search.settle_beside_noise(rest)
        if quiet.score < found.score + NAMED_BESIDE:
            return quiet
    return rest


def _is_needed(search: SetSearch, found: EffectSet, number: int, rest: EffectSet) -> bool:
    """Return whether the readings ask for a member of a set, or for another in its place.

    `rest`: The set without it.
    """
    lost, is_named = _compute_lost(search, found, number, rest), found.members[number].family.is_named
    needed = NAMED
    if is_named and len(found.named) > 1:
        if not has_nameless(search.contest, rest):
            needed = NAMED_BESIDE
        elif not has_nameless(search.contest, found):
            # Where names explain all, none of them goes for a curve that is no better.
            needed = -_find_least_lead(search, rest)
    if 0.0 < lost < needed and is_named:
        # Each must be better than nothing by itself: many that are not make no cause together.
        rivals = search.list_rivals(found, rest, lost)
        lost += 2.0 * float(
            np.log(sum(np.exp(-0.5 * (each.score - found.score)) for each in (found, *rivals)))
        )
    return lost >= needed


def _compute_lost(search: SetSearch, found: EffectSet, number: int, rest: EffectSet) -> float:
    """Return the evidence that a set loses without one of its members.

    One that is much like others leaves less of them to be paid for. It is no cause for that: beyond its own
    price it must explain what it is worth.

    `rest`: The set without it.
    """
    member = found.members[number]
    lost = compute_fit(search.contest, rest) - compute_fit(search.contest, found)
    own = lost - member.family.price - member.spread
    return min(rest.score - found.score, own)


def _keep_sure(search: SetSearch, found: EffectSet) -> EffectSet:
    """Return a set without those that another set does as well, beside something that has no name.

    Of what has no name only the kind is known. A set that is told from the same set without an effect may be
    as likely as one in which other effects and another curve do the same; then that effect is not told.
    """
    kept, several = found, set[str]()
    while kept.named:
        # The least sure goes first, and what is then looked at may tell of the others; but each is held
        # against the whole set: what little is left of it says nothing of what was in it.
        for each in kept.named:
            _list_rivals_of(search, kept, each)
        rivals = [_list_rivals_of(search, kept, each) for each in kept.named]
        # What could stand in the place of several is one cause instead of them, and none's equal.
        several |= {name for name, count in Counter(chain(*rivals)).items() if count > 1}
        evidence = [
            _compute_evidence_of(search, found, each, own - several)
            for each, own in zip(kept.named, rivals, strict=True)
        ]
        if min(evidence) >= NAMED_BESIDE:
            break
        one = search.seen.find_one_instead(kept, several, TOLD_APART)
        if one is not None:
            kept = one
            continue
        least = evidence.index(min(evidence))
        kept = search.find_best_holding(kept, [*kept.named[:least], *kept.named[least + 1 :]])
    return kept


def _list_rivals_of(search: SetSearch, kept: EffectSet, member: SetMember) -> frozenset[str]:
    """Return the effects that are not told from a member of a set, as they are installed."""
    number = next(place for place, each in enumerate(kept.members) if each is member)
    rivals = search.list_rivals(kept, search.without(kept, number), TOLD_APART)
    return frozenset(find_installed_name(each.members[-1].effect) for each in rivals)


def _compute_evidence_of(
    search: SetSearch, found: EffectSet, member: SetMember, rivals: frozenset[str]
) -> float:
    """Return the evidence of a member of a set, or of it and its rivals together, against all other sets."""
    name = find_installed_name(member.effect)
    own = search.seen.compute_evidence_of(found, {name})
    return own if own >= NAMED_BESIDE else search.seen.compute_evidence_of(found, rivals | {name})
