"""What has no name beside a set, as parts of a covariance: noise and random curves, and their amplitudes.

Beside every set of named effects something may act that nobody knows. It is no polynomial that swallows what
has a name, but a random curve: its many coefficients are not fitted but averaged over, and only its amplitude
is chosen, with a few correlation lengths (C. E. Rasmussen and C. K. I. Williams, Gaussian Processes for
Machine Learning, 2006, chapter 2). Small amplitudes of irregular shares are noise, which costs little; what
is larger has to earn its place like an effect.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.model.diagnosis.columns import Columns
from zlmreport.model.diagnosis.random_curves import PRICE, Course, list_random_curves
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.noise import BY_TARGET, NoisePart, NoiseSource
from zlmreport.model.fitting.priors import PriorExpectation

#: Variances that are tried of a random curve, in units of σ²: from hidden in the scatter to far above it.
_VARIANCES = (0.02, 0.1, 0.5, 2.5, 12.0, 60.0, 300.0, 1500.0, 1e4, 1e5, 1e6)
#: The same of irregular shares, beyond those that are noise; what drifts without being smooth stays noise.
_IRREGULAR = (0.25, 1.0, 5.0, 25.0, 125.0, 1e3, 1e4, 1e5)
#: 2·ln of the odds against an axis that is irregular from position to position beyond noise. That is the rule
#: rather than the exception, and of many names one or two pass through a few targets by chance.
_PRICE_OF_GEOMETRY = 5.0
#: Variances beyond which a curve is large, and the odds against that: those of an effect that is as large.
_LARGE = ((30.0, 18.0), (3000.0, 30.0))
#: By how much each level of a shared noise is rarer than the one below it, 2·ln of the odds.
_RARER = 1.0
_LEAST_VISIBLE = 1e-3


@dataclass(frozen=True, slots=True)
class CovariancePart:
    """A part of the covariance, with the amplitudes that are tried of it."""

    shape: Words  #: In words.
    course: Course
    #: (k,) integer: The places of its columns, whose random combination it is, of mean variance one; empty
    #: for a part that is irregular from position to position, which stands apart.
    columns: IntArray
    #: Which of the irregular factors it is; None of other parts.
    irregular: int | None
    levels: tuple[float, ...]  #: Its variances over σ² that are tried, rising from zero.
    costs: tuple[float, ...]  #: −2 ln of the prior odds of each level.
    noise_levels: int  #: How many of the levels are noise.
    source: NoiseSource | None = None  #: The source of noise that it is at these.

    @property
    def width(self) -> int:
        """The number of its columns beside the irregular ones."""
        return len(self.columns)


def list_parts_of(
    design: Design,
    columns: Columns,
    noise: tuple[NoisePart, ...],
    expected: PriorExpectation,
    *,
    with_nameless: bool,
) -> tuple[CovariancePart, ...]:
    """Return the parts of the covariance that the plan can see beside the model; their columns are added.

    `noise`: The sources of noise; those by position are the irregular factors of the table, in their order.
    `expected`: What earlier tests say of their amplitudes.
    `with_nameless`: Whether anything else than noise is thought of.
    """
    found = []
    nowhere = columns.add(np.empty((len(design.position), 0)))
    irregular = 0
    for each in noise:
        is_irregular = each.source in BY_TARGET
        contrasts = columns.space.of(each.factor)
        places = nowhere if is_irregular else columns.add(contrasts)
        may_be_more = with_nameless and each.source is not NoiseSource.TIME
        further = tuple(level for level in _IRREGULAR if may_be_more and level > each.ratios[-1])
        free = _compute_noise_costs(each, expected)
        prices = tuple(
            # Large geometry is the rule; runs that are all displaced by much are as rare as a large effect.
            _PRICE_OF_GEOMETRY if is_irregular else PRICE + _compute_cost_of_size(level)
            for level in further
        )
        found.append(
            CovariancePart(
                _WORDS[each.source],
                _COURSES[each.source],
                places,
                irregular if is_irregular else None,
                (*each.ratios, *further),
                (*free, *(price + free[-1] for price in prices)),
                len(each.ratios),
                each.source,
            )
        )
        irregular += is_irregular
    for curve in list_random_curves(design) if with_nameless else ():
        contrasts = columns.space.of(curve.features)
        size = float(np.sqrt(np.mean(np.sum(contrasts**2, axis=1))))
        if size > _LEAST_VISIBLE * np.sqrt(np.mean(np.sum(curve.features**2, axis=1))):
            costs = (0.0, *(curve.price + _compute_cost_of_size(level) for level in _VARIANCES))
            places = columns.add(contrasts / size)
            levels = (0.0, *_VARIANCES)
            found.append(CovariancePart(curve.shape, curve.course, places, None, levels, costs, 1))
    return tuple(found)


def _compute_cost_of_size(variance: float) -> float:
    """Return what it costs a curve that it is large, 2·ln of the odds."""
    return 2.0 * float(np.log(max((odds for least, odds in _LARGE if variance > least), default=1.0)))


def _compute_noise_costs(noise: NoisePart, expected: PriorExpectation) -> tuple[float, ...]:
    """Return what each ratio of a source of noise costs.

    No axis is the same at two positions, and that is free. That readings which are taken together share
    something besides is the rarer the larger it is: else it would follow whatever a curve without a name
    leaves of a cause.
    """
    costs = expected.compute_costs(noise.source, noise.ratios)
    if noise.source is NoiseSource.POSITION or noise.source in expected.ratios:
        return costs
    return tuple(cost + _RARER * level for level, cost in enumerate(costs))


def make_irregular_factors(noise: tuple[NoisePart, ...]) -> list[FloatArray]:
    """Return the factors of what is irregular from position to position."""
    return [each.factor for each in noise if each.source in BY_TARGET]


_COURSES: Mapping[NoiseSource, Course] = {
    NoiseSource.POSITION: Course.IRREGULAR,
    NoiseSource.DIRECTION: Course.IRREGULAR_REVERSAL,
    NoiseSource.RUN: Course.RUNS,
    NoiseSource.TIME: Course.TIME,
}
SLOW_DRIFT = Words("slow irregular drift")
_WORDS: Mapping[NoiseSource, Words] = {
    NoiseSource.POSITION: Words("irregular from position to position, alike in all runs"),
    NoiseSource.DIRECTION: Words("irregular from position to position, opposite up and down"),
    NoiseSource.RUN: Words("every run displaced as a whole"),
    NoiseSource.TIME: SLOW_DRIFT,
}
