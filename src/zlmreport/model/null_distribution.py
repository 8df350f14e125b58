"""What chance alone would give: the comparison made on simulated tests of the same plan, model and noise.

Every searched parameter gives chance one more opportunity, so plain tests and criteria raise false alarms.
Here the whole search is repeated on deviations that hold nothing but the noise that restricted likelihood
found in the job's own readings. Base model and σ drop out of the likelihood ratios; so one null distribution
serves every test of the same plan, model and φ̂.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

import numpy as np

from zlmreport.model.comparison import Comparison, Scores, Told, untold
from zlmreport.model.design import Design
from zlmreport.model.distributions import gamma_tail
from zlmreport.quantities.arrays import FloatArray

#: Simulated tests.
TRIALS = 400
#: Chance of a false alarm: over all that are compared together, and over all tests of residuals together.
LEVEL = 0.05


@dataclass(frozen=True, slots=True)
class PValue:
    """The chance of a value so large where nothing is missing."""

    value: float  #: Counted among the simulated tests, or extrapolated beyond them.
    #: Whether it is less than the simulated tests can show, and comes from a gamma tail fitted to them.
    is_extrapolated: bool


@dataclass(frozen=True, slots=True)
class NullDistribution:
    """The comparison where nothing is missing."""

    ratios: FloatArray  #: (effects, B): LR of each effect in each simulated test.
    nameless_ratios: FloatArray  #: (nameless, B): The same of the nameless shapes.
    #: usual and usual_of_nameless: (effects,), (nameless,): q, the 95 % points: what each candidate reaches
    #: by its own search.
    usual: FloatArray
    usual_of_nameless: FloatArray
    threshold: float  #: T, the 95 % point of the largest excess over these, of all by_effect.

    def excess(self, scores: Scores) -> FloatArray:
        """Return M, the largest excess of any candidate over what it usually reaches, shape (B,)."""
        together = np.concatenate(
            [
                scores.ratios - self.usual[:, np.newaxis],
                scores.nameless_ratios - self.usual_of_nameless[:, np.newaxis],
            ]
        )
        return np.asarray(together.max(axis=0, initial=-np.inf), dtype=np.float64)

    def p_value(self, scores: Scores) -> PValue:
        """Return the chance of such an excess of any candidate: that of a false alarm."""
        excess = float(self.excess(scores)[0])
        return _p_value(excess, self.excess(Scores(self.ratios, self.nameless_ratios)))

    def p_value_of_effect(self, index: int, ratio: float) -> PValue:
        """Return the chance of such a likelihood ratio of one effect, its own search allowed for."""
        return _p_value(ratio, self.ratios[index])


def simulate_null(
    comparison: Comparison,
    design: Design,
    ratios: FloatArray,
    posterior: FloatArray | None = None,
    told: Told = untold,
) -> NullDistribution:
    """Make the comparison on simulated tests without any effect.

    `design`: The test; its content alone seeds the simulation: the same test gives the same digits.
    `ratios`, (parts,): φ̂.
    `posterior`, (f,) array or None: Probability of each φ of the comparison's grid, where it is to be
        averaged over instead.
    """
    scores = comparison.scores(_simulated(comparison, design, ratios, posterior), told=told)
    usual = np.quantile(scores.ratios, 1 - LEVEL, axis=1)
    usual_of_nameless = np.quantile(scores.nameless_ratios, 1 - LEVEL, axis=1)
    blank = NullDistribution(scores.ratios, scores.nameless_ratios, usual, usual_of_nameless, np.inf)
    threshold = float(np.quantile(blank.excess(scores), 1 - LEVEL))
    return NullDistribution(scores.ratios, scores.nameless_ratios, usual, usual_of_nameless, threshold)


def _simulated(
    comparison: Comparison, design: Design, ratios: FloatArray, posterior: FloatArray | None
) -> FloatArray:
    """Return simulated deviations of unit σ, shape (N, B)."""
    content = hashlib.sha256()
    for array in (design.position, design.direction, design.run, design.time, ratios):
        content.update(np.ascontiguousarray(array).tobytes())
    random = np.random.default_rng(int.from_bytes(content.digest()[:16], "big"))
    space, of_each = comparison.space, np.tile(ratios, (TRIALS, 1))
    if posterior is not None:
        of_each = comparison.grid[random.choice(len(posterior), TRIALS, p=posterior)]
    found = random.standard_normal((len(design.position), TRIALS)) / space.scale[:, np.newaxis]
    for part, ratio in zip(space.parts, of_each.T, strict=True):
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
