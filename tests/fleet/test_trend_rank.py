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


def count_orders(number: int) -> list[int]:
    """Return how many orders of so many values have 0, 1, 2 … falls."""
    orders = [1]
    for joined in range(2, number + 1):
        longer = [0] * (len(orders) + joined - 1)
        for falls, count in enumerate(orders):
            for more in range(joined):
                longer[falls + more] += count
        orders = longer
    return orders


def make_order(number: int, falls: int) -> tuple[float, ...]:
    """Return values in an order with so many falls among their pairs."""
    left, placed = falls, []
    for value in range(number, 0, -1):  # each goes before as many larger ones as it can
        behind = min(left, len(placed))
        left -= behind
        placed.insert(len(placed) - behind, float(-value))
    return tuple(-each for each in reversed(placed))


@pytest.mark.parametrize("number", [41, 44, 60])
def test_more_than_forty_values_have_the_variance_that_counting_gives(number: int) -> None:
    """S goes in steps of two: its chance is that of a normal deviate from half way to the next one."""
    orders, pairs = count_orders(number), number * (number - 1) // 2
    total = math.factorial(number)
    squares = sum(count * (pairs - 2 * falls) ** 2 for falls, count in enumerate(orders))
    deviation = math.sqrt(squares / total)
    for share in (0.01, 0.5, 1.5, 2.0):  # deviations from the middle
        falls = round((pairs - share * deviation) / 2)
        values = make_order(number, falls)
        assert surplus(values) == pairs - 2 * falls
        normal = math.erfc((surplus(values) - 1) / deviation / math.sqrt(2))
        assert rank_p_value(values) == pytest.approx(min(1.0, normal), rel=1e-9)
        counted = min(1.0, 2 * sum(orders[: falls + 1]) / total)
        assert rank_p_value(values) == pytest.approx(counted, abs=3e-3)
        assert rank_p_value(values[::-1]) == rank_p_value(values)


def test_many_values_have_the_chance_that_counting_gives() -> None:
    # Fifty values that go up and down in sevens, and rise a little over all.
    values = [index * 3 % 7 + 0.02 * index for index in range(50)]
    falls = sum(later < earlier for earlier, later in combinations(values, 2))
    orders = count_orders(50)
    expected = 2 * sum(orders[: falls + 1]) / math.factorial(50)
    assert 0.01 < expected < 0.5
    assert rank_p_value(values) == pytest.approx(expected, rel=0.02)
