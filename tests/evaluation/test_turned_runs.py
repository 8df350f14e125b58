"""Runs whose reversal, or whose sign, is not that of the others."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport.evaluation.turned_runs import find_mirrored_run, find_run_of_another_reversal


def readings(seed: int = 1, *, reversal: float = 0.8, runs: int = 5) -> np.ndarray:
    """Return readings of 11 targets, µm, (direction, target, run): a curve of 3, a scatter of 0.4."""
    generator = np.random.default_rng(seed)
    curve = 1.5 * np.sin(np.linspace(0, 6, 11))[:, np.newaxis]
    sides = np.array([reversal / 2, -reversal / 2])[:, np.newaxis, np.newaxis]
    return np.asarray(curve + sides + 0.4 * generator.standard_normal((2, 11, runs)))


@pytest.mark.parametrize("run", range(5))
def test_a_run_with_its_directions_interchanged_has_the_reversal_of_the_others_turned(run: int) -> None:
    turned = readings()
    turned[..., run] = turned[::-1, :, run]

    found = find_run_of_another_reversal(turned)

    assert found is not None
    assert (found.run, found.is_interchanged) == (run, True)
    assert found.reversal == pytest.approx(-0.8, abs=0.5)
    assert found.of_others == pytest.approx(0.8, abs=0.3)


def test_a_run_that_comes_back_elsewhere_is_not_interchanged() -> None:
    moved = readings()
    moved[1, :, 3] -= 6

    found = find_run_of_another_reversal(moved)

    assert found is not None
    assert (found.run, found.is_interchanged) == (3, False)


@pytest.mark.parametrize("reversal", [0.0, 0.8, 8.0])
def test_runs_of_one_axis_have_one_reversal(reversal: float) -> None:
    found = [find_run_of_another_reversal(readings(seed, reversal=reversal)) for seed in range(200)]

    assert found == [None] * 200


def test_where_every_run_has_a_reversal_of_its_own_none_stands_apart() -> None:
    apart = np.array([0.0, 4.0, -3.0, 2.0, -4.5])
    own = readings()
    own[0] += apart

    assert find_run_of_another_reversal(own) is None


@pytest.mark.parametrize("run", range(5))
def test_a_run_with_its_sign_turned_mirrors_the_others(run: int) -> None:
    turned = readings()
    turned[..., run] *= -1

    assert find_mirrored_run(turned) == run


def test_no_run_of_one_axis_mirrors_the_others_and_none_where_there_is_no_curve() -> None:
    flat = np.random.default_rng(1).standard_normal((200, 2, 11, 5))

    assert [find_mirrored_run(readings(seed)) for seed in range(200)] == [None] * 200
    assert [find_mirrored_run(each) for each in flat] == [None] * 200


def test_outliers_at_two_positions_turn_no_run() -> None:
    apart = readings()
    apart[1, 2, 0] += 12
    apart[1, 7, 0] += 6

    assert find_run_of_another_reversal(apart) is None


def test_two_runs_and_three_targets_tell_nothing() -> None:
    turned = readings(runs=2)
    turned[..., 1] = -turned[::-1, :, 1]

    assert find_run_of_another_reversal(turned) is None
    assert find_mirrored_run(turned) is None
    assert find_mirrored_run(readings()[:, :1]) is None


def test_a_target_with_a_gap_is_left_out() -> None:
    turned = readings()
    turned[..., 2] = turned[::-1, :, 2]
    turned[0, 4, 1] = np.nan

    found = find_run_of_another_reversal(turned)

    assert found is not None
    assert found.run == 2
