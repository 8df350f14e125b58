"""The search over sets: which effects together explain the readings, beside what has no name.

A set is scored by its evidence, the coefficients of its effects, their searched parameters and σ averaged
over (`set_costs`), the amplitudes of all nameless parts chosen anew for each set. Effects come in, go out and
take each other's places as long as the evidence grows; also in pairs where something without a name is left.
The search begins several times: with effects alone, beside white noise and beside any that noise may be, and
beside all that has no name, there with each of the leading effects as the first. Beside random curves of any
size a cause may look needless, without them one may look needed that is a makeshift, and what explains most
by itself may stand for two.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence, Set as AbstractSet
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from zlmreport.job.choices import number_effect, part_number
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.diagnosis.amplitudes import AmplitudeSearch, move_amplitude
from zlmreport.model.diagnosis.contest import Contest, Told, tell_nobody
from zlmreport.model.diagnosis.effect_set import (
    EffectSet,
    MemberKey,
    SetMember,
    find_installed_name,
    find_score,
    list_beside,
    list_names,
    list_unnamed,
    make_member,
)
from zlmreport.model.diagnosis.families import Family, make_orthonormal
from zlmreport.model.diagnosis.likelihood import Amplitudes
from zlmreport.model.diagnosis.refining import jump_along_grids, refine_member
from zlmreport.model.diagnosis.set_costs import SetCosts
from zlmreport.model.diagnosis.set_pairs import list_pairs
from zlmreport.model.effects.effect import Effect

#: Effects of a set at most, and moves of a search.
_MOST_MEMBERS, _MOST_MOVES = 10, 24
#: Candidates that a look at a set brings by its scan, those that are then tried, and of pairs and exchanges.
_LISTED, _TRIED = 6, 3
#: What a score may lack before its parameters are refined, and as a share of what the best one gains.
_PROMISING, _SHARE_OF_GAIN = 12.0, 0.3
_LISTED_FOR_ANOTHER, _TRIED_FOR_ANOTHER = 4, 2
#: Evidence that a move must gain, and more where it changes what a set means.
_GAIN, _CLEAR_GAIN = 0.01, 0.5
#: Effects of a set beside nothing without a name at most, and what it may lack, to be looked at thoroughly.
_MOST_ALONE, _NEAR = 5, 40.0
#: Evidence of each effect's own above which a set of a few is not looked for again from another start: many
#: names may do what one curve without a name does at less cost.
_SURE, _FEW = 6.0, 2
#: So many names in the place of which one curve would do are not believed.
_SEVERAL = 3
#: To how many digits searched parameters are the same.
_AS_FAR = ".3g"
#: How many levels of each part are thought of, whether forms are, families with their searched parameters,
#: amplitudes.
_State: TypeAlias = tuple[Amplitudes, bool, frozenset[tuple[int, tuple[str, ...]]], Amplitudes]


class SetSearch:
    """A search over sets in a contest."""

    def __init__(self, contest: Contest) -> None:
        self.contest = contest
        # Of each part how many levels are thought of: all of them, those that are noise, or nothing.
        self._whole = tuple(len(part.levels) for part in contest.parts)
        self._noise = tuple(part.noise_levels for part in contest.parts)
        self._levels = self._whole
        # Where a climb ends that comes by a set, and whether it was thorough.
        self._ends: dict[tuple[bool, _State], EffectSet] = {}
        # Of all sets that were looked at the best ones, by the effects and the forms that are in it.
        self._best: dict[tuple[frozenset[str], frozenset[str]], EffectSet] = {}
        # What was tried already: sets with one effect more, and with one less.
        self._more: dict[tuple[Amplitudes, Amplitudes, tuple[MemberKey, ...]], EffectSet] = {}
        self._fewer: dict[tuple[Amplitudes, Amplitudes, tuple[MemberKey, ...]], EffectSet] = {}
        self._costs, self._amplitudes = SetCosts(contest), AmplitudeSearch(contest)
        self._with_forms = True  # whether forms without a name are thought of

    def find_best(self, start: Sequence[SetMember] = (), told: Told = tell_nobody) -> EffectSet:
        """Return the set with the most evidence.

        `start`: Effects that are in it at first, and may go out.
        """
        bare = self._climb_by_names_alone(start, tuple(1 for _ in self._whole), is_thorough=False)
        ends = [
            self._climb_by_names_alone(each, self._noise, is_thorough=False) for each in (start, bare.members)
        ]
        named = min(ends, key=find_score)
        told(0.3)
        released = self._with(named.members, named.amplitudes)
        if not self._list_loud(released):
            released = self._climb(released)
            is_whole = 0 < len(released.named) <= _FEW and not self._is_coloured(released)
            if is_whole and min(self.compute_own_evidence(released)) > _SURE:
                return released
        told(0.4)
        begun = [self._with(start, self.contest.quiet)]
        if self._is_coloured(released):
            begun += self._look_ahead(
                self.make_bare_set(), _LISTED, _LISTED_FOR_ANOTHER, lambda family: family.is_named
            )
        beside = min((self._climb(each, is_thorough=False) for each in begun), key=find_score)
        told(0.6)
        together = self._climb(self._unite(beside, named), is_thorough=False)
        best = self._climb(min((released, beside, together), key=find_score))
        if self._is_coloured(best):  # names alone may lead where there is no way on
            best = min(best, self._climb(beside), key=find_score)
        told(0.8)
        is_near = len(named.members) <= _MOST_ALONE and named.score < best.score + _NEAR
        if is_near and self.has_nameless(best):
            for near in (named, *self._list_named_near(best)):
                whole = self._climb_by_names_alone(near.members, self._noise, is_thorough=True)
                best = min(best, self._climb(self._with(whole.members, whole.amplitudes)), key=find_score)
        told(1.0)
        return best

    def _climb_by_names_alone(
        self, start: Sequence[SetMember], levels: Amplitudes, *, is_thorough: bool
    ) -> EffectSet:
        """Return where a climb ends beside which nothing is without a name.

        `levels`: Of each part, those that are thought of.
        """
        self._levels, self._with_forms = levels, False
        found = self._climb(self._with(start, self.contest.quiet), is_thorough=is_thorough)
        self._levels, self._with_forms = self._whole, True
        return found

    def _list_named_near(self, found: EffectSet) -> list[EffectSet]:
        """Return the best sets of names alone that were passed on the way, and lack little.

        Where effects that each look needless beside a curve explain all together, a climb passes by them.
        """
        passed = [each for each in self._best.values() if each.named and not self.has_nameless(each)]
        near = [each for each in passed if each.score < found.score + _PROMISING]
        return sorted(near, key=find_score)[:_TRIED]

    def _unite(self, found: EffectSet, other: EffectSet) -> EffectSet:
        """Return a set with the members of another that can stand beside its own."""
        members = found.members
        for each in other.members:
            if len(list_beside(members, each.effect)) == len(members):
                members = (*members, each)
        return self._with(members, found.amplitudes)

    def _list_loud(self, found: EffectSet) -> list[int]:
        """Return the parts without a name that are more than noise in a set."""
        quiet = self.contest.as_noise(found.amplitudes)
        return [number for number, level in enumerate(found.amplitudes) if level != quiet[number]]

    def _is_coloured(self, found: EffectSet) -> bool:
        """Return whether more than white noise is left beside a set, beyond doubt."""
        white = self.contest.compute_criterion(self.contest.quiet, found.columns)
        return white - self.contest.compute_criterion(found.amplitudes, found.columns) > _SURE

    def make_bare_set(self) -> EffectSet:
        """Return what there is without any effect."""
        return self._with((), self.contest.quiet)

    def has_nameless(self, found: EffectSet) -> bool:
        """Whether anything without a name is in a set, beyond what noise may be."""
        return bool(found.unnamed or self._list_loud(found))

    def compute_evidence_of(self, found: EffectSet, names: AbstractSet[str]) -> float:
        """Return the evidence that the best set without any of some effects lacks, of all looked at.

        All else may be another there: other effects, and the size of every curve without a name. It has no
        form without a name that is not in the set: what has a name goes before a form that does the same.

        `names`: As they are installed.
        """
        forms = list_unnamed(found)
        others = [
            each.score for (known, own), each in self._best.items() if not known & names and own <= forms
        ]
        return min(others, default=np.inf) - found.score

    def find_fewer_beside_curve(self, found: EffectSet, within: float) -> EffectSet | None:
        """Return the best of all sets looked at in which a curve without a name replaces several names.

        `within`: What evidence it may lack; None where all lack more.
        """
        fewer = [
            each
            for each in self._best.values()
            if len(each.named) <= len(found.named) - _SEVERAL
            and each.score < found.score + within
            and self.has_nameless(each)
        ]
        return min(fewer, key=find_score, default=None)

    def find_best_holding(self, found: EffectSet, kept: Sequence[SetMember]) -> EffectSet:
        """Return the best set with these named members alone; what has no name as it then is."""
        names = list_names(kept)
        known = [each for (own, _), each in self._best.items() if own == names]
        return min((self._with((*kept, *found.unnamed), found.amplitudes), *known), key=find_score)

    def compute_own_evidence(self, found: EffectSet) -> list[float]:
        """Return for each member the evidence that the set loses without it, all else following."""
        return [self.without(found, number).score - found.score for number in range(len(found.members))]

    def without(self, found: EffectSet, number: int) -> EffectSet:
        """Return a set without one of its members, all else at its best values then."""
        members = (*found.members[:number], *found.members[number + 1 :])
        key = self._levels, found.amplitudes, tuple(each.key for each in members)
        if key not in self._fewer:
            self._fewer[key] = self._find_best_values(self._with(members, found.amplitudes))
        return self._fewer[key]

    def _find_best_values(self, found: EffectSet) -> EffectSet:
        """Return the best of a set as it is, as it becomes once it is settled, and as it was met before."""
        near = [found]
        # Two joints are met by one name: what was met before may be a larger set than this.
        known = self._best[list_names(found.named), list_unnamed(found)]
        if len(known.members) == len(found.members):
            near.append(known)
        if any(each.theta.size for each in found.members):
            near.append(self._settle(found))
        return min(near, key=find_score)

    def as_noise(self, members: Sequence[SetMember]) -> EffectSet:
        """Return a set beside which there is nothing but noise."""
        self._levels = self._noise
        found = self._with(members, self.contest.quiet)
        self._levels = self._whole
        return found

    def make_members_of(self, effects: Sequence[tuple[Effect, FloatArray]]) -> list[SetMember]:
        """Return effects of the contest at values of their searched parameters as members of a set.

        Each costs what had to be searched for, as if it had been found.
        """
        members = [self._make_member_at(effect, theta) for effect, theta in effects]
        for number, each in enumerate(members):
            rest = [other.columns for place, other in enumerate(members) if place != number]
            own = next(place for place, other in enumerate(self.contest.families) if other is each.family)
            spread = self.contest.scan(self.contest.quiet, rest, [own]).spread[own]
            members[number] = replace(each, spread=float(spread))
        return members

    def _make_member_at(self, effect: Effect, theta: FloatArray) -> SetMember:
        family = next(
            each
            for each in self.contest.families
            if each.identifier == effect.identifier and each.effect.settings == effect.settings
        )
        contest = self.contest
        blocks, ranks, _ = make_orthonormal(
            contest.space, contest.design, effect, theta[np.newaxis], contest.least_visible
        )
        return SetMember(family, theta, contest.columns.add(blocks[:, 0]), int(ranks[0]))

    def renumber(self, found: EffectSet) -> EffectSet:
        """Return a set in which no effect stands for the second time that does not stand there once."""
        members = list(found.members)
        for place, each in enumerate(members):
            name, number = find_installed_name(each.effect), part_number(each.identifier)[1]
            if not each.effect.several or number == 1:
                continue
            taken = {other.identifier for other in members}
            for lower in (number_effect(name, other) for other in range(1, number)):
                family = next(
                    (
                        family
                        for family in self.contest.families
                        if family.identifier == lower and family.effect.settings == each.effect.settings
                    ),
                    None,
                )
                if family is not None and lower not in taken:
                    members[place] = replace(each, family=family)
                    break
        return replace(found, members=tuple(members))

    def list_rivals(self, found: EffectSet, rest: EffectSet, within: float) -> list[EffectSet]:
        """Return the sets in which another effect stands in the place of a member, best first.

        `rest`: The set without it.
        `within`: What evidence they may lack.
        """
        known = {find_installed_name(each.effect) for each in found.members}

        def is_another(family: Family) -> bool:
            return family.is_named and find_installed_name(family.effect) not in known

        beside = replace(rest, amplitudes=found.amplitudes)
        tried = [
            each
            for start in (rest, beside)
            for each in self._look_ahead(
                start, _LISTED, _TRIED, is_another, found.score + within + _PROMISING
            )
        ]
        near = sorted((*tried, *self._list_seen_instead(found, rest)), key=find_score, reverse=True)
        best = {each.members[-1].identifier: each for each in near if each.score < found.score + within}
        return sorted(best.values(), key=find_score)

    def _list_seen_instead(self, found: EffectSet, rest: EffectSet) -> Iterator[EffectSet]:
        """Yield the sets looked at that have one new effect, as their last, and not what `rest` is without.

        It may make others of the set needless, too.
        """
        own, forms = list_names(found.named), list_unnamed(found)
        gone = own - list_names(rest.named)
        for (names, unnamed), each in self._best.items():
            others = [member for member in each.named if find_installed_name(member.effect) not in own]
            if len(others) == 1 and not names & gone and unnamed <= forms:
                beside = (member for member in each.members if member is not others[0])
                yield replace(each, members=(*beside, others[0]))

    def look_ahead(self, found: EffectSet) -> list[EffectSet]:
        """Return a set with one more installed effect, each effect once, the most promising first."""
        tried = self._look_ahead(found, _LISTED, _TRIED, lambda family: family.is_named)
        return list({each.members[-1].identifier: each for each in reversed(tried)}.values())[::-1]

    def find_best_unnamed(self, found: EffectSet) -> SetMember | None:
        """Return the form without a name that adds most to a set; None if none adds anything."""
        tried = self._look_ahead(found, _LISTED, _TRIED, lambda family: not family.is_named)
        return tried[0].members[-1] if tried else None

    def _with(self, members: Sequence[SetMember], amplitudes: Amplitudes) -> EffectSet:
        """Return a set with its best amplitudes near others."""
        return self._score(members, self._find_amplitudes(members, amplitudes))

    def _find_amplitudes(self, members: Sequence[SetMember], start: Amplitudes) -> Amplitudes:
        """Return the best amplitudes beside members near others, of the levels that are thought of."""
        return self._amplitudes.find_near(start, [each.columns for each in members], self._levels)

    def _score(self, members: Sequence[SetMember], amplitudes: Amplitudes) -> EffectSet:
        columns = [each.columns for each in members]
        score = self.contest.compute_criterion(amplitudes, columns) + self._costs.compute(members, amplitudes)
        found = EffectSet(tuple(members), amplitudes, score)
        key = list_names(found.named), list_unnamed(found)
        if key not in self._best or score < self._best[key].score:
            self._best[key] = found
        return found

    def _climb(self, start: EffectSet, *, is_thorough: bool = True) -> EffectSet:
        """Return the best set that moves lead to, one after another.

        `is_thorough`: Whether effects also come in by pairs, and two in the place of one.
        """
        now, passed = self._shrink(start), set[tuple[bool, _State]]()
        for _ in range(_MOST_MOVES):
            state = is_thorough, self._make_state(now)
            if state in self._ends:
                now = self._ends[state]
                break
            passed.add(state)
            larger = self._find_larger(now, _LISTED, _TRIED) if len(now.members) < _MOST_MEMBERS else None
            if larger is not None and larger.score < now.score - _GAIN:
                now = self._shrink(larger)
                continue
            other = self._find_by_exchange(now)
            if other is None and is_thorough:
                other = self._find_by_parting(now)
            if other is None and is_thorough and self._is_coloured(now):
                other = self._find_by_pairing(now)
            if other is None:
                # What its searched parameters cost was found beside another set.
                before, now = now, self._settle(now)
                if now.score >= before.score - _GAIN:
                    break
                other = now
            now = self._shrink(other)
        self._ends.update(dict.fromkeys(passed, now))
        return now

    def _make_state(self, now: EffectSet) -> _State:
        """Return what a set is, with its searched parameters as far as they matter."""
        members = frozenset(
            (id(each.family), tuple(f"{value:{_AS_FAR}}" for value in each.theta)) for each in now.members
        )
        return self._levels, self._with_forms, members, now.amplitudes

    def _shrink(self, now: EffectSet) -> EffectSet:
        """Return a set without the members that the others make needless."""
        while now.members:
            fewer = [
                self._with((*now.members[:number], *now.members[number + 1 :]), now.amplitudes)
                for number in range(len(now.members))
            ]
            best = min(fewer, key=lambda each: each.score)
            if best.score >= now.score:
                return now
            now = best
        return now

    def _find_larger(self, now: EffectSet, listed: int, tried: int) -> EffectSet | None:
        ahead = self._look_ahead(now, listed, tried)
        return self._settle(ahead[0]) if ahead else None

    def _find_by_exchange(self, now: EffectSet) -> EffectSet | None:
        """Return a better set in which one effect takes the place of another; None if there is none.

        What has searched parameters may stand for two: then a second effect, or itself at other values, comes
        in as well.
        """
        limit = now.score + _PROMISING
        for number, member in enumerate(now.members):
            rest = replace(now, members=(*now.members[:number], *now.members[number + 1 :]))

            def is_another(family: Family, own: str = member.identifier) -> bool:
                return family.identifier != own

            for each in self._look_ahead(rest, _LISTED_FOR_ANOTHER, _TRIED_FOR_ANOTHER, is_another, limit):
                if each.score < now.score - _CLEAR_GAIN:
                    settled = self._settle(each)
                    if settled.score < now.score - _CLEAR_GAIN:
                        return settled
        return None

    def _find_by_parting(self, now: EffectSet) -> EffectSet | None:
        """Return a better set in which two effects do what one stands for; None if there is none.

        A wave in time with the period of a run does what a bow of the reversal does: only where that is in
        the set, the wave is found at the period that is its own.
        """
        for number, member in enumerate(now.members):
            if len(member.family.thetas) == 1:
                continue
            rest = replace(now, members=(*now.members[:number], *now.members[number + 1 :]))

            def is_another(family: Family, own: str = member.identifier) -> bool:
                return family.identifier != own

            for each in self._look_ahead(rest, _LISTED, _TRIED_FOR_ANOTHER, is_another):
                larger = self._find_larger(each, _TRIED, _TRIED_FOR_ANOTHER)
                if larger is not None and larger.score < now.score - _CLEAR_GAIN:
                    return larger
        return None

    def _find_by_pairing(self, now: EffectSet) -> EffectSet | None:
        """Return a better set with two more effects; None if there is none."""
        for each in self._look_ahead(now, _LISTED, _LISTED_FOR_ANOTHER):
            larger = self._find_larger(each, _TRIED, _TRIED_FOR_ANOTHER)
            if larger is not None and larger.score < now.score - _CLEAR_GAIN:
                return larger
        for each in self._list_pairs(now):
            larger = self._settle(self._try_out(each))
            if larger.score < now.score - _CLEAR_GAIN:
                return larger
        return None

    def _list_pairs(self, now: EffectSet) -> list[EffectSet]:
        """Return the most promising sets with two more installed effects, the best first."""
        best = list_pairs(self.contest, now)[:_LISTED]
        glanced = [self._glance_at(each.members, each.amplitudes) for each in best]
        return sorted(glanced, key=find_score)[:_TRIED]

    def _look_ahead(
        self,
        now: EffectSet,
        listed: int,
        tried: int,
        wanted: Callable[[Family], bool] = lambda _: True,
        limit: float | None = None,
    ) -> list[EffectSet]:
        """Return the most promising sets with one more effect, the best first.

        `listed`, `tried`: How many a scan brings, and how many of these are tried.
        `wanted`: Which families are thought of.
        `limit`: The score before any refinement beyond which nothing is tried; without it, that of the best
            and somewhat more.
        """
        glanced = []
        for family, block, spread in self._list_leading(now, listed, wanted):
            member = make_member(family, block, spread)
            members = (*list_beside(now.members, member.effect), member)
            glanced.append(self._glance_at(members, now.amplitudes))
        glanced.sort(key=lambda each: each.score)
        if limit is None and glanced:
            limit = glanced[0].score + _PROMISING + _SHARE_OF_GAIN * max(now.score - glanced[0].score, 0.0)
        promising = [each for each in glanced[:tried] if each.score < (limit or 0.0)]
        return sorted((self._try_out(each) for each in promising), key=lambda each: each.score)

    def _list_leading(
        self, now: EffectSet, listed: int, wanted: Callable[[Family], bool]
    ) -> Iterator[tuple[Family, int, float]]:
        """Yield the families that would add most, with and without the nameless parts."""
        contest, seen = self.contest, set()
        for amplitudes in dict.fromkeys((now.amplitudes, contest.as_noise(now.amplitudes))):
            scan = contest.scan(amplitudes, now.columns_with_tangents)
            names: set[str] = set()
            for number in np.argsort(scan.criterion, kind="stable").tolist():
                family, choice = contest.families[number], (number, int(scan.best[number]))
                if not np.isfinite(scan.criterion[number]) or len(names) == listed:
                    break
                if family.identifier in names or not wanted(family):
                    continue
                if not (family.is_named or self._with_forms):
                    continue
                names.add(family.identifier)
                if choice not in seen:
                    seen.add(choice)
                    yield family, choice[1], float(scan.spread[number])

    def _glance_at(self, members: Sequence[SetMember], amplitudes: Amplitudes) -> EffectSet:
        """Return a set with nameless parts lowered where that is better at once."""
        contest, columns = self.contest, [each.columns for each in members]
        best, now = contest.compute_criterion(amplitudes, columns), amplitudes
        quiet = contest.as_noise(amplitudes)
        if quiet != amplitudes:
            tried = [quiet]
            for number, part in enumerate(contest.parts):
                if amplitudes[number] >= part.noise_levels:
                    tried += [
                        move_amplitude(amplitudes, number, level) for level in (0, amplitudes[number] - 1)
                    ]
            for each in tried:
                criterion = contest.compute_criterion(each, columns)
                if criterion < best:
                    best, now = criterion, each
        return EffectSet(tuple(members), now, best + self._costs.compute(members, now))

    def _try_out(self, glanced: EffectSet) -> EffectSet:
        """Return a set with one effect more, its parameters between those of the grid."""
        key = self._levels, glanced.amplitudes, tuple(each.key for each in glanced.members)
        if key not in self._more:
            self._more[key] = self._refine_last(glanced)
        return self._more[key]

    def _refine_last(self, glanced: EffectSet) -> EffectSet:
        members = list(glanced.members)
        amplitudes = self._find_amplitudes(members, glanced.amplitudes)
        members, has_moved = jump_along_grids(self.contest, members, amplitudes)
        if has_moved:
            amplitudes = self._find_amplitudes(members, amplitudes)
        members[-1] = refine_member(self.contest, members, len(members) - 1, amplitudes)
        return self._score(members, amplitudes)

    def _settle(self, now: EffectSet) -> EffectSet:
        """Return a set with all its parameters refined and its amplitudes chosen anew."""
        members, amplitudes = list(now.members), now.amplitudes
        for number in range(len(members)):
            members[number] = refine_member(self.contest, members, number, amplitudes)
        amplitudes = self._find_amplitudes(members, amplitudes)
        members, _ = jump_along_grids(self.contest, members, amplitudes)
        return self._score(members, amplitudes)
