"""A large stack of simulated tests is one call, without copies of the stack."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from plugins.standards.installed import STANDARDS
from zlmreport.plugin.standard import position_statistics

STACK = np.random.default_rng(5).normal(scale=1e-6, size=(3, 1000, 2, 21, 5))


def test_statistics_of_a_stack_take_less_than_twice_its_memory() -> None:
    tracemalloc.start()
    position_statistics(STACK)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()

    assert peak < 2 * STACK.nbytes


@pytest.mark.parametrize("identifier", STANDARDS)
def test_a_standard_takes_less_than_twice_the_memory_of_a_stack(identifier: str) -> None:
    standard = STANDARDS[identifier]
    statistics = position_statistics(STACK)
    tracemalloc.start()
    found = standard.arithmetic(statistics, standard.options())
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()

    assert peak < 2 * STACK.nbytes
    assert {values.shape for values in found.parameters.values()} == {(3, 1000)}
    assert {values.shape for values in found.positions.values()} == {(3, 1000, 21)}
