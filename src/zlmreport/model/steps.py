"""One comparison after another: what is missing, and what is missing still when the best effect is added."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.language import Words
from zlmreport.model.candidates import effects_to_try
from zlmreport.model.comparison import Comparison, Told, untold
from zlmreport.model.contrasts import restricted_estimate
from zlmreport.model.effect import Effect
from zlmreport.model.estimate import Plausibility
from zlmreport.model.evidence import EXPLAINED, FURTHER, MENTION, NAMED, Ranked, Ranking, evidence_of, rank
from zlmreport.model.fit import Fit, fit
from zlmreport.model.noise import Noise
from zlmreport.model.null_distribution import LEVEL, PValue, simulate_null
from zlmreport.model.priors import Expected
from zlmreport.model.repeats import resolution
from zlmreport.model.search import Thetas
from zlmreport.model.visibility import Visibility, visibility

#: Effects that a diagnosis adds on trial, one after another.
_MOST_STEPS = 3
#: Share of a column that must be left beside the model: less, once effects have been added whose searched
#: parameters are only known within their uncertainty.
_LEAST_VISIBLE, _LEAST_VISIBLE_LATER = 1e-6, 1e-3
_AND = Words(en="{first}; {second}", de="{first}; {second}")
_FROM = Words(en="{effect}: {measurement}", de="{effect}: {measurement}")


#: Share of what is to be explained, and of what the model explains, that no equation of a machine describes.
_INEXACT_MISFIT, _INEXACT_MODEL = 0.01, 0.002


@dataclass(frozen=True, slots=True)
class Step:
    """A comparison beside one model."""

    fit: Fit  #: The model.
    visible: tuple[Visibility, ...]  #: How much of each effect the plan can see beside it.
    noise: Noise  #: Held to what noise may be.
    ranking: Ranking  #: The order of the effects.
    p_value: PValue  #: Chance of such a comparison where nothing is missing.

    @property
    def something_is_missing(self) -> bool:
        """Whether chance does not explain the comparison, and anything else explains it better."""
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


def compared(
    fitted: Fit,
    effects: Iterable[Effect],
    first: Fit | None = None,
    expected: Expected | None = None,
    told: Told = untold,
) -> Step:
    """Return a comparison of all effects beside a fitted model.

    `first`: The model with which a diagnosis began, where effects have been added on trial since.
    `expected`: What earlier tests say, sizes in units of σ.
    """
    design, deviation = fitted.design, fitted.open_deviation
    entered = effects_to_try(fitted.model, design, effects)
    is_linear = all(len(theta) == 0 for theta in fitted.solution.thetas)
    least_visible = _LEAST_VISIBLE if is_linear else _LEAST_VISIBLE_LATER
    comparison = Comparison.of(
        design, fitted.base(), entered.forms, fitted.noise.weights, least_visible=least_visible
    )
    if expected is not None:
        comparison = comparison.expecting(expected)
    space = comparison.space
    known = known_noise(fitted, first or fitted)
    ratios, variance = restricted_estimate(
        space,
        space.of(deviation),
        comparison.grid,
        comparison.grid.max(axis=0, initial=0.0),
        space.degrees * known**2,
    )
    by_source = {part.source: float(ratio) for part, ratio in zip(space.parts, ratios, strict=True)}
    # What earlier tests say is no single φ: each simulated test then has one of its own.
    posterior = None if expected is None else comparison.posterior(deviation, known)
    null = simulate_null(comparison, design, ratios, posterior, told)
    scores = comparison.scores(deviation[:, np.newaxis], known)
    evidence = evidence_of(comparison, design, deviation, least_visible, known)
    sigma = float(np.sqrt(variance))
    # The comparison itself is not kept: of a large test, two of them would fill the memory.
    return Step(
        fitted,
        visibility(comparison, design, null, ratios, sigma),
        Noise(sigma, by_source, fitted.noise.weights),
        _possible(fitted, rank(comparison, design, scores, evidence, null)),
        null.p_value(scores),
    )


def is_impossible(after: Fit, identifier: str) -> bool:
    """Whether an effect of a fitted model has a value that lies outside its plausible range beyond doubt."""
    counted = after.design.time_is_counted
    return any(
        each.plausibility(time_is_counted=counted) is Plausibility.IMPLAUSIBLE
        for each in after.estimates
        if each.effect == identifier
    )


def _possible(fitted: Fit, ranking: Ranking) -> Ranking:
    """Return a ranking that is led by no effect that is physically impossible or not needed.

    An effect has no evidence outside its plausible range, whatever it explains there. Only what may lead is
    fitted for this.
    """
    impossible, unneeded = [], []
    most = -np.inf
    for each in ranking.effects:
        if each.evidence <= 0 or each.evidence < most - MENTION:
            break
        after = add(fitted, each)
        if is_impossible(after, each.identifier):
            impossible.append(each)
        elif _is_unneeded(after, each):
            unneeded.append(each)
        else:
            most = max(most, each.evidence)
    return ranking.without(fitted.design, [*impossible, *unneeded], impossible)


def _is_unneeded(after: Fit, ranked: Ranked) -> bool:
    """Whether all coefficients that an effect adds lie within their uncertainty: a needless polynomial."""
    effect = ranked.effect
    if len(effect.grid(after.design)) > 1:
        return False
    added = {parameter.name for parameter in effect.linear[len(effect.contains) :]}
    return all(
        abs(each.value) < each.expanded_uncertainty
        for each in after.estimates
        if each.effect == ranked.identifier and each.parameter.name in added
    )


def known_noise(fitted: Fit, first: Fit) -> float:
    """Return the standard deviation of what repeats do not show and no effect is asked to explain, m or rad.

    Repeats share the rounding of the instrument, and no equation of a machine is exact: the wave of a screw
    is no pure sine. On a quiet machine both stand far above the scatter, and any irregular shape would
    surpass the cause that explains all but a hundredth. They are doubled, as irregular shares of the noise
    may have half the size of all of it (`noise`).
    """
    unit = first.design.axis.deviation_unit
    rounding = unit.to_si(resolution(unit.from_si(first.deviation))) / 12**0.5
    inexact = _INEXACT_MISFIT * float(np.std(first.residual)), _INEXACT_MODEL * float(np.std(fitted.fitted))
    return 2.0 * float(np.hypot(rounding, np.hypot(*inexact)))


def add(fitted: Fit, found: Ranked) -> Fit:
    """Return the fit of the model with an effect that a comparison found."""
    model = fitted.model.with_effect(found.effect)
    before = dict(zip(fitted.model.identifiers, fitted.solution.thetas, strict=True))
    start: Thetas = tuple(
        found.theta if term.effect.identifier == found.identifier else before[term.effect.identifier]
        for term in model.terms
    )
    assumptions = replace(fitted.assumptions, weights=fitted.noise.weights)
    return fit(model, fitted.design, fitted.deviation, assumptions, start)


def steps(
    first: Fit, effects: Sequence[Effect], expected: Expected | None = None, told: Told = untold
) -> tuple[Step, ...]:
    """Return the comparison beside a model and, as long as something is missing and has a name, the next.

    How many there will be nobody knows: each is told as half of what is left.
    """
    relative = expected.in_units_of(first.noise.sigma) if expected else None
    found: list[Step] = []

    def step(share: float) -> None:
        told(1.0 - 0.5 ** len(found) * (1.0 - 0.5 * share))

    found.append(compared(first, effects, None, relative, step))
    while len(found) <= _MOST_STEPS:
        last = found[-1]
        if not last.something_is_missing or last.best is None:
            break
        found.append(compared(add(last.fit, last.best), effects, first, relative, step))
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


def equals_of(ranked: Ranked, ranking: Ranking) -> tuple[Ranked, ...]:
    """Return the other leaders, if an effect is one of them: they explain the readings as well."""
    others = tuple(each for each in ranking.leaders if each is not ranked)
    return others if len(others) < len(ranking.leaders) else ()


def discriminate_by(ranked: Ranked, equals: Sequence[Ranked]) -> Words | None:
    """Return the measurements that would tell an effect from its equals, as the effects' pages name them."""
    found: dict[str, Words] = {}
    for other in equals:
        words = _told_apart(ranked, other) or _told_apart(other, ranked)
        if words is not None:
            found.setdefault(other.identifier, words)
    if not found:
        return None
    phrases = list({words.en: words for words in found.values()}.values())
    together = phrases[0]
    for words in phrases[1:]:
        together = _AND.given(first=together, second=words)
    return together


def _told_apart(one: Ranked, other: Ranked) -> Words | None:
    for confusion in one.effect.confusions:
        if confusion.effect == other.identifier:
            return confusion.told_apart_by
    return None
