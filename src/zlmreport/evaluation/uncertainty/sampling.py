"""Random errors of contributions drawn: one for a whole test, or one for each of its readings."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from statistics import NormalDist

import numpy as np

from zlmreport.evaluation.uncertainty.budget import Contribution, Distribution
from zlmreport.measurement.arrays import FloatArray


def sample_stratified(
    contributions: Sequence[Contribution], count: int, generator: np.random.Generator
) -> FloatArray:
    """Return sums of one error of each contribution, spread evenly over the distributions, shape (count,).

    Each contribution takes the middles of `count` equally probable parts of its distribution once each, in
    an order of its own (Latin hypercube): the tails are as full as they should be, and not as chance has it.
    """
    middles = (np.arange(count) + 0.5) / count
    total = np.zeros(count)
    for distribution, standard_uncertainty in _combine_distributions(contributions):
        total += standard_uncertainty * generator.permutation(_compute_quantiles(distribution, middles))
    return total


def sample_singly(
    contributions: Sequence[Contribution], shape: tuple[int, ...], generator: np.random.Generator
) -> FloatArray:
    """Return sums of one error of each contribution, each element drawn for itself, m or rad."""
    total = np.zeros(shape)
    for distribution, standard_uncertainty in _combine_distributions(contributions):
        if distribution is Distribution.NORMAL:
            errors = generator.standard_normal(shape)
        else:
            errors = _compute_quantiles(distribution, generator.random(shape))
        errors *= standard_uncertainty
        total += errors
    return total


def _combine_distributions(contributions: Sequence[Contribution]) -> Iterator[tuple[Distribution, float]]:
    """Yield distributions with their standard uncertainties; the sum of normal ones is normal."""
    normal = [each for each in contributions if each.distribution is Distribution.NORMAL]
    if normal:
        yield Distribution.NORMAL, math.sqrt(math.fsum(each.standard_uncertainty**2 for each in normal))
    for each in contributions:
        if each.distribution is not Distribution.NORMAL:
            yield each.distribution, each.standard_uncertainty


def _compute_quantiles(distribution: Distribution, probability: FloatArray) -> FloatArray:
    """Return the quantiles of a distribution whose root mean square is 1."""
    full_range = distribution.range_over_standard_uncertainty
    if distribution is Distribution.NORMAL:
        return np.array(list(map(NormalDist().inv_cdf, probability.tolist())))
    if distribution is Distribution.ONE_SIDED:
        return probability * full_range
    if distribution is Distribution.RECTANGULAR:
        return (probability - 0.5) * full_range
    tail = np.sqrt(np.minimum(probability, 1 - probability) / 2)
    return np.asarray(np.where(probability < 0.5, tail - 0.5, 0.5 - tail) * full_range)
