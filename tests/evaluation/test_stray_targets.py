"""A target that stands apart in every run from the curve that all others make."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport.evaluation.stray_targets import Stray, find_stray_target, join_found_in_both

TARGETS = np.array([3.1, 104.2, 201.7, 303.9, 398.3, 502.6, 601.4, 703.8, 799.2, 902.5, 996.4])
STEP = 0.01


def healthy(seed: int, *, kink: float = 0.0) -> np.ndarray:
    """Return readings of an axis, µm, (position, run): a bow, a scatter, and if asked a kink on its way."""
    generator = np.random.default_rng(seed)
    share = TARGETS / TARGETS[-1]
    curve = generator.uniform(-6, 6) * share + 2 * np.sin(generator.uniform(2, 12) * share)
    curve += kink * np.maximum(share - generator.uniform(0.2, 0.8), 0)
    return np.round(curve[:, np.newaxis] + 0.4 * generator.standard_normal((11, 5)), 2)


@pytest.mark.parametrize("position", [0, 1, 4, 10])
def test_a_target_that_lies_off_in_every_run_is_found(position: int) -> None:
    readings = healthy(1)
    readings[position] += 60

    found = find_stray_target(TARGETS, readings, STEP)

    assert found is not None
    assert found.position == position
    assert found.distance == pytest.approx(60, abs=6)


@pytest.mark.parametrize("kink", [0.0, 60.0])
def test_healthy_axes_have_none(kink: float) -> None:
    found = [find_stray_target(TARGETS, healthy(seed, kink=kink), STEP) for seed in range(200)]

    assert found == [None] * 200


def test_an_outlier_of_one_run_is_no_stray_target() -> None:
    readings = healthy(2)
    readings[4, 1] += 60

    assert find_stray_target(TARGETS, readings, STEP) is None


def test_few_targets_make_no_curve() -> None:
    readings = healthy(3)[:6]
    readings[3] += 60

    assert find_stray_target(TARGETS[:6], readings, STEP) is None


def test_a_target_that_is_off_in_both_directions_is_told_once() -> None:
    assert join_found_in_both(Stray(4, 60.0), Stray(4, 59.8)) == [Stray(4, 60.0)]
    assert join_found_in_both(Stray(4, 60.0), None) == [Stray(4, 60.0)]
