"""One contest after another: what is missing, and what is missing still when the best effect is added."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.model.calibration import LEVEL, Calibration, PValue, calibrate
from zlmreport.model.candidates import entrants
from zlmreport.model.contest import Contest
from zlmreport.model.contrasts import restricted_estimate
from zlmreport.model.effect import Effect
from zlmreport.model.evidence import evidence_of
from zlmreport.model.fit import Fit, fit
from zlmreport.model.noise import Noise
from zlmreport.model.ranking import EXPLAINED, FURTHER, MENTION, NAMED, Ranked, Ranking, rank
from zlmreport.model.search import Thetas
from zlmreport.quantities.arrays import FloatArray

#: Effects that a diagnosis adds on trial, one after another.
_MOST_STEPS = 3
#: Share of a column that must be left beside the model: less, once effects have been added whose searched
#: parameters are only known within their uncertainty.
_LEAST_VISIBLE, _LEAST_VISIBLE_LATER = 1e-6, 1e-3


@dataclass(frozen=True, slots=True)
class Step:
    """A contest beside one model.

    Attributes
    ----------
    fit
        The model.
    contest, calibration
        What the plan can see beside it, and what chance would give.
    ratios : (parts,) array
        φ̂ of the noise, held to what noise may be.
    noise
        The same with σ̂.
    ranking
        The order of the effects.
    p_value
        Chance of such a contest where nothing is missing.
    """

    fit: Fit
    contest: Contest
    calibration: Calibration
    ratios: FloatArray
    noise: Noise
    ranking: Ranking
    p_value: PValue

    @property
    def something_is_missing(self) -> bool:
        """Whether chance does not explain the contest, and anything else explains it better."""
        return self.p_value.value <= LEVEL and self._most >= MENTION

    @property
    def _most(self) -> float:
        return max(self.ranking.most, self.ranking.shape_evidence)

    @property
    def left(self) -> float:
        """Evidence of what is missing beside this model, with or without a name; 0 if nothing is."""
        return self._most if self.something_is_missing else 0.0

    @property
    def best(self) -> Ranked | None:
        """The effect that leads, if it is better than none."""
        leading = self.ranking.effects[:1]
        return leading[0] if leading and leading[0].evidence > 0 else None


def hold_contest(fitted: Fit, effects: Iterable[Effect]) -> Step:
    """Hold a contest of all effects beside a fitted model."""
    design, deviation = fitted.design, fitted.open_deviation
    entered = entrants(fitted.model, design, effects)
    known = all(len(theta) == 0 for theta in fitted.solution.thetas)
    least_visible = _LEAST_VISIBLE if known else _LEAST_VISIBLE_LATER
    contest = Contest.of(
        design, fitted.base(), entered.forms, fitted.noise.weights, least_visible=least_visible
    )
    space = contest.space
    ratios, variance = restricted_estimate(
        space, space.of(deviation), contest.grid, contest.grid.max(axis=0, initial=0.0)
    )
    by_source = {part.source: float(ratio) for part, ratio in zip(space.parts, ratios, strict=True)}
    calibration = calibrate(contest, design, ratios)
    scores = contest.scores(deviation[:, np.newaxis])
    return Step(
        fitted,
        contest,
        calibration,
        ratios,
        Noise(float(np.sqrt(variance)), by_source, fitted.noise.weights),
        rank(contest, design, scores, evidence_of(contest, design, deviation, least_visible), calibration),
        calibration.p_value(scores),
    )


def add(fitted: Fit, found: Ranked) -> Fit:
    """Return the fit of the model with an effect that a contest found."""
    model = fitted.model.with_effect(found.effect)
    before = dict(zip(fitted.model.identifiers, fitted.solution.thetas, strict=True))
    start: Thetas = tuple(
        found.theta if term.effect.identifier == found.identifier else before[term.effect.identifier]
        for term in model.terms
    )
    assumptions = replace(fitted.assumptions, weights=fitted.noise.weights)
    return fit(model, fitted.design, fitted.deviation, assumptions, start)


def steps(first: Fit, effects: Sequence[Effect]) -> tuple[Step, ...]:
    """Return contests beside a model and, as long as something is missing and has a name, what follows it."""
    found = [hold_contest(first, effects)]
    while len(found) <= _MOST_STEPS:
        last = found[-1]
        if not last.something_is_missing or last.best is None:
            break
        found.append(hold_contest(add(last.fit, last.best), effects))
    return tuple(found)


def named_effects(found: Sequence[Step]) -> tuple[str, ...]:
    """Return the effects that explain what is missing better than any shape without a name; none if none do.

    Effects that are found one after another add up, each at the price of a further cause. They must surpass
    the shapes clearly at every step: also at the first, where a shape may describe what a later effect
    explains. What is still missing after them must be small beside what they explain.
    """
    names: list[str] = []
    named, unnamed = 0.0, -np.inf
    for step in found:
        price = NAMED + FURTHER * max(0, len(names) - 1)
        if names and named >= unnamed + price and named * (1 - EXPLAINED) >= EXPLAINED * step.left:
            return tuple(names)
        if not step.something_is_missing or step.best is None:
            break
        unnamed = max(unnamed, named + step.ranking.shape_evidence)
        named += step.ranking.most
        names.append(step.best.identifier)
    return ()
