"""When the axis stands still, and what its reading is then."""

from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from zlmreport.live.capture.standstill import Window
from zlmreport.plugin.instrument import LiveReading

DWELL = 10.0


def filled(values: list[float], stability: float = 3.0) -> Window:
    """Return a window after readings a second apart."""
    window = Window(stability, DWELL, DWELL / 2)
    for time, value in enumerate(values):
        window.add(LiveReading(float(value), float(time)), 0)
    return window


def longest_still(values: list[float], stability: float) -> list[float]:
    """Return the last values that keep within a range, over the dwell at most: found by trying all."""
    last = values[-int(DWELL) - 1 :]
    return next(
        last[begin:] for begin in range(len(last)) if max(last[begin:]) - min(last[begin:]) <= stability
    )


@given(st.lists(st.integers(0, 8), min_size=1, max_size=60), st.integers(0, 8))
def test_it_holds_the_latest_readings_that_keep_within_the_range(values: list[int], stability: int) -> None:
    window, expected = filled(values, stability), longest_still(values, stability)
    assert window.bounds == (min(expected), max(expected))
    assert window.is_still == (len(expected) > DWELL)


@given(st.lists(st.integers(0, 3), min_size=1, max_size=60))
def test_the_mean_is_that_of_the_later_half_of_the_dwell(values: list[int]) -> None:
    averaged = values[-int(DWELL / 2) - 1 :]
    mean = filled(values).compute_mean()
    assert mean.count == len(averaged)
    assert mean.value == pytest.approx(sum(averaged) / len(averaged), abs=1e-12)
    assert mean.duration == len(averaged) - 1


def test_the_end_of_the_arrival_is_not_averaged() -> None:
    arriving = filled([*range(4), *[3] * int(DWELL - 3)])
    assert arriving.is_still
    assert arriving.compute_mean().value == 3
    assert arriving.compute_mean().range == 3


def test_after_an_hour_of_standstill_only_the_last_dwell_counts() -> None:
    window = filled([1.0] * 3600)
    assert window.duration == DWELL
    assert window.compute_mean().count == DWELL / 2 + 1


def test_what_was_lost_before_its_first_reading_is_not_of_the_window() -> None:
    window = Window(1.0, DWELL, DWELL / 2)
    window.add(LiveReading(0.0, 0.0), 7)
    window.add(LiveReading(0.0, 1.0), 2)
    assert window.compute_mean().skipped == 2


def test_a_mean_of_large_values_loses_no_digit() -> None:
    window = filled([1e6 + 1e-9 * (number % 2) for number in range(10)])
    assert window.compute_mean().value - 1e6 == pytest.approx(0.5e-9, abs=2e-10)


def test_an_empty_window_is_not_still() -> None:
    window = filled([1.0] * 20)
    window.clear()
    assert not window.is_still
    assert window.range == 0.0
