"""From scores to names: the order of the effects, their probabilities, and which cannot be told apart."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from zlmreport.language import Words
from zlmreport.model.calibration import Calibration, PValue
from zlmreport.model.contest import Contest, Scores
from zlmreport.model.design import Design
from zlmreport.model.effect import Effect
from zlmreport.model.evidence import Evidence
from zlmreport.quantities.arrays import FloatArray

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
#: Two effects with the same columns differ by rounding only.
_ALIKE = 1e-6


@dataclass(frozen=True, slots=True)
class Ranked:
    """An effect in the order of the contest.

    Attributes
    ----------
    effect
        In the form that fits best.
    theta : (s,) array
        Its searched parameters, near their best values.
    ratio
        Its likelihood ratio LR.
    usual
        The 95 % point of LR where nothing is missing.
    evidence
        2·ln of its Bayes factor against the model alone.
    probability
        Among all effects, rivals and no effect, if each was as likely before the test.
    p_value
        Of its likelihood ratio, its own search allowed for.
    """

    effect: Effect
    theta: FloatArray
    ratio: float
    usual: float
    evidence: float
    probability: float
    p_value: PValue

    @property
    def identifier(self) -> str:
        """As jobs name it."""
        return self.effect.identifier


@dataclass(frozen=True, slots=True)
class Ranking:
    """The outcome of a contest.

    Attributes
    ----------
    effects
        The plainest of those that explain the readings best; then the others, best first.
    shape
        The best shape without a name; None where there is none.
    shape_evidence
        Its evidence.
    """

    effects: tuple[Ranked, ...]
    shape: Words | None
    shape_evidence: float

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
    contest: Contest, design: Design, scores: Scores, evidence: Evidence, calibration: Calibration
) -> Ranking:
    """Return the order of the effects."""
    together = np.concatenate([[0.0], evidence.effects, evidence.rivals])
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
                float(calibration.usual[index]),
                float(evidence.effects[index]),
                float(shares[1 + index]),
                calibration.p_value_of_effect(index, ratio),
            )
        )
    # Of effects with the same columns the more general one leads: one whose sign is free.
    found.sort(key=lambda each: (-round(each.evidence / _ALIKE), _is_one_sided(each.effect), each.identifier))
    foremost = [each for each in found if each.evidence > found[0].evidence - MENTION]
    plainest = min(foremost, key=lambda each: _assumptions(each.effect, design), default=None)
    found.sort(key=lambda each: each is not plainest)
    shape, of_shape = _best_shape(contest, evidence)
    return Ranking(tuple(found), shape, of_shape)


def _assumptions(effect: Effect, design: Design) -> int:
    """Return how much an effect takes for granted: a log that it follows, parameters that are searched.

    A constant is a constant before it is the dead path of a beam in air that hardly changes.
    """
    follows_a_log = effect.untestable(replace(design, conditions={})) is not None
    searched = len(effect.searched) if len(effect.grid(design)) > 1 else 0
    return searched + follows_a_log


def _is_one_sided(effect: Effect) -> bool:
    return any(each.smallest == 0 or each.largest == 0 for each in effect.linear)


def _best_shape(contest: Contest, evidence: Evidence) -> tuple[Words | None, float]:
    """Return the leading shape without a name, the evidence of its lengths averaged."""
    by_shape: dict[str, list[float]] = {}
    for rival, value in zip(contest.rivals, evidence.rivals.tolist(), strict=True):
        by_shape.setdefault(rival.shape.en, []).append(value)
    averages = {}
    for shape, values in by_shape.items():
        most = max(values)
        averages[shape] = most + 2.0 * float(np.log(np.mean(np.exp(0.5 * (np.array(values) - most)))))
    if not averages:
        return None, -np.inf
    best = max(averages, key=averages.__getitem__)
    return next(rival.shape for rival in contest.rivals if rival.shape.en == best), averages[best]
