"""Copied readings: a series that is another one as it is, moved by a constant, or but for a digit.

Two series of one axis differ by its scatter. Where the last digit shows that, the differences of two honest
series are hardly ever all but one the same; where it does not, two honest series look like copies, and
nobody can tell. How often differences agree by chance the other pairs of runs tell.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import combinations

import numpy as np

from zlmreport.measurement.arrays import FloatArray

#: Readings that both series must have for their agreement to say anything.
_FEWEST = 6
#: Part of the readings of a copy that may have been altered; one in any case.
_ALTERED = 0.05
#: Probability of a copy by chance, of all pairs together, below which it is none.
_BY_CHANCE = 1e-4
#: Share of equal differences from which the last digit hides the scatter of most pairs.
_HIDDEN = 0.9


def estimate_agreement_by_chance(series: FloatArray, step: float) -> float:
    """Return the share of equal differences that two series usually have: its median over all pairs.

    `series`: (reading, series), m or rad; NaN where there is none.
    `step`: Of the last digit, m or rad.

    Returns 1 where there are no two series.
    """
    pairs = combinations(range(series.shape[1]), 2)
    shares = [
        equal / count
        for one, other in pairs
        for equal, count in (_count_equal_differences(series[:, one], series[:, other], step),)
        if count
    ]
    return float(np.median(shares)) if shares else 1.0


def are_nearly_copies(one: FloatArray, other: FloatArray, step: float, by_chance: float, pairs: int) -> bool:
    """Return whether two series differ by a constant, but for one reading or few.

    `by_chance`: The share of equal differences of honest series; `pairs`: how many pairs are looked at.
    """
    equal, count = _count_equal_differences(one, other, step)
    if count < _FEWEST or count - equal > max(1, int(_ALTERED * count)):
        return False
    return by_chance >= _HIDDEN or pairs * _compute_chance_of_at_least(equal, count, by_chance) < _BY_CHANCE


def group_copies(series: FloatArray, step: float) -> Sequence[Sequence[int]]:
    """Return which series are copies of each other, each group by the columns of `series`, two at least."""
    count = series.shape[1]
    by_chance, pairs = estimate_agreement_by_chance(series, step), count * (count - 1) // 2
    return group_alike(series, lambda one, other: are_nearly_copies(one, other, step, by_chance, pairs))


def group_alike(
    series: FloatArray, are_alike: Callable[[FloatArray, FloatArray], bool]
) -> Sequence[Sequence[int]]:
    """Return which series are alike to the first of their group, each group by the columns, two at least."""
    groups: list[list[int]] = []
    for number in range(series.shape[1]):
        for group in groups:
            if are_alike(series[:, group[0]], series[:, number]):
                group.append(number)
                break
        else:
            groups.append([number])
    return [group for group in groups if len(group) > 1]


def _count_equal_differences(one: FloatArray, other: FloatArray, step: float) -> tuple[int, int]:
    """Return of how many readings the difference is the commonest one, and how many there are.

    Nothing of rows of one value, that differ by a constant whatever they were: (0, 0).
    """
    both = np.isfinite(one) & np.isfinite(other)
    if not both.any() or not np.ptp(one[both]) or not np.ptp(other[both]):
        return 0, 0
    _, counts = np.unique(np.round((one[both] - other[both]) / step), return_counts=True)
    return int(counts.max()), int(both.sum())


def _compute_chance_of_at_least(equal: int, count: int, share: float) -> float:
    """Return the probability of `equal` or more of `count` trials of one probability, 0 < `share` < 1."""
    # By logarithms: of the thousands of readings of a circle the numbers of ways are no doubles any more.
    return math.fsum(
        math.exp(
            math.lgamma(count + 1)
            - math.lgamma(each + 1)
            - math.lgamma(count - each + 1)
            + each * math.log(share)
            + (count - each) * math.log1p(-share)
        )
        for each in range(equal, count + 1)
    )
