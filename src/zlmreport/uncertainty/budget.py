"""The uncertainty budget of a measuring set-up."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from zlmreport.language import Words
from zlmreport.quantities.arrays import FloatArray
from zlmreport.uncertainty.contribution import Acts, Contribution, Distribution

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
    missing
        Usual contributors of which the job states nothing, by their keys: U is then incomplete.
    negligible
        Usual contributors that the laboratory declares negligible, by their keys, each with its reason.
    of_the_instrument
        U of the measuring instrument at the measured length, m or rad, where it acts in the usual way: no
        parameter that compares positions has a smaller U (ISO/TR 230-9). 0 for no such bound.
    least
        U below which the laboratory's accreditation lets it state none (its CMC), m or rad.
    uncorrected_expansion
        By how much the measured length was longer than at 20 °C, m: it is among the contributions. None
        where nobody knows it.
    """

    contributions: tuple[Contribution, ...]
    missing: tuple[str, ...] = ()
    negligible: tuple[tuple[str, str], ...] = ()
    of_the_instrument: float = 0.0
    least: float = 0.0
    uncorrected_expansion: float | None = 0.0

    @property
    def is_complete(self) -> bool:
        """Whether every usual contributor is stated or declared negligible."""
        return not self.missing

    def acting(self, acts: Acts) -> tuple[Contribution, ...]:
        """Return the contributions that act in one way."""
        return tuple(each for each in self.contributions if each.acts is acts)

    def variance(self, acts: Acts) -> float:
        """Return the sum of u² of the contributions that act in one way, m² or rad²; known errors apart."""
        return math.fsum(
            each.standard_uncertainty**2
            for each in self.acting(acts)
            if each.distribution is not Distribution.KNOWN
        )

    def known(self, acts: Acts) -> float:
        """Return the sum of the known errors that act in one way, m or rad, with its sign."""
        known = (each for each in self.acting(acts) if each.distribution is Distribution.KNOWN)
        return math.fsum(each.sign * each.standard_uncertainty for each in known)

    @property
    def standard_uncertainty(self) -> float:
        """The combined u of a single reading at the end of the measured length, m or rad."""
        return math.sqrt(math.fsum(each.standard_uncertainty**2 for each in self.contributions))

    def share(self, contribution: Contribution) -> float:
        """Return the share of a contribution in the variance of such a reading, from 0 to 1."""
        combined = self.standard_uncertainty
        return (contribution.standard_uncertainty / combined) ** 2 if combined else 0.0


@dataclass(frozen=True, slots=True)
class NoBudget:
    """What stands in the place of a budget that cannot be made.

    Attributes
    ----------
    reason
        Why it cannot, in words.
    missing, negligible, uncorrected_expansion
        As in `Budget`.
    """

    reason: Words
    missing: tuple[str, ...] = ("instrument",)
    negligible: tuple[tuple[str, str], ...] = ()
    uncorrected_expansion: float | None = 0.0

    @property
    def is_complete(self) -> bool:
        """Never: nothing is known of the instrument."""
        return False


def effect_along(target_positions: FloatArray) -> FloatArray:
    """Return what part of an error along the length acts at each target position, shape (m,).

    Nothing at the datum, which is the first target position; all of it at the last one.
    """
    distance = target_positions - target_positions[0]
    length = float(distance[-1])
    return np.asarray(distance / length) if length else distance
