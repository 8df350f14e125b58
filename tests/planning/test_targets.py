"""Targets at random fractions of a period."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from zlmreport.planning.targets import target_positions


def _random(seed: int = 1) -> np.random.Generator:
    return np.random.default_rng(seed)


@given(seed=st.integers(0, 2**32), count=st.integers(2, 60), share=st.floats(0.0, 0.999))
def test_targets_rise_within_the_travel(seed: int, count: int, share: float) -> None:
    period = share * 1.2 / count  # a period of 1.2 m / count just fits
    targets = target_positions((-0.2, 1.0), count, period, _random(seed))
    assert np.all(np.diff(targets) > 0)
    assert targets[0] >= -0.2
    assert targets[-1] <= 1.0 + 1e-12


def test_each_target_is_its_multiple_of_the_interval_and_a_fraction_of_the_period() -> None:
    targets = target_positions((0.0, 1.0), 11, 0.01, _random())
    fraction = targets - 0.099 * np.arange(11)
    assert np.all((fraction >= 0) & (fraction < 0.01))
    assert len(set(fraction.round(12))) == 11


def test_without_a_period_targets_are_even() -> None:
    np.testing.assert_array_equal(target_positions((0.0, 4.0), 5, 0.0, _random()), [0, 1, 2, 3, 4])


def test_the_same_seed_gives_the_same_targets() -> None:
    one, other = (target_positions((0.0, 1.0), 11, 0.01, _random(5)) for _ in range(2))
    np.testing.assert_array_equal(one, other)


def test_too_many_targets_are_refused_with_how_many_would_fit() -> None:
    with pytest.raises(ValueError, match=r"101 targets .* do not fit into the travel; up to 100 do"):
        target_positions((0.0, 1.0), 101, 0.01, _random())
