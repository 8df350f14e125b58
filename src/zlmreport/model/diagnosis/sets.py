"""The search over sets: which effects together explain the readings, beside what has no name.

It begins several times: with effects alone, beside white noise and beside any that noise may be, and beside
all that has no name, there with each of the leading effects as the first. Beside random curves of any size a
cause may look needless, without them one may look needed that is a makeshift, and what explains most by
itself may stand for two. In the end every effect is left out in turn, and the search goes on from a better
set that is found without it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import chain, combinations

from zlmreport.model.diagnosis.climbing import BROAD, FOLLOWED, GAIN, PROMISING, Breadth, Climb, Scope
from zlmreport.model.diagnosis.contest import Contest, Told, tell_nobody
from zlmreport.model.diagnosis.effect_set import (
    EffectSet,
    MemberKey,
    SetMember,
    find_installed_name,
    find_score,
    has_nameless,
    list_beside,
    list_loud,
    list_names,
    list_unnamed,
)
from zlmreport.model.diagnosis.forms import IN_TIME, UnnamedForm
from zlmreport.model.diagnosis.likelihood import Amplitudes
from zlmreport.model.diagnosis.random_curves import Along
from zlmreport.model.diagnosis.scored_sets import ScoredSets
from zlmreport.model.diagnosis.seen_sets import SeenSets
from zlmreport.model.diagnosis.set_members import renumber

#: Effects of a set beside nothing without a name at most, and what it may lack, to be looked at thoroughly.
#: One beside smooth curves may lack as much.
_MOST_ALONE, _NEAR = 5, 40.0
#: Of forms that may stand for two names how many a scan brings, and how many of these are tried; and what one
#: may lack whose place and width are those of a grid.
_FOR_TWO: Breadth = (3, 1)
_UNREFINED = 60.0
#: How many of those that explain most are tried with another in the place of one.
_FIRSTS = 12
#: How many of the sets of names alone that were passed are looked at so.
_MOST_PASSED = 3
#: Evidence of each effect's own above which a set of a few is not looked for again from another start: many
#: names may do what one curve without a name does at less cost.
_SURE, _FEW = 6.0, 2


class SetSearch:
    """A search over sets in a contest."""

    def __init__(self, contest: Contest) -> None:
        self.contest = contest
        self._sets = ScoredSets(contest)
        self.seen = SeenSets(self._sets)  #: All sets that were looked at.
        self._climbs = Climb(self._sets)
        self._climb = self._climbs.climb
        # Of each part all levels are thought of, those that are noise, or nothing but white noise.
        self._whole = Scope(tuple(len(part.levels) for part in contest.parts))
        self._names = Scope(tuple(part.noise_levels for part in contest.parts), with_forms=False)
        self._forms = replace(self._names, with_forms=True)
        self._bare = Scope(tuple(1 for _ in contest.parts), with_forms=False)
        # The same as the first, but for shares that are irregular from position to position.
        self._regular = Scope(
            tuple(len(part.levels) if part.irregular is None else part.noise_levels for part in contest.parts)
        )
        # What was tried already: sets with one effect less.
        self._fewer: dict[tuple[Amplitudes, tuple[MemberKey, ...]], EffectSet] = {}

    def find_best(self, start: Sequence[SetMember] = (), told: Told = tell_nobody) -> EffectSet:
        """Return the set with the most evidence.

        `start`: Effects that are in it at first, and may go out.
        """
        begun = self._begin(start, self._names)
        bare = self._climb(self._begin(start, self._bare), self._bare)
        named = min(
            (self._climb(each, self._names) for each in (begun, self._begin(bare.members, self._names))),
            key=find_score,
        )
        told(0.3)
        released = self._release(named)
        beside = self._climb_beside_curves(start, released)
        told(0.4)
        released = self._begin_with_forms(start, released, beside)
        if not list_loud(self.contest, released):
            released = self._climb(released, self._whole, is_thorough=True)
            released = self._put_pairs_for_one(self._do_without_each(released, self._whole))
            released = self._put_forms_for_two(released)
            is_whole = 0 < len(released.named) <= _FEW and not self._climbs.is_coloured(released)
            if is_whole and min(self.compute_own_evidence(released)) > _SURE:
                return released
        told(0.6)
        together = self._climb(self._unite(beside, named), self._whole)
        best = self._climb(min((released, beside, together), key=find_score), self._whole, is_thorough=True)
        if self._climbs.is_coloured(best):  # names alone may lead where there is no way on
            best = min(best, self._climb(beside, self._whole, is_thorough=True), key=find_score)
        told(0.7)
        best = self._go_back_to_names(best, named)
        told(0.8)
        best = self._put_forms_for_two(self._go_on_without_each(best, named))
        told(1.0)
        return best

    def _begin_with_forms(self, start: Sequence[SetMember], named: EffectSet, beside: EffectSet) -> EffectSet:
        """Return where a climb by names and forms leads, or the set of names alone.

        Several names may do what one form does, and leave no place for it; so may a smooth curve. That little
        is gained is no reason to think of forms: the climb is kept apart, and counts where it explains all
        and its end is better beyond doubt than what is known.
        """
        apart = ScoredSets(self.contest)
        begun = apart.score_near(start, self.contest.quiet, self._forms.levels)
        end = Climb(apart).climb(begun, self._forms)
        whole = apart.score_near(end.members, end.amplitudes, self._whole.levels)
        if list_loud(self.contest, whole) or whole.score > min(named.score, beside.score) - _SURE:
            return named
        return self._climb(self._release(end), self._whole)

    def _climb_beside_curves(self, start: Sequence[SetMember], released: EffectSet) -> EffectSet:
        """Return the best end of climbs that begin beside all that has no name."""
        begun = [self._begin(start, self._whole)]
        if self._climbs.is_coloured(released):
            scope = replace(self._whole, with_forms=False)
            begun += self._climbs.look_ahead(self.make_bare_set(), scope, FOLLOWED)
        return min((self._climb(each, self._whole) for each in begun), key=find_score)

    def _go_back_to_names(self, best: EffectSet, named: EffectSet) -> EffectSet:
        """Return the best of a set and of what thorough climbs by names alone lead to."""
        is_near = len(named.members) <= _MOST_ALONE and named.score < best.score + _NEAR
        if is_near and has_nameless(self.contest, best):
            for near in (named, *self._list_named_near(best)):
                whole = self._climb(self._begin(near.members, self._names), self._names, is_thorough=True)
                end = self._climb(self._release(whole), self._whole, is_thorough=True)
                best = min(best, end, key=find_score)
        return best

    def _go_on_without_each(self, best: EffectSet, named: EffectSet) -> EffectSet:
        """Return the best of a set and of where climbs lead that must do without one of its effects.

        `named`: The best set of names alone: it is gone on from too.
        """
        if has_nameless(self.contest, best):
            begun = [(named, self._names, PROMISING)]
            parts = [self.contest.parts[number] for number in list_loud(self.contest, best)]
            is_irregular = any(part.irregular is not None for part in parts)
            if is_irregular:
                best = self._begin_anew(best, (self._regular, self._forms))
            elif any(part.course.along is Along.TIME for part in parts):
                best = self._begin_anew(best, (self._forms,))
            if is_irregular:
                regular = self._climb(self._begin(best.members, self._regular), self._regular)
                begun.append((regular, self._regular, _NEAR))
            for each, scope, within in begun:
                if each.score < best.score + within:
                    end = self._release(self._do_without_each(each, scope))
                    best = min(best, self._climb(end, self._whole), key=find_score)
        return self._put_pairs_for_one(self._do_without_each(best, self._whole))

    def _put_pairs_for_one(self, now: EffectSet) -> EffectSet:
        """Return where climbs lead in which two names have the place of one, as long as one ends higher.

        Lost motion that settles after each reversal, and a constant one, are much like a bow of it: beside
        that bow neither is needed, and neither by itself takes its place. Beside what has no name, two names
        more would only describe that.
        """
        while not has_nameless(self.contest, now):
            tried = (
                self._climbs.look_ahead_by_pairs(now.without(number), _FIRSTS, now.score + PROMISING)
                for number, each in enumerate(now.members)
                if each.family.is_named
            )
            settled = (self._sets.settle(each, self._whole.levels) for each in chain.from_iterable(tried))
            better = next((each for each in settled if each.score < now.score - GAIN), None)
            if better is None:
                break
            now = min(better, self._climb(better, self._whole), key=find_score)
        return now

    def _begin_anew(self, best: EffectSet, scopes: Sequence[Scope]) -> EffectSet:
        """Return the best of a set and of where climbs lead that begin with nothing.

        `scopes`: What is thought of at first. What is irregular takes in every wave and every step at once:
        where several are there, none gains by itself what it costs; beside curves that are smooth, or forms
        alone, each does. And where two curves in time cancel each other, a form says when it happens.
        """
        for scope in scopes:
            end = self._climb(self._begin((), scope), scope, is_thorough=True)
            best = min(best, self._climb(self._release(end), self._whole), key=find_score)
        return best

    def _do_without_each(self, now: EffectSet, scope: Scope) -> EffectSet:
        """Return where climbs lead that must do without one effect, as long as one ends higher.

        What came in first may stand for two and keep them out: lost motion that grows along the axis, and a
        bump, do what lost motion and a kink of one direction do.
        """
        while True:
            ends = (
                self._climb(
                    self._sets.score_near(now.without(number).members, now.amplitudes, scope.levels),
                    scope.without(find_installed_name(each.effect)),
                    goal=now.score,
                )
                for number, each in enumerate(now.members)
            )
            better = next((each for each in ends if each.score < now.score - GAIN), None)
            if better is None:
                return now
            # A climb that comes by a set nearly known ends where that one did, perhaps a trifle lower.
            now = min(better, self._climb(better, scope), key=find_score)

    def _put_forms_for_two(self, now: EffectSet) -> EffectSet:
        """Return where climbs lead in which a form has the place of two names, as long as one ends higher.

        A stretch that is displaced is one joint and another back: beside either of them it is needless. One
        that stands for three names gains once the third has gone.
        """
        forms = replace(self._whole, with_names=False)
        while True:
            fewer = (
                replace(
                    now, members=tuple(each for each in now.members if each is not one and each is not other)
                )
                for one, other in combinations(now.named, 2)
            )
            tried = (self._climbs.look_ahead(each, forms, _FOR_TWO, now.score + _UNREFINED) for each in fewer)
            ends = (
                self._climb(each, self._whole, goal=now.score)
                for each in chain.from_iterable(tried)
                if each.score < now.score + PROMISING
            )
            better = next((each for each in ends if each.score < now.score - GAIN), None)
            if better is None:
                return now
            now = better

    def _begin(self, members: Sequence[SetMember], scope: Scope) -> EffectSet:
        """Return a set with its best amplitudes near nothing."""
        return self._sets.score_near(members, self.contest.quiet, scope.levels)

    def _release(self, found: EffectSet) -> EffectSet:
        """Return a set with whatever has no name beside it."""
        return self._sets.score_near(found.members, found.amplitudes, self._whole.levels)

    def _list_named_near(self, found: EffectSet) -> list[EffectSet]:
        """Return the best sets of names alone that were passed on the way, and lack little.

        Where effects that each look needless beside a curve explain all together, a climb passes by them.
        """
        passed = [
            each for each in self._sets.best.values() if each.named and not has_nameless(self.contest, each)
        ]
        near = [each for each in passed if each.score < found.score + PROMISING]
        return sorted(near, key=find_score)[:_MOST_PASSED]

    def _unite(self, found: EffectSet, other: EffectSet) -> EffectSet:
        """Return a set with the members of another that can stand beside its own."""
        members = found.members
        for each in other.members:
            if len(list_beside(members, each.effect)) == len(members):
                members = (*members, each)
        return self._sets.score_near(members, found.amplitudes, self._whole.levels)

    def make_bare_set(self) -> EffectSet:
        """Return what there is without any effect."""
        return self._begin((), self._whole)

    def compute_evidence_of_changes(self, found: EffectSet) -> float:
        """Return the evidence of what changes in time, or from run to run, and has no name in a set."""
        still = tuple(
            level if part.course.along is Along.PLACE else min(level, part.noise_levels - 1)
            for level, part in zip(found.amplitudes, self.contest.parts, strict=True)
        )
        kept = [each for each in found.members if not _changes_without_name(each)]
        return self._sets.score(kept, still).score - found.score

    def find_best_holding(self, found: EffectSet, kept: Sequence[SetMember]) -> EffectSet:
        """Return the best set with these named members alone; what has no name as it then is."""
        names = list_names(kept)
        # Two displaced runs have one name: a set with both is no set with one.
        known = [
            each
            for (own, _), each in self._sets.best.items()
            if own == names and len(each.named) == len(kept)
        ]
        return min(
            (self._sets.score_near((*kept, *found.unnamed), found.amplitudes, self._whole.levels), *known),
            key=find_score,
        )

    def compute_own_evidence(self, found: EffectSet) -> list[float]:
        """Return for each member the evidence that the set loses without it, all else following."""
        return [self.without(found, number).score - found.score for number in range(len(found.members))]

    def without(self, found: EffectSet, number: int) -> EffectSet:
        """Return a set without one of its members, all else at its best values then."""
        fewer = found.without(number)
        key = found.amplitudes, tuple(each.key for each in fewer.members)
        if key not in self._fewer:
            self._fewer[key] = self._find_best_values(self._release(fewer))
        return self._fewer[key]

    def settle_beside_noise(self, found: EffectSet) -> EffectSet:
        """Return a set at its best values beside nothing but noise."""
        return self._sets.settle(self._begin(found.members, self._names), self._names.levels)

    def _find_best_values(self, found: EffectSet) -> EffectSet:
        """Return the best of a set as it is, as it becomes once it is settled, and as it was met before."""
        near = [found]
        # Two joints are met by one name: what was met before may be a larger set than this.
        known = self._sets.best[list_names(found.named), list_unnamed(found)]
        if len(known.members) == len(found.members):
            near.append(known)
        if any(each.theta.size for each in found.members):
            near.append(self._sets.settle(found, self._whole.levels))
        return min(near, key=find_score)

    def as_noise(self, members: Sequence[SetMember]) -> EffectSet:
        """Return a set beside which there is nothing but noise."""
        return self._begin(members, self._names)

    def list_rivals(self, found: EffectSet, rest: EffectSet, within: float) -> list[EffectSet]:
        """Return the sets in which another effect stands in the place of a member, best first.

        `rest`: The set without it.
        `within`: What evidence they may lack.
        """
        others = replace(self._whole.without(*list_names(found.members)), with_forms=False)
        beside = replace(rest, amplitudes=found.amplitudes)
        tried = [
            each
            for start in (rest, beside)
            for each in self._climbs.look_ahead(start, others, BROAD, found.score + within + PROMISING)
        ]
        seen = (renumber(self.contest, each) for each in self.seen.list_with_one_instead(found, rest))
        near = sorted((*tried, *seen), key=find_score, reverse=True)
        best = {each.members[-1].identifier: each for each in near if each.score < found.score + within}
        return sorted(best.values(), key=find_score)

    def look_ahead(self, found: EffectSet) -> list[EffectSet]:
        """Return a set with one more installed effect, each effect once, the most promising first."""
        tried = self._climbs.look_ahead(found, replace(self._whole, with_forms=False))
        return list({each.members[-1].identifier: each for each in reversed(tried)}.values())[::-1]

    def find_best_with_form(self, found: EffectSet) -> EffectSet | None:
        """Return a set with the form without a name, its last, that adds most; None if none adds anything."""
        tried = self._climbs.look_ahead(found, replace(self._whole, with_names=False))
        return tried[0] if tried else None


def _changes_without_name(member: SetMember) -> bool:
    """Return whether a member of a set is a form without a name that is laid in time."""
    return isinstance(member.effect, UnnamedForm) and member.effect.carrier in IN_TIME
