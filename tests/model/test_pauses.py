"""Pauses between runs: a night is no time in which anything was followed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import linear_test
from model.worlds import with_night
from zlmreport.model.fitting.pauses import compute_working_time, find_pauses

_DESIGN = linear_test(9, 3)


def test_test_without_a_pause_has_its_own_time() -> None:
    assert not find_pauses(_DESIGN).any()
    assert compute_working_time(_DESIGN) is _DESIGN.time


def test_night_between_two_runs_is_a_pause() -> None:
    design = with_night(_DESIGN, run=2)
    assert np.flatnonzero(find_pauses(design)).tolist() == [2 * 18 - 1]


def test_working_time_leaves_the_night_out() -> None:
    assert compute_working_time(with_night(_DESIGN, run=2)) == pytest.approx(_DESIGN.time)


def test_counted_readings_know_no_pause() -> None:
    design = replace(with_night(_DESIGN, run=2), time_is_counted=True)
    assert not find_pauses(design).any()
