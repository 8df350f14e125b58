"""Evidence: which effect it is that explains the readings.

A likelihood averaged over the values of the searched parameters and of the noise: an effect that fits
wherever its searched parameters point is better explained than one that had to be pointed. What is large
shows these parameters more finely than the grid of the comparison has them; so the leaders are averaged
over a finer one about their best values.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from zlmreport.language import Words
from zlmreport.model.candidates import Entry
from zlmreport.model.comparison import Comparison, Criteria, Scores
from zlmreport.model.design import Design
from zlmreport.model.effect import Effect
from zlmreport.model.null_distribution import NullDistribution, PValue
from zlmreport.quantities.arrays import FloatArray

#: Parts of the distance of neighbours in the grid by which the finer one proceeds.
_PARTS = 6
#: Evidence behind the best from which on a finer grid changes no outcome.
_REACH = 30.0
# Of evidence, 2·ln of a Bayes factor, less than 2 is "not worth more than a bare mention", 2 to 6 positive, 6
# to 10 strong (R. E. Kass and A. E. Raftery, Journal of the American Statistical Association 90 (1995) 773).

#: Evidence that anything must have to be worth a mention, and by which effects must differ to be told apart.
MENTION = 2.0
#: Evidence by which a name must surpass a shape without one.
NAMED = 2.0
#: Evidence that each effect after the first must bring beyond that: a single cause is likelier than two.
FURTHER = 8.0
#: Share of all evidence that the effects found must explain.
EXPLAINED = 0.75
#: Criteria that differ by less, of the largest, are equal but for rounding.
_ALIKE = 1e-9
#: Two effects with the same columns differ by rounding only.
_ALIKE = 1e-6


@dataclass(frozen=True, slots=True)
class Evidence:
    """How all explain one set of deviations."""

    effects: FloatArray  #: (effects,): 2·ln of each effect's Bayes factor against the model alone.
    nameless: FloatArray  #: (nameless,): The same of the nameless shapes.
    #: Of each effect, the form that fits best, and its searched parameters.
    best: tuple[tuple[Effect, FloatArray], ...]


@dataclass(frozen=True, slots=True)
class _Tried:
    """A family on one set of deviations."""

    effect: Effect  #: Its form.
    thetas: FloatArray  #: (g, s): Searched parameters that were tried.
    weights: FloatArray  #: (g,): The part of the grid for which each stands.
    #: fits and averages: (f, g): Its criteria.
    fits: FloatArray
    averages: FloatArray

    @property
    def best(self) -> int:
        """The row of the best fit; in the middle of those that fit alike.

        Between two targets every place of a kink fits alike: the last digits, which another processor
        computes otherwise, must not choose among them.
        """
        fits = self.fits.min(axis=0)
        alike = np.flatnonzero(fits <= fits.min() + _ALIKE * np.abs(fits).max())
        return int(alike[(len(alike) - 1) // 2])

    @property
    def average(self) -> float:
        """The criterion averaged over searched parameters and noise."""
        return _average(self.averages, self.weights)


def evidence_of(
    comparison: Comparison,
    design: Design,
    deviation: FloatArray,
    least_visible: float,
    known: float = 0.0,
) -> Evidence:
    """Return the evidence of one set of deviations.

    `deviation`, (N,): x, m or rad.
    `least_visible`: Share of an effect's length below which the base model imitates it entirely.
    `known`: Standard deviation of a noise of known size that stands beside σ, m or rad.
    """
    criteria = comparison.criteria(deviation, known)
    families = _tried(comparison, criteria)
    by_effect = comparison.bases.by_effect
    averages = [_of_forms([families[form] for form in forms]) for forms in by_effect]
    foremost = min(averages, default=np.inf) + _REACH
    leaders = [forms for forms, average in zip(by_effect, averages, strict=True) if average < foremost]
    finer = [_finer(min((families[form] for form in forms), key=_least)) for forms in leaders]
    others = comparison.of_others(design, [each for each in finer if each is not None], least_visible)
    between = {id(each.effect): each for each in _tried(others, others.criteria(deviation, known))}
    families = [_merged(each, between.get(id(each.effect))) for each in families]
    base = _average(criteria.null)
    best = [min((families[form] for form in forms), key=_least) for forms in by_effect]
    return Evidence(
        np.array([base - _of_forms([families[form] for form in forms]) for forms in by_effect]),
        np.array([base - _average(nameless) for nameless in criteria.nameless.T]),
        tuple((each.effect, each.thetas[each.best]) for each in best),
    )


def _tried(comparison: Comparison, criteria: Criteria) -> list[_Tried]:
    """Return the families of a comparison with their criteria, each value of θ standing for itself."""
    found, last = [], 0
    for family in comparison.bases.families:
        first, last = last, last + len(family.thetas)
        own = slice(first, last)
        weights = np.ones(last - first)
        found.append(
            _Tried(family.effect, family.thetas, weights, criteria.fits[:, own], criteria.averages[:, own])
        )
    return found


def _finer(family: _Tried) -> Entry | None:
    """Return values between the best one and its neighbours in the grid; None where there are none."""
    searched = family.effect.searched
    if len(searched) != 1 or not searched[0].is_refined or len(family.thetas) == 1:
        return None
    best, steps = family.best, np.arange(1, _PARTS) / _PARTS
    values = family.thetas[max(best - 1, 0) : best + 2]
    return family.effect, np.concatenate(
        [one + steps[:, np.newaxis] * (other - one) for one, other in pairwise(values)]
    )


def _merged(family: _Tried, between: _Tried | None) -> _Tried:
    """Return a family with the values between its best one and the neighbours of this.

    Each value stands for the part of the grid about it, the coarse ones for a whole step.
    """
    if between is None:
        return family
    weights, best = family.weights.copy(), family.best
    gaps = 0
    for neighbour in (best - 1, best + 1):
        if 0 <= neighbour < len(weights):
            weights[neighbour] = 0.5 + 0.5 / _PARTS
            gaps += 1
    weights[best] = 1.0 - gaps * (0.5 - 0.5 / _PARTS)
    return _Tried(
        family.effect,
        np.concatenate([family.thetas, between.thetas]),
        np.concatenate([weights, between.weights / _PARTS]),
        np.concatenate([family.fits, between.fits], axis=1),
        np.concatenate([family.averages, between.averages], axis=1),
    )


def _least(family: _Tried) -> float:
    return float(family.fits.min())


def _of_forms(forms: Sequence[_Tried]) -> float:
    """Return the criterion averaged over the forms of an effect."""
    return _average(np.array([form.average for form in forms]))


def _average(criteria: FloatArray, weights: FloatArray | None = None) -> float:
    """Return −2 ln of the mean likelihood, the last axis weighted."""
    least = criteria.min()
    likelihoods = np.exp(-0.5 * (criteria - least)).reshape(-1, criteria.shape[-1]).mean(axis=0)
    return float(least - 2.0 * np.log(np.average(likelihoods, weights=weights)))


@dataclass(frozen=True, slots=True)
class Ranked:
    """An effect in the order of the comparison."""

    effect: Effect  #: In the form that fits best.
    theta: FloatArray  #: (s,): Its searched parameters, near their best values.
    ratio: float  #: Its likelihood ratio LR.
    usual: float  #: The 95 % point of LR where nothing is missing.
    evidence: float  #: 2·ln of its Bayes factor against the model alone.
    #: Among all effects, nameless shapes and no effect, if each was as likely before the test.
    probability: float
    p_value: PValue  #: Of its likelihood ratio, its own search allowed for.

    @property
    def identifier(self) -> str:
        """As jobs name it."""
        return self.effect.identifier


@dataclass(frozen=True, slots=True)
class Ranking:
    """The outcome of a comparison."""

    #: The plainest of those that explain the readings best; then the others, best first.
    effects: tuple[Ranked, ...]
    shape: Words | None  #: The best shape without a name; None where there is none.
    shape_evidence: float  #: Its evidence.
    #: Effects that would lead, but with values outside their plausible range.
    impossible: tuple[Ranked, ...] = ()

    def without(self, design: Design, rejected: Sequence[Ranked], impossible: Sequence[Ranked]) -> Ranking:
        """Return the ranking of the others, as if those rejected had never been likely.

        `impossible`: Those among them whose estimates are physically impossible.
        """
        left = 1.0 - sum(each.probability for each in rejected)
        kept = [
            replace(each, probability=min(1.0, each.probability / left) if left > 0 else 0.0)
            for each in self.effects
            if each not in rejected
        ]
        return replace(self, effects=_in_order(kept, design), impossible=tuple(impossible))

    @property
    def leaders(self) -> tuple[Ranked, ...]:
        """The first, and those that the readings cannot tell from it."""
        if not self.effects:
            return ()
        return tuple(each for each in self.effects if each.evidence > self.most - MENTION)

    @property
    def most(self) -> float:
        """The largest evidence of any effect; −∞ where there is none."""
        return max((each.evidence for each in self.effects), default=-np.inf)


def rank(
    comparison: Comparison,
    design: Design,
    scores: Scores,
    evidence: Evidence,
    null: NullDistribution,
) -> Ranking:
    """Return the order of the effects."""
    together = np.concatenate([[0.0], evidence.effects, evidence.nameless])
    weights = np.exp(0.5 * (together - together.max()))
    shares = weights / weights.sum()
    found = []
    for index, (effect, theta) in enumerate(evidence.best):
        ratio = float(scores.ratios[index, 0])
        found.append(
            Ranked(
                effect,
                theta,
                ratio,
                float(null.usual[index]),
                float(evidence.effects[index]),
                float(shares[1 + index]),
                null.p_value_of_effect(index, ratio),
            )
        )
    shape, of_shape = _best_shape(comparison, evidence)
    return Ranking(_in_order(found, design), shape, of_shape)


def _in_order(effects: Sequence[Ranked], design: Design) -> tuple[Ranked, ...]:
    """Return the plainest of those that explain the readings best, then the others, best first."""
    # Of effects with the same columns the more general one leads: one whose sign is free.
    found = sorted(
        effects,
        key=lambda each: (-round(each.evidence / _ALIKE), _is_one_sided(each.effect), each.identifier),
    )
    foremost = [each for each in found if each.evidence > found[0].evidence - MENTION]
    plainest = min(foremost, key=lambda each: _assumptions(each.effect, design), default=None)
    return tuple(sorted(found, key=lambda each: each is not plainest))


def _assumptions(effect: Effect, design: Design) -> int:
    """Return how much an effect takes for granted: a log that it follows, parameters that are searched.

    A constant is a constant before it is the dead path of a beam in air that hardly changes.
    """
    follows_a_log = effect.untestable(replace(design, conditions={})) is not None
    searched = len(effect.searched) if len(effect.grid(design)) > 1 else 0
    return searched + follows_a_log


def _is_one_sided(effect: Effect) -> bool:
    return any(each.smallest == 0 or each.largest == 0 for each in effect.linear)


def _best_shape(comparison: Comparison, evidence: Evidence) -> tuple[Words | None, float]:
    """Return the leading shape without a name, the evidence of its lengths averaged."""
    by_shape: dict[str, list[float]] = {}
    for nameless, value in zip(comparison.nameless, evidence.nameless.tolist(), strict=True):
        by_shape.setdefault(nameless.shape.en, []).append(value)
    averages = {}
    for shape, values in by_shape.items():
        most = max(values)
        averages[shape] = most + 2.0 * float(np.log(np.mean(np.exp(0.5 * (np.array(values) - most)))))
    if not averages:
        return None, -np.inf
    best = max(averages, key=averages.__getitem__)
    return next(nameless.shape for nameless in comparison.nameless if nameless.shape.en == best), averages[
        best
    ]
