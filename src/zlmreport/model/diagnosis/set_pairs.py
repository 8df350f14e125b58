"""Pairs of effects that explain much together and nothing alone.

A lever of the guide's angle brings a slope with it: beside the slope it explains all, without it nothing. A
search that takes in one effect at a time comes by neither.
"""

from __future__ import annotations

import numpy as np

from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.effect_set import EffectSet, find_score, list_beside, make_member
from zlmreport.model.diagnosis.families import Family
from zlmreport.model.diagnosis.likelihood import DIGITS_OF_SCORE


def list_pairs(contest: Contest, now: EffectSet, firsts: int) -> list[EffectSet]:
    """Return sets with two more installed effects, the best first; their scores are those of the scans alone.

    Every effect is tried beside others, at the values that are best for the first by itself.

    `firsts`: How many of those that explain most by themselves are the first at most.
    """
    found: dict[frozenset[str], EffectSet] = {}
    named = np.array([each.is_named for each in contest.families])
    for amplitudes in dict.fromkeys((contest.as_noise(now.amplitudes), contest.quiet)):
        first = contest.scan(amplitudes, now.columns)
        criterion = np.where(named, first.criterion, np.inf)
        for number in np.argsort(np.round(criterion, DIGITS_OF_SCORE), kind="stable")[:firsts].tolist():
            family = contest.families[number]
            if not np.isfinite(criterion[number]):
                break
            member = make_member(family, int(first.best[number]), float(first.spread[number]))
            members = (*list_beside(now.members, member.effect), member)
            second = contest.scan(amplitudes, [each.columns for each in members])
            others = _list_others(contest, family)
            if not others:
                continue
            other = min(others, key=lambda each: float(second.criterion[each]))
            last = make_member(contest.families[other], int(second.best[other]), float(second.spread[other]))
            score = float(first.criterion[number] + second.criterion[other])
            pair = frozenset((member.identifier, last.identifier))
            if np.isfinite(score) and (pair not in found or score < found[pair].score):
                found[pair] = EffectSet((*list_beside(members, last.effect), last), amplitudes, score)
    return sorted(found.values(), key=find_score)


def _list_others(contest: Contest, family: Family) -> list[int]:
    """Return the places of the families of other installed effects."""
    return [
        number
        for number, each in enumerate(contest.families)
        if each.is_named and each.identifier != family.identifier
    ]
