"""Mann's and Kendall's test against the count of all orders."""

from __future__ import annotations

import math
from itertools import combinations, permutations

import numpy as np
import pytest

from zlmreport.fleet.trend import rank_p_value


def surplus(values: tuple[float, ...]) -> int:
    signs = np.sign(np.subtract.outer(values, values))
    return int(np.tril(signs).sum())


def counted(values: tuple[float, ...]) -> float:
    """Return the share of all orders that have as large a surplus."""
    own = abs(surplus(values))
    orders = list(permutations(range(len(values))))
    return sum(abs(surplus(order)) >= own for order in orders) / len(orders)


@pytest.mark.parametrize(
    "values",
    [
        (1.0, 2.0, 3.0, 4.0, 5.0),
        (5.0, 4.0, 3.0, 2.0, 1.0),
        (2.0, 1.0, 3.0, 5.0, 4.0),
        (3.0, 1.0, 2.0, 6.0, 4.0, 5.0),
        (1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 6.0),
        (2.0, 1.0),
    ],
)
def test_the_chance_is_the_share_of_all_orders(values: tuple[float, ...]) -> None:
    assert rank_p_value(values) == pytest.approx(counted(values), rel=1e-12)


def test_a_surplus_of_none_is_no_trend() -> None:
    assert rank_p_value((1.0, 4.0, 3.0, 2.0)) == 1.0


@pytest.mark.parametrize(
    "values",
    [
        (1.0, 2.0, 2.0, 4.0, 5.0),
        (1.0, 1.0, 2.0, 2.0, 3.0),
        (1.0, 1.0, 1.0, 2.0, 3.0),
        (3.0, 1.0, 2.0, 2.0, 4.0, 4.0),
        (1.0, 1.0, 1.0, 1.0, 1.0),
    ],
)
def test_equal_values_make_the_chance_too_large_rather_than_too_small(values: tuple[float, ...]) -> None:
    own = abs(surplus(values))
    orders = list(permutations(values))
    assert rank_p_value(values) >= sum(abs(surplus(order)) >= own for order in orders) / len(orders)


def test_one_odd_value_at_the_end_is_no_trend() -> None:
    assert rank_p_value((5.1, 4.9, 5.2, 5.0, 4.8, 90.0)) > 0.5


def test_many_values_have_the_chance_that_counting_gives() -> None:
    # Fifty values that go up and down in sevens, and rise a little over all.
    values = [index * 3 % 7 + 0.02 * index for index in range(50)]
    falls = sum(later < earlier for earlier, later in combinations(values, 2))
    orders = [1]
    for joined in range(2, 51):
        longer = [0] * (len(orders) + joined - 1)
        for number, count in enumerate(orders):
            for more in range(joined):
                longer[number + more] += count
        orders = longer
    expected = 2 * sum(orders[: falls + 1]) / math.factorial(50)
    assert 0.01 < expected < 0.5
    assert rank_p_value(values) == pytest.approx(expected, rel=0.02)
