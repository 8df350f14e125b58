"""The test of H. B. Mann and M. G. Kendall: whether later values tend to be larger, or smaller.

It knows only which of two values is the larger. One odd calibration, however far off, cannot make a trend
of it, and the values need not be normally distributed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from itertools import combinations

import numpy as np

from zlmreport.model.distributions import normal_tail

#: Up to so many values the chance is counted; beyond, S is as good as normally distributed.
_MOST_COUNTED = 40


def rank_p_value(values: Sequence[float]) -> float:
    """Return the chance of so many rises over falls, or falls over rises, where nothing drifts (two-sided).

    Equal values count as neither, and half a fall is taken as a whole one: with ties the chance comes out too
    large rather than too small.

    Parameters
    ----------
    values
        In the order of time, two or more.
    """
    surplus = abs(sum((later > earlier) - (later < earlier) for earlier, later in combinations(values, 2)))
    number = len(values)
    if number > _MOST_COUNTED:
        deviation = math.sqrt(number * (number - 1) * (2 * number + 5) / 18)
        return min(1.0, 2 * normal_tail((surplus - 1) / deviation))
    # With `falls` falls among n(n − 1)/2 pairs the surplus of rises is n(n − 1)/2 − 2·falls.
    most_falls = (number * (number - 1) // 2 - surplus + 1) // 2
    return min(1.0, 2 * _chance_of_falls(number)[most_falls])


@cache
def _chance_of_falls(number: int) -> tuple[float, ...]:
    """Return the chance of at most 0, 1, 2 … falls among the pairs of so many values in random order.

    The n-th value joins n − 1 others anywhere in their order, and so adds 0 to n − 1 falls, each as likely.
    """
    chances = np.ones(1)
    for joined in range(2, number + 1):
        chances = np.convolve(chances, np.full(joined, 1 / joined))
    return tuple(np.cumsum(chances).tolist())
