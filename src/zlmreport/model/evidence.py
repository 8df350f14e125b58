"""Evidence: which effect it is that explains the readings.

A likelihood averaged over the values of the searched parameters and of the noise: an effect that fits
wherever its searched parameters point is better explained than one that had to be pointed. What is large
shows these parameters more finely than the grid of the contest has them; so the leaders are averaged over a
finer one about their best values.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from zlmreport.model.bases import Entry
from zlmreport.model.contest import Contest, Criteria
from zlmreport.model.design import Design
from zlmreport.model.effect import Effect
from zlmreport.quantities.arrays import FloatArray

#: Parts of the distance of neighbours in the grid by which the finer one proceeds.
_PARTS = 6
#: Evidence behind the best from which on a finer grid changes no outcome.
_REACH = 30.0


@dataclass(frozen=True, slots=True)
class Evidence:
    """How the contestants explain one set of deviations.

    Attributes
    ----------
    effects : (effects,) array
        2·ln of each effect's Bayes factor against the model alone.
    rivals : (rivals,) array
        The same of the rivals.
    best
        Of each effect, the form that fits best, and its searched parameters.
    """

    effects: FloatArray
    rivals: FloatArray
    best: tuple[tuple[Effect, FloatArray], ...]


@dataclass(frozen=True, slots=True)
class _Tried:
    """A family on one set of deviations.

    Attributes
    ----------
    effect
        Its form.
    thetas : (g, s) array
        Searched parameters that were tried.
    weights : (g,) array
        The part of the grid for which each stands.
    fits, averages : (f, g) arrays
        Its criteria.
    """

    effect: Effect
    thetas: FloatArray
    weights: FloatArray
    fits: FloatArray
    averages: FloatArray

    @property
    def best(self) -> int:
        """The row of the best fit."""
        return int(np.argmin(self.fits.min(axis=0)))

    @property
    def average(self) -> float:
        """The criterion averaged over searched parameters and noise."""
        return _average(self.averages, self.weights)


def evidence_of(contest: Contest, design: Design, deviation: FloatArray, least_visible: float) -> Evidence:
    """Return the evidence of one set of deviations.

    Parameters
    ----------
    contest
        The contest.
    design
        The test.
    deviation : (N,) array
        x, m or rad.
    least_visible
        Share of an effect's length below which the base model imitates it entirely.
    """
    criteria = contest.criteria(deviation)
    families = _tried(contest, criteria)
    contestants = contest.bases.contestants
    averages = [_of_forms([families[form] for form in forms]) for forms in contestants]
    foremost = min(averages, default=np.inf) + _REACH
    leaders = [forms for forms, average in zip(contestants, averages, strict=True) if average < foremost]
    finer = [_finer(min((families[form] for form in forms), key=_least)) for forms in leaders]
    others = contest.of_others(design, [each for each in finer if each is not None], least_visible)
    between = {id(each.effect): each for each in _tried(others, others.criteria(deviation))}
    families = [_merged(each, between.get(id(each.effect))) for each in families]
    base = _average(criteria.null)
    best = [min((families[form] for form in forms), key=_least) for forms in contestants]
    return Evidence(
        np.array([base - _of_forms([families[form] for form in forms]) for forms in contestants]),
        np.array([base - _average(rival) for rival in criteria.rivals.T]),
        tuple((each.effect, each.thetas[each.best]) for each in best),
    )


def _tried(contest: Contest, criteria: Criteria) -> list[_Tried]:
    """Return the families of a contest with their criteria, each value of θ standing for itself."""
    found, last = [], 0
    for family in contest.bases.families:
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
