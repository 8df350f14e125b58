"""What readings show by themselves: runs that are copies or turned, a target that stands apart."""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np
import pytest

from document.certificate.documents import job
from zlmreport.evaluation.evidence import find_evidence
from zlmreport.plugin import Language
from zlmreport.plugin.extension import Job
from zlmreport.testing import bidirectional_test

TARGETS = np.array([3.1, 104.2, 201.7, 303.9, 398.3, 502.6, 601.4, 703.8, 799.2, 902.5, 996.4])
Spoil = Callable[[np.ndarray], None]


@pytest.fixture(scope="module")
def of(tmp_path_factory: pytest.TempPathFactory) -> Job:
    return job(tmp_path_factory.mktemp("evidence"))


def honest(  # noqa: PLR0913 - what readings of an axis depend on
    seed: int,
    *,
    curve: float = 2.0,
    slope: float = 6.0,
    kink: float = 0.0,
    reversal: float = 0.8,
    change: float = 0.0,
    step: float = 0.01,
    runs: int = 5,
) -> np.ndarray:
    """Return readings, µm, (direction, target, run): a bow, a scatter of 0.4, and if asked a kink.

    `change`: Of the reversal, from the first target to the last.
    """
    generator = np.random.default_rng(seed)
    share = TARGETS / TARGETS[-1]
    bow = curve * np.sin(generator.uniform(2, 12) * share) + slope * generator.uniform(-1, 1) * share
    bow += kink * np.maximum(share - generator.uniform(0.2, 0.8), 0)
    sides = np.array([0.5, -0.5])[:, np.newaxis] * (reversal + change * share)
    true = (bow + sides)[..., np.newaxis] + 0.4 * generator.standard_normal((2, len(TARGETS), runs))
    return np.asarray(np.round(true / step) * step)


def shown(of: Job, readings: np.ndarray, targets: np.ndarray = TARGETS) -> str:
    found = find_evidence(of, bidirectional_test(targets, *readings))
    return "\n".join(each.in_language(Language.ENGLISH) for each in found)


@pytest.mark.parametrize(
    "axis",
    [
        {},
        {"runs": 1},
        {"step": 0.4},
        {"reversal": 0.0},
        {"reversal": 8.0},
        {"change": 2.0},
        {"kink": 60.0},
        {"curve": 0.0, "slope": 0.0},
    ],
    ids=str,
)
def test_honest_axes_show_nothing(of: Job, axis: dict[str, float]) -> None:
    assert [shown(of, honest(seed, **axis)) for seed in range(100)] == [""] * 100


def test_scatter_with_long_tails_turns_no_run(of: Job) -> None:
    curve = np.mean(honest(1), axis=2, keepdims=True)
    for seed in range(30):
        tails = 0.3 * np.random.default_rng(seed).standard_t(3, (2, len(TARGETS), 5))
        said = shown(of, np.round(curve + tails, 2))
        assert "mirrors" not in said
        assert "reversal" not in said
        assert "counter" not in said


# --- copies


def with_a_digit_changed(series: np.ndarray) -> None:
    series[..., 3] = series[..., 1]
    series[0, 7, 3] += 0.03


def moved_by_a_constant(series: np.ndarray) -> None:
    series[..., 3] = series[..., 1] + 1.7


def moved_where_a_reading_is_missing(series: np.ndarray) -> None:
    moved_by_a_constant(series)
    series[0, 4, 3] = np.nan


@pytest.mark.parametrize(
    "spoil", [with_a_digit_changed, moved_by_a_constant, moved_where_a_reading_is_missing]
)
def test_a_run_that_was_copied_and_touched_up_is_found(of: Job, spoil: Spoil) -> None:
    readings = honest(1)
    spoil(readings)
    assert "Runs 2, 4 differ by a constant only, but for single digits" in shown(of, readings)


def test_runs_that_are_all_copies_of_one_are_one_group(of: Job) -> None:
    readings = np.repeat(honest(2, runs=1), 4, axis=2)
    for run in range(1, 4):
        readings[0, run, run] += 0.05
    assert "Runs 1, 2, 3, 4 differ by a constant only" in shown(of, readings)


def test_a_copy_with_many_digits_changed_is_found_among_the_readings_of_a_record(of: Job) -> None:
    generator = np.random.default_rng(3)
    series = np.round(3 * generator.standard_normal((7200, 3)), 1)
    series[:, 1] = series[:, 0]
    altered = generator.permutation(7200)
    series[altered[:300], 1] += 0.1
    assert "Runs 1, 2 differ" in shown(of, series.reshape(2, 3600, 3), np.arange(3600.0))
    series[altered[300:400], 1] += 0.1  # now more than a twentieth
    assert "Runs 1, 2 differ" not in shown(of, series.reshape(2, 3600, 3), np.arange(3600.0))


@pytest.mark.parametrize(("missing", "is_copy"), [(0, True), (1, False)])
def test_six_readings_tell_of_a_copy_and_five_do_not(of: Job, missing: int, *, is_copy: bool) -> None:
    readings = honest(1, runs=3)[:, :3]
    readings[..., 2] = readings[..., 1] + 1.7
    readings[0, :missing, 2] = np.nan
    assert ("Runs 2, 3 differ" in shown(of, readings, TARGETS[:3])) is is_copy


def test_runs_that_each_stand_still_are_no_copies(of: Job) -> None:
    readings = np.broadcast_to(np.arange(5.0), (2, len(TARGETS), 5))
    assert "differ by a constant" not in shown(of, readings)


# --- runs whose reversal, or whose sign, is not that of the others


@pytest.mark.parametrize("run", [0, 4])
def test_a_run_with_its_directions_interchanged_has_the_reversal_of_the_others_turned(
    of: Job, run: int
) -> None:
    readings = honest(1)
    readings[..., run] = readings[::-1, :, run]
    readings[0, 4, 1] = np.nan  # a target with a gap is left out
    found = re.search(
        r"reversal of run (\d) is −(\S+) µm in the mean, and (\S+) µm in the others: its directions seem to",
        shown(of, readings),
    )
    assert int(found[1]) == run + 1
    assert float(found[2]) == pytest.approx(0.8, abs=0.5)
    assert float(found[3]) == pytest.approx(0.8, abs=0.3)


def test_where_every_run_has_a_reversal_of_its_own_none_stands_apart(of: Job) -> None:
    readings = honest(1)
    readings[0] += np.array([0.0, 4.0, -3.0, 2.0, -4.5])
    assert "reversal" not in shown(of, readings)


@pytest.mark.parametrize("run", [0, 4])
def test_a_run_with_its_sign_turned_mirrors_the_others(of: Job, run: int) -> None:
    readings = honest(1) + 2 * np.arange(5)  # the runs drift
    readings[..., run] *= -1
    first, *others = shown(of, readings).splitlines()
    assert first == f"Run {run + 1} mirrors the others: the sign of its deviations seems to be turned"
    assert not any("lies" in each for each in others)  # outliers that follow from it


@pytest.mark.parametrize("run", [0, 4])
def test_a_run_in_reverse_order_of_the_targets_mirrors_the_others(of: Job, run: int) -> None:
    readings = honest(1, slope=12.0)
    readings[..., run] = readings[:, ::-1, run]
    assert shown(of, readings).splitlines() == [
        f"Run {run + 1} mirrors the others: its readings seem to stand in reverse order of the targets"
    ]


def test_a_straight_line_that_falls_in_one_run_is_turned_either_way(of: Job) -> None:
    readings = honest(1, curve=0.0, slope=0.0, reversal=0.0) + 20 * (TARGETS / TARGETS[-1])[:, np.newaxis]
    readings[..., 2] = readings[:, ::-1, 2]
    assert shown(of, readings) == (
        "Run 3 mirrors the others: the sign of its deviations seems to be turned, or its readings stand in "
        "reverse order of the targets"
    )


def test_outliers_beside_a_turned_run_are_told_after_it(of: Job) -> None:
    readings = honest(1)
    readings[0, 3, 0] += 6
    readings[..., 4] *= -1
    first, *others = shown(of, readings).splitlines()
    assert first.startswith("Run 5 mirrors")
    assert [each[:24] for each in others] == ["The reading of run 1 at "]


def test_outliers_at_two_positions_turn_no_run(of: Job) -> None:
    readings = honest(1)
    readings[1, 2, 0] += 12
    readings[1, 7, 0] += 6
    assert "reversal" not in shown(of, readings)


@pytest.mark.parametrize(
    ("runs", "targets", "tells"), [(2, 11, False), (3, 11, True), (5, 3, False), (5, 4, True)]
)
def test_two_runs_or_three_targets_tell_nothing(of: Job, runs: int, targets: int, *, tells: bool) -> None:
    readings = honest(1, runs=runs, reversal=3.0)[:, :targets]
    readings[..., 1] = readings[::-1, :, 1]
    assert ("interchanged" in shown(of, readings, TARGETS[:targets])) is tells


def test_two_runs_of_which_one_mirrors_the_other_are_both_right(of: Job) -> None:
    readings = honest(1, runs=2)
    readings[..., 1] *= -1
    assert "mirrors" not in shown(of, readings)


@pytest.mark.parametrize(
    ("up", "down", "is_counter"), [(3.0, -3.0, True), (0.3, -0.3, False), (3.0, -1.5, False)]
)
def test_directions_run_counter_where_they_mirror_each_other_beyond_scatter(
    of: Job, up: float, down: float, *, is_counter: bool
) -> None:
    wave = np.sin(5 * TARGETS / TARGETS[-1])
    means = np.stack([up * wave, down * wave])
    said = shown(of, np.round(means[..., np.newaxis] + np.array([-0.5, 0.25, 0.0, -0.25, 0.5]), 2))
    assert ("run counter to each other" in said) is is_counter


# --- a target that stands apart in every run


@pytest.mark.parametrize("target", [0, 1, 4, 10])
def test_a_target_that_lies_off_in_every_run_is_found_and_told_once(of: Job, target: int) -> None:
    readings = honest(1, slope=60.0)
    readings[:, target] += 60
    (found,) = shown(of, readings).splitlines()
    distance = re.match(rf"The target at {TARGETS[target]:g} mm lies (\S+) µm off the line", found)
    assert float(distance[1]) == pytest.approx(60, abs=6)


def test_a_target_that_lies_off_in_one_direction_is_found(of: Job) -> None:
    readings = honest(1)
    readings[1, 4] += 60
    assert "The target at 398.3 mm" in shown(of, readings)


def test_a_target_apart_in_each_direction_is_told_each(of: Job) -> None:
    readings = honest(1)
    readings[0, 4] += 60
    readings[1, 8] += 60
    found = shown(of, readings)
    assert "The target at 398.3 mm" in found
    assert "The target at 799.2 mm" in found


def test_an_outlier_of_one_run_is_no_stray_target(of: Job) -> None:
    readings = honest(2)
    readings[0, 4, 1] += 60
    assert "The target" not in shown(of, readings)


def test_few_targets_make_no_curve(of: Job) -> None:
    readings = honest(3)[:, :6]
    readings[:, 3] += 60
    assert shown(of, readings, TARGETS[:6]) == ""
