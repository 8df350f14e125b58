"""Variances of few readings each, as all of them together tell: each cell is informed by the others.

The variances of cells (positions in one direction) are taken as drawn from one scaled inverse χ²
distribution, whose two parameters are estimated from all of them by the moments of ln s² (G. K. Smyth, Stat.
Appl. Genet. Mol. Biol. 3, 2004, article 3): so positions that scatter alike inform each other, and those that
do not keep their own. Where the scatter grows along the axis they are pooled about its growth. A position
whose scatter stands out from all others is judged by itself, by both directions together where they scatter
alike.
"""

from __future__ import annotations

import math

import numpy as np

from zlmreport.measurement.arrays import BoolArray, FloatArray

#: Standard deviations of ln s² by which a position stands out from the others.
_STANDS_OUT = 2.2
#: Share of the positions that may stand out: were it more, they would be the rule.
_MOST_STANDING_OUT = 0.3
#: Variances of fewer positions tell nothing of how these vary.
_FEWEST = 4
#: Standard errors of a slope of ln s² along the axis from which the scatter counts as growing.
_GROWS = 3.0
#: Standard errors by which variances are taken to differ more than they seem to.
_CAUTION = 1.0
_STEP = 1e-3


def pool_variances(
    variance: FloatArray, freedom: FloatArray, positions: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the posterior variances and degrees of freedom of cells, each informed by all others.

    `variance`, `freedom`: (approach, position), m² or rad² and s² has so many degrees of freedom; NaN and 0
        where there are too few readings. `positions`: (position,), m or rad.
    """
    known = (freedom > 0) & (variance > 0)
    if np.count_nonzero(known) < _FEWEST:
        total = float(freedom.sum())
        common = float(np.nansum(variance * freedom)) / total
        return np.full_like(freedom, common), np.full_like(freedom, total)
    own = float(np.median(freedom[known]))
    chance = compute_trigamma(own / 2)
    logarithms = np.log(np.where(known, variance, 1.0)) - compute_digamma(own / 2) + math.log(own / 2)
    trend, spent = _fit_trend(logarithms, known, np.broadcast_to(positions, known.shape), chance)
    logarithms -= trend
    level = np.where(known, variance, 0.0) / np.exp(trend)
    alike = _select_alike(logarithms, known, chance)
    cells = np.count_nonzero(alike)
    observed = float(logarithms[alike].var(ddof=1))
    beyond_chance = observed * (1 + _CAUTION * math.sqrt(2 / (cells - 1))) - chance
    if beyond_chance <= _STEP:  # no more different than equal variances look
        total = float(freedom[alike].sum())
        common = float((level[alike] * freedom[alike]).sum()) / total
        pooled, pooled_freedom = np.full_like(freedom, common), np.full_like(freedom, total)
    else:
        prior = 2 * compute_inverse_trigamma(beyond_chance)
        scale = math.exp(float(logarithms[alike].mean()) + compute_digamma(prior / 2) - math.log(prior / 2))
        pooled_freedom = freedom + prior
        pooled = (level * freedom + prior * scale) / pooled_freedom
    pooled = pooled * np.exp(trend)
    pooled_freedom = _blur_freedom(pooled_freedom, spent)
    stands_out = known & ~alike
    joined, joined_freedom = _join_directions(variance, freedom, stands_out, chance)
    return np.where(stands_out, joined, pooled), np.where(stands_out, joined_freedom, pooled_freedom)


def _join_directions(
    variance: FloatArray, freedom: FloatArray, stands_out: BoolArray, chance: float
) -> tuple[FloatArray, FloatArray]:
    """Return variances and freedom of cells, joined at positions that stand out alike in both directions."""
    if len(variance) == 1:
        return variance, freedom
    with np.errstate(invalid="ignore", divide="ignore"):
        apart = np.abs(np.log(variance[0] / variance[1]))
    alike = stands_out.all(axis=0) & (apart <= _STANDS_OUT * math.sqrt(2 * chance))
    total = freedom.sum(axis=0)
    with np.errstate(invalid="ignore"):
        common = (variance * freedom).sum(axis=0) / np.maximum(total, 1)
    return np.where(alike, common, variance), np.where(alike, total, freedom)


def _fit_trend(
    logarithms: FloatArray, known: BoolArray, positions: FloatArray, chance: float
) -> tuple[FloatArray, FloatArray]:
    """Return how ln σ² grows along the axis, about its mean, and the variance of that; 0 if by chance."""
    x = positions - positions[known].mean()
    squares = float((x[known] ** 2).sum())
    nothing = np.zeros_like(logarithms)
    if not squares or np.count_nonzero(known) <= _FEWEST:
        return nothing, nothing
    slope = float((x * logarithms)[known].sum()) / squares
    left = (logarithms - slope * x)[known]
    variance = max(float(left.var(ddof=2)), chance) / squares
    if abs(slope) <= _GROWS * math.sqrt(variance):
        return nothing, nothing
    return slope * x, variance * x**2


def _blur_freedom(freedom: FloatArray, variance: FloatArray) -> FloatArray:
    """Return degrees of freedom of variances whose logarithms are known worse by a `variance`."""
    return np.array(
        [
            2 * compute_inverse_trigamma(compute_trigamma(each / 2) + more) if more else each
            for each, more in zip(freedom.ravel().tolist(), variance.ravel().tolist(), strict=True)
        ]
    ).reshape(freedom.shape)


def _select_alike(logarithms: FloatArray, known: BoolArray, chance: float) -> BoolArray:
    """Return the cells without those whose ln s² stands out from the others.

    A position is asked as a whole first: what shakes it shakes both directions, and their mean tells by two
    tests what the s of one, which may have come out small, does not.
    """
    whole = np.asarray(known.all(axis=0, keepdims=True))
    means = np.where(whole, logarithms.mean(axis=0, keepdims=True), 0.0)
    stand_out = whole & ~_drop_outstanding(means, whole, whole, chance / len(known))
    return _drop_outstanding(logarithms, known & ~stand_out, known, chance)


def _drop_outstanding(logarithms: FloatArray, alike: BoolArray, known: BoolArray, chance: float) -> BoolArray:
    """Return those of `alike` that do not stand out from the others, the largest dropped first.

    `known`: All, of which only so many may stand out. `chance`: The variance that alike ones show.
    """
    fewest = max(_FEWEST, (1 - _MOST_STANDING_OUT) * np.count_nonzero(known))
    while np.count_nonzero(alike) > fewest:
        largest = np.unravel_index(np.argmax(np.where(alike, logarithms, -np.inf)), alike.shape)
        others = alike.copy()
        others[largest] = False
        spread = math.sqrt(max(float(logarithms[others].var(ddof=1)), chance))
        if logarithms[largest] - logarithms[others].mean() <= _STANDS_OUT * spread:
            break
        alike = others
    return alike


def compute_digamma(x: float) -> float:
    """Return ψ(x), by a difference quotient of ln Γ: to 1e-7, where variances are known to a third."""
    return (math.lgamma(x + _STEP) - math.lgamma(x - _STEP)) / (2 * _STEP)


def compute_trigamma(x: float) -> float:
    """Return ψ′(x) for x ≥ 1/2, by its recurrence and its asymptotic series."""
    total = 0.0
    while x < 6:  # where the series is good to 1e-7
        total += 1 / x**2
        x += 1
    return total + 1 / x + 1 / (2 * x**2) + 1 / (6 * x**3) - 1 / (30 * x**5)


def compute_inverse_trigamma(value: float) -> float:
    """Return x with ψ′(x) = value, by bisection over all that matters."""
    low, high = 1e-2, 1e6
    for _ in range(60):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if compute_trigamma(middle) > value else (low, middle)
    return low
