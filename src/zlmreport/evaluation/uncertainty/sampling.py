"""Random errors of contributions drawn: one for a whole test, or one for each of its readings."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import lru_cache
from statistics import NormalDist

import numpy as np

from zlmreport.evaluation.uncertainty.budget import Contribution, Distribution
from zlmreport.measurement.arrays import FloatArray, read_only_floats


def sample_stratified(
    contributions: Sequence[Contribution], count: int, generator: np.random.Generator
) -> FloatArray:
    """Return sums of one error of each contribution, spread evenly over the distributions, shape (count,).

    Each contribution takes the middles of `count` equally probable parts of its distribution once each, in
    an order of its own (Latin hypercube): the tails are as full as they should be, and not as chance has it.
    """
    total = np.zeros(count)
    for distribution, standard_uncertainty in _combine_distributions(contributions):
        total += standard_uncertainty * generator.permutation(_compute_middles(distribution, count))
    return total


def sample_singly(
    contributions: Sequence[Contribution], shape: tuple[int, ...], generator: np.random.Generator
) -> FloatArray:
    """Return sums of one error of each contribution, each element drawn for itself, m or rad."""
    total, errors = np.empty(shape), np.empty(shape)
    draw_singly(contributions, total, errors, generator)
    return total


def draw_singly(
    contributions: Sequence[Contribution],
    total: FloatArray,
    errors: FloatArray,
    generator: np.random.Generator,
) -> None:
    """Fill an array with such sums; `errors`, of the same shape, is where those of one are drawn."""
    total.fill(0.0)
    for distribution, standard_uncertainty in _combine_distributions(contributions):
        if distribution is Distribution.NORMAL:
            drawn = generator.standard_normal(out=errors)
        else:
            drawn = _compute_quantiles(distribution, generator.random(out=errors))
        drawn *= standard_uncertainty
        total += drawn


def _combine_distributions(contributions: Sequence[Contribution]) -> Iterator[tuple[Distribution, float]]:
    """Yield distributions with their standard uncertainties; the sum of normal ones is normal."""
    normal = [each for each in contributions if each.distribution is Distribution.NORMAL]
    if normal:
        yield Distribution.NORMAL, math.sqrt(math.fsum(each.standard_uncertainty**2 for each in normal))
    for each in contributions:
        if each.distribution is not Distribution.NORMAL:
            yield each.distribution, each.standard_uncertainty


@lru_cache(maxsize=16)
def _compute_middles(distribution: Distribution, count: int) -> FloatArray:
    """Return the middles of so many equally probable parts; kept, for each simulation asks for them."""
    return read_only_floats(_compute_quantiles(distribution, (np.arange(count) + 0.5) / count))


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
