"""Keeps scores of sets of effects while a search goes on.

A set is scored by its evidence, the coefficients of its effects, their searched parameters and σ averaged
over (`set_costs`), the amplitudes of all nameless parts chosen anew for each set.
"""

from __future__ import annotations

from collections.abc import Sequence

from zlmreport.model.diagnosis.amplitudes import AmplitudeSearch, move_amplitude
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.effect_set import EffectSet, SetMember, list_names, list_unnamed
from zlmreport.model.diagnosis.likelihood import Amplitudes
from zlmreport.model.diagnosis.refining import jump_along_grids, refine_member
from zlmreport.model.diagnosis.set_costs import SetCosts


class ScoredSets:
    """The sets of a contest that were looked at.

    `best`: Of all sets that were scored the best ones, by the effects, as they are installed, and the forms
        that are in it.
    """

    def __init__(self, contest: Contest) -> None:
        self.contest = contest
        self.best: dict[tuple[frozenset[str], frozenset[str]], EffectSet] = {}
        self._costs, self._amplitudes = SetCosts(contest), AmplitudeSearch(contest)

    def score(self, members: Sequence[SetMember], amplitudes: Amplitudes) -> EffectSet:
        """Return a set as it is given, with its score."""
        columns = [each.columns for each in members]
        score = self.contest.compute_criterion(amplitudes, columns) + self._costs.compute(members, amplitudes)
        found = EffectSet(tuple(members), amplitudes, score)
        key = list_names(found.named), list_unnamed(found)
        if key not in self.best or score < self.best[key].score:
            self.best[key] = found
        return found

    def score_near(
        self, members: Sequence[SetMember], amplitudes: Amplitudes, levels: Amplitudes
    ) -> EffectSet:
        """Return a set with its best amplitudes near others.

        `levels`: Of each part, how many are thought of.
        """
        return self.score(members, self._find_amplitudes(members, amplitudes, levels))

    def glance_at(self, members: Sequence[SetMember], amplitudes: Amplitudes) -> EffectSet:
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

    def refine_last(self, now: EffectSet, levels: Amplitudes) -> EffectSet:
        """Return a set with the parameters of its last effect between those of the grid."""
        members = list(now.members)
        amplitudes = self._find_amplitudes(members, now.amplitudes, levels)
        members, has_moved = jump_along_grids(self.contest, members, amplitudes)
        if has_moved:
            amplitudes = self._find_amplitudes(members, amplitudes, levels)
        members[-1] = refine_member(self.contest, members, len(members) - 1, amplitudes)
        return self.score(members, amplitudes)

    def settle(self, now: EffectSet, levels: Amplitudes) -> EffectSet:
        """Return a set with all its parameters refined and its amplitudes chosen anew."""
        members, amplitudes = list(now.members), now.amplitudes
        for number in range(len(members)):
            members[number] = refine_member(self.contest, members, number, amplitudes)
        amplitudes = self._find_amplitudes(members, amplitudes, levels)
        members, _ = jump_along_grids(self.contest, members, amplitudes)
        return self.score(members, amplitudes)

    def _find_amplitudes(
        self, members: Sequence[SetMember], start: Amplitudes, levels: Amplitudes
    ) -> Amplitudes:
        return self._amplitudes.find_near(start, [each.columns for each in members], levels)
