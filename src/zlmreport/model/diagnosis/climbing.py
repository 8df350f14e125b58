"""The search from set to set of effects: add, drop, exchange, until the evidence rises no more.

Effects come in, go out and take each other's places; also in pairs where something without a name is left.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from zlmreport.model.diagnosis.effect_set import (
    EffectSet,
    MemberKey,
    find_installed_name,
    find_one_before,
    find_score,
    list_beside,
    make_member,
)
from zlmreport.model.diagnosis.families import Family
from zlmreport.model.diagnosis.likelihood import DIGITS_OF_SCORE, Amplitudes
from zlmreport.model.diagnosis.refining import hides_jumps, refine_member
from zlmreport.model.diagnosis.scored_sets import ScoredSets
from zlmreport.model.diagnosis.set_pairs import list_pairs

#: Of effects, how many a scan brings, and how many of these are tried.
Breadth: TypeAlias = tuple[int, int]

#: As a rule; where each of some is followed further; in another's place; and beside one that was tried.
BROAD: Breadth = (6, 3)
FOLLOWED: Breadth = (6, 4)
_FOR_ANOTHER: Breadth = (4, 2)
_SECOND: Breadth = (3, 2)
#: What a score may lack before its parameters are refined, and as a share of what the best one gains.
PROMISING, _SHARE_OF_GAIN = 12.0, 0.3
#: Effects of a set at most, and moves of a climb.
_MOST_MEMBERS, _MOST_MOVES = 10, 24
#: Evidence that a move must gain, and more where it changes what a set means.
GAIN, _CLEAR_GAIN = 0.01, 0.5
#: The share of what a score lacks that a move must gain, or the climb is given up.
_SLOW = 0.1
#: Evidence of anything but white noise that is beyond doubt.
_SURE = 6.0
#: To how many digits searched parameters are the same.
_AS_FAR = ".3g"


@dataclass(frozen=True, slots=True)
class Scope:
    """What is thought of in a climb."""

    levels: Amplitudes  #: Of each part of the covariance, how many of its levels.
    with_names: bool = True  #: Whether installed effects are.
    with_forms: bool = True  #: Whether forms without a name are.
    left_out: frozenset[str] = frozenset()  #: Effects that are not, as they are installed.

    def without(self, *names: str) -> Scope:
        """Return the same without some effects."""
        return replace(self, left_out=self.left_out.union(names))

    def is_open_to(self, family: Family) -> bool:
        """Return whether a family is thought of."""
        is_wanted = self.with_names if family.is_named else self.with_forms
        return is_wanted and find_installed_name(family.effect) not in self.left_out


#: What is thought of, families with their searched parameters, amplitudes, and whether a climb is thorough.
_State: TypeAlias = tuple[Scope, frozenset[tuple[int, tuple[str, ...]]], Amplitudes, bool]


class Climb:
    """Climbs in a contest; what one came by the others know."""

    def __init__(self, sets: ScoredSets) -> None:
        self._sets, self._contest = sets, sets.contest
        # Where a climb ends that comes by a set.
        self._ends: dict[_State, EffectSet] = {}
        # What was tried already: sets with one effect more.
        self._more: dict[tuple[Amplitudes, Amplitudes, tuple[MemberKey, ...]], EffectSet] = {}
        # Of an effect that may be there several times, the one before each.
        names = {each.identifier for each in self._contest.families}
        before = {each.identifier: find_one_before(each.effect) for each in self._contest.families}
        self._before = {name: one for name, one in before.items() if one in names}

    def climb(
        self, start: EffectSet, scope: Scope, *, is_thorough: bool = False, goal: float = np.inf
    ) -> EffectSet:
        """Return the best set that moves lead to, one after another.

        `is_thorough`: Whether effects also come in by pairs.
        `goal`: The score that is to be passed; what moves too slowly towards it is given up.
        """
        now, passed = self._shrink(start, scope), set[_State]()
        before = now
        for moves in range(_MOST_MOVES):
            lack = now.score - goal
            if moves and lack > PROMISING and before.score - now.score < _SLOW * lack:
                return now
            before = now
            state = _make_state(now, scope, is_thorough=is_thorough)
            if state in self._ends:
                now = self._ends[state]
                break
            passed.add(state)
            larger = self._find_larger(now, scope, BROAD) if len(now.members) < _MOST_MEMBERS else None
            if larger is not None and larger.score < now.score - GAIN:
                now = self._shrink(larger, scope)
                continue
            other = self._find_by_exchange(now, scope)
            if other is None and is_thorough and self.is_coloured(now):
                other = self._find_by_pairing(now, scope)
            if other is None:
                # What its searched parameters cost was found beside another set.
                now = self._sets.settle(now, scope.levels)
                if now.score >= before.score - GAIN:
                    break
                other = now
            now = self._shrink(other, scope)
        self._ends.update(dict.fromkeys(passed, now))
        return now

    def is_coloured(self, found: EffectSet) -> bool:
        """Return whether more than white noise is left beside a set, beyond doubt."""
        white = self._contest.compute_criterion(self._contest.quiet, found.columns)
        return white - self._contest.compute_criterion(found.amplitudes, found.columns) > _SURE

    def look_ahead(
        self, now: EffectSet, scope: Scope, breadth: Breadth = BROAD, limit: float | None = None
    ) -> list[EffectSet]:
        """Return the most promising sets with one more effect, the best first.

        `limit`: The score before any refinement beyond which nothing is tried; without it, that of the best
            and somewhat more.
        """
        listed, tried = breadth
        glanced = []
        for family, block, spread in self._list_leading(now, scope, listed):
            member = make_member(family, block, spread)
            members = (*list_beside(now.members, member.effect), member)
            if hides_jumps(member):
                refined = refine_member(self._contest, members, len(members) - 1, now.amplitudes)
                members = (*members[:-1], refined)
            glanced.append(self._sets.glance_at(members, now.amplitudes))
        glanced.sort(key=find_score)
        if limit is None and glanced:
            limit = glanced[0].score + PROMISING + _SHARE_OF_GAIN * max(now.score - glanced[0].score, 0.0)
        promising = [each for each in glanced[:tried] if each.score < (limit or 0.0)]
        return sorted((self._try_out(each, scope) for each in promising), key=find_score)

    def _list_leading(self, now: EffectSet, scope: Scope, listed: int) -> Iterator[tuple[Family, int, float]]:
        """Yield the families that would add most, with and without the nameless parts."""
        contest, seen = self._contest, set()
        present = {each.identifier for each in now.members}
        for amplitudes in dict.fromkeys((now.amplitudes, contest.as_noise(now.amplitudes))):
            scan = contest.scan(amplitudes, now.columns_with_tangents)
            names: set[str] = set()
            for number in np.argsort(np.round(scan.criterion, DIGITS_OF_SCORE), kind="stable").tolist():
                family, choice = contest.families[number], (number, int(scan.best[number]))
                if not np.isfinite(scan.criterion[number]) or len(names) == listed:
                    break
                if family.identifier in names or not scope.is_open_to(family):
                    continue
                if self._before.get(family.identifier, "") not in {"", *present}:  # no second without a first
                    continue
                names.add(family.identifier)
                if choice not in seen:
                    seen.add(choice)
                    yield family, choice[1], float(scan.spread[number])

    def _try_out(self, glanced: EffectSet, scope: Scope) -> EffectSet:
        """Return a set with one effect more, its parameters between those of the grid."""
        key = scope.levels, glanced.amplitudes, tuple(each.key for each in glanced.members)
        if key not in self._more:
            self._more[key] = self._sets.refine_last(glanced, scope.levels)
        return self._more[key]

    def _shrink(self, now: EffectSet, scope: Scope) -> EffectSet:
        """Return a set without the members that the others make needless."""
        while now.members:
            fewer = [
                self._sets.score_near(now.without(number).members, now.amplitudes, scope.levels)
                for number in range(len(now.members))
            ]
            best = min(fewer, key=find_score)
            if best.score >= now.score:
                return now
            now = best
        return now

    def _find_larger(self, now: EffectSet, scope: Scope, breadth: Breadth) -> EffectSet | None:
        ahead = self.look_ahead(now, scope, breadth)
        return self._sets.settle(ahead[0], scope.levels) if ahead else None

    def _find_by_exchange(self, now: EffectSet, scope: Scope) -> EffectSet | None:
        """Return a better set in which one effect takes the place of another; None if there is none.

        What has searched parameters may stand for two: then a second effect, or itself at other values, comes
        in as well.
        """
        limit = now.score + PROMISING
        for number, member in enumerate(now.members):
            others = scope.without(find_installed_name(member.effect))
            for each in self.look_ahead(now.without(number), others, _FOR_ANOTHER, limit):
                if each.score < now.score - _CLEAR_GAIN:
                    settled = self._sets.settle(each, scope.levels)
                    if settled.score < now.score - _CLEAR_GAIN:
                        return settled
        return None

    def _find_by_pairing(self, now: EffectSet, scope: Scope) -> EffectSet | None:
        """Return a better set with two more effects; None if there is none."""
        for each in self.look_ahead(now, scope, FOLLOWED):
            larger = self._find_larger(each, scope, _SECOND)
            if larger is not None and larger.score < now.score - _CLEAR_GAIN:
                return larger
        for each in self.look_ahead_by_pairs(now, len(self._contest.families)):
            larger = self._sets.settle(self._try_out(each, scope), scope.levels)
            if larger.score < now.score - _CLEAR_GAIN:
                return larger
        return None

    def look_ahead_by_pairs(self, now: EffectSet, firsts: int, limit: float = np.inf) -> list[EffectSet]:
        """Return the most promising sets with two more installed effects, the best first.

        `firsts`: How many of those that explain most by themselves are one of the two at most.
        `limit`: The score before any refinement beyond which none is promising.
        """
        listed, tried = BROAD
        glanced = [
            self._sets.glance_at(each.members, each.amplitudes)
            for each in list_pairs(self._contest, now, firsts)[:listed]
        ]
        return sorted((each for each in glanced if each.score < limit), key=find_score)[:tried]


def _make_state(now: EffectSet, scope: Scope, *, is_thorough: bool) -> _State:
    """Return what a set is, with its searched parameters as far as they matter."""
    members = frozenset(
        (id(each.family), tuple(f"{value:{_AS_FAR}}" for value in each.theta)) for each in now.members
    )
    return scope, members, now.amplitudes, is_thorough
