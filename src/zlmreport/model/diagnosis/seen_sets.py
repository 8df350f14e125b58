"""The sets that a search looked at: which of them would do in the place of one, and what each of them lacks.

Nothing is searched here, and no set is scored: what nobody looked at takes the place of none.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence, Set as AbstractSet
from dataclasses import replace

import numpy as np

from zlmreport.model.diagnosis.effect_set import (
    EffectSet,
    compute_fit,
    count_nameless,
    find_installed_name,
    find_score,
    has_nameless,
    list_loud,
    list_names,
    list_unnamed,
)
from zlmreport.model.diagnosis.scored_sets import ScoredSets


class SeenSets:
    """Questions about the sets of a contest that were scored until now."""

    def __init__(self, scored: ScoredSets) -> None:
        self._contest, self._best = scored.contest, scored.best

    def compute_evidence_of(self, found: EffectSet, names: AbstractSet[str]) -> float:
        """Return the evidence that the best set without any of some effects lacks.

        All else may be another there: other effects, and the size of every curve without a name. It has no
        form without a name that is not in the set: what has a name goes before a form that does the same. And
        where the same curves are left, it has no more names: one cause goes before two that do the same.

        `names`: As they are installed.
        """
        forms, loud = list_unnamed(found), list_loud(self._contest, found)
        others = [
            each.score
            for (known, own), each in self._best.items()
            if not known & names
            and own <= forms
            and (
                len(each.named) <= len(found.named) or (own, list_loud(self._contest, each)) != (forms, loud)
            )
        ]
        return min(others, default=np.inf) - found.score

    def find_best_as_small(self, found: EffectSet) -> EffectSet:
        """Return the best of a set and all others with no more names, beside nothing more without one."""
        as_small = (
            each
            for each in self._list_beside_no_more(found)
            if len(each.named) <= len(found.named) and len(each.unnamed) <= len(found.unnamed)
        )
        return min((found, *as_small), key=find_score)

    def find_fewer_beside_curve(self, found: EffectSet, names: int, within: float) -> EffectSet | None:
        """Return the best set in which curves without a name replace several names each.

        `names`: How many one replaces at least; each further one replaces one more.
        `within`: What evidence it may lack; None where all lack more.
        """
        fewer = [
            each
            for each in self._best.values()
            if 0 < count_nameless(self._contest, each) <= len(found.named) - len(each.named) - names + 1
            and each.score < found.score + within
        ]
        return min(fewer, key=find_score, default=None)

    def find_irregular_instead(self, found: EffectSet, within: Sequence[float]) -> EffectSet | None:
        """Return the best set in which what is irregular has the place of names.

        `within`: What evidence it may lack in the place of one name, of two and so on, the last also of more;
        None where all lack more.
        """
        forms, loud = list_unnamed(found), set(list_loud(self._contest, found))
        irregular = {number for number, part in enumerate(self._contest.parts) if part.irregular is not None}
        instead = []
        for (_, unnamed), each in self._best.items():
            more = set(list_loud(self._contest, each)) - loud
            fewer = len(found.named) - len(each.named)
            is_irregular = more and more <= irregular and unnamed <= forms
            if not is_irregular or fewer < 1:
                continue
            if each.score < found.score + within[min(fewer, len(within)) - 1]:
                instead.append(each)
        return min(instead, key=find_score, default=None)

    def find_names_instead(
        self, found: EffectSet, names: int, within: float
    ) -> tuple[EffectSet, float] | None:
        """Return the set in which fewest names more do all that forms and curves do, and what it lacks.

        `names`: How many more at most: with enough names any curve is described.
        `within`: What evidence it may lack of the best set that has something without a name.
        """
        own, known = list_names(found.named), self._best.values()
        best = min((each.score for each in known if has_nameless(self._contest, each)), default=np.inf)
        alone = [
            each
            for each in known
            if own < list_names(each.named)
            and len(each.named) <= len(found.named) + names
            and not has_nameless(self._contest, each)
            and each.score < best + within
        ]
        instead = min(alone, key=lambda each: (len(each.named), find_score(each)), default=None)
        return None if instead is None else (instead, instead.score - best)

    def find_names_alone(self, found: EffectSet, within: float) -> EffectSet | None:
        """Return the best set in which one name each does what forms and curves do, or more do it better.

        `within`: What evidence it may lack; None where all lack more.
        """
        most = len(found.named) + count_nameless(self._contest, found)
        alone = [
            each
            for each in self._best.values()
            if each.score < found.score + (within if len(each.named) <= most else min(within, 0.0))
            and not has_nameless(self._contest, each)
        ]
        return min(alone, key=find_score, default=None)

    def find_one_instead(self, found: EffectSet, names: AbstractSet[str], within: float) -> EffectSet | None:
        """Return the best set in which one name stands in the place of several.

        `names`: Those that may, as they are installed.
        `within`: What evidence it may lack; None where all lack more.
        """
        own = list_names(found.named)
        instead = [
            each
            for each in self._list_beside_no_more(found)
            if len(new := list_names(each.named) - own) == 1
            and new <= names
            and len(own - list_names(each.named)) > 1
            and each.score < found.score + within
        ]
        return min(instead, key=find_score, default=None)

    def find_named_alike(
        self, found: EffectSet, within: float, fit_within: float, toss_up: float
    ) -> EffectSet | None:
        """Return the best set in which one name has the place and the shape of one form, or is as likely.

        It has no more columns than the form: a polynomial does what many a form does.

        `within`: What evidence it may lack; None where all lack more.
        `fit_within`: The same of the fit alone, whatever the name costs.
        `toss_up`: Evidence that decides nothing: a name that lacks no more needs no better fit.
        """
        names, forms = list_names(found.named), list_unnamed(found)
        fit, columns = compute_fit(self._contest, found), sum(member.rank for member in found.members)
        alike = [
            each
            for each in self._list_beside_no_more(found)
            if names < list_names(each.named)
            and list_unnamed(each) < forms
            and len(each.members) == len(found.members)
            and len(each.named) == len(found.named) + 1
            and sum(member.rank for member in each.members) <= columns
            and each.score < found.score + within
            and (compute_fit(self._contest, each) < fit + fit_within or each.score < found.score + toss_up)
        ]
        return min(alike, key=find_score, default=None)

    def list_with_one_instead(self, found: EffectSet, rest: EffectSet) -> Iterator[EffectSet]:
        """Yield the sets that have one new effect, as their last, and not what `rest` is without.

        It may make others of the set needless, too. A set with both joints is none without the second.
        """
        own, forms, left = list_names(found.named), list_unnamed(found), _count_by_name(rest)
        gone = _count_by_name(found) - left
        for (_, unnamed), each in self._best.items():
            others = [member for member in each.named if find_installed_name(member.effect) not in own]
            has_gone = any(count > left[name] for name, count in _count_by_name(each).items() if name in gone)
            if len(others) == 1 and not has_gone and unnamed <= forms:
                beside = (member for member in each.members if member is not others[0])
                yield replace(each, members=(*beside, others[0]))

    def _list_beside_no_more(self, found: EffectSet) -> Iterator[EffectSet]:
        """Yield the sets that have no other forms and no other curves without a name than one."""
        forms, loud = list_unnamed(found), set(list_loud(self._contest, found))
        for (_, unnamed), each in self._best.items():
            if unnamed <= forms and loud.issuperset(list_loud(self._contest, each)):
                yield each


def _count_by_name(found: EffectSet) -> Counter[str]:
    """Return how many effects of each installed name are in a set."""
    return Counter(find_installed_name(each.effect) for each in found.named)
