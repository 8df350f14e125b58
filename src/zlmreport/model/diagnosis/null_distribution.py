"""p-values of a diagnosis: the chance of a false alarm, all searches together, by simulated tests.

Every searched parameter gives chance one more opportunity, so plain tests and criteria raise false alarms.
Here every family is tried on deviations that hold nothing but a set of effects, and beside it the amplitudes
that restricted likelihood found in the job's own readings. The model and σ drop out of the likelihood ratios;
so one null distribution serves every test of the same plan, model and φ̂.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.likelihood import Amplitudes
from zlmreport.model.diagnosis.trials import Trials
from zlmreport.model.fitting.distributions import gamma_tail

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
class Scores:
    """How effects and what has no name did on B sets of deviations."""

    ratios: FloatArray  #: (effects, B): LR of each effect, in its best form.
    nameless_ratios: FloatArray  #: (nameless, B): LR of each nameless shape, its coefficients averaged over.


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

    def compute_excess(self, scores: Scores) -> FloatArray:
        """Return M, the largest excess of any candidate over what it usually reaches, shape (B,)."""
        together = np.concatenate(
            [
                scores.ratios - self.usual[:, np.newaxis],
                scores.nameless_ratios - self.usual_of_nameless[:, np.newaxis],
            ]
        )
        return np.asarray(together.max(axis=0, initial=-np.inf), dtype=np.float64)

    def compute_p_value(self, scores: Scores) -> PValue:
        """Return the chance of such an excess of any candidate: that of a false alarm."""
        excess = float(self.compute_excess(scores)[0])
        return _compute_p_value(excess, self.compute_excess(Scores(self.ratios, self.nameless_ratios)))

    def compute_p_value_of_effect(self, index: int, ratio: float) -> PValue:
        """Return the chance of such a likelihood ratio of one effect, its own search allowed for."""
        return _compute_p_value(ratio, self.ratios[index])


def simulate_null(
    contest: Contest, amplitudes: Amplitudes, members: Sequence[IntArray] = ()
) -> NullDistribution:
    """Make a contest on simulated tests that hold nothing but a set and what has no name beside it.

    `amplitudes`: Those of all parts; the simulated readings have the same.
    `members`: Columns of the set.
    """
    trials = Trials(contest, amplitudes, members, _simulate(contest, amplitudes))
    usual = np.quantile(trials.ratios, 1 - LEVEL, axis=1)
    usual_of_nameless = np.quantile(trials.nameless, 1 - LEVEL, axis=1)
    blank = NullDistribution(trials.ratios, trials.nameless, usual, usual_of_nameless, np.inf)
    threshold = float(np.quantile(blank.compute_excess(Scores(trials.ratios, trials.nameless)), 1 - LEVEL))
    return NullDistribution(trials.ratios, trials.nameless, usual, usual_of_nameless, threshold)


def compute_chances_of(
    contest: Contest, amplitudes: Amplitudes, members: Sequence[IntArray], effects: Iterable[str]
) -> dict[str, PValue]:
    """Return the chance of the likelihood ratio of each of some effects beside a set, its search allowed for.

    `amplitudes`, `members`: As for `simulate_null`.
    """
    asked = frozenset(effects)
    names = [each for each in contest.identifiers if each in asked]
    deviations = np.column_stack([contest.deviation, _simulate(contest, amplitudes)])
    ratios = Trials(contest, amplitudes, members, deviations).compute_ratios_of(names)
    return {name: _compute_p_value(float(own[0]), own[1:]) for name, own in zip(names, ratios, strict=True)}


def _simulate(contest: Contest, amplitudes: Amplitudes) -> FloatArray:
    """Return simulated deviations of unit σ, shape (N, B).

    The content of the test alone seeds them: the same test gives the same digits.
    """
    design, space = contest.design, contest.space
    content = hashlib.sha256()
    for array in (design.position, design.direction, design.run, design.time, np.array(amplitudes)):
        content.update(np.ascontiguousarray(array).tobytes())
    random = np.random.default_rng(int.from_bytes(content.digest()[:16], "big"))
    found = space.single.undo_whitening(random.standard_normal((len(design.position), TRIALS)))
    for factor in contest.list_factors(amplitudes):
        found += factor @ random.standard_normal((factor.shape[1], TRIALS))
    return found


def _compute_p_value(value: float, simulated: FloatArray) -> PValue:
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
