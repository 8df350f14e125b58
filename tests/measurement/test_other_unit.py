"""A run in another unit than the others."""

from __future__ import annotations

import numpy as np

from zlmreport.measurement.other_unit import find_run_in_another_unit

_RUN = np.repeat([1, 2, 3, 4], 5)
_DEVIATION = np.tile([1e-6, -2e-6, 3e-6, 4e-6, -5e-6], 4)


def test_a_run_a_thousand_times_as_small_as_the_others_is_found() -> None:
    assert find_run_in_another_unit(_RUN, np.where(_RUN == 3, 1e-3 * _DEVIATION, _DEVIATION)) == 3


def test_a_run_a_thousand_times_as_large_is_found_where_readings_are_missing() -> None:
    deviation = np.where(_RUN == 2, 1e3 * _DEVIATION, _DEVIATION)
    deviation[[0, 6, 7]] = np.nan
    assert find_run_in_another_unit(_RUN, deviation) == 2


def test_two_runs_do_not_tell_which_of_them_it_is() -> None:
    two = _RUN <= 2
    assert find_run_in_another_unit(_RUN[two], np.where(_RUN == 2, 1e3 * _DEVIATION, _DEVIATION)[two]) is None


def test_runs_of_all_sizes_are_no_matter_of_units() -> None:
    assert find_run_in_another_unit(_RUN, 30.0**_RUN * _DEVIATION) is None


def test_no_reading_is_no_run() -> None:
    assert find_run_in_another_unit(_RUN, np.full(20, np.nan)) is None
