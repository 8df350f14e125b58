"""The uncertainty budget of a measuring set-up."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from zlmreport.language import Words
from zlmreport.quantities.arrays import FloatArray
from zlmreport.uncertainty.contribution import Acts, Contribution

#: Probability that intervals y ± U hold the true value: 2 standard deviations of a normal distribution
#: (JCGM 100, 6.2.2 and table G.1).
COVERAGE_PROBABILITY = 0.9545
#: Of the mean deviations by position, whose errors are sums of many.
COVERAGE_FACTOR = 2.0


@dataclass(frozen=True, slots=True)
class Budget:
    """The contributions of a measuring set-up.

    Attributes
    ----------
    contributions
        Those that were taken, at least one; those that act alike stand together.
    not_considered
        Usual contributions of which the job states nothing, in words.
    """

    contributions: tuple[Contribution, ...]
    not_considered: tuple[Words, ...] = ()

    def acting(self, acts: Acts) -> tuple[Contribution, ...]:
        """Return the contributions that act in one way."""
        return tuple(each for each in self.contributions if each.acts is acts)

    def variance(self, acts: Acts) -> float:
        """Return the sum of u² of the contributions that act in one way, m² or rad²."""
        return math.fsum(each.standard_uncertainty**2 for each in self.acting(acts))

    @property
    def standard_uncertainty(self) -> float:
        """The combined u of a single reading at the end of the measured length, m or rad."""
        return math.sqrt(math.fsum(map(self.variance, Acts)))

    def share(self, contribution: Contribution) -> float:
        """Return the share of a contribution in the variance of such a reading, from 0 to 1."""
        combined = self.standard_uncertainty
        return (contribution.standard_uncertainty / combined) ** 2 if combined else 0.0


@dataclass(frozen=True, slots=True)
class NoBudget:
    """What stands in the place of a budget that cannot be made, and why it cannot, in words."""

    reason: Words


def effect_along(target_positions: FloatArray) -> FloatArray:
    """Return what part of an error along the length acts at each target position, shape (m,).

    Nothing at the datum, which is the first target position; all of it at the last one.
    """
    distance = target_positions - target_positions[0]
    length = float(distance[-1])
    return np.asarray(distance / length) if length else distance
