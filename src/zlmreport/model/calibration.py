"""What chance alone would give: the contest held on simulated tests of the same plan, model and noise.

Every searched parameter gives chance one more opportunity, so plain tests and criteria raise false alarms.
Here the whole search is repeated on deviations that hold nothing but the noise that restricted likelihood
found in the job's own readings. Base model and σ drop out of the likelihood ratios; so one calibration serves
every test of the same plan, model and φ̂.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

import numpy as np

from zlmreport.model.contest import Contest, Scores
from zlmreport.model.design import Design
from zlmreport.model.distributions import gamma_tail
from zlmreport.quantities.arrays import FloatArray

#: Simulated tests.
TRIALS = 400
#: Chance of a false alarm, over all contestants together.
LEVEL = 0.05


@dataclass(frozen=True, slots=True)
class PValue:
    """The chance of a value so large where nothing is missing.

    Attributes
    ----------
    value
        Counted among the simulated tests, or extrapolated beyond them.
    is_extrapolated
        Whether it is less than the simulated tests can show, and comes from a gamma tail fitted to them.
    """

    value: float
    is_extrapolated: bool


@dataclass(frozen=True, slots=True)
class Calibration:
    """The contest where nothing is missing.

    Attributes
    ----------
    ratios : (effects, B) array
        LR of each effect in each simulated test.
    rival_ratios : (rivals, B) array
        The same of the rivals.
    usual, usual_of_rivals : (effects,), (rivals,) arrays
        q, the 95 % points: what each contestant reaches by its own search.
    threshold
        T, the 95 % point of the largest excess over these, of all contestants.
    """

    ratios: FloatArray
    rival_ratios: FloatArray
    usual: FloatArray
    usual_of_rivals: FloatArray
    threshold: float

    def excess(self, scores: Scores) -> FloatArray:
        """Return M, the largest excess of any contestant over what it usually reaches, shape (B,)."""
        together = np.concatenate(
            [
                scores.ratios - self.usual[:, np.newaxis],
                scores.rival_ratios - self.usual_of_rivals[:, np.newaxis],
            ]
        )
        return np.asarray(together.max(axis=0, initial=-np.inf), dtype=np.float64)

    def p_value(self, scores: Scores) -> PValue:
        """Return the chance of such an excess of any contestant: that of a false alarm."""
        excess = float(self.excess(scores)[0])
        return _p_value(excess, self.excess(Scores(self.ratios, self.rival_ratios)))

    def p_value_of_effect(self, index: int, ratio: float) -> PValue:
        """Return the chance of such a likelihood ratio of one effect, its own search allowed for."""
        return _p_value(ratio, self.ratios[index])


def calibrate(contest: Contest, design: Design, ratios: FloatArray) -> Calibration:
    """Hold the contest on simulated tests without any effect.

    Parameters
    ----------
    contest
        The contest.
    design
        The test; its content alone seeds the simulation: the same test gives the same digits.
    ratios : (parts,) array
        φ̂.
    """
    scores = contest.scores(_simulated(contest, design, ratios))
    usual = np.quantile(scores.ratios, 1 - LEVEL, axis=1)
    usual_of_rivals = np.quantile(scores.rival_ratios, 1 - LEVEL, axis=1)
    blank = Calibration(scores.ratios, scores.rival_ratios, usual, usual_of_rivals, np.inf)
    threshold = float(np.quantile(blank.excess(scores), 1 - LEVEL))
    return Calibration(scores.ratios, scores.rival_ratios, usual, usual_of_rivals, threshold)


def _simulated(contest: Contest, design: Design, ratios: FloatArray) -> FloatArray:
    """Return simulated deviations of unit σ, shape (N, B)."""
    content = hashlib.sha256()
    for array in (design.position, design.direction, design.run, design.time, ratios):
        content.update(np.ascontiguousarray(array).tobytes())
    random = np.random.default_rng(int.from_bytes(content.digest()[:16], "big"))
    space = contest.space
    found = random.standard_normal((len(design.position), TRIALS)) / space.scale[:, np.newaxis]
    for part, ratio in zip(space.parts, ratios, strict=True):
        shared = random.standard_normal((part.factor.shape[1], TRIALS))
        found += part.factor @ (np.sqrt(ratio) * shared)
    return found


def _p_value(value: float, simulated: FloatArray) -> PValue:
    trials = len(simulated)
    reached = int(np.count_nonzero(simulated >= value))
    if reached:
        return PValue((1 + reached) / (trials + 1), is_extrapolated=False)
    least = 1 / (trials + 1)
    lowest = min(0.0, float(simulated.min()))
    mean, variance = float(simulated.mean()) - lowest, float(simulated.var())
    if variance == 0 or mean <= 0:
        return PValue(least, is_extrapolated=False)
    tail = gamma_tail(mean**2 / variance, (value - lowest) * mean / variance)
    return PValue(min(least, tail), is_extrapolated=True)
