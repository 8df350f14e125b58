"""Every parameter and every column of all standards, against plain Python written from the formulas."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

from plugins.standards.installed import STANDARDS
from plugins.standards.oracle import evaluated_plainly
from zlmreport.plugin import FloatArray
from zlmreport.plugin.standard import position_statistics

#: Some tens of operations, each rounded to a double, on readings that cancel to no less than this part.
RELATIVE = 1e-12

COMPLETE, GAPS, HOLES, UPWARDS, DOWNWARDS, ONE_RUN = (
    "complete",
    "readings missing",
    "targets without a direction",
    "positive direction only",
    "negative direction only",
    "a single run",
)


def a_test(kind: str, seed: int) -> FloatArray:
    """Return the deviations of a random test, (approach, position, run), m."""
    chance = random.Random(seed)
    targets, runs = chance.randint(2, 25), 1 if kind == ONE_RUN else chance.randint(2, 10)
    scatter, lost_motion = chance.uniform(0.1, 20), chance.uniform(-30, 30)
    grid = np.array(
        [
            [
                [slope + direction * lost_motion / 2 + chance.gauss(0, scatter) for _ in range(runs)]
                for slope in (chance.uniform(-50, 50) for _ in range(targets))
            ]
            for direction in (1, -1)
        ]
    )
    if kind == GAPS:
        for place in chance.sample(list(np.ndindex(grid.shape)), grid.size // 6):
            grid[place] = np.nan
    if kind == HOLES:
        for target in chance.sample(range(targets), max(1, targets // 3)):
            grid[chance.randint(0, 1), target] = np.nan
    if kind == UPWARDS:
        grid[1] = np.nan
    if kind == DOWNWARDS:
        grid[0] = np.nan
    return grid * 1e-6


def by_target(direction: FloatArray) -> list[list[float]]:
    return [[x for x in readings if not math.isnan(x)] for readings in direction.tolist()]


def differences(found: FloatArray, expected: list[float | None], scale: float) -> list[str]:
    return [
        f"{place}: {value!r} instead of {true!r}"
        for place, (value, true) in enumerate(zip(np.atleast_1d(found).tolist(), expected, strict=True))
        if (math.isnan(value) if true is None else abs(value - true) <= RELATIVE * max(abs(true), scale))
        is False
    ]


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("kind", [COMPLETE, GAPS, HOLES, UPWARDS, DOWNWARDS, ONE_RUN])
@pytest.mark.parametrize("identifier", STANDARDS)
def test_agrees_with_the_formulas_in_plain_python(identifier: str, kind: str, seed: int) -> None:
    grid = a_test(kind, seed)
    standard = STANDARDS[identifier]
    found = standard.arithmetic(position_statistics(grid), standard.options())
    expected = evaluated_plainly(identifier, by_target(grid[0]), by_target(grid[1]))
    scale = float(np.nanmax(np.abs(grid)))

    assert found.parameters.keys() == expected.parameters.keys()
    assert found.positions.keys() == expected.positions.keys()
    wrong = {
        symbol: differences(found.parameters[symbol], [value], scale)
        for symbol, value in expected.parameters.items()
    } | {
        f"{symbol} by position": differences(found.positions[symbol], values, scale)
        for symbol, values in expected.positions.items()
    }
    assert {symbol: message for symbol, message in wrong.items() if message} == {}


@pytest.mark.parametrize("identifier", STANDARDS)
def test_oracle_and_program_are_compared_on_defined_values(identifier: str) -> None:
    grid = a_test(COMPLETE, 0)

    expected = evaluated_plainly(identifier, by_target(grid[0]), by_target(grid[1]))

    assert None not in expected.parameters.values()
